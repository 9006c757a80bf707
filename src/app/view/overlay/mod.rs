//! The overlay over the picture: panels of figures and settings, in egui.
//!
//! Hidden, it is neither made nor drawn: the picture goes to the window as it is. Shown, it is drawn into a copy of the
//! picture, so that a picture at rest need not be rendered again for a pointer that moves.

mod compare;
mod counts;
mod document;
mod gathered;
mod history;
mod inspect;
mod keys;
mod legend;
mod loading;
mod paint;
mod panels;
mod picked;
mod scenes;
mod settings;
mod tools;
mod truth;
mod views;

pub(super) use settings::Change;

use super::input::number;
use super::loading::Loading;
use super::picture::Picture;
use super::recent::Recent;
use super::stage::Stage;
use crate::error::Result;
use crate::frame::Timings;
use crate::gpu::Image;
use crate::passes::overlay::Ground;
use crate::scene::{Camera, Scene};
use compare::{Beside, Compare, Mode};
use counts::Figures;
use egui::{Color32, ViewportId};
use history::History;
use inspect::Inspector;
use loading::Job;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use tools::Tools;
use views::Views;
use winit::event::{ElementState, WindowEvent};
use winit::keyboard::KeyCode;
use winit::window::Window;

/// Colours of the passes in frame order: those of Okabe and Ito, which all eyes tell apart, with light grey for their black.
const PASS_COLORS: [Color32; 8] = [
    Color32::from_rgb(240, 228, 66),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(0, 114, 178),
    Color32::from_rgb(220, 220, 220),
];

/// Time between two looks at the reference.
const LOOK: Duration = Duration::from_millis(250);

/// The overlay's state; what it draws with is made when it is first shown.
#[derive(Default)]
pub(super) struct Gui {
    /// The panels of figures and settings are open.
    panels: bool,
    /// The list of keys is open.
    keys: bool,
    /// The list of scenes that were shown before is open.
    scenes: bool,
    recent: Recent,
    /// Of them, the one to show next.
    chosen: Option<PathBuf>,
    tools: Option<Tools>,
    history: History,
    /// Of the last picture; `None` where nobody has asked.
    figures: Option<Figures>,
    inspector: Inspector,
    views: Views,
    compare: Compare,
    /// Sources of shaders are watched.
    watched: bool,
    /// Why shaders that changed are not used.
    trouble: Option<String>,
    /// Why the scene that was loaded last is not shown.
    refused: Option<String>,
    /// The scene that is being loaded.
    job: Option<Job>,
    /// The user does not want it.
    cancelled: bool,
    /// When egui wants to be drawn again though nothing happened.
    due: Option<Instant>,
}

/// What is new in a picture, with what it took.
pub(super) enum Fresh {
    Nothing,
    Sample(Timings),
    Gathered(Timings),
}

impl Gui {
    /// Whether anything is to be drawn over the picture.
    fn is_shown(&self) -> bool {
        let open = self.panels || self.keys || self.scenes;
        let told = self.trouble.is_some() || self.refused.is_some() || self.job.is_some();
        open || told || self.shows_view() || self.compare.mode != Mode::Off
    }

    /// Whether a picture at rest is to be drawn once more, with its error.
    pub(super) fn is_behind(&self) -> bool {
        self.panels && self.figures.as_ref().is_some_and(|figures| !figures.is_estimated())
    }

    /// Whether a debug view is shown in the picture's place.
    pub(super) fn shows_view(&self) -> bool {
        self.views.shown().is_some()
    }

    /// A file to compare pictures with, instead of the oracle's.
    pub(super) fn compare_with(&mut self, file: Option<PathBuf>) {
        self.compare.file = file;
    }

    /// The scenes that were shown before.
    pub(super) fn remember(&mut self, recent: Recent) {
        self.recent = recent;
    }

    /// What is being loaded, if anything is.
    pub(super) fn follow(&mut self, loading: Option<&Loading>) {
        self.job = loading.and_then(Job::of);
    }

    /// Whether the user does not want what is being loaded, once.
    pub(super) fn cancelled(&mut self) -> bool {
        std::mem::take(&mut self.cancelled)
    }

    /// The scene that the user wants next, once.
    pub(super) fn chosen(&mut self) -> Option<PathBuf> {
        self.chosen.take()
    }

    /// A scene was loaded, from that file.
    pub(super) fn begin(&mut self, scene: &Scene, file: Option<&Path>) {
        if let Some(file) = file {
            self.recent.add(file);
        }
        self.inspector.begin(scene);
        self.views.forget();
        self.compare.forget();
        self.refused = None;
    }

    /// Whether there are sources of shaders to watch.
    pub(super) fn shaders_watched(&mut self, watched: bool) {
        self.watched = watched;
    }

    /// What came of shaders that changed.
    pub(super) fn shaders_compiled(&mut self, made: std::result::Result<(), String>) {
        if made.is_ok() {
            // The overlay's own may be among them.
            self.tools = None;
            self.views.forget();
            self.compare.outdate();
        }
        self.trouble = made.err();
    }

    /// Why a scene is not shown.
    pub(super) fn complain(&mut self, trouble: String) {
        self.refused = Some(trouble);
    }

    /// Picks what is under a pixel, and opens the panels.
    pub(super) fn pick(&mut self, picture: &Picture, camera: &Camera, time: f64, at: [f64; 2]) -> Result<()> {
        self.inspector.picked = picked::pick(picture, camera, time, at)?;
        self.panels = true;
        Ok(())
    }

    /// Opens or closes what a key stands for; whether it does.
    pub(super) fn key(&mut self, code: KeyCode) -> bool {
        let open = match code {
            KeyCode::KeyO => &mut self.panels,
            KeyCode::Slash | KeyCode::F1 => &mut self.keys,
            KeyCode::KeyL => &mut self.scenes,
            _ if self.scenes
                && let Some(number) = number(code) =>
            {
                self.chosen = self.recent.scenes().get(number).cloned();
                self.scenes = false;
                return true;
            }
            KeyCode::KeyX => {
                self.compare.next();
                return true;
            }
            _ => return self.views.key(code),
        };
        *open = !*open;
        true
    }

    /// Whether an event is the overlay's alone.
    pub(super) fn takes(&mut self, window: &Window, event: &WindowEvent) -> bool {
        let shown = self.is_shown();
        let Some(tools) = self.tools.as_mut().filter(|_| shown) else {
            return false;
        };
        let response = tools.input.on_window_event(window, event);
        if response.repaint {
            window.request_redraw();
        }
        // What goes up may have gone down before the overlay was in the way.
        let up = match event {
            WindowEvent::MouseInput { state, .. } => *state == ElementState::Released,
            WindowEvent::KeyboardInput { event, .. } => event.state == ElementState::Released,
            _ => false,
        };
        response.consumed && !up
    }

    /// It is being drawn again, or cannot be: a time that has passed must not be waited for.
    pub(super) fn woken(&mut self) {
        self.due = None;
    }

    /// When the overlay has to be drawn again of itself.
    pub(super) fn due(&self) -> Option<Instant> {
        self.due.filter(|_| self.is_shown())
    }

    /// The picture with what is shown over it, and what the user changed there.
    pub(super) fn draw(
        &mut self,
        stage: &Stage,
        picture: &mut Picture,
        camera: &Camera,
        fresh: Fresh,
    ) -> Result<(Arc<Image>, Change)> {
        let rests = !matches!(fresh, Fresh::Sample(_)) && picture.is_complete();
        if let Fresh::Sample(timings) | Fresh::Gathered(timings) = &fresh {
            self.history.add(timings);
            self.compare.refresh();
        }
        if let Fresh::Sample(_) = fresh {
            self.figures = None;
            self.views.outdate();
        }
        if !self.is_shown() {
            return Ok((picture.image().clone(), Change::Nothing));
        }
        if self.panels && self.figures.is_none() {
            self.figures = Some(Figures::new(&stage.device, picture)?);
        }
        if self.panels
            && rests
            && let Some(figures) = &mut self.figures
        {
            figures.estimate(picture)?;
        }
        let mut tools = match self.tools.take().filter(|tools| tools.encoding == stage.encoding()) {
            Some(tools) => tools,
            None => {
                // What was made for others has gone.
                self.views.forget();
                self.compare.outdate();
                Tools::new(stage)?
            }
        };
        let mut change = Change::Nothing;
        let size = picture.frame.settings().size;
        let status = picture.status();
        let output = tools.run(&stage.window, size, |context| {
            if self.panels {
                change = change.max(self.panels(context, &mut picture.scene, status));
                self.mark(context, &picture.scene, camera, size);
            }
            if self.keys {
                keys::show(context, &mut self.keys);
            }
            if self.scenes
                && let Some(scene) = scenes::show(context, &self.recent, &mut self.scenes)
            {
                self.chosen = Some(scene);
            }
            if let Some(job) = &self.job {
                self.cancelled |= job.show(context);
            }
            self.complaints(context);
            legend::show(context, &self.views, &mut self.compare, size);
        });
        // Longer than a day means never.
        let delay = output.viewport_output.get(&ViewportId::ROOT).map(|view| view.repaint_delay);
        self.due = delay.filter(|&delay| delay < Duration::from_secs(86_400)).map(|d| Instant::now() + d);
        if self.compare.is_at_work() {
            let look = Instant::now() + LOOK;
            self.due = Some(self.due.map_or(look, |due| due.min(look)));
        }
        // There is one cover, and a difference takes it.
        let differs = self.compare.mode == Mode::Difference;
        let mut covered = !differs && self.views.draw(picture, &mut tools.pass)?;
        if differs {
            self.views.outdate();
        }
        let beside = match self.compare.draw(picture, camera, &mut tools.pass)? {
            Beside::Nothing => None,
            Beside::Split(truth, column) => Some((truth, column)),
            Beside::Cover => {
                covered = true;
                None
            }
        };
        let image = tools.paint(&Ground { picture: picture.image(), beside }, covered, output)?;
        self.tools = Some(tools);
        self.settle(change);
        Ok((image, change))
    }

    /// Forgets what a change makes wrong.
    fn settle(&mut self, change: Change) {
        if change >= Change::Frame {
            self.views.forget();
            self.compare.outdate();
        }
        if matches!(change, Change::Edit(_) | Change::Scene) {
            self.compare.forget();
        }
    }
}
