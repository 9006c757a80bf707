//! `amas view`: the same frame in a window.
//!
//! The window's thread handles input and renders a sample of the picture at a time, when there is something new to see:
//! one through the pixels' centres while the view moves, the scene's samples, one after the other, once it rests. Then, when
//! nothing else is to be done, it gathers light, in slices that input need not wait for. Lights are traced, files are read, scenes uploaded and pipelines compiled on other threads, whose results arrive as [`Event`]s.

mod capture;
mod display;
mod events;
mod fly;
mod folders;
mod gathering;
mod input;
mod loading;
mod overlay;
mod pace;
mod picture;
mod pilot;
mod recent;
mod scenes;
mod shaders;
mod signals;
mod stage;
mod startup;
mod supply;
mod waiting;
mod watch;
mod worker;

use super::args::{SceneOptions, ViewOptions};
use super::outputs::{Kind, kind};
use super::report;
use crate::error::{Error, Result};
use crate::frame::Timings;
use crate::gpu::Replaced;
use crate::image::HdrImage;
use capture::Captures;
use gathering::Done;
use input::Pointer;
use loading::{Aim, Loading, Progress};
use overlay::{Change, Fresh, Gui};
use picture::{Occasion, Picture, Shape};
use pilot::Pilot;
use recent::Recent;
use stage::Stage;
use startup::Startup;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Instant;
use waiting::Waiting;
use watch::Watch;
use winit::event_loop::{EventLoop, EventLoopProxy};
use winit::window::Window;
use worker::Worker;

/// What other threads tell the window's.
enum Event {
    /// A signal asks to close.
    Quit,
    /// Lights to gather from are ready.
    Lights,
    /// A job of that ticket has come to something.
    Loaded(u64, Progress),
    /// A file that the scene was read from has changed.
    Changed,
    /// Sources of shaders have changed: what they compile to, or why they do not.
    Shaders(std::result::Result<Replaced, String>),
}

pub(super) fn run(options: &ViewOptions) -> Result<()> {
    let startup = Startup::new(options.startup);
    // What is wrong with the scene file itself is said before a window opens.
    let settings = options.scene.origin().settings(&options.scene.overrides())?;
    check(options)?;
    open(options, settings.size, startup).map_err(display::advise)
}

/// What else the options name is there, and is what it is for.
fn check(options: &ViewOptions) -> Result<()> {
    if let Some(file) = &options.compare {
        if kind(file)? == Kind::Display {
            let cause =
                format!("--compare {}: 8 bits of a display hold no light to compare with", file.display());
            return Err(Error::usage(cause, "give a .exr or .pfm, as `amas reference` writes them"));
        }
        HdrImage::load(file)?;
    }
    options.glsl.as_deref().map_or(Ok(()), shaders::check)
}

fn open(options: &ViewOptions, size: [u32; 2], startup: Startup) -> Result<()> {
    let event_loop: EventLoop<Event> = display::connect()?;
    let proxy = event_loop.create_proxy();
    signals::listen(proxy.clone())?;
    let first = Aim::First(options.camera.clone());
    let loading = Loading::start(options.scene.clone(), first, 0, &proxy, Worker::start());
    let mut viewer = Viewer {
        options,
        size,
        watch: Watch::start(proxy.clone()),
        proxy,
        startup,
        current: options.scene.clone(),
        window: None,
        stage: None,
        picture: None,
        pilot: None,
        waiting: Waiting::default(),
        loading: Some(loading),
        look: None,
        ticket: 0,
        worker: None,
        abandoned: Vec::new(),
        captures: Captures::default(),
        notice: None,
        pointer: Pointer::default(),
        gui: Gui::default(),
        hidden: false,
        minimised: None,
        moves: false,
        gathered: None,
        warned: false,
        start: Instant::now(),
        remaining: options.frames,
        closing: false,
        outcome: Ok(()),
        end: None,
    };
    viewer.gui.compare_with(options.compare.clone());
    viewer.gui.remember(Recent::load(folders::state()));
    viewer.gui.shaders_watched(shaders::watch(options.glsl.as_deref(), viewer.proxy.clone()));
    event_loop.run_app(&mut viewer).map_err(|error| display::missing(&error.to_string()))?;
    viewer.close()
}

struct Viewer<'a> {
    options: &'a ViewOptions,
    /// Of the window, as the scene asked for it, pixels.
    size: [u32; 2],
    proxy: EventLoopProxy<Event>,
    startup: Startup,
    /// The scene in the window, or that is to be the first there.
    current: SceneOptions,
    watch: Watch,
    /// Held to the end: if it is destroyed, it was not from here.
    window: Option<Arc<Window>>,
    stage: Option<Stage>,
    /// `None` until the first scene is loaded.
    picture: Option<Box<Picture>>,
    pilot: Option<Pilot>,
    waiting: Waiting,
    loading: Option<Loading>,
    /// When to see next how far it is.
    look: Option<Instant>,
    /// Of the last job.
    ticket: u64,
    /// Of the last job that has come to its end.
    worker: Option<Worker>,
    /// Threads that still use the device for scenes that nobody waits for.
    abandoned: Vec<JoinHandle<()>>,
    captures: Captures,
    /// What went wrong last, for the title.
    notice: Option<&'static str>,
    pointer: Pointer,
    gui: Gui,
    /// Nothing of the window is on screen.
    hidden: bool,
    /// Minimised, and when to look next whether it still is.
    minimised: Option<Instant>,
    /// The view moved when it was last drawn.
    moves: bool,
    /// A frame of gathered light that is not drawn yet.
    gathered: Option<Timings>,
    warned: bool,
    start: Instant,
    /// Pictures to show before closing; `None`: until the user closes.
    remaining: Option<u32>,
    closing: bool,
    outcome: Result<()>,
    /// When an outcome that is an error closes the window.
    end: Option<Instant>,
}

impl Viewer<'_> {
    fn redraw(&self) {
        if let Some(stage) = &self.stage {
            stage.window.request_redraw();
        }
    }

    fn draw(&mut self) -> Result<()> {
        let Some(stage) = &mut self.stage else {
            return Ok(());
        };
        // Without an area nothing moves, until the window has a size again.
        let Some(size) = stage.fit()? else {
            return Ok(());
        };
        let (Some(picture), Some(pilot)) = (&mut self.picture, &mut self.pilot) else {
            let fraction = self.loading.as_ref().map_or(0.0, Loading::fraction);
            if stage.show(self.waiting.image(&stage.device, size, fraction)?)? {
                self.startup.reached_once("window");
            }
            return Ok(());
        };
        let now = Instant::now();
        let moves = pilot.step(now) || picture.frame.scene().moves();
        picture.set_single(self.gui.shows_view());
        picture.fit(Shape { size, encoding: stage.encoding() }, pilot.camera())?;
        if self.remaining.is_some() && picture.is_complete() {
            picture.restart();
        }
        self.moves = moves;
        let gathers = !moves && self.remaining.is_none();
        let occasion = Occasion { time: (now - self.start).as_secs_f64(), moves, gathers };
        let fresh = match (picture.step(pilot.camera(), occasion)?, self.gathered.take()) {
            (Some(timings), _) => Fresh::Sample(timings),
            (None, Some(timings)) => Fresh::Gathered(timings),
            (None, None) => Fresh::Nothing,
        };
        if picture.is_dark() {
            // What the window shows has more light.
            if !picture.is_complete() {
                stage.window.request_redraw();
            }
            return Ok(());
        }
        self.gui.follow(self.loading.as_ref());
        let (image, change) = self.gui.draw(stage, picture, pilot.camera(), fresh)?;
        let shown = stage.show(&image)?;
        picture.change(change, pilot.camera())?;
        if shown && let Some(remaining) = &mut self.remaining {
            *remaining = remaining.saturating_sub(1);
        }
        if shown {
            self.startup.done("first picture")?;
        }
        let counters = picture.frame.counters();
        if !self.warned && counters.overflowed > 0 {
            report::warn_of_overflow(&counters, picture.scene.render.max_lights_per_cluster);
            self.warned = true;
        }
        let unfinished = !picture.is_complete() || self.gui.is_behind();
        if moves || !shown || change > Change::Nothing || unfinished || self.remaining.is_some() {
            stage.window.request_redraw();
        }
        if self.gui.cancelled() {
            self.abandon();
            self.redraw();
        }
        if let Some(scene) = self.gui.chosen() {
            self.dropped(scene);
        }
        Ok(())
    }

    /// Gathers light for some milliseconds, where the view rests and there is any to gather; whether there may be more to do.
    fn gather(&mut self) -> Result<bool> {
        if self.moves || self.rests() || self.closing || self.remaining.is_some() {
            return Ok(false);
        }
        let (Some(picture), Some(pilot)) = (&mut self.picture, &self.pilot) else {
            return Ok(false);
        };
        let more = match picture.gather(pilot.camera())? {
            Done::Nothing => false,
            Done::Part => true,
            Done::State => {
                self.redraw();
                true
            }
            Done::Frame(timings) => {
                self.gathered = Some(timings);
                self.redraw();
                true
            }
        };
        Ok(more)
    }

    /// Makes the frame anew with shaders that have changed; where that fails, the old one stays.
    fn reload_shaders(&mut self, shaders: std::result::Result<Replaced, String>) {
        let (Some(stage), Some(picture), Some(pilot)) = (&self.stage, &mut self.picture, &self.pilot) else {
            return;
        };
        let made = shaders.and_then(|shaders| {
            let before = stage.device.replace_shaders(Replaced::new());
            stage.device.replace_shaders(before.clone().into_iter().chain(shaders).collect());
            picture.remake(pilot.camera()).map_err(|error| {
                stage.device.replace_shaders(before);
                error.to_string()
            })
        });
        self.gui.shaders_compiled(made);
        self.redraw();
    }

    /// After the loop: how it went.
    fn close(mut self) -> Result<()> {
        // What is under way on the device may take seconds to end.
        if let Some(stage) = &self.stage {
            stage.window.set_visible(false);
        }
        self.abandon();
        self.abandoned.extend(self.worker.take().map(Worker::retire));
        for thread in self.abandoned.drain(..) {
            // A panic was reported on its thread.
            let _ = thread.join();
        }
        self.picture = None;
        let device = self.stage.take().map(|stage| stage.device.clone());
        if let Some(device) = &device {
            device.keep_pipelines();
        }
        self.outcome?;
        device.map_or(Ok(()), |device| device.require_silence())
    }
}
