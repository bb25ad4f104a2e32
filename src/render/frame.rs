//! The frame: for each pixel, which sphere is seen, at which root, and what the view shows of it.

use glam::Vec3;

use super::View;
use super::bounds::{Eye, Window};
use super::cover::{BLOCK, Block, Projector};
use super::field::Field;
use super::finish::{self, Lighting};
use super::layer::{Contact, Layer, refill};
use super::nearest::{NOBODY, Nearest, Question, is_before};
use super::shade;
use crate::geometry::{Ray, Sphere};
use crate::method::exact::{self, Stage};
use crate::method::{Class, Method, Place};
use crate::scene::{Rays, Scene, Size};

/// What is seen at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The sphere's place in the scene's list.
    pub body: u32,
    /// The visible root, the least t > 0, as the method gave it; +∞ past the range of binary32.
    pub t: f32,
}

/// What a method lost of the visible root, held against the exact one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lost {
    /// So many bits, 0 to 24: log2(1 + the error in ulps).
    Bits(f32),
    /// The method sees another sphere than there is, one where there is none, or none.
    Everything,
}

/// The least Δ/(4Ar²) of a miss that [`View::Delta`] shows: the line passes the centre at 2r.
pub(super) const FARTHEST_MISS: f32 = -3.0;

/// The answers for the pixels of one picture, in arrays that are kept from frame to frame.
///
/// A picture is the same in whatever order its spheres are asked: the least t wins, and of two
/// spheres at equal t the one listed first.
#[derive(Debug, Clone)]
pub struct Frame {
    view: View,
    method: Method,
    field: Field,
    seen: Layer,
    /// Whether the roots of `seen` are the method's own, and not only about where they are.
    has_roots: bool,
    /// What `exact` sees, in the view that compares the two.
    truth: Layer,
    nearest: Nearest,
    block: Block,
    /// What the view shows of each pixel, if that is a number: its brightness, Δ/(4Ar²), the bits
    /// lost, the place of its stage among all.
    value: Vec<f32>,
    /// The least and the greatest finite root seen.
    range: Option<[f32; 2]>,
}

impl Default for Frame {
    fn default() -> Self {
        Self {
            view: View::default(),
            method: Method::default(),
            field: Field::default(),
            seen: Layer::default(),
            has_roots: true,
            truth: Layer::default(),
            nearest: Nearest::default(),
            block: Block::default(),
            value: Vec::new(),
            range: None,
        }
    }
}

impl Frame {
    /// A frame of no pixels.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks `method` what the rays hit, and works out what the view shows of it.
    pub fn render(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) {
        self.reset(rays, method, view);
        if self.method == Method::Exact && view.shows_only_what_is_seen() {
            self.ask_nearest(scene, rays);
            self.finish(scene);
        } else {
            let eye = Eye::new(rays);
            let reach = if view == View::Delta { 2.0 } else { 1.0 };
            self.ask_windows(scene, |sphere| eye.window(sphere, reach));
        }
    }

    /// As [`Frame::render`], but asks about every sphere at every pixel: what `render` must equal,
    /// bit for bit.
    pub fn render_all(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) {
        self.reset(rays, method, view);
        self.ask_windows(scene, |_| Window::whole(rays.size));
    }

    fn reset(&mut self, rays: &Rays, method: Method, view: View) {
        self.view = view;
        self.method = if view == View::Stage {
            Method::Exact
        } else {
            method
        };
        self.range = None;
        self.has_roots = true;
        self.field.aim(rays);
    }

    /// Asks for the nearest hits by the certified way.
    fn ask_nearest(&mut self, scene: &Scene, rays: &Rays) {
        self.nearest.clear(&self.field);
        let projector = Projector::new(rays);
        let question = Question {
            field: &self.field,
            bodies: &scene.bodies,
        };
        for (first, bodies) in (0..).step_by(BLOCK).zip(scene.bodies.chunks(BLOCK)) {
            projector.bound(bodies, &mut self.block);
            for i in 0..bodies.len() {
                if self.block.is_behind(i) {
                    continue;
                }
                let (bounds, least) = (self.block.bounds(i), self.block.least(i));
                if bounds.is_empty() || self.nearest.hides(bounds, least) {
                    continue;
                }
                self.nearest.ask(&question, first + i as u32, bounds, least);
            }
        }
        self.nearest.trim(&self.field);
    }

    /// Works out, once for each pixel, what the view asks of what is seen there.
    fn finish(&mut self, scene: &Scene) {
        let places = self.field.places();
        self.seen.resize(places);
        self.value.resize(places, 0.0);
        let question = Question {
            field: &self.field,
            bodies: &scene.bodies,
        };
        self.has_roots = self.view.shows_roots();
        finish::identify(&question, &self.nearest, &mut self.seen, self.has_roots);
        match self.view {
            View::Shade => {
                let lighting = Lighting::new(scene.light);
                finish::shade(
                    &question,
                    &self.nearest,
                    &self.seen,
                    &lighting,
                    &mut self.value,
                );
            }
            View::Depth => self.range = range_of(&self.seen.t),
            // The exact root loses nothing.
            View::Lost => self.value.fill(0.0),
            _ => {}
        }
    }

    /// Asks about each sphere at the pixels of its window.
    fn ask_windows(&mut self, scene: &Scene, window: impl Fn(&Sphere) -> Window) {
        let places = self.field.places();
        self.seen.clear(places);
        let compares = self.view == View::Lost;
        self.truth.clear(if compares { places } else { 0 });
        let none = match self.view {
            View::Delta => f32::NEG_INFINITY,
            _ => 0.0,
        };
        refill(&mut self.value, places, none);
        for (number, body) in (0..NOBODY).zip(&scene.bodies) {
            let sphere = &body.sphere;
            let Window { columns, rows } = window(sphere);
            for y in rows {
                for x in columns.clone() {
                    self.ask(self.field.place(x, y), number, sphere);
                }
            }
        }
        if self.view != View::Class {
            self.seen.forget_what_is_behind();
        }
        match self.view {
            View::Shade => self.shade(scene),
            View::Depth => self.range = range_of(&self.seen.t),
            View::Lost => self.compare(),
            View::Stage => self.stage_of_roots(scene),
            View::Class | View::Outline | View::Normal | View::Delta => {}
        }
    }

    /// Asks about one sphere at one pixel.
    fn ask(&mut self, i: usize, number: u32, sphere: &Sphere) {
        let ray = &self.field.ray(i);
        match self.view {
            View::Delta => {
                let answer = self.method.solve(ray, sphere);
                let delta = normalised_discriminant(self.method, ray, sphere, answer.class);
                if self.seen.note(i, number, &answer) {
                    self.value[i] = delta;
                } else if self.seen.body[i] == NOBODY && delta > FARTHEST_MISS {
                    self.value[i] = self.value[i].max(delta);
                }
            }
            View::Stage => {
                let (answer, stages) = exact::solve_staged(ray, sphere);
                self.value[i] = self.value[i].max(stages.class as u8 as f32);
                self.seen.note(i, number, &answer);
            }
            View::Lost => {
                let exact = Method::Exact.solve(ray, sphere);
                self.truth.note(i, number, &exact);
                let answer = self.method.solve(ray, sphere);
                self.seen.note(i, number, &answer);
            }
            _ => {
                let answer = self.method.solve(ray, sphere);
                self.seen.note(i, number, &answer);
            }
        }
    }

    fn shade(&mut self, scene: &Scene) {
        for (i, &number) in self.seen.body.iter().enumerate() {
            if let Some(body) = scene.bodies.get(number as usize) {
                let hit = shade::Hit {
                    method: self.method,
                    ray: &self.field.ray(i),
                    sphere: &body.sphere,
                    t: self.seen.t[i],
                    place: self.seen.contact[i].visible_root(),
                };
                self.value[i] = hit.brightness(scene.light);
            }
        }
    }

    /// Bits lost, or ∞ where the method is wrong about what there is.
    fn compare(&mut self) {
        let (seen, truth) = (&self.seen, &self.truth);
        for (i, value) in self.value.iter_mut().enumerate() {
            *value = if seen.body[i] == truth.body[i] {
                bits_lost(seen.t[i], truth.t[i])
            } else {
                f32::INFINITY
            };
        }
    }

    /// The stage that rounded the visible root counts, beside those that were sure of a class.
    fn stage_of_roots(&mut self, scene: &Scene) {
        for (i, &number) in self.seen.body.iter().enumerate() {
            let Some(body) = scene.bodies.get(number as usize) else {
                continue;
            };
            let (_, stages) = exact::solve_staged(&self.field.ray(i), &body.sphere);
            let root = match self.seen.contact[i].visible_root() {
                Place::Inside => stages.far,
                _ => stages.near,
            };
            let root = root.unwrap_or(stages.class) as u8;
            self.value[i] = self.value[i].max(root.into());
        }
    }

    /// The size of the picture.
    pub fn size(&self) -> Size {
        self.field.size()
    }

    /// The view for which the frame was rendered.
    pub const fn view(&self) -> View {
        self.view
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        let Size { width, height } = self.size();
        (x < width && y < height).then(|| self.field.place(x, y))
    }

    /// The place in the scene's list of the sphere that is seen at pixel (x, y), if one is.
    pub fn seen(&self, x: u32, y: u32) -> Option<u32> {
        let body = self.seen.body[self.index(x, y)?];
        (body != NOBODY).then_some(body)
    }

    /// The nearest visible hit at pixel (x, y), if there is one; nothing outside the picture.
    ///
    /// Where the view shows no roots the method is asked for this one, in the `scene` that the frame
    /// was rendered from.
    pub fn hit(&self, scene: &Scene, x: u32, y: u32) -> Option<Hit> {
        let body = self.seen(x, y)?;
        let place = self.index(x, y)?;
        let t = if self.has_roots {
            self.seen.t[place]
        } else {
            let sphere = &scene.bodies.get(body as usize)?.sphere;
            let ray = self.field.ray(place);
            self.method.solve(&ray, sphere).visible()?
        };
        Some(Hit { body, t })
    }

    /// What the line of pixel (x, y) does; a miss outside the picture.
    ///
    /// Only [`View::Class`] tells what is behind the eye; for the other views it is a miss.
    pub fn contact(&self, x: u32, y: u32) -> Contact {
        self.index(x, y)
            .map_or(Contact::Miss, |i| self.seen.contact[i])
    }

    fn value(&self, view: View, x: u32, y: u32) -> Option<f32> {
        let i = self.index(x, y)?;
        (self.view == view).then(|| self.value[i])
    }

    /// How bright the hit at pixel (x, y) is, from 0 to 1; 0 where nothing is hit, and in views
    /// without shades.
    pub fn brightness(&self, x: u32, y: u32) -> f32 {
        self.value(View::Shade, x, y).unwrap_or(0.0)
    }

    /// Δ/(4Ar²) of the sphere seen at pixel (x, y), else the greatest of all; nothing where every
    /// line passes at twice the radius or more, and in other views.
    pub fn delta(&self, x: u32, y: u32) -> Option<f32> {
        let delta = self.value(View::Delta, x, y)?;
        (delta > f32::NEG_INFINITY).then_some(delta)
    }

    /// What the method lost of the visible root at pixel (x, y); nothing where nothing is to be
    /// seen, and in other views.
    pub fn lost(&self, x: u32, y: u32) -> Option<Lost> {
        let lost = self.value(View::Lost, x, y)?;
        if lost == f32::INFINITY {
            Some(Lost::Everything)
        } else {
            self.seen(x, y).map(|_| Lost::Bits(lost))
        }
    }

    /// The slowest stage of `exact` that pixel (x, y) needed, for the classes of all spheres and
    /// for the visible root; nothing in other views.
    pub fn stage(&self, x: u32, y: u32) -> Option<Stage> {
        let place = self.value(View::Stage, x, y)?;
        Stage::ALL.get(place as usize).copied()
    }

    /// The unit normal at pixel (x, y) on the side that is seen, along the axes of the screen:
    /// right, up, towards the eye. Nothing where no sphere is seen, and for a point sphere.
    pub fn normal(&self, scene: &Scene, x: u32, y: u32) -> Option<Vec3> {
        let camera = self.field.camera()?;
        let i = self.index(x, y)?;
        let hit = shade::Hit {
            method: self.method,
            ray: &self.field.ray(i),
            sphere: &scene.bodies.get(self.seen(x, y)? as usize)?.sphere,
            t: self.seen.t[i],
            place: self.seen.contact[i].visible_root(),
        };
        let normal = hit.normal().try_normalize()?;
        let axes = [camera.right, -camera.down, -camera.direction];
        let along = axes.map(|axis| axis.normalize().dot(normal) as f32);
        Some(along.into()).filter(|n: &Vec3| n.is_finite())
    }

    /// How near `t` is among the roots that [`View::Depth`] shows, by its logarithm: 1 for the
    /// nearest, 0 for the farthest.
    pub fn nearness(&self, t: f32) -> f32 {
        let Some([nearest, farthest]) = self.range else {
            return 0.0;
        };
        let whole = (farthest / nearest).log2();
        let part = (farthest / t).log2();
        if whole > 0.0 {
            (part / whole).clamp(0.0, 1.0)
        } else {
            1.0
        }
    }

    /// The nearest and the farthest root that [`View::Depth`] shows, those at ∞ apart.
    pub const fn range(&self) -> Option<[f32; 2]> {
        self.range
    }

    /// Whether pixel (x, y) is an edge of what is seen there: whether a neighbour shows something
    /// else that is farther away. So an edge is one pixel wide and belongs to the nearer sphere.
    pub fn outline(&self, scene: &Scene, x: u32, y: u32) -> bool {
        self.seen(x, y).is_some()
            && [
                (x.wrapping_sub(1), y),
                (x + 1, y),
                (x, y.wrapping_sub(1)),
                (x, y + 1),
            ]
            .into_iter()
            .any(|there| self.is_beyond(scene, there, (x, y)))
    }

    /// Whether one pixel shows something else than another, and farther away.
    fn is_beyond(&self, scene: &Scene, there: (u32, u32), here: (u32, u32)) -> bool {
        let [Some(i), Some(j)] = [there, here].map(|(x, y)| self.index(x, y)) else {
            return false;
        };
        let [there_is, here_is] = [i, j].map(|place| (self.seen.t[place], self.seen.body[place]));
        if there_is.1 == here_is.1 {
            return false;
        }
        if there_is.1 == NOBODY || is_before(here_is.0, there_is.0) {
            return true;
        }
        if is_before(there_is.0, here_is.0) {
            return false;
        }
        // About as far away as each other: only the method can tell.
        let order = |(x, y): (u32, u32)| self.hit(scene, x, y).map(|hit| (hit.t, hit.body));
        order(there) > order(here)
    }
}

/// The least and the greatest number that is finite.
fn range_of(t: &[f32]) -> Option<[f32; 2]> {
    let finite = || t.iter().copied().filter(|t| t.is_finite());
    Some([finite().reduce(f32::min)?, finite().reduce(f32::max)?])
}

/// log2(1 + |answer − exact| in ulps), at most the 24 bits that there are.
fn bits_lost(answer: f32, exact: f32) -> f32 {
    if answer == exact {
        return 0.0;
    }
    let ulp = f64::from(exact.next_up()) - f64::from(exact);
    let ulps = (f64::from(answer) - f64::from(exact)).abs() / ulp;
    ((1.0 + ulps).log2() as f32).min(f32::MANTISSA_DIGITS as f32)
}

/// Δ/(4Ar²) as `method` has it: −∞ for a miss, 0 for a meeting where that is not a number, as with
/// a point sphere.
///
/// The size of an exact Δ is taken from the method `double`, which has it to all the bits that a
/// picture can show; its sign is that of the exact class.
fn normalised_discriminant(method: Method, ray: &Ray, sphere: &Sphere, class: Class) -> f32 {
    let size = match method {
        Method::Exact => Method::Double,
        _ => method,
    }
    .coefficients(ray, sphere);
    let r = f64::from(sphere.radius);
    let delta = (size.discriminant / (4.0 * size.a * r * r)) as f32;
    let delta = match (method, class) {
        (Method::Exact, Class::Miss) => -delta.abs(),
        (Method::Exact, Class::Tangent) => 0.0,
        (Method::Exact, Class::Secant) => delta.abs(),
        _ => delta,
    };
    match class {
        _ if !delta.is_nan() => delta,
        Class::Tangent | Class::Secant => 0.0,
        Class::Miss | Class::Nan => f32::NEG_INFINITY,
    }
}
