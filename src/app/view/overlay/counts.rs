//! What the last picture held: lights, clusters, lists, memory, samples and the estimated error.

use crate::app::view::picture::Picture;
use crate::error::Result;
use crate::gpu::Device;
use crate::shared::Counters;
use egui::Ui;

const MEGABYTE: f64 = 1024.0 * 1024.0;

/// Figures of a picture.
#[derive(Clone, Debug, Default)]
pub(super) struct Figures {
    device: String,
    driver: String,
    size: [u32; 2],
    grid: [u32; 3],
    counters: Counters,
    point_lights: usize,
    area_lights: u32,
    /// Samples so far, and of the picture at rest.
    samples: [u32; 2],
    /// Of what folds and cuts cause, relative; `None` until the picture rests, because measuring it takes as long as a
    /// frame or more.
    error: Option<f64>,
    memory: f64,
}

impl Figures {
    /// Of the sample last rendered.
    pub(super) fn new(device: &Device, picture: &Picture) -> Result<Self> {
        let (info, frame) = (device.info(), &picture.frame);
        let counters = frame.counters();
        Ok(Self {
            device: info.name.clone(),
            driver: info.driver.clone(),
            size: frame.settings().size,
            grid: frame.grid(),
            point_lights: frame.scene().lights.lights.len(),
            area_lights: frame.scene().area.count,
            samples: [frame.samples(), picture.samples()],
            error: None,
            memory: device.peak_memory() as f64 / MEGABYTE,
            counters,
        })
    }

    /// Whether the error of the picture is known.
    pub(super) fn is_estimated(&self) -> bool {
        self.error.is_some()
    }

    /// Estimates it, unless it is known.
    pub(super) fn estimate(&mut self, picture: &Picture) -> Result<()> {
        if self.error.is_none() {
            self.error = Some(picture.frame.light_error()?);
        }
        Ok(())
    }

    pub(super) fn show(&self, ui: &mut Ui) {
        let [width, height] = self.size;
        let [x, y, z] = self.grid;
        let counters = &self.counters;
        let lists = format!("{} in all, {} at most", counters.entries, counters.longest);
        let folded = format!("{} lights, {} clusters", counters.folded, counters.overflowed);
        let cuts = format!("{} in all, {} at most", counters.cut_entries, counters.cut_longest);
        let error = self.error.map_or("once it rests".into(), |error| format!("{:.3} %", 100.0 * error));
        let rows = [
            (
                "samples",
                "so far, and of the picture at rest",
                format!("{} of {}", self.samples[0], self.samples[1]),
            ),
            ("estimated error", "of folds and cuts, relative", error),
            ("lights", "of the scene", format!("{} points, {} areas", self.point_lights, self.area_lights)),
            ("clusters", "that hold a surface", format!("{} of {x} × {y} × {z}", counters.occupied)),
            ("lists", "point lights with a range, cluster by cluster", lists),
            ("cuts", "nodes of lights without a range, cluster by cluster", cuts),
            ("folded", "lights beyond the longest list", folded),
            ("picture", "pixels", format!("{width} × {height}")),
            ("memory", "of amas", format!("{:.0} MB of the device at most", self.memory)),
            ("device", "", self.device.clone()),
            ("driver", "", self.driver.clone()),
        ];
        egui::Grid::new("counts").num_columns(2).striped(true).show(ui, |ui| {
            for (name, hint, value) in rows {
                let name = ui.weak(name);
                if !hint.is_empty() {
                    name.on_hover_text(hint);
                }
                ui.label(value);
                ui.end_row();
            }
        });
    }
}
