//! Output variables of `amas render`: numbers in `.exr` and `.pfm`, and of what can be shown a picture in `.png`.

use super::false_color;
use super::outputs::{Kind, check_linear, check_picture, frame_path, kind};
use super::terminal::print;
use crate::error::{Error, Result};
use crate::frame::{Frame, FrameInputs, FrameSettings};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::image::{HdrImage, save_png8};
use crate::passes::aov::Quantity;
use crate::scene::{Camera, Scene};
use indicatif::ProgressBar;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// An output variable and its file.
pub(super) struct AovOutput {
    variable: Variable,
    pub(super) file: PathBuf,
}

#[derive(Clone, Copy)]
enum Variable {
    Surface(Quantity),
    /// Light of the scene's own lights, without background.
    Direct,
    /// Light that comes by way of other surfaces.
    Indirect,
}

/// Every variable by its name.
const VARIABLES: [(&str, Variable); 16] = [
    ("position", Variable::Surface(Quantity::Position)),
    ("normal", Variable::Surface(Quantity::Normal)),
    ("material", Variable::Surface(Quantity::Material)),
    ("light_count", Variable::Surface(Quantity::LightCount)),
    ("albedo", Variable::Surface(Quantity::Albedo)),
    ("roughness", Variable::Surface(Quantity::Roughness)),
    ("depth", Variable::Surface(Quantity::Depth)),
    ("cluster", Variable::Surface(Quantity::Cluster)),
    ("slice", Variable::Surface(Quantity::Slice)),
    ("pair_ratio", Variable::Surface(Quantity::PairRatio)),
    ("folded", Variable::Surface(Quantity::Folded)),
    ("light_error", Variable::Surface(Quantity::LightError)),
    ("ltc_bound", Variable::Surface(Quantity::LtcBound)),
    ("wireframe", Variable::Surface(Quantity::Wireframe)),
    ("direct", Variable::Direct),
    ("indirect", Variable::Indirect),
];

impl Variable {
    /// Whether 8 bits can show it.
    fn shown(self) -> bool {
        matches!(self, Self::Surface(quantity) if quantity != Quantity::Position)
    }
}

impl AovOutput {
    /// `NAME=FILE` of the command line.
    pub(super) fn new((name, file): &(String, String)) -> Result<Self> {
        match VARIABLES.iter().find(|(known, _)| known == name) {
            Some(&(_, variable)) => Ok(Self { variable, file: file.into() }),
            None => {
                let names = VARIABLES.map(|(name, _)| name);
                let [most @ .., last] = &names;
                Err(Error::usage(
                    format!("there is no output variable {name:?}"),
                    format!("choose {} or {last}", most.join(", ")),
                ))
            }
        }
    }

    /// Checks extension and folder of the file.
    pub(super) fn check(&self) -> Result<()> {
        if self.variable.shown() { check_picture(&self.file).map(|_| ()) } else { check_linear(&self.file) }
    }
}

/// What the variables are rendered from.
pub(super) struct Source<'a> {
    pub(super) device: &'a Arc<Device>,
    pub(super) gpu_scene: &'a Arc<GpuScene>,
    pub(super) scene: &'a Scene,
    pub(super) camera: &'a Camera,
    pub(super) time: f64,
}

impl Source<'_> {
    /// Writes the variables of the picture last rendered, which is frame `index`.
    pub(super) fn save(&self, frame: &mut Frame, aovs: &[AovOutput], index: u32) -> Result<()> {
        let [width, height] = self.scene.render.size;
        let image = |pixels| HdrImage { width, height, pixels };
        // Of all samples, and so fetched before the picture starts anew.
        let lights = aovs.iter().any(|aov| matches!(aov.variable, Variable::Direct | Variable::Indirect));
        let gathered = if lights { frame.gathered_light()? } else { None };
        let [indirect, points] =
            gathered.unwrap_or_else(|| [HdrImage::new(width, height), HdrImage::new(width, height)]);
        // Variables are those of the pixel's centre, and of light alone.
        if self.scene.render.samples > 1 && !aovs.is_empty() {
            frame.render(&self.inputs(1))?;
        }
        for aov in aovs {
            let path = frame_path(&aov.file, index);
            match aov.variable {
                Variable::Surface(quantity) => {
                    let values = frame.aov(quantity)?;
                    match kind(&path)? {
                        Kind::Display => {
                            save_png8(&path, width, height, &picture(&path, quantity, &values)?)?
                        }
                        Kind::Linear => image(values.iter().map(|value| numbers(quantity, value)).collect())
                            .save(&path)?,
                    }
                }
                Variable::Direct => self.direct_light(&points)?.save(&path)?,
                Variable::Indirect => indirect.save(&path)?,
            }
        }
        Ok(())
    }

    /// The picture without its background and indirect light; `points` is that of point lights with shadows.
    fn direct_light(&self, points: &HdrImage) -> Result<HdrImage> {
        let render = &self.scene.render;
        let settings = FrameSettings { background: [0.0; 3], ..FrameSettings::new(render, self.camera) };
        let mut frame = Frame::new(self.device, self.gpu_scene, settings)?;
        frame.render(&self.inputs(render.samples))?;
        Ok(frame.hdr()?.plus(points))
    }

    fn inputs(&self, samples: u32) -> FrameInputs<'_> {
        FrameInputs {
            camera: self.camera,
            time: self.time,
            samples,
            exposure: 0.0,
            split: false,
            progress: ProgressBar::hidden(),
        }
    }
}

/// A pixel's numbers. Where there is no surface, an index is one that nothing has, since 0 is the first of all.
fn numbers(quantity: Quantity, &[x, y, z, there]: &[f32; 4]) -> [f32; 3] {
    match quantity {
        Quantity::Material if there == 0.0 => [-2.0; 3],
        Quantity::Cluster | Quantity::Slice if there == 0.0 => [-1.0; 3],
        _ => [x, y, z],
    }
}

/// The picture of a variable; says which numbers its darkest and brightest colours stand for.
fn picture(path: &Path, quantity: Quantity, values: &[[f32; 4]]) -> Result<Vec<[u8; 3]>> {
    let (colors, range) = false_color::of(quantity, values);
    if let Some([dark, bright]) = range {
        print(format_args!("{}: {dark} (dark) to {bright} (bright)", path.display()))?;
    }
    Ok(colors)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_variables_are_named() {
        let error = AovOutput::new(&("colour".into(), "a.exr".into())).err().map(|error| error.to_string());
        assert!(error.is_some_and(|text| text.contains("colour") && text.contains("light_count")));
        for (name, _) in VARIABLES {
            let output = AovOutput::new(&(name.into(), "a.png".into()));
            let numbers = ["position", "direct", "indirect"].contains(&name);
            assert_eq!(output.is_ok_and(|output| output.check().is_ok()), !numbers, "{name}");
        }
    }
}
