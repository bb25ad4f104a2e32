//! `solve --ray … --sphere …`: the derivation of one intersection, as text or as JSON.

use std::fmt::{self, Write as _};

use super::{DerivationFormat, input, json};
use crate::explain::{self, Lens, Reading};
use crate::geometry::{Ray, Sphere};
use crate::method::format::binary32;
use crate::method::trace::{self, Measured, Trace};
use crate::method::{Class, Method};
use crate::text::Glyphs;

/// Columns of the text.
const COLUMNS: usize = 80;
/// Digits of exact values in the text.
const DIGITS: usize = 25;

/// The derivation of one intersection, or what is wrong with the numbers.
pub(super) fn written(
    (ray, sphere): (&str, &str),
    (lens, method): (Lens, Method),
    format: DerivationFormat,
) -> Result<String, String> {
    let (ray, sphere) = input::ray_and_sphere(ray, sphere)?;
    let trace = method.trace(&ray, &sphere);
    Ok(match (format, lens) {
        (DerivationFormat::Json, _) => json::text(&ray, &sphere, &trace),
        (DerivationFormat::Text, Lens::Machine) => text(&ray, &sphere, &trace),
        (DerivationFormat::Text, Lens::Mathematics) => mathematics(&ray, &sphere, method),
    })
}

/// The sheet of the mathematics; a line more where the method is wrong about it.
fn mathematics(ray: &Ray, sphere: &Sphere, method: Method) -> String {
    let read = |method| Reading::alone(*ray, *sphere, method);
    let exact = read(Method::Exact);
    let steps = explain::sheet(Lens::Mathematics, &exact, None, None, None);
    let wrong = read(method).disagreement(&exact);
    let wrong = wrong.map_or(String::new(), |wrong| {
        format!("{wrong}: --lens machine shows why\n")
    });
    explain::sheet_text(&steps, COLUMNS) + &wrong
}

fn text(ray: &Ray, sphere: &Sphere, trace: &Trace) -> String {
    let mut out = String::new();
    // Writing to a `String` cannot fail.
    let _ = write_text(&mut out, ray, sphere, trace);
    out
}

fn write_text(out: &mut String, ray: &Ray, sphere: &Sphere, trace: &Trace) -> fmt::Result {
    let glyphs = Glyphs::Unicode;
    let vector = |v: glam::Vec3| {
        let [x, y, z] = v.to_array().map(|x| binary32(x, glyphs));
        format!("({x}, {y}, {z})")
    };
    writeln!(
        out,
        "ray     p0 {}  d {}",
        vector(ray.origin),
        vector(ray.direction)
    )?;
    let radius = binary32(sphere.radius, glyphs);
    writeln!(out, "sphere  c {}  r {radius}", vector(sphere.center))?;
    writeln!(out, "method  {}\n", trace.method)?;
    trace::write(trace, out, glyphs, DIGITS)?;
    write_answer(out, trace, glyphs)
}

/// The class and the roots, and what is right where they are wrong.
fn write_answer(out: &mut String, trace: &Trace, glyphs: Glyphs) -> fmt::Result {
    let class = trace.solution.class;
    let meaning = match class {
        Class::Miss if trace.method.is_routine() => "the routine says that there is no hit",
        Class::Tangent if trace.method.is_routine() => {
            "the routine gives one root, or the same twice"
        }
        Class::Secant if trace.method.is_routine() => "the routine gives two roots",
        Class::Nan if trace.method.is_routine() => {
            "the routine has no answer: what it gives is not a number, or takes too long"
        }
        Class::Hit => "the routine says that there is a hit",
        Class::Miss => "Δ < 0: the line misses the sphere",
        Class::Tangent => "Δ = 0: the line touches the sphere in one point",
        Class::Secant => "Δ > 0: the line crosses the sphere in two points",
        Class::Nan => "Δ is not a number: the method has no answer",
    };
    writeln!(out, "{class}  {meaning}")?;
    let mut root = |name, measured: &Option<Measured>| match measured {
        None => Ok(()),
        Some(root) => {
            let value = root.shortest(glyphs);
            match root.ulps() {
                Some(0.0) => writeln!(out, "{name} → {value}, exactly"),
                Some(_) => {
                    let exact = root.exact_text(DIGITS, glyphs).unwrap_or_default();
                    if root.is_correctly_rounded() {
                        return writeln!(out, "{name} → {value}, {exact} rounded once");
                    }
                    let off = root.error_text(glyphs).unwrap_or_default();
                    writeln!(out, "{name} → {value}, {off} from {exact}")
                }
                None => writeln!(out, "{name} → {value}, but there is no such root"),
            }
        }
    };
    root("near", &trace.near)?;
    root("far", &trace.far)?;
    match (trace.solution.place(), trace.solution.visible()) {
        (Some(place), Some(t)) => {
            writeln!(
                out,
                "{}: the ray sees it at t {}",
                place.name(),
                binary32(t, glyphs)
            )?;
        }
        (Some(place), None) => {
            writeln!(out, "{}: the line meets it, the ray does not", place.name())?;
        }
        (None, _) => {}
    }
    match trace.verdict(glyphs) {
        Some(verdict) => writeln!(out, "WRONG: {verdict}"),
        None => Ok(()),
    }
}
