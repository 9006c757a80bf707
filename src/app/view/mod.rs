//! `amas view`: the same frame in a window.
//!
//! A picture is rendered when there is something new to see: with one sample a pixel while the camera moves, with the
//! scene's samples once it rests.

mod fly;
mod overlay;
mod stage;

use super::args::ViewOptions;
use super::{camera, in_scene, load_scene};
use crate::error::{Error, Result};
use crate::gpu::Shown;
use crate::scene::Scene;
use fly::Fly;
use overlay::Change;
use stage::{Stage, View};
use std::panic;
use std::time::Instant;
use winit::application::ApplicationHandler;
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{KeyCode, PhysicalKey};
use winit::window::WindowId;

/// Pixels that a touchpad scrolls for a notch of a wheel.
const PIXELS_PER_NOTCH: f64 = 40.0;

pub(super) fn run(options: &ViewOptions) -> Result<()> {
    let scene = load_scene(&options.scene)?;
    let camera = in_scene(&options.scene, camera(&scene, options.camera.as_deref()))?;
    let fly = Fly::new(camera);
    open(options, scene, fly).map_err(advise)
}

fn open(options: &ViewOptions, scene: Scene, fly: Fly) -> Result<()> {
    let event_loop = event_loop()?;
    let mut viewer = Viewer {
        options,
        scene,
        fly,
        stale: true,
        stage: None,
        start: Instant::now(),
        pointer: None,
        dragging: false,
        remaining: options.frames,
        outcome: Ok(()),
    };
    event_loop.run_app(&mut viewer).map_err(|error| no_display(&error.to_string()))?;
    let device = viewer.stage.take().map(|stage| stage.device.clone());
    viewer.outcome?;
    device.map_or(Ok(()), |device| device.require_silence())
}

/// Connects to the display.
fn event_loop() -> Result<EventLoop<()>> {
    // winit panics where a library or an extension of the display is missing; its message belongs into the error.
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let made = panic::catch_unwind(EventLoop::new);
    panic::set_hook(hook);
    match made {
        Ok(made) => made.map_err(|error| no_display(&error.to_string())),
        Err(payload) => Err(no_display(message(&*payload))),
    }
}

fn message(payload: &dyn std::any::Any) -> &str {
    payload
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| payload.downcast_ref::<&str>().copied())
        .unwrap_or("no reason given")
}

fn no_display(reason: &str) -> Error {
    // winit's place in its own source says nothing to a user.
    let reason = reason
        .strip_prefix("os error at ")
        .and_then(|rest| rest.split_once(": "))
        .map_or(reason, |(_, reason)| reason);
    Error::NoDevice {
        cause: format!("there is no display to open a window on ({})", reason.trim_end_matches('.')),
        remedy: "start it from a desktop session, and run ./setup for the display's libraries".into(),
    }
}

/// Whatever keeps the window shut, the same picture can be had without it.
fn advise(error: Error) -> Error {
    match error {
        Error::NoDevice { cause, remedy } => Error::NoDevice {
            cause,
            remedy: format!("{remedy}; or use `amas render`, which needs no window"),
        },
        other => other,
    }
}

struct Viewer<'a> {
    options: &'a ViewOptions,
    scene: Scene,
    fly: Fly,
    /// The picture on screen is not of this moment.
    stale: bool,
    start: Instant,
    stage: Option<Stage>,
    /// Where the pointer was last, in pixels.
    pointer: Option<[f64; 2]>,
    dragging: bool,
    /// Pictures to show before closing; `None`: until the user closes.
    remaining: Option<u32>,
    outcome: Result<()>,
}

impl Viewer<'_> {
    /// Has the picture rendered anew.
    fn redraw(&mut self) {
        self.stale = true;
        if let Some(stage) = &self.stage {
            stage.window.request_redraw();
        }
    }

    fn draw(&mut self) -> Result<()> {
        let Some(stage) = &mut self.stage else {
            return Ok(());
        };
        let now = Instant::now();
        let moves = self.fly.step(now) || !self.scene.motions.is_empty();
        let time = (now - self.start).as_secs_f64();
        let samples = if moves { 1 } else { self.scene.render.samples };
        let view = View { camera: self.fly.camera(), time, samples };
        if self.stale || moves || self.remaining.is_some() || !stage.has_picture() {
            // Without an area nothing moves, until the window has a size again.
            if !stage.render(&self.scene, view)? {
                return Ok(());
            }
            self.stale = false;
        }
        let (shown, change) = stage.show(&mut self.scene)?;
        if change > Change::Nothing {
            stage.change(self.options, &self.scene, self.fly.camera(), change)?;
            self.stale = true;
        }
        let on_screen = matches!(shown, Shown::Yes | Shown::Misfit);
        if on_screen && let Some(remaining) = &mut self.remaining {
            *remaining = remaining.saturating_sub(1);
        }
        if self.stale || moves || !on_screen || self.remaining.is_some() {
            stage.window.request_redraw();
        }
        Ok(())
    }

    fn key(&mut self, event_loop: &ActiveEventLoop, code: KeyCode, pressed: bool) {
        if code == KeyCode::Escape && pressed {
            event_loop.exit();
        } else if pressed && self.stage.as_mut().is_some_and(|stage| stage.key(code)) {
            // The overlay alone is drawn anew.
        } else if self.fly.key(code, pressed) {
            self.redraw();
        }
    }

    fn drag(&mut self, to: [f64; 2]) {
        let from = self.pointer.replace(to);
        if let (true, Some([x, y]), Some(stage)) = (self.dragging, from, &self.stage) {
            let height = f64::from(stage.window.inner_size().height.max(1));
            self.fly.turn((to[0] - x) / height, (to[1] - y) / height);
            self.redraw();
        }
    }

    /// Ends the loop where something failed.
    fn settle(&mut self, event_loop: &ActiveEventLoop, result: Result<()>) {
        if result.is_err() {
            self.outcome = result;
        }
        if self.outcome.is_err() || self.remaining == Some(0) {
            event_loop.exit();
        }
    }
}

impl ApplicationHandler for Viewer<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.stage.is_some() {
            return;
        }
        let opened = Stage::open(event_loop, self.options, &self.scene);
        let result = opened.map(|stage| self.stage = Some(stage));
        self.settle(event_loop, result);
        self.redraw();
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let due = self.stage.as_ref().and_then(Stage::due);
        event_loop.set_control_flow(due.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
        if due.is_some_and(|due| due <= Instant::now())
            && let Some(stage) = &self.stage
        {
            stage.window.request_redraw();
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if self.stage.as_mut().is_some_and(|stage| stage.overlay_takes(&event)) {
            return;
        }
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested if self.outcome.is_ok() && !event_loop.exiting() => {
                let result = self.draw();
                self.settle(event_loop, result);
            }
            WindowEvent::Resized(_) => {
                if let Some(stage) = &mut self.stage {
                    stage.outdate();
                }
                self.redraw();
            }
            WindowEvent::KeyboardInput {
                event: KeyEvent { physical_key: PhysicalKey::Code(code), state, .. },
                ..
            } => self.key(event_loop, code, state == ElementState::Pressed),
            WindowEvent::Focused(false) => {
                self.fly.release();
                self.dragging = false;
            }
            WindowEvent::MouseInput { button: MouseButton::Left, state, .. } => {
                self.dragging = state == ElementState::Pressed
            }
            WindowEvent::CursorMoved { position, .. } => self.drag(position.into()),
            WindowEvent::MouseWheel { delta, .. } => self.fly.accelerate(match delta {
                MouseScrollDelta::LineDelta(_, lines) => lines.into(),
                MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_PER_NOTCH,
            }),
            _ => {}
        }
    }
}
