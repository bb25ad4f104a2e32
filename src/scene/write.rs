//! Writing scene files: a tidy text that reads back to exactly the same scene.
//!
//! Where and how the text is saved is the caller's affair.

use std::fmt::{self, Write};

use glam::Vec3;

use super::{Aim, Body, Camera, Probe, Projection, Rgb, Scene};

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
            Projection::Orthographic { extent } => writeln!(out, "extent = {}", List(extent)),
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

/// The shortest decimal that reads back as the same binary32, as TOML spells it.
struct Decimal(f32);

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Readers of TOML need not accept integers from 2⁶³ on; zeros before that are no help.
        const PLAIN: std::ops::Range<f32> = 1e-5..1e15;
        let value = self.0;
        if value == 0.0 && value.is_sign_negative() {
            // As an integer, −0 would lose its sign.
            write!(f, "-0.0")
        } else if value == 0.0 || PLAIN.contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

struct List<const N: usize>([f32; N]);

fn list(v: Vec3) -> List<3> {
    List(v.to_array())
}

impl<const N: usize> fmt::Display for List<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (n, &component) in self.0.iter().enumerate() {
            let before = if n == 0 { "[" } else { ", " };
            write!(f, "{before}{}", Decimal(component))?;
        }
        write!(f, "]")
    }
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
    fn decimals_are_short_and_plain_where_that_is_short() {
        for (value, text) in [
            (10.0, "10"),
            (-0.1, "-0.1"),
            (16_777_216.0, "16777216"),
            (0.0, "0"),
            (-0.0, "-0.0"),
            (1e-5, "0.00001"),
            (1e-7, "1e-7"),
            (1e30, "1e30"),
            (-f32::MAX, "-3.4028235e38"),
            (f32::from_bits(1), "1e-45"),
        ] {
            assert_eq!(Decimal(value).to_string(), text);
        }
    }

    #[test]
    fn strings_are_escaped() {
        let quoted = Quoted("a \"b\" \\ √\n\u{7f}").to_string();
        assert_eq!(quoted, r#""a \"b\" \\ √\u000A\u007F""#);
    }
}
