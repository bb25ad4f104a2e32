//! Writing scene files: a tidy text that reads back to exactly the same scene.
//!
//! Where and how the text is saved is the caller's affair.

use std::fmt::{self, Write};

use glam::Vec3;

use super::{Aim, Body, Camera, Probe, Projection, Rgb, Scene};
use crate::geometry::{Decimal, List};

impl Scene {
    /// The scene as the text of a scene file.
    ///
    /// Numbers are the shortest decimals that read back as the same binary32.
    pub fn to_toml(&self) -> String {
        let mut text = String::with_capacity(512 + 80 * self.bodies.len());
        // Writing to a string cannot fail.
        let _ = self.write_to(&mut text);
        text
    }

    fn write_to(&self, out: &mut impl Write) -> fmt::Result {
        writeln!(out, "name = {}", Quoted(&self.name))?;
        if let Some(about) = &self.about {
            writeln!(out, "about = {}", Quoted(about))?;
        }
        self.camera.write_to(out)?;
        if let Some(pixels) = self.pixels {
            writeln!(out, "pixels = [{}, {}]", pixels.width, pixels.height)?;
        }
        if let Some(light) = self.light {
            writeln!(out, "\n[light]\nposition = {}", list(light.position))?;
        }
        self.probes.iter().try_for_each(|p| p.write_to(out))?;
        self.bodies.iter().try_for_each(|b| b.write_to(out))
    }
}

impl Camera {
    fn write_to(&self, out: &mut impl Write) -> fmt::Result {
        let name = self.projection.name();
        writeln!(out, "\n[camera]\nprojection = \"{name}\"")?;
        writeln!(out, "position = {}", list(self.position))?;
        writeln!(out, "look_at = {}", list(self.look_at))?;
        writeln!(out, "up = {}", list(self.up))?;
        match self.projection {
            Projection::Orthographic { extent, step } => {
                writeln!(out, "extent = {}", List(extent))?;
                step.map_or(Ok(()), |step| writeln!(out, "step = {}", Decimal(step)))
            }
            Projection::Perspective { field_of_view } => {
                writeln!(out, "field_of_view = {}", Decimal(field_of_view))
            }
        }
    }
}

impl Probe {
    fn write_to(&self, out: &mut impl Write) -> fmt::Result {
        writeln!(out, "\n[[probe]]")?;
        match self.aim {
            Aim::Pixel(x, y) => writeln!(out, "pixel = [{x}, {y}]")?,
            Aim::Point(point) => writeln!(out, "point = {}", list(point))?,
        }
        writeln!(out, "title = {}", Quoted(&self.title))?;
        writeln!(out, "text = {}", Quoted(&self.text))
    }
}

impl Body {
    fn write_to(&self, out: &mut impl Write) -> fmt::Result {
        writeln!(out, "\n[[sphere]]")?;
        if let Some(name) = &self.name {
            writeln!(out, "name = {}", Quoted(name))?;
        }
        writeln!(out, "center = {}", list(self.sphere.center))?;
        writeln!(out, "radius = {}", Decimal(self.sphere.radius))?;
        if let Some(color) = self.color {
            writeln!(out, "color = \"{color}\"")?;
        }
        Ok(())
    }
}

impl fmt::Display for Rgb {
    /// `#rrggbb`, as scene files have it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(r, g, b) = self;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

fn list(v: Vec3) -> List<3> {
    List(v.to_array())
}

/// A basic string of TOML.
struct Quoted<'a>(&'a str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('"')?;
        for c in self.0.chars() {
            match c {
                '"' | '\\' => write!(f, "\\{c}")?,
                c if c.is_control() => write!(f, "\\u{:04X}", u32::from(c))?,
                c => f.write_char(c)?,
            }
        }
        f.write_char('"')
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_are_escaped() {
        let quoted = Quoted("a \"b\" \\ √\n\u{7f}").to_string();
        assert_eq!(quoted, r#""a \"b\" \\ √\u000A\u007F""#);
    }
}
