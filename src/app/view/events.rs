//! What the window system and the other threads tell the viewer, and when it draws of itself.

use super::stage::{self, Stage};
use super::{Event, Viewer};
use crate::error::{Error, Result};
use std::time::{Duration, Instant};
use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow};
use winit::window::WindowId;

/// Time between two looks at how far loading is.
const LOOK: Duration = Duration::from_millis(100);

/// Time between two looks at whether a minimised window is back: the window manager may say so after the display asked for
/// a picture.
const REST: Duration = Duration::from_millis(250);

/// Time that a display has to say that the window is gone, once the driver fails to draw there.
const GRACE: Duration = Duration::from_millis(200);

impl Viewer<'_> {
    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let window = stage::window(event_loop, self.size)?;
        self.window = Some(window.clone());
        self.stage = Some(Stage::open(event_loop, self.options, window)?);
        Ok(())
    }

    /// Ends the loop where something failed, or where all is done.
    fn settle(&mut self, event_loop: &ActiveEventLoop, result: Result<()>) {
        if let Err(error) = result
            && self.outcome.is_ok()
        {
            // Another program may have destroyed the window: the driver knows before the display has said so.
            let of_driver = matches!(error, Error::NoDevice { .. } | Error::Vulkan { .. });
            self.end = (of_driver && self.window.is_some()).then(|| Instant::now() + GRACE);
            self.outcome = Err(error);
        }
        let failed = self.outcome.is_err() && self.end.is_none_or(|end| end <= Instant::now());
        if self.closing || failed || self.remaining == Some(0) {
            event_loop.exit();
        }
    }

    /// Another program destroyed the window, without asking: it is closed, and what drawing there came to is no error.
    fn destroyed(&mut self) {
        self.closing = true;
        if self.end.take().is_some() {
            self.outcome = Ok(());
        }
    }

    /// Nobody sees the window.
    pub(super) fn rests(&self) -> bool {
        self.hidden || self.minimised.is_some()
    }

    /// When to draw though nothing happens.
    fn due(&mut self) -> Option<Instant> {
        self.look = self.loading.as_ref().map(|_| self.look.unwrap_or_else(|| Instant::now() + LOOK));
        self.look.into_iter().chain(self.gui.due()).chain(self.minimised).min()
    }

    /// Draws because it is due.
    fn wake(&mut self) {
        self.look = None;
        self.minimised = self.minimised.map(|_| Instant::now() + REST);
        self.gui.woken();
        self.redraw();
    }

    fn occurred(&mut self, event: Event) -> Result<()> {
        match event {
            Event::Quit => self.closing = true,
            // What waits for them goes on before the loop sleeps again.
            Event::Lights => {}
            Event::Loaded(ticket, progress) => return self.progress(ticket, progress),
            Event::Shaders(shaders) => self.reload_shaders(shaders),
            Event::Changed => self.reload(),
        }
        Ok(())
    }

    fn window_said(&mut self, event: WindowEvent) -> Result<()> {
        match event {
            WindowEvent::CloseRequested => self.closing = true,
            WindowEvent::RedrawRequested => {
                // X11 does not say it of itself.
                let minimised =
                    self.window.as_ref().is_some_and(|window| window.is_minimized() == Some(true));
                self.minimised = minimised.then(|| Instant::now() + REST);
                if !self.rests() {
                    return self.draw();
                }
            }
            WindowEvent::Resized(size) => {
                if let Some(stage) = &mut self.stage {
                    stage.resized(size);
                }
                self.redraw();
            }
            // Where that changes the size, it is said next.
            WindowEvent::ScaleFactorChanged { .. } => self.redraw(),
            WindowEvent::Occluded(hidden) => {
                self.hidden = hidden;
                self.redraw();
            }
            WindowEvent::DroppedFile(path) => self.dropped(path),
            event => return self.input(event),
        }
        Ok(())
    }
}

impl ApplicationHandler<Event> for Viewer<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.stage.is_none() {
            let opened = self.open(event_loop);
            self.startup.reached("device");
            self.settle(event_loop, opened);
        }
        self.redraw();
    }

    fn suspended(&mut self, _: &ActiveEventLoop) {
        if let Some(stage) = &mut self.stage {
            stage.suspend();
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if matches!(cause, StartCause::ResumeTimeReached { .. }) {
            self.wake();
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: Event) {
        if self.outcome.is_ok() {
            let result = self.occurred(event);
            self.settle(event_loop, result);
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if event_loop.exiting() {
            return;
        }
        let result = match event {
            WindowEvent::Destroyed => {
                self.destroyed();
                Ok(())
            }
            _ if self.outcome.is_err() => Ok(()),
            event => self.window_said(event),
        };
        self.settle(event_loop, result);
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let mut more = false;
        if self.outcome.is_ok() && !event_loop.exiting() {
            let gathered = self.gather();
            more = matches!(gathered, Ok(true));
            self.settle(event_loop, gathered.map(|_| ()));
        }
        if self.outcome.is_err() {
            self.settle(event_loop, Ok(()));
            event_loop.set_control_flow(self.end.map_or(ControlFlow::Poll, ControlFlow::WaitUntil));
            return;
        }
        self.entitle();
        let due = self.due();
        if more {
            if due.is_some_and(|due| due <= Instant::now()) {
                self.wake();
            }
            event_loop.set_control_flow(ControlFlow::Poll);
            return;
        }
        event_loop.set_control_flow(due.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}
