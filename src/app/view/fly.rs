//! Flying by keys.

use crate::scene::Camera;
use glam::DVec3;
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

/// Longest time between two pictures that counts as movement, in seconds: a slow picture must not throw the camera.
const LONGEST_STEP: f64 = 0.25;

/// Factor on the speed for a notch of the wheel.
const NOTCH: f64 = 1.25;

/// Keys that are held, and how fast they move a camera.
#[derive(Default)]
pub(super) struct Fly {
    /// Metres a second.
    speed: f64,
    held: [bool; KEYS.len()],
    /// The picture before, while a key is held.
    before: Option<Instant>,
}

impl Fly {
    /// At a speed in metres a second.
    pub(super) fn new(speed: f64) -> Self {
        Self { speed, ..Self::default() }
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

    /// Moves on to the picture of time `now`; `false` where no key is held.
    pub(super) fn step(&mut self, camera: &mut Camera, now: Instant) -> bool {
        let flies = self.held.contains(&true);
        let before = std::mem::replace(&mut self.before, flies.then_some(now));
        if let (true, Some(before)) = (flies, before) {
            self.advance(camera, (now - before).as_secs_f64().min(LONGEST_STEP));
        }
        flies
    }

    fn advance(&self, camera: &mut Camera, seconds: f64) {
        let basis = camera.basis();
        let way: DVec3 = KEYS.iter().zip(self.held).filter(|&(_, held)| held).map(|(&(_, way), _)| way).sum();
        let way = basis.right * way.x + camera.up.normalize() * way.y + basis.forward * way.z;
        let step = way.normalize_or_zero() * self.speed * seconds;
        camera.position += step;
        camera.target += step;
    }
}

#[cfg(test)]
mod tests {
    use super::super::pilot::tests::{camera, near};
    use super::*;
    use std::time::Duration;

    #[test]
    fn keys_move_by_speed_and_time() {
        let (mut fly, mut camera, start) = (Fly::new(1.0), camera(), Instant::now());
        assert!(!fly.step(&mut camera, start));
        assert!(fly.key(KeyCode::KeyW, true));
        assert!(!fly.key(KeyCode::KeyP, true));
        assert!(fly.step(&mut camera, start));
        near(camera.position, DVec3::ZERO);
        assert!(fly.step(&mut camera, start + Duration::from_millis(100)));
        near(camera.position, DVec3::NEG_Z * 0.1);
        near(camera.target, DVec3::NEG_Z * 2.1);
        fly.key(KeyCode::KeyW, false);
        assert!(!fly.step(&mut camera, start + Duration::from_millis(200)));
        near(camera.position, DVec3::NEG_Z * 0.1);
    }

    #[test]
    fn a_pause_is_no_leap() {
        let (mut fly, mut camera, start) = (Fly::new(1.0), camera(), Instant::now());
        fly.key(KeyCode::KeyE, true);
        fly.step(&mut camera, start);
        fly.step(&mut camera, start + Duration::from_secs(60));
        near(camera.position, DVec3::Y * LONGEST_STEP);
        fly.release();
        assert!(!fly.step(&mut camera, start + Duration::from_secs(61)));
    }

    #[test]
    fn opposite_keys_cancel() {
        let (mut fly, mut camera, start) = (Fly::new(1.0), camera(), Instant::now());
        fly.key(KeyCode::KeyA, true);
        fly.key(KeyCode::KeyD, true);
        fly.step(&mut camera, start);
        fly.step(&mut camera, start + Duration::from_millis(100));
        near(camera.position, DVec3::ZERO);
    }

    #[test]
    fn the_wheel_changes_the_speed() {
        let mut fly = Fly::new(1.0);
        fly.accelerate(2.0);
        assert!((fly.speed - NOTCH * NOTCH).abs() < 1e-12);
        fly.accelerate(-1e9);
        assert!(fly.speed > 0.0);
    }
}
