//! The overlay over the picture: panels of figures and settings, in egui.
//!
//! Hidden, it is neither made nor drawn: the picture goes to the window as it is. Shown, it is drawn into a copy of the
//! picture, so that a picture at rest need not be rendered again for a pointer that moves.

mod counts;
mod history;
mod keys;
mod paint;
mod settings;

pub(super) use counts::Figures;
pub(super) use history::History;
pub(super) use settings::Change;

use crate::error::Result;
use crate::gpu::{Device, Image};
use crate::passes::overlay::{Ground, Overlay};
use crate::scene::RenderSettings;
use egui::{Color32, Context, ScrollArea, Ui, ViewportId};
use paint::Textures;
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::event::WindowEvent;
use winit::window::Window;

/// Colours of the passes in frame order: those of Okabe and Ito, which all eyes tell apart.
const PASS_COLORS: [Color32; 7] = [
    Color32::from_rgb(240, 228, 66),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(0, 114, 178),
];

/// Width of the panels, points.
const WIDTH: f32 = 250.0;

/// The overlay's state; what it draws with is made when it is first shown.
#[derive(Default)]
pub(super) struct Gui {
    /// The panels of figures and settings.
    pub(super) panels: bool,
    /// The list of keys.
    pub(super) keys: bool,
    tools: Option<Tools>,
    /// When egui wants to be drawn again though nothing happened.
    due: Option<Instant>,
}

/// What an overlay is drawn with.
struct Tools {
    input: egui_winit::State,
    textures: Textures,
    pass: Overlay,
}

/// What the panels show, and what they may change.
pub(super) struct Content<'a> {
    pub(super) figures: &'a Figures,
    pub(super) history: &'a History,
    pub(super) render: &'a mut RenderSettings,
}

impl Gui {
    /// Whether anything is to be drawn over the picture.
    pub(super) fn is_shown(&self) -> bool {
        self.panels || self.keys
    }

    /// Takes note of an event; whether it is the overlay's alone.
    pub(super) fn event(&mut self, window: &Window, event: &WindowEvent) -> Taken {
        if !self.is_shown() {
            return Taken { whole: false, redraw: false };
        }
        let Some(tools) = &mut self.tools else {
            return Taken { whole: false, redraw: false };
        };
        // A redraw asked for by a redraw would never end.
        if matches!(event, WindowEvent::RedrawRequested) {
            return Taken { whole: false, redraw: false };
        }
        let response = tools.input.on_window_event(window, event);
        Taken { whole: response.consumed, redraw: response.repaint }
    }

    /// When the overlay has to be drawn again of itself.
    pub(super) fn due(&self) -> Option<Instant> {
        self.due.filter(|_| self.is_shown())
    }

    /// Draws the panels over a picture: the result, and what was changed.
    pub(super) fn draw(
        &mut self,
        (device, window): (&Arc<Device>, &Window),
        ground: &Ground<'_>,
        content: &mut Content<'_>,
    ) -> Result<(&Image, Change)> {
        let tools = match self.tools.take() {
            Some(tools) => tools,
            None => Tools::new(device, window)?,
        };
        let tools = self.tools.insert(tools);
        let input = tools.input.take_egui_input(window);
        let context = tools.input.egui_ctx().clone();
        let mut change = Change::Nothing;
        let mut output = context.run_ui(input, |ui| {
            if self.panels {
                change = change.max(panels(ui.ctx(), content));
            }
            if self.keys {
                keys::show(ui.ctx(), &mut self.keys);
            }
        });
        tools.input.handle_platform_output(window, output.platform_output);
        let delay = output.viewport_output.get(&ViewportId::ROOT).map(|view| view.repaint_delay);
        // Longer than a day means never.
        self.due = delay.filter(|&delay| delay < Duration::from_secs(86_400)).map(|d| Instant::now() + d);
        tools.textures.update(&mut output.textures_delta, &mut tools.pass)?;
        let scale = output.pixels_per_point;
        let primitives = context.tessellate(output.shapes, scale);
        let drawing = paint::drawing(primitives, scale, ground.picture.size());
        Ok((tools.pass.draw(ground, &drawing)?, change))
    }
}

/// What the overlay makes of an event.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    /// Nothing else may answer it.
    pub(super) whole: bool,
    /// The overlay changes its looks.
    pub(super) redraw: bool,
}

impl Tools {
    fn new(device: &Arc<Device>, window: &Window) -> Result<Self> {
        let context = Context::default();
        context.set_theme(egui::Theme::Dark);
        // What moves by itself would have the window drawn again and again, on lavapipe at the picture's cost.
        context.all_styles_mut(|style| style.animation_time = 0.0);
        let scale = Some(window.scale_factor() as f32);
        let side = Some(device.largest_image() as usize);
        let input = egui_winit::State::new(context, ViewportId::ROOT, window, scale, None, side);
        Ok(Self { input, textures: Textures::default(), pass: Overlay::new(device)? })
    }
}

fn panels(context: &Context, content: &mut Content<'_>) -> Change {
    let mut change = Change::Nothing;
    let window = egui::Window::new("amas").default_pos([8.0, 8.0]).default_width(WIDTH).resizable(true);
    window.show(context, |ui| {
        ScrollArea::vertical().show(ui, |ui| {
            section(ui, "Time", |ui| content.history.show(ui));
            section(ui, "Counts", |ui| content.figures.show(ui));
            section(ui, "Settings", |ui| change = settings::show(ui, content.render));
        });
    });
    change
}

fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(title).default_open(true).show(ui, contents);
}
