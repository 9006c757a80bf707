//! Debug views: output variables of the frame in the colours that `amas render --aov NAME=FILE.png` gives them.

use super::paint::COVER;
use crate::app::false_color;
use crate::app::view::picture::Picture;
use crate::error::Result;
use crate::passes::aov::{Aov, Quantity};
use crate::passes::overlay::Overlay;
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
pub(super) const VIEWS: [DebugView; 11] = [
    view(KeyCode::F2, "albedo", Quantity::Albedo),
    view(KeyCode::F3, "normal", Quantity::Normal),
    view(KeyCode::F4, "roughness (alpha)", Quantity::Roughness),
    view(KeyCode::F6, "depth, metres", Quantity::Depth),
    view(KeyCode::F7, "depth slice", Quantity::Slice),
    view(KeyCode::F8, "cluster", Quantity::Cluster),
    view(KeyCode::F9, "lights evaluated", Quantity::LightCount),
    view(KeyCode::F10, "lights evaluated per useful one", Quantity::PairRatio),
    view(KeyCode::F11, "estimated relative error of many lights", Quantity::LightError),
    view(KeyCode::KeyB, "bound of the closed form's error, area lights", Quantity::LtcBound),
    view(KeyCode::KeyG, "wireframe", Quantity::Wireframe),
];

/// Which view is shown, and its picture.
#[derive(Default)]
pub(super) struct Views {
    shown: Option<usize>,
    pass: Option<(Fit, Aov)>,
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

    /// Makes the view's colours the overlay's cover; whether there is a view.
    pub(super) fn draw(&mut self, picture: &Picture, pass: &mut Overlay) -> Result<bool> {
        let Some(view) = self.shown else {
            return Ok(false);
        };
        let settings = picture.frame.settings();
        let fit = Fit { view, size: settings.size, perspective: settings.perspective };
        let made = self.pass.take().filter(|(made, _)| *made == fit);
        if !self.stale && made.is_some() {
            self.pass = made;
            return Ok(true);
        }
        let quantity = VIEWS[view].quantity;
        let aov = match made {
            Some((_, aov)) => aov,
            None => picture.frame.aov_pass(quantity)?,
        };
        picture.frame.draw_aov(&aov)?;
        let (colors, range) = false_color::of(quantity, &aov.fetch()?);
        cover(pass, fit.size, &colors)?;
        (self.range, self.stale) = (range, false);
        self.pass = Some((fit, aov));
        Ok(true)
    }
}

/// Makes colours of the whole window the overlay's cover.
pub(super) fn cover(pass: &mut Overlay, size: [u32; 2], colors: &[[u8; 3]]) -> Result<()> {
    let texels: Vec<[u8; 4]> = colors.iter().map(|&[r, g, b]| [r, g, b, 255]).collect();
    pass.set_texture(COVER, size, &texels)
}
