//! The frame: for each pixel, which sphere is seen, at which root, and how bright.

use glam::Vec3;

use super::View;
use super::bounds::{Eye, Window};
use super::shade;
use crate::geometry::{Ray, Sphere};
use crate::method::exact::{self, Stage};
use crate::method::{Class, Method, Place, Solution};
use crate::scene::{Rays, Scene, Size};

/// What the line of a pixel does, of all spheres together: that of the nearest visible hit, else
/// the greatest in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Contact {
    /// It misses every sphere.
    #[default]
    Miss,
    /// It touches a sphere behind the eye.
    TangentBehind,
    /// It crosses a sphere behind the eye.
    SecantBehind,
    /// It meets nothing, as far as the method can tell, but for one sphere at least the method's
    /// discriminant is not a number.
    Nan,
    /// It touches the nearest visible sphere.
    Tangent,
    /// It crosses the nearest visible sphere, which lies before the eye.
    Secant,
    /// The eye is inside the nearest visible sphere.
    Inside,
}

impl Contact {
    fn of(answer: &Solution) -> Self {
        match (answer.class, answer.place()) {
            (Class::Nan, _) => Self::Nan,
            (Class::Miss, _) | (_, None) => Self::Miss,
            (Class::Tangent, Some(Place::Behind)) => Self::TangentBehind,
            (Class::Secant, Some(Place::Behind)) => Self::SecantBehind,
            (_, Some(Place::Inside)) => Self::Inside,
            (Class::Tangent, Some(Place::Hit)) => Self::Tangent,
            (Class::Secant, Some(Place::Hit)) => Self::Secant,
        }
    }

    /// The root of the sphere that is seen so.
    const fn visible_root(self) -> Place {
        match self {
            Self::Inside => Place::Inside,
            _ => Place::Hit,
        }
    }

    /// Whether the line meets a sphere, be it behind the eye: the tutorial's boolean.
    pub const fn meets(self) -> bool {
        !matches!(self, Self::Miss | Self::Nan)
    }
}

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

/// The spheres seen at the pixels, and at which roots.
#[derive(Debug, Clone, Default, PartialEq)]
struct Layer {
    t: Vec<f32>,
    body: Vec<u32>,
    contact: Vec<Contact>,
}

impl Layer {
    fn clear(&mut self, pixels: usize) {
        refill(&mut self.t, pixels, f32::INFINITY);
        refill(&mut self.body, pixels, NOBODY);
        refill(&mut self.contact, pixels, Contact::Miss);
    }

    /// Takes note of one answer; whether it is of the sphere that is seen so far.
    fn note(&mut self, i: usize, number: u32, answer: &Solution) -> bool {
        let contact = Contact::of(answer);
        match answer.visible() {
            Some(t) if (t, number) < (self.t[i], self.body[i]) => {
                self.t[i] = t;
                self.body[i] = number;
                self.contact[i] = contact;
                true
            }
            None if self.body[i] == NOBODY => {
                self.contact[i] = self.contact[i].max(contact);
                false
            }
            _ => false,
        }
    }

    fn forget_what_is_behind(&mut self) {
        for contact in &mut self.contact {
            if matches!(contact, Contact::TangentBehind | Contact::SecantBehind) {
                *contact = Contact::Miss;
            }
        }
    }
}

/// No sphere: greater than the number of any, so that at equal t a sphere wins over it.
const NOBODY: u32 = u32::MAX;

/// The answers for the pixels of one picture, in arrays that are kept from frame to frame.
///
/// A picture is the same in whatever order its spheres are asked: the least t wins, and of two
/// spheres at equal t the one listed first.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    size: Size,
    view: View,
    method: Method,
    /// What `rays` was filled from: a frame in which only spheres move keeps it.
    camera: Option<Rays>,
    rays: Vec<Ray>,
    seen: Layer,
    /// What `exact` sees, in the view that compares the two.
    truth: Layer,
    /// What the view shows of each pixel, if that is a number: its brightness, Δ/(4Ar²), the bits
    /// lost, the place of its stage among all.
    value: Vec<f32>,
    /// The least and the greatest finite root seen.
    range: Option<[f32; 2]>,
}

impl Default for Frame {
    fn default() -> Self {
        Self {
            size: Size::new(0, 0),
            view: View::default(),
            method: Method::default(),
            camera: None,
            rays: Vec::new(),
            seen: Layer::default(),
            truth: Layer::default(),
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
        let eye = Eye::new(rays);
        let reach = if view == View::Delta { 2.0 } else { 1.0 };
        self.render_within(scene, rays, method, view, |sphere| {
            eye.window(sphere, reach)
        });
    }

    /// As [`Frame::render`], but asks about every sphere at every pixel: what `render` must equal,
    /// bit for bit.
    pub fn render_all(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) {
        self.render_within(scene, rays, method, view, |_| Window::whole(rays.size));
    }

    fn render_within(
        &mut self,
        scene: &Scene,
        rays: &Rays,
        method: Method,
        view: View,
        window: impl Fn(&Sphere) -> Window,
    ) {
        self.method = if view == View::Stage {
            Method::Exact
        } else {
            method
        };
        self.reset(rays, view);
        for (number, body) in (0..NOBODY).zip(&scene.bodies) {
            let sphere = &body.sphere;
            for i in pixels_of(window(sphere), self.size) {
                self.ask(i, number, sphere);
            }
        }
        if view != View::Class {
            self.seen.forget_what_is_behind();
        }
        match view {
            View::Shade => self.shade(scene),
            View::Depth => self.range = range_of(&self.seen.t),
            View::Lost => self.compare(),
            View::Stage => self.stage_of_roots(scene),
            View::Class | View::Outline | View::Normal | View::Delta => {}
        }
    }

    fn reset(&mut self, rays: &Rays, view: View) {
        self.size = rays.size;
        self.view = view;
        self.range = None;
        if self.camera != Some(*rays) {
            self.camera = Some(*rays);
            self.rays.clear();
            let pixels =
                (0..rays.size.height).flat_map(|y| (0..rays.size.width).map(move |x| (x, y)));
            self.rays.extend(pixels.map(|(x, y)| rays.ray(x, y)));
        }
        let pixels = rays.size.area();
        self.seen.clear(pixels);
        self.truth
            .clear(if view == View::Lost { pixels } else { 0 });
        let none = match view {
            View::Delta => f32::NEG_INFINITY,
            _ => 0.0,
        };
        refill(&mut self.value, pixels, none);
    }

    /// Asks about one sphere at pixel `i`.
    fn ask(&mut self, i: usize, number: u32, sphere: &Sphere) {
        let ray = &self.rays[i];
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
                let place = self.seen.contact[i].visible_root();
                let hit = shade::Hit {
                    method: self.method,
                    ray: &self.rays[i],
                    sphere: &body.sphere,
                    t: self.seen.t[i],
                    place,
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
            let (_, stages) = exact::solve_staged(&self.rays[i], &body.sphere);
            let root = match self.seen.contact[i].visible_root() {
                Place::Inside => stages.far,
                _ => stages.near,
            };
            let root = root.unwrap_or(stages.class) as u8;
            self.value[i] = self.value[i].max(root.into());
        }
    }

    /// The size of the picture.
    pub const fn size(&self) -> Size {
        self.size
    }

    /// The view for which the frame was rendered.
    pub const fn view(&self) -> View {
        self.view
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        let inside = x < self.size.width && y < self.size.height;
        inside.then(|| y as usize * self.size.width as usize + x as usize)
    }

    /// The place in the scene's list of the sphere that is seen at pixel (x, y), if one is.
    pub fn seen(&self, x: u32, y: u32) -> Option<u32> {
        let body = self.seen.body[self.index(x, y)?];
        (body != NOBODY).then_some(body)
    }

    /// The nearest visible hit at pixel (x, y), if there is one; nothing outside the picture.
    pub fn hit(&self, x: u32, y: u32) -> Option<Hit> {
        let body = self.seen(x, y)?;
        let t = self.seen.t[self.index(x, y)?];
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
        let camera = self.camera.as_ref()?;
        let i = self.index(x, y)?;
        let hit = shade::Hit {
            method: self.method,
            ray: &self.rays[i],
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
    pub fn outline(&self, x: u32, y: u32) -> bool {
        let Some(here) = self.hit(x, y) else {
            return false;
        };
        let beyond = |x: u32, y: u32| {
            self.index(x, y).is_some() && self.hit(x, y).is_none_or(|there| is_beyond(there, here))
        };
        beyond(x.wrapping_sub(1), y)
            || beyond(x + 1, y)
            || beyond(x, y.wrapping_sub(1))
            || beyond(x, y + 1)
    }
}

fn is_beyond(there: Hit, here: Hit) -> bool {
    there.body != here.body && (there.t, there.body) > (here.t, here.body)
}

/// The places of the pixels of `window` in a picture of this size.
fn pixels_of(window: Window, size: Size) -> impl Iterator<Item = usize> {
    let Window { columns, rows } = window;
    rows.flat_map(move |y| {
        let row = y as usize * size.width as usize;
        columns.clone().map(move |x| row + x as usize)
    })
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

fn refill<T: Copy>(buffer: &mut Vec<T>, length: usize, value: T) {
    buffer.clear();
    buffer.resize(length, value);
}
