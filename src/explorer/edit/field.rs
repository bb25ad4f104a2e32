//! The numbers that a person can type: each of the selected sphere and of the camera.

use crate::geometry::{Decimal, Invalid, Sphere};
use crate::scene::{Camera, Projection, Scene};
use crate::text::read;

use crate::explorer::edit::document::Change;

/// One number of a sphere or of the camera.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberField {
    /// A coordinate of the selected sphere's centre.
    Center(usize),
    /// The selected sphere's radius.
    Radius,
    /// A coordinate of the camera's position.
    Position(usize),
    /// A coordinate of the point looked at.
    LookAt(usize),
    /// A coordinate of the direction that points up.
    Up(usize),
    /// Width (0) or height (1) of what an orthographic camera sees.
    Extent(usize),
    /// What the places of an orthographic camera's pixels are multiples of.
    PixelStep,
    /// The vertical angle that a perspective camera sees, in degrees.
    ViewAngle,
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl NumberField {
    /// All fields that a scene has, the selected sphere's first.
    pub fn of(scene: &Scene, selected: Option<usize>) -> Vec<Self> {
        Self::all()
            .filter(|f| f.get(scene, selected).is_some())
            .collect()
    }

    fn all() -> impl Iterator<Item = Self> {
        (0..3)
            .map(Self::Center)
            .chain([Self::Radius])
            .chain((0..3).map(Self::Position))
            .chain((0..3).map(Self::LookAt))
            .chain((0..3).map(Self::Up))
            .chain((0..2).map(Self::Extent))
            .chain([Self::PixelStep, Self::ViewAngle])
    }

    /// The field of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().find(|f| f.name() == name)
    }

    /// The names of all fields.
    pub fn all_names() -> Vec<String> {
        Self::all().map(Self::name).collect()
    }

    /// The name: the key of the scene file, with the axis after a point.
    pub fn name(self) -> String {
        match self {
            Self::Center(i) => format!("center.{}", AXES[i]),
            Self::Radius => "radius".into(),
            Self::Position(i) => format!("position.{}", AXES[i]),
            Self::LookAt(i) => format!("look_at.{}", AXES[i]),
            Self::Up(i) => format!("up.{}", AXES[i]),
            Self::Extent(0) => "extent.width".into(),
            Self::Extent(_) => "extent.height".into(),
            Self::PixelStep => "step".into(),
            Self::ViewAngle => "field_of_view".into(),
        }
    }

    /// Whether it belongs to the sphere rather than to the camera.
    pub const fn is_of_sphere(self) -> bool {
        matches!(self, Self::Center(_) | Self::Radius)
    }

    /// The number now; none if the scene has no such number.
    pub fn get(self, scene: &Scene, selected: Option<usize>) -> Option<f32> {
        let sphere = selected.and_then(|s| scene.bodies.get(s)).map(|b| b.sphere);
        let camera = &scene.camera;
        match (self, camera.projection) {
            (Self::Center(i), _) => sphere.map(|s| s.center[i]),
            (Self::Radius, _) => sphere.map(|s| s.radius),
            (Self::Position(i), _) => Some(camera.position[i]),
            (Self::LookAt(i), _) => Some(camera.look_at[i]),
            (Self::Up(i), _) => Some(camera.up[i]),
            (Self::Extent(i), Projection::Orthographic { extent, .. }) => Some(extent[i]),
            (Self::PixelStep, Projection::Orthographic { step, .. }) => step,
            (Self::ViewAngle, Projection::Perspective { field_of_view }) => Some(field_of_view),
            _ => None,
        }
    }

    /// The change that gives the number this value, if a scene file could hold it.
    pub fn set(
        self,
        scene: &Scene,
        selected: Option<usize>,
        value: f32,
    ) -> Result<Change, Invalid> {
        if self.get(scene, selected).is_none() {
            let found = "not in this scene";
            return Err(Invalid::new(self.name(), found, "a number the scene has"));
        }
        if !value.is_finite() {
            return Err(Invalid::new(self.name(), Decimal(value), "a finite number"));
        }
        if let (true, Some(at)) = (self.is_of_sphere(), selected) {
            let mut body = scene.bodies[at].clone();
            match self {
                Self::Center(i) => body.sphere.center[i] = value,
                _ => body.sphere.radius = value,
            }
            body.sphere =
                Sphere::new(body.sphere.center, body.sphere.radius).map_err(|e| Invalid {
                    field: self.name(),
                    ..e
                })?;
            return Ok(Change::Replace(at, body));
        }
        let mut camera = scene.camera;
        self.set_in_camera(&mut camera, value);
        camera.check()?;
        Ok(Change::Camera(camera))
    }

    fn set_in_camera(self, camera: &mut Camera, value: f32) {
        match (self, &mut camera.projection) {
            (Self::Position(i), _) => camera.position[i] = value,
            (Self::LookAt(i), _) => camera.look_at[i] = value,
            (Self::Up(i), _) => camera.up[i] = value,
            (Self::Extent(i), Projection::Orthographic { extent, .. }) => extent[i] = value,
            (Self::PixelStep, Projection::Orthographic { step, .. }) => *step = Some(value),
            (Self::ViewAngle, Projection::Perspective { field_of_view }) => {
                *field_of_view = value;
            }
            _ => {}
        }
    }
}

/// The scene with all these numbers, if a scene file could hold it: what two of them say together
/// is checked, not what each says alone.
pub(crate) fn set_all(
    scene: &Scene,
    selected: Option<usize>,
    numbers: &[(NumberField, f32)],
) -> Result<Scene, Invalid> {
    let mut scene = scene.clone();
    for &(field, value) in numbers {
        if field.get(&scene, selected).is_none() {
            let found = "not in this scene";
            return Err(Invalid::new(field.name(), found, "a number the scene has"));
        }
        if field.is_of_sphere() {
            if let Change::Replace(at, body) = field.set(&scene, selected, value)? {
                scene.bodies[at] = body;
            }
        } else {
            field.set_in_camera(&mut scene.camera, value);
        }
    }
    scene.camera.check()?;
    Ok(scene)
}

/// A number as a person types it, rounded once to binary32.
pub fn parse_number(field: &str, text: &str) -> Result<f32, Invalid> {
    match read::binary32(text) {
        Some(value) if value.is_finite() => Ok(value),
        Some(value) if text.bytes().any(|b| b.is_ascii_digit()) => Err(Invalid::new(
            field,
            format!("{text}, which rounds to {value}"),
            "a number within ±3.4028235e38",
        )),
        _ => Err(Invalid::new(field, format!("“{text}”"), "a finite number")),
    }
}
