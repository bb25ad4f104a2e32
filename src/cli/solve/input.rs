//! The numbers of `--ray` and `--sphere`.

use glam::Vec3;

use super::super::rows;
use crate::geometry::{Ray, Sphere};

/// The ray of `--ray` and the sphere of `--sphere`, or which of the two, which of its numbers, and
/// what was expected.
pub(super) fn ray_and_sphere(ray: &str, sphere: &str) -> Result<(Ray, Sphere), String> {
    let [ox, oy, oz, dx, dy, dz] = list("--ray", ray, ["ox", "oy", "oz", "dx", "dy", "dz"])?;
    let [cx, cy, cz, r] = list("--sphere", sphere, ["cx", "cy", "cz", "r"])?;
    let ray = Ray::new(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz));
    let sphere = Sphere::new(Vec3::new(cx, cy, cz), r);
    Ok((
        ray.map_err(|e| format!("--ray: {e}"))?,
        sphere.map_err(|e| format!("--sphere: {e}"))?,
    ))
}

/// The numbers of a list with commas between them, called `names`.
fn list<const N: usize>(option: &str, text: &str, names: [&str; N]) -> Result<[f32; N], String> {
    let fields: Vec<&str> = text.split(',').collect();
    if fields.len() != N {
        let found = fields.len();
        let names = names.join(",");
        return Err(format!(
            "{option} {text}: {found} numbers; expected {N}: {names}"
        ));
    }
    let mut numbers = [0.0; N];
    for ((number, field), name) in numbers.iter_mut().zip(fields).zip(names) {
        *number = rows::number(field.as_bytes())
            .map_err(|reason| format!("{option}, {name}: {reason}"))?;
    }
    Ok(numbers)
}
