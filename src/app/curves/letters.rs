//! Bitmaps with letters of an embedded font: a plot needs none of the system's.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use plotters::backend::BitMapBackend;
use plotters::style::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};

/// Fonts up to this size have the smaller letters.
const SMALL: f64 = 14.0;

pub(super) struct Lettered<'a>(pub(super) BitMapBackend<'a>);

type Done<'a> = Result<(), DrawingErrorKind<<BitMapBackend<'a> as DrawingBackend>::ErrorType>>;

fn raster(style: &impl BackendTextStyle) -> (RasterHeight, [i32; 2]) {
    let height = if style.size() > SMALL { RasterHeight::Size20 } else { RasterHeight::Size16 };
    (height, [get_raster_width(FontWeight::Regular, height) as i32, height.val() as i32])
}

impl<'a> DrawingBackend for Lettered<'a> {
    type ErrorType = <BitMapBackend<'a> as DrawingBackend>::ErrorType;

    fn get_size(&self) -> (u32, u32) {
        self.0.get_size()
    }

    fn ensure_prepared(&mut self) -> Done<'a> {
        self.0.ensure_prepared()
    }

    fn present(&mut self) -> Done<'a> {
        self.0.present()
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Done<'a> {
        self.0.draw_pixel(point, color)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Done<'a> {
        self.0.draw_line(from, to, style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Done<'a> {
        self.0.draw_rect(upper_left, bottom_right, style, fill)
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, pos: BackendCoord) -> Done<'a> {
        let (height, [across, down]) = raster(style);
        let width = across * text.chars().count() as i32;
        let left = match style.anchor().h_pos {
            HPos::Left => 0,
            HPos::Right => -width,
            HPos::Center => -width / 2,
        };
        let top = match style.anchor().v_pos {
            VPos::Top => 0,
            VPos::Center => -down / 2,
            VPos::Bottom => -down,
        };
        let color = style.color();
        for (letter, begin) in text.chars().zip((0..).step_by(across as usize)) {
            let Some(letter) = get_raster(letter, FontWeight::Regular, height) else { continue };
            for (y, line) in letter.rows().enumerate() {
                for (x, &intensity) in line.iter().enumerate().filter(|(_, intensity)| **intensity > 0) {
                    let alpha = color.alpha * f64::from(intensity) / 255.0;
                    let at = (pos.0 + left + begin + x as i32, pos.1 + top + y as i32);
                    self.draw_pixel(at, BackendColor { alpha, ..color })?;
                }
            }
        }
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Self::ErrorType>> {
        let (_, [across, down]) = raster(style);
        Ok((across as u32 * text.chars().count() as u32, down as u32))
    }
}
