//! The rays of a picture, in arrays, kept for as long as the camera does not move.

use glam::Vec3;

use super::cover::Bounds;
use super::lanes::{LANES, Lanes, Real, dot};
use crate::geometry::Ray;
use crate::scene::{Rays, Size};

/// Columns and rows of a tile; a multiple of the lanes.
pub(super) const TILE: usize = 8;

/// The rays of all pixels: what they share once, what varies as three arrays.
///
/// A row takes a whole number of tiles. The pixels that fill it up lie beyond the right edge; their
/// rays are the camera's too, so nothing that is worked out for them can do harm.
#[derive(Debug, Clone)]
pub(super) struct Field {
    camera: Option<Rays>,
    size: Size,
    stride: usize,
    perspective: bool,
    /// The origin of all rays (perspective) or their direction (orthographic).
    shared: Vec3,
    /// The components of the other one of the two.
    varying: [Vec<f32>; 3],
    /// A = d·d of each ray (perspective) or of all (orthographic).
    a: Vec<f64>,
}

impl Default for Field {
    fn default() -> Self {
        Self {
            camera: None,
            size: Size::new(0, 0),
            stride: 0,
            perspective: false,
            shared: Vec3::ZERO,
            varying: Default::default(),
            a: Vec::new(),
        }
    }
}

impl Field {
    /// Makes ready for this camera; whether that meant work.
    pub(super) fn aim(&mut self, rays: &Rays) -> bool {
        if self.camera == Some(*rays) {
            return false;
        }
        self.camera = Some(*rays);
        self.size = rays.size;
        self.stride = (rays.size.width as usize).next_multiple_of(TILE);
        self.perspective = rays.perspective;
        let centre = rays.ray(0, 0);
        self.shared = if rays.perspective {
            centre.origin
        } else {
            centre.direction
        };
        self.varying.iter_mut().for_each(Vec::clear);
        self.a.clear();
        for y in 0..rays.size.height {
            for x in 0..self.stride as u32 {
                let ray = rays.ray(x, y);
                self.push(&ray);
            }
        }
        true
    }

    fn push(&mut self, ray: &Ray) {
        let varying = if self.perspective {
            ray.direction
        } else {
            ray.origin
        };
        for (array, v) in self.varying.iter_mut().zip(varying.to_array()) {
            array.push(v);
        }
        let d = ray.direction.to_array().map(f64::from);
        if self.perspective || self.a.is_empty() {
            self.a.push(dot(d, d));
        }
    }

    /// The camera that the rays are of.
    pub(super) const fn camera(&self) -> Option<&Rays> {
        self.camera.as_ref()
    }

    /// The size of the picture.
    pub(super) const fn size(&self) -> Size {
        self.size
    }

    /// Places from one row to the next.
    pub(super) const fn stride(&self) -> usize {
        self.stride
    }

    /// How many places there are, those beyond the right edge included.
    pub(super) const fn places(&self) -> usize {
        self.stride * self.size.height as usize
    }

    /// Whether the rays start at one point; else they all have one direction.
    pub(super) const fn perspective(&self) -> bool {
        self.perspective
    }

    /// The place of pixel (x, y).
    pub(super) const fn place(&self, x: u32, y: u32) -> usize {
        y as usize * self.stride + x as usize
    }

    /// The places of the pixels within `bounds`, row by row.
    pub(super) fn places_within(&self, bounds: Bounds) -> impl Iterator<Item = usize> + use<> {
        let stride = self.stride;
        (bounds.top..=bounds.bottom).flat_map(move |y| {
            let row = y as usize * stride;
            (bounds.left..=bounds.right).map(move |x| row + x as usize)
        })
    }

    /// The places at which runs of [`LANES`] begin that together hold the pixels within `bounds`.
    pub(super) fn runs_within(&self, bounds: Bounds) -> impl Iterator<Item = usize> + use<> {
        let stride = self.stride;
        let bounds = if bounds.is_empty() {
            Bounds::NONE
        } else {
            bounds
        };
        let first = bounds.left as usize / LANES * LANES;
        (bounds.top..=bounds.bottom).flat_map(move |y| {
            let row = y as usize * stride;
            (first..=bounds.right as usize)
                .step_by(LANES)
                .map(move |x| row + x)
        })
    }

    /// Whether a place is that of a pixel.
    pub(super) const fn is_pixel(&self, place: usize) -> bool {
        place % self.stride < self.size.width as usize
    }

    /// The ray of a place, the very bits of [`Rays::ray`].
    pub(super) fn ray(&self, place: usize) -> Ray {
        let [x, y, z] = &self.varying;
        let varying = Vec3::new(x[place], y[place], z[place]);
        if self.perspective {
            Ray {
                origin: self.shared,
                direction: varying,
            }
        } else {
            Ray {
                origin: varying,
                direction: self.shared,
            }
        }
    }

    /// What all rays share: their origin (perspective) or direction.
    pub(super) fn shared(&self) -> [f64; 3] {
        self.shared.to_array().map(f64::from)
    }

    /// What varies, from a place on.
    #[inline(always)]
    pub(super) fn varying(&self, place: usize) -> [Lanes; 3] {
        let [x, y, z] = &self.varying;
        [
            Lanes::load(x, place),
            Lanes::load(y, place),
            Lanes::load(z, place),
        ]
    }

    /// A = d·d, from a place on.
    #[inline(always)]
    pub(super) fn a(&self, place: usize) -> Lanes {
        if self.perspective {
            Lanes::load_double(&self.a, place)
        } else {
            Lanes::of(self.a[0])
        }
    }
}
