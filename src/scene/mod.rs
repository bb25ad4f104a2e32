//! What is looked at, and from where: spheres, camera, light, and places worth a look.
//!
//! A [`Scene`] is plain data that has been checked. Its camera makes rays; nothing here asks what
//! they hit.

mod builtin;
mod camera;
mod file;
mod open;
pub mod value;
mod write;

pub use builtin::Builtin;
pub use camera::{Camera, PixelShape, Projection, Rays, Size};
pub use file::LARGEST_FILE;
pub use open::Source;

use glam::Vec3;

use crate::geometry::Sphere;

/// Everything that a picture depends on.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The title.
    pub name: String,
    /// One sentence on what there is to see.
    pub about: Option<String>,
    /// The eye.
    pub camera: Camera,
    /// A picture of exactly this many pixels; without it the picture fills what room there is.
    pub pixels: Option<Size>,
    /// The spheres, in the order in which they are listed: at equal t the first wins.
    pub bodies: Vec<Body>,
    /// Where light comes from; without one, the eye carries a headlight.
    pub light: Option<Light>,
    /// Places worth looking at.
    pub probes: Vec<Probe>,
}

/// A sphere with what tells it from the others.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Its shape and place.
    pub sphere: Sphere,
    /// What the author calls it.
    pub name: Option<Box<str>>,
    /// Its colour; without one, the palette gives one by the sphere's number.
    pub color: Option<Rgb>,
}

/// A colour in sRGB, 8 bits a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Rgb(pub u8, pub u8, pub u8);

/// A point that shines equally in every direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Where it is.
    pub position: Vec3,
}

/// A place worth looking at, with the reason.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Where to put the cursor.
    pub aim: Aim,
    /// A few words.
    pub title: String,
    /// A sentence.
    pub text: String,
}

/// Where a probe points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Aim {
    /// A pixel of the scene's own picture.
    Pixel(u32, u32),
    /// The pixel whose ray passes nearest to this point, whatever the size of the picture.
    Point(Vec3),
}
