//! Numbers as people and files write them, read into rays and spheres.

use glam::Vec3;

use crate::geometry::{Ray, Sphere};
use crate::text::read;

/// A number rounded once to binary32; refused with its text if it is none, or beyond the range.
pub(in crate::cli) fn number(field: &[u8]) -> Result<f32, String> {
    let field = field.trim_ascii();
    match str::from_utf8(field).ok().and_then(read::binary32) {
        Some(number) if f32::is_finite(number) => Ok(number),
        number => Err(refusal(field, number)),
    }
}

/// Why a field is no number that will do.
fn refusal(field: &[u8], number: Option<f32>) -> String {
    let text = String::from_utf8_lossy(field);
    let shown: String = text.chars().take(40).collect();
    let has_digits = text.contains(|c: char| c.is_ascii_digit());
    match number {
        None if text.is_empty() => "nothing there; expected a number".to_owned(),
        None => format!("`{shown}` is not a number; expected one like -1.5e3 or 0x1.8p3"),
        Some(x) if x.is_infinite() && has_digits => {
            format!("{shown} is past the range of binary32; expected at most 3.4028235e38")
        }
        Some(_) => format!("{shown} is no finite number; expected one"),
    }
}

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
        *number = self::number(field.as_bytes())
            .map_err(|reason| format!("{option}, {name}: {reason}"))?;
    }
    Ok(numbers)
}
