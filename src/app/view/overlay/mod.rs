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
mod paint;
mod picked;
mod scenes;
mod settings;
mod truth;
mod views;

pub(super) use settings::Change;

use super::gathering::Status;
use super::input::number;
use super::picture::Picture;
use super::recent::Recent;
use super::stage::Stage;
use crate::error::Result;
use crate::frame::Timings;
use crate::gpu::Image;
use crate::passes::overlay::{Ground, Overlay};
use crate::scene::settings::Encoding;
use crate::scene::{Camera, Scene};
use compare::{Beside, Compare, Mode};
use counts::Figures;
use egui::style::ScrollStyle;
use egui::{Color32, ComboBox, Context, FullOutput, LayerId, ScrollArea, Ui, ViewportId, pos2};
use history::History;
use inspect::Inspector;
use paint::Textures;
use picked::project;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use views::{VIEWS, Views};
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

/// On hot reload of shaders.
const WATCHED: &str = "Changes in glsl/ are compiled and shown at once.";
const NOT_WATCHED: &str = "The checkout that amas was built from is not here: shaders stay as they are.";

/// Width of the panels, points.
const WIDTH: f32 = 280.0;

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
    /// When egui wants to be drawn again though nothing happened.
    due: Option<Instant>,
}

/// What is new in a picture, with what it took.
pub(super) enum Fresh {
    Nothing,
    Sample(Timings),
    Gathered(Timings),
}

/// What an overlay is drawn with.
struct Tools {
    input: egui_winit::State,
    textures: Textures,
    pass: Overlay,
    /// Of the pictures that it is drawn over.
    encoding: Encoding,
}

impl Gui {
    /// Whether anything is to be drawn over the picture.
    fn is_shown(&self) -> bool {
        let open = self.panels || self.keys || self.scenes || self.trouble.is_some();
        open || self.shows_view() || self.compare.mode != Mode::Off
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

    /// Why a scene is not shown; `None` once one is.
    pub(super) fn complain(&mut self, trouble: Option<String>) {
        self.refused = trouble;
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
        let output = tools.run(&stage.window, |context| {
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
            if let Some(trouble) = &self.trouble {
                complain(context, "Shaders", trouble);
            }
            if let Some(refused) = self.refused.as_ref().filter(|_| self.panels) {
                complain(context, "Scene", refused);
            }
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

    fn panels(&mut self, context: &Context, scene: &mut Arc<Scene>, status: Option<Status>) -> Change {
        let mut change = Change::Nothing;
        let window = egui::Window::new("amas").default_pos([8.0, 8.0]).default_width(WIDTH);
        window.default_height(context.content_rect().height() - 64.0).show(context, |ui| {
            ScrollArea::vertical().show(ui, |ui| {
                section(ui, "Time", |ui| self.history.show(ui));
                section(ui, "View", |ui| self.choose(ui));
                if let Some(status) = status {
                    section(ui, "Gathered light", |ui| gathered::show(ui, status));
                }
                if let Some(figures) = &self.figures {
                    section(ui, "Counts", |ui| figures.show(ui));
                }
                section(ui, "Settings", |ui| change = settings::show(ui, scene));
                section(ui, "Picked", |ui| change = change.max(self.inspector.show(ui, scene)));
                section(ui, "Shaders", |ui| {
                    ui.weak(if self.watched { WATCHED } else { NOT_WATCHED });
                });
                section(ui, "Save", |ui| self.inspector.save(ui, scene));
            });
        });
        change
    }

    /// The debug views and comparisons, as the keys have them.
    fn choose(&mut self, ui: &mut Ui) {
        let mut shown = self.views.shown();
        ComboBox::from_id_salt("view")
            .selected_text(shown.map_or("picture", |view| VIEWS[view].name))
            .show_ui(ui, |ui| {
                ui.selectable_value(&mut shown, None, "picture");
                for (index, view) in VIEWS.iter().enumerate() {
                    ui.selectable_value(&mut shown, Some(index), view.name);
                }
            });
        self.views.show(shown);
        let mut mode = self.compare.mode;
        ui.horizontal(|ui| {
            for (name, value) in [("alone", Mode::Off), ("split", Mode::Split), ("error", Mode::Difference)] {
                ui.radio_value(&mut mode, value, name);
            }
        });
        while mode != self.compare.mode {
            self.compare.next();
        }
    }

    /// A ring around the light that is picked.
    fn mark(&self, context: &Context, scene: &Scene, camera: &Camera, size: [u32; 2]) {
        let place = self.inspector.picked.and_then(|picked| picked.place(scene));
        let Some([x, y, _]) = place.and_then(|place| project(camera, size, place.as_dvec3())) else {
            return;
        };
        let scale = context.pixels_per_point();
        let painter = context.layer_painter(LayerId::background());
        painter.circle_stroke(pos2(x as f32 / scale, y as f32 / scale), 8.0, (1.5, Color32::WHITE));
        painter.circle_stroke(pos2(x as f32 / scale, y as f32 / scale), 9.5, (1.5, Color32::BLACK));
    }
}

impl Tools {
    fn new(stage: &Stage) -> Result<Self> {
        let context = Context::default();
        context.set_theme(egui::Theme::Dark);
        context.all_styles_mut(|style| {
            // What moves by itself would have the window drawn again and again.
            style.animation_time = 0.0;
            style.spacing.scroll = ScrollStyle::solid();
        });
        let scale = Some(stage.window.scale_factor() as f32);
        let side = Some(stage.device.largest_image() as usize);
        let input = egui_winit::State::new(context, ViewportId::ROOT, &stage.window, scale, None, side);
        let encoding = stage.encoding();
        let pass = Overlay::new(&stage.device, encoding)?;
        Ok(Self { input, textures: Textures::default(), pass, encoding })
    }

    fn run(&mut self, window: &Window, mut show: impl FnMut(&Context)) -> FullOutput {
        let input = self.input.take_egui_input(window);
        let context = self.input.egui_ctx().clone();
        let mut output = context.run_ui(input, |ui| show(ui.ctx()));
        self.input.handle_platform_output(window, std::mem::take(&mut output.platform_output));
        output
    }

    fn paint(&mut self, ground: &Ground<'_>, covered: bool, mut output: FullOutput) -> Result<Arc<Image>> {
        self.textures.update(&mut output.textures_delta, &mut self.pass)?;
        let scale = output.pixels_per_point;
        let primitives = self.input.egui_ctx().tessellate(output.shapes, scale);
        let drawing = paint::drawing(primitives, scale, ground.picture.size(), covered);
        self.pass.draw(ground, &drawing)
    }
}

fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(title).default_open(true).show(ui, contents);
}

/// A window on what went wrong.
fn complain(context: &Context, title: &str, trouble: &str) {
    let window = egui::Window::new(title).collapsible(false).default_pos([8.0, 8.0]);
    window.show(context, |ui| {
        ScrollArea::both().max_height(120.0).show(ui, |ui| {
            ui.label(egui::RichText::new(trouble).monospace().color(Color32::LIGHT_RED));
        });
    });
}
