//! Debug views: output variables of the frame in the colours that `amas render --aov NAME=FILE.png` gives them.

use crate::app::false_color;
use crate::app::view::picture::Picture;
use crate::app::view::stage::Stage;
use crate::error::Result;
use crate::gpu::{Image, ImageDescription, Use};
use crate::passes::aov::{Aov, Quantity};
use crate::targets::LDR_FORMAT;
use winit::keyboard::KeyCode;

/// A debug view.
pub(super) struct DebugView {
    key: KeyCode,
    pub(super) name: &'static str,
    quantity: Quantity,
}

const fn view(key: KeyCode, name: &'static str, quantity: Quantity) -> DebugView {
    DebugView { key, name, quantity }
}

/// Every view, in the order of its keys.
pub(super) const VIEWS: [DebugView; 10] = [
    view(KeyCode::F2, "albedo", Quantity::Albedo),
    view(KeyCode::F3, "normal", Quantity::Normal),
    view(KeyCode::F4, "roughness (alpha)", Quantity::Roughness),
    view(KeyCode::F5, "depth, metres", Quantity::Depth),
    view(KeyCode::F6, "depth slice", Quantity::Slice),
    view(KeyCode::F7, "cluster", Quantity::Cluster),
    view(KeyCode::F8, "lights evaluated", Quantity::LightCount),
    view(KeyCode::F9, "lights evaluated per useful one", Quantity::PairRatio),
    view(KeyCode::F10, "estimated relative error of many lights", Quantity::LightError),
    view(KeyCode::F11, "bound of the closed form's error, area lights", Quantity::LtcBound),
];

/// Which view is shown, and its picture.
#[derive(Default)]
pub(super) struct Views {
    shown: Option<usize>,
    pass: Option<(Fit, Aov)>,
    image: Option<Image>,
    range: Option<[f32; 2]>,
    /// The picture is not of the frame's last sample, or of another view.
    stale: bool,
}

/// What a pass was made for.
#[derive(Clone, Copy, PartialEq)]
struct Fit {
    view: usize,
    size: [u32; 2],
    perspective: bool,
}

impl Views {
    /// Shows a view, or the picture again; whether the key is one of a view.
    pub(super) fn key(&mut self, code: KeyCode) -> bool {
        let Some(index) = VIEWS.iter().position(|view| view.key == code) else {
            return false;
        };
        self.show((self.shown != Some(index)).then_some(index));
        true
    }

    pub(super) fn show(&mut self, view: Option<usize>) {
        self.stale |= view != self.shown;
        self.shown = view;
    }

    pub(super) fn shown(&self) -> Option<usize> {
        self.shown
    }

    /// The frame has another sample.
    pub(super) fn outdate(&mut self) {
        self.stale = true;
    }

    /// The frame was made anew, and what was made for it has gone.
    pub(super) fn forget(&mut self) {
        self.pass = None;
        self.stale = true;
    }

    /// Numbers that the darkest and the brightest colour stand for, where colours stand for numbers.
    pub(super) fn range(&self) -> Option<[f32; 2]> {
        self.range
    }

    /// The view's picture of the frame; `None` where the picture itself is shown.
    pub(super) fn image(&mut self, stage: &Stage, picture: &Picture) -> Result<Option<&Image>> {
        let Some(view) = self.shown else {
            return Ok(None);
        };
        let settings = picture.frame.settings();
        let fit = Fit { view, size: settings.size, perspective: settings.perspective };
        if self.stale || self.image.as_ref().is_none_or(|image| image.size() != fit.size) {
            let quantity = VIEWS[view].quantity;
            let aov = match self.pass.take().filter(|(made, _)| *made == fit) {
                Some((_, aov)) => aov,
                None => picture.frame.aov_pass(quantity)?,
            };
            picture.frame.draw_aov(&aov)?;
            let (colors, range) = false_color::of(quantity, &aov.fetch()?);
            self.range = range;
            self.pass = Some((fit, aov));
            upload(&mut self.image, stage, fit.size, &colors)?;
            self.stale = false;
        }
        Ok(self.image.as_ref())
    }
}

/// Puts colours into an image of that size, in use [`Use::TransferRead`].
pub(super) fn upload(
    image: &mut Option<Image>,
    stage: &Stage,
    size: [u32; 2],
    colors: &[[u8; 3]],
) -> Result<()> {
    if image.as_ref().is_none_or(|image| image.size() != size) {
        // An attachment only because every image has a view, and that needs such a use.
        let uses = &[Use::TransferWrite, Use::TransferRead, Use::ColorWrite];
        let description =
            ImageDescription { name: "false colour", format: LDR_FORMAT, size, layers: None, mips: 1, uses };
        *image = Some(Image::new(&stage.device, &description)?);
    }
    let texels: Vec<[u8; 4]> = colors.iter().map(|&[r, g, b]| [r, g, b, 255]).collect();
    image.as_ref().map_or(Ok(()), |image| image.upload(&[&texels], Use::TransferRead))
}
