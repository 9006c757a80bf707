//! Cameras: pose, projection, key frames.

use glam::DVec3;

/// A camera; `near` and `far` are distances from `position` along the view.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Name for `--camera`.
    pub name: String,
    /// Eye point.
    pub position: DVec3,
    /// Point looked at.
    pub target: DVec3,
    /// Up direction, not necessarily orthogonal to the view.
    pub up: DVec3,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Near plane, > 0.
    pub near: f64,
    /// Far plane; infinite without it.
    pub far: Option<f64>,
    /// Key frames in ascending time; empty for a camera that stands.
    pub path: Vec<KeyFrame>,
}

/// How the camera projects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Full vertical field of view in degrees.
    Perspective {
        /// Degrees.
        vertical_fov: f64,
    },
    /// Full height of the picture in metres.
    Orthographic {
        /// Metres.
        height: f64,
    },
}

/// One key of a camera path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeyFrame {
    /// Seconds.
    pub t: f64,
    /// Eye point.
    pub position: DVec3,
    /// Point looked at.
    pub target: DVec3,
}

/// Orthonormal frame of a camera: right, up, forward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basis {
    /// +x of the picture.
    pub right: DVec3,
    /// +y of the picture.
    pub up: DVec3,
    /// Into the picture.
    pub forward: DVec3,
}

impl Camera {
    /// The camera's frame, in double precision.
    #[must_use]
    pub fn basis(&self) -> Basis {
        let forward = (self.target - self.position).normalize();
        let right = forward.cross(self.up).normalize();
        Basis { right, up: right.cross(forward), forward }
    }

    /// The camera as it stands at time `t`, in seconds: key frames interpolated linearly, held at both ends.
    #[must_use]
    pub fn at(&self, t: f64) -> Self {
        let mut camera = self.clone();
        let after = self.path.partition_point(|key| key.t <= t);
        let (a, b) = match (after.checked_sub(1).and_then(|i| self.path.get(i)), self.path.get(after)) {
            (Some(a), Some(b)) => (a, b),
            (Some(key), None) | (None, Some(key)) => (key, key),
            (None, None) => return camera,
        };
        let s = if b.t > a.t { (t - a.t) / (b.t - a.t) } else { 0.0 };
        camera.position = a.position.lerp(b.position, s);
        camera.target = a.target.lerp(b.target, s);
        camera
    }
}
