//! What the window shows before the first picture: a bar.

use crate::error::Result;
use crate::gpu::{Device, Image, ImageDescription, Use};
use crate::scene::settings::Encoding;
use crate::targets::ldr_format;
use std::sync::Arc;

/// Of the part of a bar that is done, sRGB.
pub(super) const DONE: [u8; 4] = [200, 160, 80, 255];
/// Of its rest.
const REST: [u8; 4] = [56, 56, 56, 255];
/// Behind it.
const GROUND: [u8; 4] = [24, 24, 24, 255];

/// A bar that shows how far loading is.
#[derive(Default)]
pub(super) struct Waiting {
    /// As last drawn, and how many pixels of its bar are done.
    drawn: Option<(Arc<Image>, u32)>,
}

impl Waiting {
    /// The bar at `fraction`, in 0 … 1, for a window of that size.
    pub(super) fn image(
        &mut self,
        device: &Arc<Device>,
        size: [u32; 2],
        fraction: f64,
    ) -> Result<&Arc<Image>> {
        let [from, to] = span(size[0]);
        let done = (f64::from(to - from) * fraction.clamp(0.0, 1.0)) as u32;
        let fits = |(image, bar): &(Arc<Image>, u32)| image.size() == size && *bar == done;
        let drawn = match self.drawn.take().filter(fits) {
            Some(drawn) => drawn,
            None => (draw(device, size, done)?, done),
        };
        Ok(&self.drawn.insert(drawn).0)
    }
}

/// Where the bar begins and ends: the middle half.
fn span(width: u32) -> [u32; 2] {
    [width / 4, width - width / 4]
}

/// A new image each time: a window may still read the last one.
fn draw(device: &Arc<Device>, size: [u32; 2], done: u32) -> Result<Arc<Image>> {
    // An attachment only because every image has a view, and that needs such a use.
    let uses = &[Use::TransferWrite, Use::TransferRead, Use::ColorWrite];
    let image = Image::new(
        device,
        &ImageDescription {
            name: "waiting",
            format: ldr_format(Encoding::Srgb),
            size,
            layers: None,
            mips: 1,
            uses,
        },
    )?;
    let [width, height] = size;
    let [from, to] = span(width);
    let thickness = (height / 60).max(2);
    let rows = (height / 2).saturating_sub(thickness / 2);
    let color = |x: u32, y: u32| match y.wrapping_sub(rows) < thickness && (from..to).contains(&x) {
        false => GROUND,
        true if x - from < done => DONE,
        true => REST,
    };
    let texels: Vec<[u8; 4]> =
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| color(x, y)).collect();
    image.upload(&[&texels], Use::TransferRead)?;
    Ok(Arc::new(image))
}
