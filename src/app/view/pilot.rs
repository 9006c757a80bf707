//! The camera under the user's hands: flying, looking around, turning around a point, walking along a path.

use super::fly::Fly;
use crate::scene::{Camera, Projection};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;
use std::time::Instant;
use winit::keyboard::KeyCode;

/// Angle that is kept from straight up and straight down, where "right" has no direction.
const POLE: f64 = PI / 180.0;

/// Seconds in which the whole scene is crossed at first.
const TIME_ACROSS: f64 = 10.0;

/// Where the window looks from, and the scene's cameras to go back to.
pub(super) struct Pilot {
    camera: Camera,
    /// The scene's cameras, in the file's order.
    homes: Vec<Camera>,
    home: usize,
    fly: Fly,
    walk: Option<Walk>,
    /// Since the last picture.
    moved: bool,
}

/// On the path of a camera.
struct Walk {
    path: Camera,
    /// When it was at the path's beginning.
    start: Instant,
}

impl Pilot {
    /// At one of the cameras, which are not empty, in a scene of that many metres from corner to corner.
    pub(super) fn new(homes: &[Camera], home: usize, diagonal: Option<f64>) -> Self {
        let camera = homes[home].clone();
        // Without surfaces there is still something that the camera looks at.
        let size = diagonal.unwrap_or_else(|| 5.0 * camera.position.distance(camera.target));
        let fly = Fly::new(size / TIME_ACROSS);
        Self { camera, homes: homes.to_vec(), home, fly, walk: None, moved: false }
    }

    pub(super) fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The camera as another one for the scene file.
    pub(super) fn copy(&self) -> Camera {
        Camera { name: format!("{} (copied)", self.camera.name), ..self.camera.clone() }
    }

    /// A key of [`Fly`] goes down or up; `false` where it is none.
    pub(super) fn key(&mut self, code: KeyCode, pressed: bool) -> bool {
        let flies = self.fly.key(code, pressed);
        if flies && pressed {
            self.walk = None;
        }
        flies
    }

    /// All keys go up.
    pub(super) fn release(&mut self) {
        self.fly.release();
    }

    /// Flies faster by notches of the wheel.
    pub(super) fn accelerate(&mut self, notches: f64) {
        self.fly.accelerate(notches);
    }

    /// Looks to the right and down, by parts of the picture's height.
    pub(super) fn look(&mut self, right: f64, down: f64) {
        let field = match self.camera.projection {
            Projection::Perspective { vertical_fov } => vertical_fov.to_radians(),
            Projection::Orthographic { .. } => PI / 4.0,
        };
        self.rotate(self.camera.position, right * field, down * field);
    }

    /// Turns around a point that stays where it is in the picture, by parts of the picture's height: half a turn for all of
    /// it.
    pub(super) fn orbit(&mut self, pivot: DVec3, right: f64, down: f64) {
        self.rotate(pivot, right * PI, down * PI);
    }

    /// Rotates the camera about a point, to the right and down by angles.
    fn rotate(&mut self, pivot: DVec3, right: f64, down: f64) {
        let basis = self.camera.basis();
        let up = self.camera.up.normalize();
        let from_up = basis.forward.angle_between(up);
        let lowered = (from_up + down).clamp(POLE, PI - POLE) - from_up;
        let rotation = DQuat::from_axis_angle(up, -right) * DQuat::from_axis_angle(basis.right, -lowered);
        for point in [&mut self.camera.position, &mut self.camera.target] {
            *point = pivot + rotation * (*point - pivot);
        }
        self.walk = None;
        self.moved = true;
    }

    /// Goes nearer to the target by a share of its distance.
    pub(super) fn approach(&mut self, share: f64) {
        let way = (self.camera.target - self.camera.position) * share.clamp(-0.9, 0.9);
        self.camera.position += way;
        self.walk = None;
        self.moved = true;
    }

    /// Goes to the scene's camera of that number, or back to the last of them; `false` where it has no such.
    pub(super) fn go_home(&mut self, number: Option<usize>) -> bool {
        let home = number.unwrap_or(self.home);
        let Some(camera) = self.homes.get(home) else {
            return false;
        };
        self.camera = camera.clone();
        self.home = home;
        self.walk = None;
        self.moved = true;
        true
    }

    /// Sets off on the path of the last of the scene's cameras, or of the first that has one, or stops; `false` where there is
    /// none.
    pub(super) fn walk(&mut self, now: Instant) -> bool {
        if self.walk.take().is_some() {
            return true;
        }
        let path = self.homes[self.home..].iter().chain(&self.homes).find(|home| !home.path.is_empty());
        self.walk = path.map(|path| Walk { path: path.clone(), start: now });
        self.walk.is_some()
    }

    /// The scene was loaded again: the camera stays.
    pub(super) fn rehome(&mut self, homes: &[Camera]) {
        self.homes = homes.to_vec();
        self.home = self.home.min(homes.len() - 1);
        self.walk = None;
    }

    /// Moves on to the picture of time `now`; `false` where the view rests.
    pub(super) fn step(&mut self, now: Instant) -> bool {
        let flies = self.fly.step(&mut self.camera, now);
        let walks = self.follow(now);
        std::mem::take(&mut self.moved) || flies || walks
    }

    fn follow(&mut self, now: Instant) -> bool {
        let Some(Walk { path, start }) = &self.walk else {
            return false;
        };
        let begin = path.path.first().map_or(0.0, |key| key.t);
        let t = begin + now.saturating_duration_since(*start).as_secs_f64();
        self.camera = path.at(t);
        if path.path.last().is_none_or(|key| t >= key.t) {
            self.walk = None;
        }
        true
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::scene::KeyFrame;
    use std::time::Duration;

    /// At the origin, looking along −z from 2 m away, 90° high.
    pub(in super::super) fn camera() -> Camera {
        Camera {
            name: "main".into(),
            position: DVec3::ZERO,
            target: DVec3::NEG_Z * 2.0,
            up: DVec3::Y,
            projection: Projection::Perspective { vertical_fov: 90.0 },
            near: 0.05,
            far: None,
            path: Vec::new(),
        }
    }

    pub(in super::super) fn near(a: DVec3, b: DVec3) {
        assert!(a.distance(b) < 1e-9, "{a} against {b}");
    }

    fn pilot() -> Pilot {
        Pilot::new(&[camera()], 0, None)
    }

    #[test]
    fn dragging_looks_around_and_stops_at_the_poles() {
        let mut pilot = pilot();
        pilot.look(1.0, 0.0);
        near(pilot.camera().target, DVec3::X * 2.0);
        assert!(pilot.step(Instant::now()));
        assert!(!pilot.step(Instant::now()));
        pilot.look(0.0, 0.5);
        near(pilot.camera().basis().forward, DVec3::new(1.0, -1.0, 0.0).normalize());
        for down in [9.0, -9.0] {
            pilot.look(0.0, down);
            let basis = pilot.camera().basis();
            assert!(basis.right.is_finite());
            assert!((basis.forward.y.abs() - POLE.cos()).abs() < 1e-9);
        }
    }

    /// Half a turn leads to the other side; distance and place in the picture stay.
    #[test]
    fn orbits_keep_the_pivot_in_its_place() {
        let pivot = DVec3::new(0.5, 0.25, -3.0);
        let seen = |camera: &Camera| {
            let (basis, way) = (camera.basis(), pivot - camera.position);
            DVec3::new(way.dot(basis.right), way.dot(basis.up), way.dot(basis.forward))
        };
        let mut pilot = pilot();
        let before = seen(pilot.camera());
        pilot.orbit(pivot, 1.0, 0.0);
        near(pilot.camera().position, DVec3::new(1.0, 0.0, -6.0));
        for (right, down) in [(0.3, 0.1), (-0.7, -0.25), (0.0, 5.0)] {
            pilot.orbit(pivot, right, down);
            near(seen(pilot.camera()), before);
        }
    }

    #[test]
    fn numbers_lead_to_cameras_and_back() {
        let other = Camera { position: DVec3::X, ..camera() };
        let mut pilot = Pilot::new(&[camera(), other.clone()], 0, Some(10.0));
        assert!(pilot.go_home(Some(1)));
        assert_eq!(pilot.camera(), &other);
        assert!(!pilot.go_home(Some(2)));
        pilot.approach(0.5);
        near(pilot.camera().position, DVec3::new(0.5, 0.0, -1.0));
        assert!(pilot.go_home(None));
        assert_eq!(pilot.camera(), &other);
        pilot.rehome(&[camera()]);
        assert!(pilot.go_home(None));
        assert_eq!(pilot.camera(), &camera());
    }

    #[test]
    fn walks_follow_the_path_to_its_end() {
        let key = |t, x| KeyFrame { t, position: DVec3::X * x, target: DVec3::X * x - DVec3::Z };
        let path = Camera { path: vec![key(1.0, 0.0), key(3.0, 4.0)], ..camera() };
        let now = Instant::now();
        let mut pilot = Pilot::new(&[camera(), path], 0, None);
        assert!(pilot.walk(now));
        assert!(pilot.step(now + Duration::from_millis(500)));
        near(pilot.camera().position, DVec3::X);
        assert!(pilot.step(now + Duration::from_secs(9)));
        near(pilot.camera().position, DVec3::X * 4.0);
        assert!(!pilot.step(now + Duration::from_secs(10)));
        assert!(!Pilot::new(&[camera()], 0, None).walk(now));
    }
}
