//! Which of two spheres a ray sees first: by the roots of the method.
//!
//! For `exact` by the true ones. Rounding is monotone, so only roots that round alike are in question;
//! signs decide between these, not roots.

use std::cmp::Ordering;

use super::exact::U;
use super::{Method, Solution, Truth, Which};
use crate::geometry::{Ray, Sphere};

impl Method {
    /// How the visible roots of two spheres along `ray` compare, of which this method says that; a sphere
    /// that is not seen comes after all that are.
    pub fn order(
        self,
        ray: &Ray,
        (one, found): (&Sphere, Solution),
        (other, found_other): (&Sphere, Solution),
    ) -> Ordering {
        let [seen, seen_other] = [found, found_other].map(|found| {
            let root = found.place()?.visible_root()?;
            Some((root, found.visible()?))
        });
        let (Some((root, t)), Some((other_root, u))) = (seen, seen_other) else {
            return seen.is_none().cmp(&seen_other.is_none());
        };
        match t.total_cmp(&u) {
            Ordering::Equal if self == Self::Exact && one != other => {
                order_of_equals(ray, (one, root), (other, other_root), t)
            }
            order => order,
        }
    }
}

/// How two exact roots compare that both round to t.
#[cold]
fn order_of_equals(
    ray: &Ray,
    (one, root): (&Sphere, Which),
    (other, other_root): (&Sphere, Which),
    t: f32,
) -> Ordering {
    let order = certain_order(ray, one, (other, other_root), t).or_else(|| {
        let [one, other] = [one, other].map(|sphere| Truth::new(ray, sphere));
        one.compare(root, &other, other_root)
    });
    // The truth knows the order of any two roots.
    order.unwrap_or(Ordering::Equal)
}

/// The same in binary64, by the signs that [`Truth::compare`] takes, where these are certain.
///
/// Each of the three sums below is off by less than 16u of what its terms are in size, and the root is
/// t to within half of its spacing.
fn certain_order(
    ray: &Ray,
    one: &Sphere,
    (other, other_root): (&Sphere, Which),
    t: f32,
) -> Option<Ordering> {
    let t = f64::from(t);
    let t_error = t.abs() * f64::from(f32::EPSILON) + f64::from(f32::from_bits(1));
    let [p0, d, c, e] =
        [ray.origin, ray.direction, one.center, other.center].map(|v| v.to_array().map(f64::from));
    let [r, s] = [one.radius, other.radius].map(f64::from);
    let mut a = 0.0;
    // b′ − b, C′ − C and b′, each with the sum of the sizes of its terms.
    let [mut db, mut dc, mut b] = [[0.0; 2]; 3];
    let add = |sum: &mut [f64; 2], term: f64, size: f64| {
        sum[0] += term;
        sum[1] += size;
    };
    for i in 0..3 {
        let apart = c[i] - e[i];
        let [o, of_other] = [p0[i] - c[i], p0[i] - e[i]];
        a += d[i] * d[i];
        add(&mut db, apart * d[i], (apart * d[i]).abs());
        add(
            &mut dc,
            apart * (o + of_other),
            apart.abs() * (o.abs() + of_other.abs()),
        );
        add(&mut b, of_other * d[i], (of_other * d[i]).abs());
    }
    add(&mut dc, (r - s) * (r + s), (r - s).abs() * (r + s));

    let sign = |sum: f64, error: f64| (sum.abs() > error).then(|| sum.total_cmp(&0.0));
    let slope = sign(
        a * t + b[0],
        16.0 * U * (a * t.abs() + b[1]) + 2.0 * a * t_error,
    )?;
    other_root
        .compare(slope, || {
            let sizes = 2.0 * db[1] * t.abs() + dc[1];
            let error = 16.0 * U * sizes + 4.0 * db[1] * t_error;
            sign(2.0 * db[0] * t + dc[0], error)
        })
        .map(Ordering::reverse)
}
