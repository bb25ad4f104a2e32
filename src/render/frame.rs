//! The frame: for each pixel, which sphere is seen, at which root, and how bright.

use super::View;
use super::bounds::{Eye, Window};
use super::shade::brightness;
use crate::geometry::{Ray, Sphere};
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
    /// What `rays` was filled from: a frame in which only spheres move keeps it.
    camera: Option<Rays>,
    rays: Vec<Ray>,
    t: Vec<f32>,
    body: Vec<u32>,
    contact: Vec<Contact>,
    brightness: Vec<f32>,
}

impl Default for Frame {
    fn default() -> Self {
        Self {
            size: Size::new(0, 0),
            view: View::default(),
            camera: None,
            rays: Vec::new(),
            t: Vec::new(),
            body: Vec::new(),
            contact: Vec::new(),
            brightness: Vec::new(),
        }
    }
}

impl Frame {
    /// A frame of no pixels.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks `method` what the rays hit, and shades it if the view shows shades.
    pub fn render(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) {
        let eye = Eye::new(rays);
        self.render_within(scene, rays, method, view, |sphere| eye.window(sphere));
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
        self.reset(rays, view);
        for (number, body) in (0..NOBODY).zip(&scene.bodies) {
            self.ask(method, number, &body.sphere, window(&body.sphere));
        }
        if view != View::Class {
            self.forget_what_is_behind();
        }
        if view == View::Shade {
            self.shade(scene);
        }
    }

    fn reset(&mut self, rays: &Rays, view: View) {
        self.size = rays.size;
        self.view = view;
        if self.camera != Some(*rays) {
            self.camera = Some(*rays);
            self.rays.clear();
            let pixels =
                (0..rays.size.height).flat_map(|y| (0..rays.size.width).map(move |x| (x, y)));
            self.rays.extend(pixels.map(|(x, y)| rays.ray(x, y)));
        }
        let pixels = rays.size.area();
        refill(&mut self.t, pixels, f32::INFINITY);
        refill(&mut self.body, pixels, NOBODY);
        refill(&mut self.contact, pixels, Contact::Miss);
        refill(&mut self.brightness, pixels, 0.0);
    }

    /// Asks for one sphere at the pixels of `window`.
    fn ask(&mut self, method: Method, number: u32, sphere: &Sphere, window: Window) {
        for y in window.rows {
            let row = y as usize * self.size.width as usize;
            for x in window.columns.clone() {
                let i = row + x as usize;
                let answer = method.solve(&self.rays[i], sphere);
                self.note(i, number, &answer);
            }
        }
    }

    fn note(&mut self, i: usize, number: u32, answer: &Solution) {
        let contact = Contact::of(answer);
        match answer.visible() {
            Some(t) if (t, number) < (self.t[i], self.body[i]) => {
                self.t[i] = t;
                self.body[i] = number;
                self.contact[i] = contact;
            }
            None if self.body[i] == NOBODY => self.contact[i] = self.contact[i].max(contact),
            _ => {}
        }
    }

    fn forget_what_is_behind(&mut self) {
        for contact in &mut self.contact {
            if matches!(contact, Contact::TangentBehind | Contact::SecantBehind) {
                *contact = Contact::Miss;
            }
        }
    }

    fn shade(&mut self, scene: &Scene) {
        for (i, &number) in self.body.iter().enumerate() {
            if let Some(body) = scene.bodies.get(number as usize) {
                let ray = &self.rays[i];
                self.brightness[i] = brightness(ray, &body.sphere, self.t[i], scene.light);
            }
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

    /// The nearest visible hit at pixel (x, y), if there is one; nothing outside the picture.
    pub fn hit(&self, x: u32, y: u32) -> Option<Hit> {
        let i = self.index(x, y)?;
        let body = self.body[i];
        (body != NOBODY).then(|| Hit { body, t: self.t[i] })
    }

    /// What the line of pixel (x, y) does; a miss outside the picture.
    ///
    /// Only [`View::Class`] tells what is behind the eye; for the other views it is a miss.
    pub fn contact(&self, x: u32, y: u32) -> Contact {
        self.index(x, y).map_or(Contact::Miss, |i| self.contact[i])
    }

    /// How bright the hit at pixel (x, y) is, from 0 to 1; 0 where nothing is hit, and in views
    /// without shades.
    pub fn brightness(&self, x: u32, y: u32) -> f32 {
        self.index(x, y).map_or(0.0, |i| self.brightness[i])
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

fn refill<T: Copy>(buffer: &mut Vec<T>, length: usize, value: T) {
    buffer.clear();
    buffer.resize(length, value);
}
