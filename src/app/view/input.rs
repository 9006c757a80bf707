//! Keys and pointer: what they ask of the viewer.

use super::Viewer;
use crate::app::terminal::print;
use crate::error::Result;
use crate::scene::write;
use arboard::Clipboard;
use glam::DVec3;
use std::time::Instant;
use winit::event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{KeyCode, ModifiersState, PhysicalKey};

/// Pixels that a touchpad scrolls for a notch of a wheel, at a scale of 1.
const PIXELS_PER_NOTCH: f64 = 40.0;

/// The number keys, which stand for the scene's cameras, or for scenes.
const NUMBERS: [KeyCode; 9] = [
    KeyCode::Digit1,
    KeyCode::Digit2,
    KeyCode::Digit3,
    KeyCode::Digit4,
    KeyCode::Digit5,
    KeyCode::Digit6,
    KeyCode::Digit7,
    KeyCode::Digit8,
    KeyCode::Digit9,
];

/// The number key that it is, from 0 on.
pub(super) fn number(code: KeyCode) -> Option<usize> {
    NUMBERS.iter().position(|&key| key == code)
}

/// Where the pointer is, what it drags, and what was copied.
#[derive(Default)]
pub(super) struct Pointer {
    /// Pixels of the window.
    at: Option<[f64; 2]>,
    drag: Option<Drag>,
    modifiers: ModifiersState,
    /// Serves what was copied for as long as it lives.
    clipboard: Option<Clipboard>,
}

impl Pointer {
    /// Where there is no clipboard (Wayland without an X server), the terminal has the text.
    fn copy(&mut self, text: String) {
        if self.clipboard.is_none() {
            self.clipboard = Clipboard::new().ok();
        }
        if let Some(clipboard) = &mut self.clipboard {
            let _ = clipboard.set_text(text);
        }
    }
}

#[derive(Clone, Copy)]
enum Drag {
    Look,
    Orbit(DVec3),
}

impl Viewer<'_> {
    /// Handles an event of keyboard or pointer.
    pub(super) fn input(&mut self, event: WindowEvent) -> Result<()> {
        if let Some(stage) = &self.stage
            && self.gui.takes(&stage.window, &event)
        {
            return Ok(());
        }
        match event {
            WindowEvent::KeyboardInput { event, .. } => {
                if let PhysicalKey::Code(code) = event.physical_key {
                    return self.key(code, event.state == ElementState::Pressed, event.repeat);
                }
            }
            WindowEvent::ModifiersChanged(modifiers) => self.pointer.modifiers = modifiers.state(),
            WindowEvent::Focused(false) => {
                self.pointer.drag = None;
                if let Some(pilot) = &mut self.pilot {
                    pilot.release();
                }
            }
            WindowEvent::MouseInput { button, state, .. } => {
                self.pointer.drag = if state == ElementState::Pressed { self.grab(button)? } else { None };
            }
            WindowEvent::CursorMoved { position, .. } => self.drag(position.into()),
            WindowEvent::MouseWheel { delta, .. } => self.scroll(delta),
            WindowEvent::PinchGesture { delta, .. } => {
                if let Some(pilot) = &mut self.pilot {
                    pilot.approach(delta);
                    self.redraw();
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn key(&mut self, code: KeyCode, pressed: bool, repeat: bool) -> Result<()> {
        if code == KeyCode::Escape && pressed {
            self.cancel_or_close();
            return Ok(());
        }
        let Some(pilot) = &mut self.pilot else {
            return Ok(());
        };
        let flies = !self.pointer.modifiers.control_key() && pilot.key(code, pressed);
        if !flies && (!pressed || repeat) {
            return Ok(());
        }
        match code {
            _ if flies => {}
            KeyCode::KeyP => {
                pilot.walk(Instant::now());
            }
            KeyCode::KeyR => {
                pilot.go_home(None);
            }
            KeyCode::KeyC => {
                let text = write::camera(&pilot.copy());
                print(text.trim_end())?;
                self.pointer.copy(text);
            }
            KeyCode::KeyI => {
                if let (Some(at), Some(picture)) = (self.pointer.at, &self.picture) {
                    let time = self.start.elapsed().as_secs_f64();
                    self.gui.pick(picture, pilot.camera(), time, at)?;
                }
            }
            _ if self.gui.key(code) => {}
            KeyCode::F5 => self.reload(),
            KeyCode::F12 => {
                if let Some(picture) = &self.picture {
                    self.captures.take(picture)?;
                }
            }
            KeyCode::KeyV => {
                if let Some(stage) = &mut self.stage {
                    stage.toggle_vsync();
                }
            }
            _ => {
                if let Some(number) = number(code) {
                    pilot.go_home(Some(number));
                }
            }
        }
        self.redraw();
        Ok(())
    }

    /// What a button that goes down begins to drag.
    fn grab(&self, button: MouseButton) -> Result<Option<Drag>> {
        let around = match button {
            MouseButton::Left => self.pointer.modifiers.control_key(),
            MouseButton::Right => true,
            _ => return Ok(None),
        };
        if !around {
            return Ok(Some(Drag::Look));
        }
        let (Some(at), Some(pilot), Some(picture)) = (self.pointer.at, &self.pilot, &self.picture) else {
            return Ok(None);
        };
        // Where nothing is, around what the camera looks at.
        let pivot = picture.pick(at.map(|side| side.max(0.0) as u32))?;
        Ok(Some(Drag::Orbit(pivot.unwrap_or(pilot.camera().target))))
    }

    fn drag(&mut self, to: [f64; 2]) {
        let from = self.pointer.at.replace(to);
        let (Some(drag), Some([x, y]), Some(stage), Some(pilot)) =
            (self.pointer.drag, from, &self.stage, &mut self.pilot)
        else {
            return;
        };
        let [right, down] = [to[0] - x, to[1] - y].map(|way| way / stage.height());
        match drag {
            Drag::Look => pilot.look(right, down),
            Drag::Orbit(pivot) => pilot.orbit(pivot, right, down),
        }
        self.redraw();
    }

    fn scroll(&mut self, delta: MouseScrollDelta) {
        let scale = self.stage.as_ref().map_or(1.0, |stage| stage.window.scale_factor());
        let notches = match delta {
            MouseScrollDelta::LineDelta(_, lines) => lines.into(),
            MouseScrollDelta::PixelDelta(pixels) => pixels.y / (PIXELS_PER_NOTCH * scale),
        };
        if let Some(pilot) = &mut self.pilot {
            pilot.accelerate(notches);
        }
    }
}
