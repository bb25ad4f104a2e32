//! The eye: position, orientation and projection, and the rays that it makes for the pixels.

use std::fmt;

use glam::{DVec3, Vec3};

use super::value::NumberKind;
use crate::geometry::{Decimal, Invalid, List, Ray};

/// How pixels become rays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Parallel rays through a window of this width and height, in units of the world.
    Orthographic {
        /// Width and height seen.
        extent: [f32; 2],
        /// A power of two that the place of every pixel is a multiple of, whatever the size of the
        /// picture.
        step: Option<f32>,
    },
    /// Rays that start at one point.
    Perspective {
        /// The vertical angle seen, in degrees, between 0 and 180.
        field_of_view: f32,
    },
}

impl Projection {
    /// The name in files and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Orthographic { .. } => "orthographic",
            Self::Perspective { .. } => "perspective",
        }
    }
}

/// The eye. The world is right-handed: right = forward × up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Orthographic or perspective.
    pub projection: Projection,
    /// Where the eye is: the centre of the window (orthographic) or the start of all rays.
    pub position: Vec3,
    /// The point that appears at the centre of the picture, and about which the camera orbits.
    pub look_at: Vec3,
    /// The direction that points up on the screen; need not be perpendicular to the view.
    pub up: Vec3,
}

/// Right, down and forward of the screen: unit vectors, each perpendicular to the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Basis {
    /// Towards greater x on the screen.
    pub right: DVec3,
    /// Towards greater y on the screen.
    pub down: DVec3,
    /// Into the screen.
    pub forward: DVec3,
}

impl Camera {
    /// Refuses a camera that looks nowhere or sees nothing, naming the key of the scene file.
    pub fn check(&self) -> Result<(), Invalid> {
        for (name, v) in [
            ("position", self.position),
            ("look_at", self.look_at),
            ("up", self.up),
        ] {
            if !v.is_finite() {
                return Err(Invalid::new(
                    name,
                    List(v.to_array()),
                    "three finite numbers",
                ));
            }
        }
        match self.projection {
            Projection::Orthographic { extent, step } => {
                if !extent.iter().all(|e| e.is_finite() && *e > 0.0) {
                    let found = List(extent);
                    return Err(Invalid::new("extent", found, "two finite numbers above 0"));
                }
                let kind = NumberKind::Step;
                if let Some(step) = step.filter(|&step| kind.check(step).is_err()) {
                    return Err(Invalid::new("step", Decimal(step), kind.expected()));
                }
                // Whatever the shape of its room, a picture shows less than this many times as much.
                let side = f64::from(extent[0].max(extent[1])) + f64::from(step.unwrap_or(0.0));
                let reach = f64::from(Size::LARGEST) * side;
                if self.position.as_dvec3().abs().max_element() + reach > f64::from(f32::MAX) {
                    let found = List(extent);
                    return Err(Invalid::new(
                        "extent",
                        found,
                        "a window whose rays all start within binary32's ±3.4028235e38",
                    ));
                }
            }
            Projection::Perspective { field_of_view } => {
                if !(field_of_view > 0.0 && field_of_view < 180.0) {
                    return Err(Invalid::new(
                        "field_of_view",
                        Decimal(field_of_view),
                        "an angle in degrees above 0 and below 180",
                    ));
                }
            }
        }
        if self.look_at == self.position {
            return Err(Invalid::new(
                "look_at",
                List(self.look_at.to_array()),
                "a point other than the camera's position",
            ));
        }
        if self.try_basis().is_none() {
            return Err(Invalid::new(
                "up",
                List(self.up.to_array()),
                "a direction other than zero and other than the one the camera looks in",
            ));
        }
        Ok(())
    }

    /// The step of the grid that the pixels' places are on, if they are on one.
    pub const fn step(&self) -> Option<f32> {
        match self.projection {
            Projection::Orthographic { step, .. } => step,
            Projection::Perspective { .. } => None,
        }
    }

    fn try_basis(&self) -> Option<Basis> {
        let forward = unit(self.look_at.as_dvec3() - self.position.as_dvec3())?;
        let across = forward.cross(unit(self.up.as_dvec3())?);
        if across.length() < LEAST_SINE {
            return None;
        }
        let right = unit(across)?;
        let down = forward.cross(right);
        Some(Basis {
            right,
            down,
            forward,
        })
    }

    /// The axes of the screen in the world. The camera must have passed [`Camera::check`].
    pub fn basis(&self) -> Basis {
        self.try_basis().unwrap_or(Basis {
            right: DVec3::X,
            down: DVec3::NEG_Y,
            forward: DVec3::NEG_Z,
        })
    }
}

/// How far `up` must turn away from the view: the sine of the angle between them. Below this the
/// orientation would hang on the last bits of the numbers in the file.
const LEAST_SINE: f64 = 1e-9;

/// The unit vector along `v`, of whatever length; none if `v` is zero.
fn unit(v: DVec3) -> Option<DVec3> {
    let scale = v.abs().max_element();
    if scale == 0.0 {
        return None;
    }
    let v = v / scale;
    Some(v / v.length())
}

/// A number of pixels across and down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Size {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Size {
    /// The greatest width and the greatest height of a picture.
    pub const LARGEST: u32 = 4096;

    /// A size of `width` by `height`.
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }

    /// Number of pixels.
    pub const fn area(self) -> usize {
        self.width as usize * self.height as usize
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{}", self.width, self.height)
    }
}

/// What a pixel looks like where it is shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PixelShape {
    /// The scene fixes the picture: its extent is divided by its pixels, wherever it is shown.
    Own,
    /// A pixel of a picture that fills its room is this many times as high as it is wide.
    Aspect(f64),
}

/// The rays of all pixels of one picture: affine in the pixel, rounded once to binary32.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rays {
    /// The picture.
    pub size: Size,
    /// Start of the ray at the centre of the picture.
    pub origin: DVec3,
    /// Direction of the ray at the centre of the picture.
    pub direction: DVec3,
    /// One pixel to the right: what is added to the direction (perspective) or the origin.
    pub right: DVec3,
    /// One pixel down, likewise.
    pub down: DVec3,
    /// Whether the pixel moves the direction (perspective) rather than the origin.
    pub perspective: bool,
}

impl Rays {
    /// The rays of a picture of `size` pixels of the given shape.
    ///
    /// With a shape of its own the picture shows exactly the camera's extent; in a room of
    /// another shape, or where the camera has a step, at least that. A field of view is always the
    /// height of the picture.
    pub fn new(camera: &Camera, size: Size, shape: PixelShape) -> Self {
        let Basis {
            right,
            down,
            forward,
        } = camera.basis();
        let [w, h] = [size.width.max(1) as f64, size.height.max(1) as f64];
        let (perspective, [dx, dy]) = match camera.projection {
            Projection::Orthographic { extent, step } => {
                let [ew, eh] = extent.map(f64::from);
                let pixel = match shape {
                    PixelShape::Own => [ew / w, eh / h],
                    PixelShape::Aspect(aspect) => {
                        let dx = (ew / w).max(eh / h / aspect);
                        [dx, dx * aspect]
                    }
                };
                let on_grid = |step| whole_steps(pixel, f64::from(step), shape);
                (false, step.map_or(pixel, on_grid))
            }
            Projection::Perspective { field_of_view } => {
                let dy = 2.0 * (f64::from(field_of_view) / 2.0).to_radians().tan() / h;
                let dx = match shape {
                    PixelShape::Own => dy,
                    PixelShape::Aspect(aspect) => dy / aspect,
                };
                (true, [dx, dy])
            }
        };
        let mut origin = camera.position.as_dvec3();
        if camera.step().is_some() {
            origin += onto_grid(origin, right, dx, size.width);
            origin += onto_grid(origin, down, dy, size.height);
        }
        Self {
            size,
            origin,
            direction: forward,
            right: right * dx,
            down: down * dy,
            perspective,
        }
    }

    /// The rays of the same picture in pixels about this many times as wide and as high.
    #[must_use]
    pub fn coarser(&self, times: u32) -> Self {
        let [w, h] = [self.size.width, self.size.height].map(|n| n.div_ceil(times));
        let stretch = |all: u32, few: u32| f64::from(all) / f64::from(few.max(1));
        Self {
            size: Size::new(w, h),
            right: self.right * stretch(self.size.width, w),
            down: self.down * stretch(self.size.height, h),
            ..*self
        }
    }

    /// The ray of pixel (x, y), counted from 0 at the top left.
    ///
    /// It passes through the point (x − (W−1)/2, y − (H−1)/2), in pixel steps right and down from
    /// the centre.
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        let u = f64::from(x) - (f64::from(self.size.width) - 1.0) / 2.0;
        let v = f64::from(y) - (f64::from(self.size.height) - 1.0) / 2.0;
        let shift = u * self.right + v * self.down;
        let (origin, direction) = if self.perspective {
            (self.origin, self.direction + shift)
        } else {
            (self.origin + shift, self.direction)
        };
        Ray {
            origin: origin.as_vec3(),
            direction: direction.as_vec3(),
        }
    }

    /// The pixel, in fractions from 0 at the middle of the top left one, that shows the point `p`;
    /// none for a point at or behind a perspective eye.
    pub fn project(&self, p: DVec3) -> Option<[f64; 2]> {
        let from_eye = p - self.origin;
        let depth = if self.perspective {
            let depth = from_eye.dot(self.direction);
            if depth <= 0.0 {
                return None;
            }
            depth
        } else {
            1.0
        };
        let along = |step: DVec3| from_eye.dot(step) / (depth * step.length_squared());
        Some([
            along(self.right) + (f64::from(self.size.width) - 1.0) / 2.0,
            along(self.down) + (f64::from(self.size.height) - 1.0) / 2.0,
        ])
    }
}

/// A pixel of whole steps that shows no less than `pixel`; in a room, of whole proportions too.
fn whole_steps(pixel: [f64; 2], step: f64, shape: PixelShape) -> [f64; 2] {
    let steps = |length: f64| (length / step).ceil().max(1.0);
    match shape {
        PixelShape::Own => pixel.map(|length| steps(length) * step),
        PixelShape::Aspect(aspect) => {
            let [wide, high] = [1.0 / aspect, aspect].map(|ratio| ratio.round().max(1.0));
            let n = steps(pixel[0] / wide).max(steps(pixel[1] / high));
            [n * wide * step, n * high * step]
        }
    }
}

/// What shifts a picture along one of its axes so that all its pixels, so many of this `length`, are
/// at multiples of their length.
fn onto_grid(origin: DVec3, axis: DVec3, length: f64, count: u32) -> DVec3 {
    let half = if count.is_multiple_of(2) { 0.5 } else { 0.0 };
    let middle = origin.dot(axis) + half * length;
    axis * ((middle / length).round() * length - middle)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tutorial() -> Camera {
        Camera {
            projection: Projection::Orthographic {
                extent: [40.0, 40.0],
                step: None,
            },
            position: Vec3::new(19.5, 19.5, 0.0),
            look_at: Vec3::new(19.5, 19.5, 20.0),
            up: Vec3::NEG_Y,
        }
    }

    #[test]
    fn the_tutorials_pixels_start_where_they_say() {
        let rays = Rays::new(&tutorial(), Size::new(40, 40), PixelShape::Own);
        for (x, y) in [(0, 0), (20, 20), (39, 0), (13, 37)] {
            let ray = rays.ray(x, y);
            assert_eq!(ray.origin, Vec3::new(x as f32, y as f32, 0.0));
            assert_eq!(ray.direction, Vec3::Z);
        }
    }

    #[test]
    fn a_point_on_a_ray_projects_to_its_pixel() {
        let perspective = Camera {
            projection: Projection::Perspective {
                field_of_view: 50.0,
            },
            position: Vec3::new(3.0, -2.0, 9.0),
            look_at: Vec3::new(0.5, 0.25, -1.0),
            up: Vec3::Y,
        };
        for camera in [tutorial(), perspective] {
            let rays = Rays::new(&camera, Size::new(31, 17), PixelShape::Aspect(2.0));
            for (x, y) in [(0, 0), (30, 16), (7, 11)] {
                let at = rays.project(rays.ray(x, y).at(5.0).as_dvec3()).unwrap();
                assert!((at[0] - f64::from(x)).abs() < 1e-4, "{at:?}");
                assert!((at[1] - f64::from(y)).abs() < 1e-4, "{at:?}");
            }
        }
    }

    #[test]
    fn the_pixels_of_a_camera_with_a_step_are_on_its_grid_at_any_size() {
        for step in [0.25, 1.0, 2.0] {
            let camera = Camera {
                projection: Projection::Orthographic {
                    extent: [40.0, 40.0],
                    step: Some(step),
                },
                ..tutorial()
            };
            for (w, h) in [(1, 1), (7, 40), (40, 20), (41, 39), (200, 117)] {
                for shape in [1.0, 2.0, 2.1, 0.5].map(PixelShape::Aspect) {
                    let rays = Rays::new(&camera, Size::new(w, h), shape);
                    let [first, last] =
                        [(0, 0), (w - 1, h - 1)].map(|(x, y)| rays.ray(x, y).origin);
                    for at in [first, last] {
                        assert_eq!((at.x % step, at.y % step, at.z), (0.0, 0.0, 0.0), "{at}");
                    }
                    let seen =
                        (last - first) + Vec3::new(rays.right.x as f32, rays.down.y as f32, 0.0);
                    assert!(
                        seen.x >= 40.0 && seen.y >= 40.0,
                        "{w}×{h} {shape:?}: {seen}"
                    );
                }
            }
        }
        let own = |camera: &Camera| Rays::new(camera, Size::new(40, 40), PixelShape::Own);
        let with_step = Camera {
            projection: Projection::Orthographic {
                extent: [40.0, 40.0],
                step: Some(1.0),
            },
            ..tutorial()
        };
        assert_eq!(own(&with_step), own(&tutorial()));
    }

    #[test]
    fn a_camera_that_looks_nowhere_is_refused_by_key() {
        let said = |change: fn(&mut Camera)| {
            let mut camera = tutorial();
            change(&mut camera);
            camera.check().unwrap_err().field
        };
        assert!(tutorial().check().is_ok());
        assert_eq!(said(|c| c.look_at = c.position), "look_at");
        assert_eq!(said(|c| c.up = Vec3::Z), "up");
        assert_eq!(said(|c| c.up = Vec3::ZERO), "up");
        assert_eq!(said(|c| c.position.x = f32::NAN), "position");
    }
}
