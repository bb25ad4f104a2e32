//! The rays of a picture, in arrays, kept for as long as the camera does not move.

use std::ops::Range;

use glam::Vec3;

use super::bounds::Bounds;
use super::lanes::{Lanes, dot};
use crate::geometry::{Ray, Sphere};
use crate::method::Method;
use crate::method::batch::{Batch, Solutions};
use crate::scene::{Rays, Size};

/// Columns and rows of a tile; a multiple of the lanes.
pub(super) const TILE: usize = 8;

/// A direction that is up to 2²⁰ times as long as that at the centre, which has length 1.
const GREATEST_A: f32 = (1_u64 << 40) as f32;

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
    a: Vec<f32>,
    /// For each tile how long its directions are at most, if they vary.
    longest: Vec<f32>,
    /// Whether no A is so large or small that products of it leave the range of binary32.
    ordinary: bool,
    /// The components of what varies that do not: whether o·d is the same for all rays.
    constant_b: bool,
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
            longest: Vec::new(),
            ordinary: false,
            constant_b: false,
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
        self.measure_tiles();
        let ordinary = 1.0 / GREATEST_A..GREATEST_A;
        self.ordinary = self.a.iter().all(|a| ordinary.contains(a));
        self.constant_b = !self.perspective && self.b_is_constant();
        true
    }

    /// Whether, of parallel rays, the components of the origin that vary meet a zero of the direction:
    /// then b = o·d comes out with the same bits at every pixel.
    fn b_is_constant(&self) -> bool {
        let direction = self.shared.to_array();
        direction.iter().zip(&self.varying).all(|(&d, origins)| {
            let first = origins.first();
            d == 0.0 || origins.iter().all(|o| Some(o) == first)
        })
    }

    fn measure_tiles(&mut self) {
        self.longest.clear();
        if !self.perspective || self.stride == 0 {
            return;
        }
        let across = self.stride / TILE;
        for band in self.a.chunks(self.stride * TILE) {
            let start = self.longest.len();
            self.longest.resize(start + across, 0.0);
            for row in band.chunks(self.stride) {
                for (longest, a) in self.longest[start..].iter_mut().zip(row.chunks(TILE)) {
                    *longest = a.iter().fold(*longest, |most, &a| most.max(a.sqrt()));
                }
            }
        }
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
            self.a.push(dot(d, d) as f32);
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

    /// The places of the columns from the first to the last in row `y`.
    pub(super) const fn run(&self, y: i16, [first, last]: [i16; 2]) -> Range<usize> {
        let row = y as usize * self.stride;
        if first > last {
            row..row
        } else {
            row + first as usize..row + last as usize + 1
        }
    }

    /// The places of the pixels within `bounds`, row by row.
    pub(super) fn places_within(&self, bounds: Bounds) -> impl Iterator<Item = usize> + use<> {
        let stride = self.stride;
        (bounds.top..=bounds.bottom).flat_map(move |y| {
            let row = y as usize * stride;
            (bounds.left..=bounds.right).map(move |x| row + x as usize)
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

    /// What varies, at each place, in binary32.
    pub(super) const fn varying_singles(&self) -> [&[f32]; 3] {
        let [x, y, z] = &self.varying;
        [x.as_slice(), y.as_slice(), z.as_slice()]
    }

    /// What all rays share, as it is.
    pub(super) const fn shared_singles(&self) -> [f32; 3] {
        self.shared.to_array()
    }

    /// A = d·d rounded to binary32: at each place (perspective) or once for all.
    pub(super) const fn a_singles(&self) -> &[f32] {
        self.a.as_slice()
    }

    /// Asks `method` about a sphere at a run of places.
    pub(super) fn ask(
        &self,
        method: Method,
        sphere: &Sphere,
        run: Range<usize>,
        answers: &mut Solutions,
    ) {
        let varying = self.varying.each_ref().map(|v| &v[run.clone()]);
        let Sphere { center, radius } = *sphere;
        if self.perspective {
            let rays = Batch {
                origin: self.shared,
                direction: varying,
                center,
                radius,
            };
            rays.solve(method, answers);
        } else {
            let rays = Batch {
                origin: varying,
                direction: self.shared,
                center,
                radius,
            };
            rays.solve(method, answers);
        }
    }

    /// How long a direction is at most within a tile of a perspective picture.
    pub(super) fn longest(&self, tile: usize) -> f32 {
        self.longest[tile]
    }

    /// Whether products with any A stay within the range of binary32, if the other factors do by far.
    pub(super) const fn ordinary(&self) -> bool {
        self.ordinary
    }

    /// Whether b = o·d of a sphere has the same bits at every pixel.
    pub(super) const fn constant_b(&self) -> bool {
        self.constant_b
    }
}
