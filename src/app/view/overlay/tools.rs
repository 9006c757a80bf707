//! What an overlay is drawn with: egui, its input from the window, and the pass that puts its triangles on the picture.

use super::paint::{self, Textures};
use crate::app::view::stage::Stage;
use crate::error::Result;
use crate::gpu::Image;
use crate::passes::overlay::{Ground, Overlay};
use crate::scene::settings::Encoding;
use egui::style::ScrollStyle;
use egui::{Context, FullOutput, Pos2, Rect, Vec2, ViewportId};
use std::sync::Arc;
use std::time::Instant;
use winit::window::Window;

/// Made when an overlay is first shown.
pub(super) struct Tools {
    pub(super) input: egui_winit::State,
    textures: Textures,
    pub(super) pass: Overlay,
    /// Of the pictures that it is drawn over.
    pub(super) encoding: Encoding,
    start: Instant,
}

impl Tools {
    pub(super) fn new(stage: &Stage) -> Result<Self> {
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
        Ok(Self { input, textures: Textures::default(), pass, encoding, start: Instant::now() })
    }

    /// Lays out what is to be shown over a picture of `size` pixels.
    pub(super) fn run(
        &mut self,
        window: &Window,
        size: [u32; 2],
        mut show: impl FnMut(&Context),
    ) -> FullOutput {
        let context = self.input.egui_ctx().clone();
        let scale = window.scale_factor() as f32;
        let points = Vec2::from(size.map(|side| side as f32)) / (scale * context.zoom_factor());
        // As egui-winit does, but for the size: it asks the window, and winit panics where that was destroyed.
        let input = self.input.egui_input_mut();
        input.time = Some(self.start.elapsed().as_secs_f64());
        input.screen_rect = Some(Rect::from_min_size(Pos2::ZERO, points));
        input.viewports.entry(ViewportId::ROOT).or_default().native_pixels_per_point = Some(scale);
        let input = input.take();
        let mut output = context.run_ui(input, |ui| show(ui.ctx()));
        self.input.handle_platform_output(window, std::mem::take(&mut output.platform_output));
        output
    }

    /// Draws it over the picture, or over the cover that takes its place.
    pub(super) fn paint(
        &mut self,
        ground: &Ground<'_>,
        covered: bool,
        mut output: FullOutput,
    ) -> Result<Arc<Image>> {
        self.textures.update(&mut output.textures_delta, &mut self.pass)?;
        let scale = output.pixels_per_point;
        let primitives = self.input.egui_ctx().tessellate(output.shapes, scale);
        let drawing = paint::drawing(primitives, scale, ground.picture.size(), covered);
        self.pass.draw(ground, &drawing)
    }
}
