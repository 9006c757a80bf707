//! A camera that flies.

use crate::scene::{Camera, Projection};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;
use std::time::Instant;
use winit::keyboard::KeyCode;

/// Keys by their place on the keyboard, and where each moves: right, up, forward.
const KEYS: [(KeyCode, DVec3); 6] = [
    (KeyCode::KeyW, DVec3::Z),
    (KeyCode::KeyS, DVec3::NEG_Z),
    (KeyCode::KeyA, DVec3::NEG_X),
    (KeyCode::KeyD, DVec3::X),
    (KeyCode::KeyE, DVec3::Y),
    (KeyCode::KeyQ, DVec3::NEG_Y),
];

/// Angle that is kept from straight up and straight down, where "right" has no direction.
const POLE: f64 = PI / 180.0;

/// Longest time between two pictures that counts as movement, in seconds: a slow picture must not throw the camera.
const LONGEST_STEP: f64 = 0.25;

/// Seconds that the way to the camera's target takes at first.
const TIME_TO_TARGET: f64 = 2.0;

/// Factor on the speed for a notch of the wheel.
const NOTCH: f64 = 1.25;

/// A scene's camera under the user's hands.
pub(super) struct Fly {
    camera: Camera,
    /// Metres a second.
    speed: f64,
    held: [bool; KEYS.len()],
    /// The picture before, while a key is held.
    before: Option<Instant>,
    turned: bool,
}

impl Fly {
    pub(super) fn new(camera: &Camera) -> Self {
        Self {
            camera: camera.clone(),
            speed: camera.position.distance(camera.target) / TIME_TO_TARGET,
            held: [false; KEYS.len()],
            before: None,
            turned: false,
        }
    }

    pub(super) fn camera(&self) -> &Camera {
        &self.camera
    }

    /// A key goes down or up; `false` where it does not fly.
    pub(super) fn key(&mut self, code: KeyCode, pressed: bool) -> bool {
        let index = KEYS.iter().position(|&(key, _)| key == code);
        if let Some(index) = index {
            self.held[index] = pressed;
        }
        index.is_some()
    }

    /// All keys go up: a window that is not in front does not hear of it.
    pub(super) fn release(&mut self) {
        self.held = Default::default();
    }

    /// Flies faster by notches of the wheel.
    pub(super) fn accelerate(&mut self, notches: f64) {
        self.speed = (self.speed * NOTCH.powf(notches)).clamp(1e-6, 1e6);
    }

    /// Looks to the right and down, by parts of the picture's height.
    pub(super) fn turn(&mut self, right: f64, down: f64) {
        let field = match self.camera.projection {
            Projection::Perspective { vertical_fov } => vertical_fov.to_radians(),
            Projection::Orthographic { .. } => PI / 4.0,
        };
        let basis = self.camera.basis();
        let up = self.camera.up.normalize();
        let from_up = basis.forward.angle_between(up);
        let lowered = (from_up + down * field).clamp(POLE, PI - POLE) - from_up;
        let rotation =
            DQuat::from_axis_angle(up, -right * field) * DQuat::from_axis_angle(basis.right, -lowered);
        let offset = self.camera.target - self.camera.position;
        self.camera.target = self.camera.position + rotation * offset;
        self.turned = true;
    }

    /// Moves on to the picture of time `now`; `false` where the view rests.
    pub(super) fn step(&mut self, now: Instant) -> bool {
        let flies = self.held.contains(&true);
        let before = std::mem::replace(&mut self.before, flies.then_some(now));
        if let (true, Some(before)) = (flies, before) {
            self.advance((now - before).as_secs_f64().min(LONGEST_STEP));
        }
        std::mem::take(&mut self.turned) || flies
    }

    fn advance(&mut self, seconds: f64) {
        let basis = self.camera.basis();
        let way: DVec3 = KEYS.iter().zip(self.held).filter(|&(_, held)| held).map(|(&(_, way), _)| way).sum();
        let way = basis.right * way.x + self.camera.up.normalize() * way.y + basis.forward * way.z;
        let step = way.normalize_or_zero() * self.speed * seconds;
        self.camera.position += step;
        self.camera.target += step;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    /// At the origin, looking along −z from 2 m away, 90° high.
    fn fly() -> Fly {
        Fly::new(&Camera {
            name: "main".into(),
            position: DVec3::ZERO,
            target: DVec3::NEG_Z * 2.0,
            up: DVec3::Y,
            projection: Projection::Perspective { vertical_fov: 90.0 },
            near: 0.05,
            far: None,
            path: Vec::new(),
        })
    }

    fn near(a: DVec3, b: DVec3) {
        assert!(a.distance(b) < 1e-9, "{a} against {b}");
    }

    #[test]
    fn keys_move_by_speed_and_time() {
        let (mut fly, start) = (fly(), Instant::now());
        assert!(!fly.step(start));
        assert!(fly.key(KeyCode::KeyW, true));
        assert!(!fly.key(KeyCode::KeyP, true));
        assert!(fly.step(start));
        near(fly.camera().position, DVec3::ZERO);
        assert!(fly.step(start + Duration::from_millis(100)));
        near(fly.camera().position, DVec3::NEG_Z * 0.1);
        near(fly.camera().target, DVec3::NEG_Z * 2.1);
        fly.key(KeyCode::KeyW, false);
        assert!(!fly.step(start + Duration::from_millis(200)));
        near(fly.camera().position, DVec3::NEG_Z * 0.1);
    }

    #[test]
    fn a_pause_is_no_leap() {
        let (mut fly, start) = (fly(), Instant::now());
        fly.key(KeyCode::KeyE, true);
        fly.step(start);
        fly.step(start + Duration::from_secs(60));
        near(fly.camera().position, DVec3::Y * LONGEST_STEP);
        fly.release();
        assert!(!fly.step(start + Duration::from_secs(61)));
    }

    #[test]
    fn opposite_keys_cancel() {
        let (mut fly, start) = (fly(), Instant::now());
        fly.key(KeyCode::KeyA, true);
        fly.key(KeyCode::KeyD, true);
        fly.step(start);
        fly.step(start + Duration::from_millis(100));
        near(fly.camera().position, DVec3::ZERO);
    }

    #[test]
    fn dragging_turns_and_stops_at_the_poles() {
        let mut fly = fly();
        fly.turn(1.0, 0.0);
        near(fly.camera().target, DVec3::X * 2.0);
        assert!(fly.step(Instant::now()));
        assert!(!fly.step(Instant::now()));
        fly.turn(0.0, 0.5);
        let forward = fly.camera().basis().forward;
        near(forward, DVec3::new(1.0, -1.0, 0.0).normalize());
        for down in [9.0, -9.0] {
            fly.turn(0.0, down);
            assert!(fly.camera().basis().right.is_finite());
            assert!((fly.camera().basis().forward.y.abs() - POLE.cos()).abs() < 1e-9);
        }
    }

    #[test]
    fn the_wheel_changes_the_speed() {
        let mut fly = fly();
        fly.accelerate(2.0);
        assert!((fly.speed - NOTCH * NOTCH).abs() < 1e-12);
        fly.accelerate(-1e9);
        assert!(fly.speed > 0.0);
    }
}
