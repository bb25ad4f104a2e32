//! What a person does to spheres: select, move, grow, add, delete, make tangent.

use glam::Vec3;

use crate::explorer::Explorer;
use crate::explorer::edit::document::Change;
use crate::explorer::edit::motion;
use crate::geometry::{Decimal, Sphere};
use crate::method::{Class, Method};
use crate::scene::Body;

/// The radius of a new sphere as a part of what the camera sees.
const NEW_RADIUS: f64 = 1.0 / 8.0;
/// The greatest factor by which one step grows a sphere.
const GROWTH: f32 = 2.0;

impl Explorer {
    pub(crate) fn select(&mut self, at: usize) {
        self.selected = Some(at);
        // What the person selects is what the panel should show, if the line meets it.
        self.chosen = Some(at);
    }

    pub(crate) fn select_neighbour(&mut self, by: isize) {
        let count = self.scene().bodies.len() as isize;
        if count == 0 {
            return self.say("The scene has no spheres. i adds one.");
        }
        let at = match self.selected {
            Some(at) => (at as isize + by).rem_euclid(count),
            None => 0,
        };
        self.select(at as usize);
        let name = self.scene().bodies[at as usize].name.clone();
        let name = name.map_or(String::new(), |n| format!(", {n}"));
        self.say(format!("Sphere {} of {count}{name} is selected.", at + 1));
    }

    pub(crate) fn select_shown(&mut self) {
        if let Some(subject) = self.reading().and_then(|r| r.subject.as_ref()) {
            let at = subject.body;
            self.select(at);
            self.say(format!("Sphere {} is selected.", at + 1));
        }
    }

    pub(crate) fn choose_next_on_line(&mut self) {
        let Some(reading) = self.reading() else {
            return;
        };
        let shown = reading.subject.as_ref().map(|s| s.body);
        let at = reading.meetings.iter().position(|m| Some(m.body) == shown);
        let next = match at {
            Some(at) => reading.meetings.get((at + 1) % reading.meetings.len()),
            None => reading.meetings.first(),
        };
        match next.map(|m| m.body) {
            Some(body) => self.chosen = Some(body),
            None => self.say("No sphere is on this line."),
        }
    }

    /// After spheres have come or gone: the numbers still name spheres that are there.
    pub(crate) fn mend_selection(&mut self) {
        let count = self.scene().bodies.len();
        self.selected = match (self.selected, count) {
            (_, 0) => None,
            (at, _) => Some(at.unwrap_or(0).min(count - 1)),
        };
        self.chosen = self.chosen.filter(|&c| c < count);
    }

    fn selected_body(&mut self) -> Option<(usize, Body)> {
        let found = self
            .selected
            .and_then(|at| Some((at, self.scene().bodies.get(at)?.clone())));
        if found.is_none() {
            self.say("No sphere is selected.");
        }
        found
    }

    /// Gives the selected sphere another shape, if that is one.
    fn reshape(&mut self, at: usize, body: Body, center: Vec3, radius: f32) {
        match Sphere::new(center, radius) {
            Ok(sphere) => {
                if !self
                    .document
                    .apply(Change::Replace(at, Body { sphere, ..body }))
                {
                    self.say(format!(
                        "A step of {} is lost in rounding here. ] makes steps coarser.",
                        self.step
                    ));
                }
            }
            Err(refused) => self.warn(refused.to_string()),
        }
    }

    pub(crate) fn move_sphere(&mut self, axis: usize, steps: f32) {
        let step = self.step;
        if let Some((at, body)) = self.selected_body() {
            let mut center = body.sphere.center;
            center[axis] += steps * step;
            let radius = body.sphere.radius;
            self.reshape(at, body, center, radius);
        }
    }

    pub(crate) fn grow(&mut self, steps: f32) {
        let step = self.step;
        if let Some((at, body)) = self.selected_body() {
            let Sphere { center, radius } = body.sphere;
            let grown = radius + steps * step;
            // The last step down would pass zero: halve instead, so that small spheres stay spheres.
            let grown = if grown > 0.0 { grown } else { radius / GROWTH };
            self.reshape(at, body, center, grown);
        }
    }

    pub(crate) fn add_sphere(&mut self) {
        let camera = self.scene().camera;
        let radius = (motion::window(&camera) * NEW_RADIUS) as f32;
        match Sphere::new(camera.look_at, radius) {
            Ok(sphere) => {
                let body = Body {
                    sphere,
                    name: None,
                    color: None,
                };
                self.insert(body, "added where the camera looks");
            }
            Err(refused) => self.warn(refused.to_string()),
        }
    }

    pub(crate) fn duplicate_sphere(&mut self) {
        let step = self.step;
        if let Some((_, mut body)) = self.selected_body() {
            body.sphere.center.x += step;
            match Sphere::new(body.sphere.center, body.sphere.radius) {
                Ok(sphere) => {
                    body.sphere = sphere;
                    self.insert(body, "added, one step along +x");
                }
                Err(refused) => self.warn(refused.to_string()),
            }
        }
    }

    fn insert(&mut self, body: Body, how: &str) {
        let at = self.scene().bodies.len();
        self.document.apply(Change::Insert(at, body));
        self.select(at);
        self.say(format!("Sphere {} {how}.", at + 1));
    }

    pub(crate) fn delete_sphere(&mut self) {
        if let Some((at, _)) = self.selected_body() {
            self.document.apply(Change::Remove(at));
            self.chosen = None;
            self.mend_selection();
            self.say(format!("Sphere {} is deleted. u brings it back.", at + 1));
        }
    }

    /// The radius for which Δ = 0 at the cursor, and what the method makes of it.
    pub(crate) fn make_tangent(&mut self) {
        let Some(subject) = self.reading().and_then(|r| r.subject.as_ref()) else {
            return self.say("There is no sphere to change.");
        };
        let (at, ray) = (
            subject.body,
            self.picture.rays.ray(self.cursor.0, self.cursor.1),
        );
        let o = ray.origin.as_dvec3() - subject.sphere.center.as_dvec3();
        let d = ray.direction.as_dvec3();
        let radius = (o.cross(d).length() / d.length()) as f32;
        let body = self.scene().bodies[at].clone();
        let center = body.sphere.center;
        let Ok(sphere) = Sphere::new(center, radius) else {
            return self.warn(format!(
                "The line is {} away: no sphere has that radius.",
                Decimal(radius)
            ));
        };
        self.select(at);
        let body = Body { sphere, ..body };
        self.document.apply(Change::Replace(at, body));
        let method: Method = self.options.method;
        let class = method.solve(&ray, &sphere).class;
        let discriminant = method.coefficients(&ray, &sphere).discriminant;
        let radius = Decimal(radius);
        self.say(match class {
            Class::Tangent => format!("r = {radius}: Δ = 0 by {method}, the line touches."),
            _ => format!(
                "r = {radius}, the nearest binary32: Δ = {discriminant:e} by {method}, a {class}."
            ),
        });
    }

    /// Puts the cursor on the pixel nearest to it whose ray touches the sphere shown, or on the
    /// pixel whose ray comes nearest to touching.
    pub(crate) fn snap_tangent(&mut self) {
        let Some(subject) = self.reading().and_then(|r| r.subject.as_ref()) else {
            return self.say("There is no sphere to touch.");
        };
        let sphere = subject.sphere;
        let (method, size) = (self.options.method, self.size());
        let from = self.cursor;
        let distance = |x: u32, y: u32| {
            let [dx, dy] = [x.abs_diff(from.0), y.abs_diff(from.1)].map(u64::from);
            dx * dx + dy * dy
        };
        let mut touching: Option<(u64, (u32, u32))> = None;
        let mut closest: Option<(f64, (u32, u32))> = None;
        for y in 0..size.height {
            for x in 0..size.width {
                let ray = self.picture.rays.ray(x, y);
                let away = distance(x, y);
                let tilt = touch(&ray, &sphere).abs();
                if closest.is_none_or(|(least, _)| tilt < least) {
                    closest = Some((tilt, (x, y)));
                }
                if touching.is_none_or(|(least, _)| away < least)
                    && tilt < 1e-3
                    && method.solve(&ray, &sphere).class == Class::Tangent
                {
                    touching = Some((away, (x, y)));
                }
            }
        }
        if let Some((_, (x, y))) = touching {
            self.put_cursor(x, y);
            self.say("This ray touches the sphere: Δ = 0.");
        } else if let Some((tilt, (x, y))) = closest {
            self.put_cursor(x, y);
            self.say(format!(
                "No pixel's ray touches it exactly; this one comes nearest: |cos²θ| = {tilt:.1e}."
            ));
        }
    }
}

/// Δ/(4Ar²) = cos²θ, or its like for a miss, in binary64: zero where the line touches.
fn touch(ray: &crate::geometry::Ray, sphere: &Sphere) -> f64 {
    let o = ray.origin.as_dvec3() - sphere.center.as_dvec3();
    let d = ray.direction.as_dvec3();
    let r = f64::from(sphere.radius);
    1.0 - o.cross(d).length_squared() / (d.length_squared() * r * r)
}
