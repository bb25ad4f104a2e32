//! What a person does to spheres: select, move, grow, add, delete, make tangent.

use glam::{DVec3, Vec3};

use crate::explain::{Digits, number};
use crate::explorer::action::Action;
use crate::explorer::cursor;
use crate::explorer::dialog::Dialog;
use crate::explorer::edit::document::Change;
use crate::explorer::edit::motion;
use crate::explorer::state::State;
use crate::geometry::{Decimal, Invalid, Sphere};
use crate::method::{Class, Method, Precision};
use crate::scene::{Body, Projection};

/// The radius of a new sphere as a part of what the camera sees.
const NEW_RADIUS: f64 = 1.0 / 8.0;
/// The greatest factor by which one step grows a sphere.
const GROWTH: f32 = 2.0;

/// Does an action on spheres; false if it is another's.
pub(crate) fn act(action: Action, state: &mut State) -> bool {
    match action {
        Action::SnapTangent => snap_tangent(state),
        Action::NextSphere => select_neighbour(state, 1),
        Action::PreviousSphere => select_neighbour(state, -1),
        Action::NextOnLine => choose_next_on_line(state),
        Action::SelectShown => select_shown(state),
        Action::MoveXPlus => move_sphere(state, 0, 1.0),
        Action::MoveXMinus => move_sphere(state, 0, -1.0),
        Action::MoveYPlus => move_sphere(state, 1, 1.0),
        Action::MoveYMinus => move_sphere(state, 1, -1.0),
        Action::MoveZPlus => move_sphere(state, 2, 1.0),
        Action::MoveZMinus => move_sphere(state, 2, -1.0),
        Action::Grow => grow(state, 1.0),
        Action::Smaller => grow(state, -1.0),
        Action::StepCoarser => set_stride(state, state.work.stride * 2.0),
        Action::StepFiner => set_stride(state, state.work.stride / 2.0),
        Action::MakeTangent => make_tangent(state),
        Action::Add => add_sphere(state),
        Action::Duplicate => duplicate_sphere(state),
        Action::Delete => delete_sphere(state),
        Action::Edit => state.open(Dialog::Form),
        _ => return false,
    }
    true
}

pub(crate) fn select(state: &mut State, at: usize) {
    state.at.sphere = Some(at);
    // What the person selects is what the panel should show, if the line meets it.
    state.at.shown = Some(at);
}

fn select_neighbour(state: &mut State, by: isize) {
    let count = state.scene().bodies.len() as isize;
    if count == 0 {
        return state.say("The scene has no spheres. {add} adds one.");
    }
    let at = match state.at.sphere {
        Some(at) => (at as isize + by).rem_euclid(count),
        None => 0,
    };
    select(state, at as usize);
    let name = state.scene().bodies[at as usize].name.clone();
    let name = name.map_or(String::new(), |n| format!(", {n}"));
    state.say(format!("Sphere {} of {count}{name} is selected.", at + 1));
}

fn select_shown(state: &mut State) {
    if let Some(subject) = state.subject() {
        let at = subject.body;
        select(state, at);
        state.say(format!("Sphere {} is selected.", at + 1));
    }
}

fn choose_next_on_line(state: &mut State) {
    let Some(reading) = state.reading() else {
        return;
    };
    let shown = reading.subject.as_ref().map(|s| s.body);
    let at = reading.meetings.iter().position(|m| Some(m.body) == shown);
    let next = match at {
        Some(at) => reading.meetings.get((at + 1) % reading.meetings.len()),
        None => reading.meetings.first(),
    };
    match next.map(|m| m.body) {
        Some(body) => state.at.shown = Some(body),
        None => state.say("No sphere is on this line."),
    }
}

/// After spheres have come or gone: the numbers still name spheres that are there.
pub(crate) fn mend_selection(state: &mut State) {
    let count = state.scene().bodies.len();
    state.at.sphere = match (state.at.sphere, count) {
        (_, 0) => None,
        (at, _) => Some(at.unwrap_or(0).min(count - 1)),
    };
    state.at.shown = state.at.shown.filter(|&c| c < count);
}

fn selected_body(state: &mut State) -> Option<(usize, Body)> {
    let found = state
        .at
        .sphere
        .and_then(|at| Some((at, state.scene().bodies.get(at)?.clone())));
    if found.is_none() {
        state.say("No sphere is selected.");
    }
    found
}

/// Gives the selected sphere another shape, if that is one.
fn reshape(state: &mut State, at: usize, body: Body, center: Vec3, radius: f32) {
    match Sphere::new(center, radius) {
        Ok(sphere) => {
            if !state.apply(Change::Replace(at, Body { sphere, ..body })) {
                state.say(format!(
                    "A step of {} is lost in rounding here. {{coarser}} makes steps longer.",
                    state.work.stride
                ));
            }
        }
        Err(refused) => state.warn(refused.to_string()),
    }
}

fn move_sphere(state: &mut State, axis: usize, steps: f32) {
    let step = state.work.stride;
    if let Some((at, body)) = selected_body(state) {
        let mut center = body.sphere.center;
        center[axis] += steps * step;
        let radius = body.sphere.radius;
        reshape(state, at, body, center, radius);
    }
}

fn grow(state: &mut State, steps: f32) {
    let step = state.work.stride;
    if let Some((at, body)) = selected_body(state) {
        let Sphere { center, radius } = body.sphere;
        let grown = radius + steps * step;
        // The last step down would pass zero: halve instead, so that small spheres stay spheres.
        let grown = if grown > 0.0 { grown } else { radius / GROWTH };
        reshape(state, at, body, center, grown);
    }
}

/// Adds a sphere on the ray under the cursor, in front of what that hits: it is seen there.
fn add_sphere(state: &mut State) {
    match new_sphere(state) {
        Ok(sphere) => {
            let body = Body {
                sphere,
                name: None,
                color: None,
            };
            insert(state, body, "is added under the cursor and selected");
        }
        Err(refused) => state.warn(refused.to_string()),
    }
}

fn new_sphere(state: &State) -> Result<Sphere, Invalid> {
    let (scene, (x, y)) = (state.scene(), state.at.cursor);
    let camera = &scene.camera;
    let ray = state.picture.rays.ray(x, y);
    let [origin, direction] = [ray.origin, ray.direction].map(Vec3::as_dvec3);
    let far = (camera.look_at - camera.position).as_dvec3().length();
    let first = state.reading().and_then(|reading| reading.meetings.first());
    let hit = first.and_then(|first| first.solution.visible());
    let hit = hit.map(|t| f64::from(t) * direction.length());
    let room = hit.filter(|way| way.is_finite());
    let usual = NEW_RADIUS * motion::window(camera);
    // Half way to what is hit, or where the camera looks.
    let (radius, way) = match (room, camera.projection) {
        (Some(room), Projection::Orthographic { .. }) => (usual.min(room / 4.0), room / 2.0),
        (Some(room), Projection::Perspective { .. }) => {
            ((usual * room / (2.0 * far)).min(room / 4.0), room / 2.0)
        }
        (None, _) => (usual, far),
    };
    let center = origin + direction.normalize_or_zero() * way;
    let grid = f64::from(state.work.usual_stride);
    // On the grid of the keys, numbers stay short; what is smaller than that keeps its own.
    if radius >= 2.0 * grid {
        let round = |x: f64| (x / grid).round() * grid;
        let center = DVec3::from_array(center.to_array().map(round));
        return Sphere::new(center.as_vec3(), ((radius / grid).floor() * grid) as f32);
    }
    Sphere::new(center.as_vec3(), radius as f32)
}

fn duplicate_sphere(state: &mut State) {
    let step = state.work.stride;
    if let Some((_, mut body)) = selected_body(state) {
        body.sphere.center.x += step;
        match Sphere::new(body.sphere.center, body.sphere.radius) {
            Ok(sphere) => {
                body.sphere = sphere;
                insert(state, body, "is added, one step along +x");
            }
            Err(refused) => state.warn(refused.to_string()),
        }
    }
}

fn insert(state: &mut State, body: Body, how: &str) {
    let at = state.scene().bodies.len();
    state.apply(Change::Insert(at, body));
    select(state, at);
    state.say(format!("Sphere {} {how}.", at + 1));
}

fn delete_sphere(state: &mut State) {
    if let Some((at, _)) = selected_body(state) {
        state.apply(Change::Remove(at));
        state.at.shown = None;
        mend_selection(state);
        state.say(format!(
            "Sphere {} is deleted. {{undo}} brings it back.",
            at + 1
        ));
    }
}

/// The radius for which Δ = 0 at the cursor, and what the method makes of it.
fn make_tangent(state: &mut State) {
    let Some(subject) = state.subject() else {
        return state.say("There is no sphere to change.");
    };
    let (at, ray) = (
        subject.body,
        state.picture.rays.ray(state.at.cursor.0, state.at.cursor.1),
    );
    let o = ray.origin.as_dvec3() - subject.sphere.center.as_dvec3();
    let d = ray.direction.as_dvec3();
    let radius = (o.cross(d).length() / d.length()) as f32;
    let body = state.scene().bodies[at].clone();
    let center = body.sphere.center;
    let Ok(sphere) = Sphere::new(center, radius) else {
        return state.warn(format!(
            "The line is {} away: no sphere has that radius.",
            Decimal(radius)
        ));
    };
    select(state, at);
    let body = Body { sphere, ..body };
    state.apply(Change::Replace(at, body));
    let method: Method = state.at.method;
    let class = method.solve(&ray, &sphere).class;
    let discriminant = method.coefficients(&ray, &sphere).discriminant;
    let radius = Decimal(radius);
    state.say(match class {
        Class::Tangent => format!("r = {radius}: Δ = 0 by {method}, the line touches."),
        _ => format!(
            "r = {radius}, the nearest binary32: Δ = {discriminant:e} by {method}, a {class}."
        ),
    });
}

/// Puts the cursor on the pixel nearest to it whose ray touches the sphere shown, or on the
/// pixel whose ray comes nearest to touching.
fn snap_tangent(state: &mut State) {
    let Some(subject) = state.subject() else {
        return state.say("There is no sphere to touch.");
    };
    let sphere = subject.sphere;
    let (method, size) = (state.at.method, state.size());
    let from = state.at.cursor;
    let distance = |x: u32, y: u32| {
        let [dx, dy] = [x.abs_diff(from.0), y.abs_diff(from.1)].map(u64::from);
        dx * dx + dy * dy
    };
    let mut touching: Option<(u64, (u32, u32))> = None;
    let mut closest: Option<(f64, (u32, u32))> = None;
    for y in 0..size.height {
        for x in 0..size.width {
            let ray = state.picture.rays.ray(x, y);
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
        cursor::put_cursor(state, x, y);
        state.say("This ray touches the sphere: Δ = 0.");
    } else if let Some((tilt, (x, y))) = closest {
        cursor::put_cursor(state, x, y);
        state.say(format!(
            "No pixel's ray touches it exactly; this one comes nearest: |cos²θ| = {tilt:.1e}."
        ));
    }
}

/// Δ/(4Ar²) = cos²θ, or its like for a miss, in binary64: zero where the line touches.
fn touch(ray: &crate::geometry::Ray, sphere: &Sphere) -> f64 {
    let o = ray.origin.as_dvec3() - sphere.center.as_dvec3();
    let d = ray.direction.as_dvec3();
    let r = f64::from(sphere.radius);
    1.0 - o.cross(d).length_squared() / (d.length_squared() * r * r)
}

/// Makes steps this long, if that is a length.
pub(crate) fn set_stride(state: &mut State, step: f32) {
    if step.is_finite() && step > 0.0 {
        state.work.stride = step;
    }
    let ratio = state.work.stride / state.work.usual_stride;
    let [step, ratio] = [state.work.stride, ratio]
        .map(|x| number(x.into(), Precision::Binary32, Digits::Significant(6)));
    state.say(format!("One step is {step} ({ratio}× the usual)."));
}
