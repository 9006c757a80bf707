//! The display-referred picture for displays of high dynamic range, against the standards' formulas in double precision.

use amas::gpu::Use;
use amas::scene::settings::{Encoding, Tonemap};
use glam::{DMat3, DVec3};
use half::f16;

use crate::support::{FIVE_MATERIALS, Rig, scene};

/// The picture under an encoding, as it reads back in 8 bits.
fn picture(encoding: Encoding, tonemap: Tonemap) -> Vec<[u8; 4]> {
    let text = FIVE_MATERIALS.replace("[render]", "[render]\nbackground = [0.9, 0.4, 0.1]");
    let mut rig = Rig::with(scene(&text), |settings| {
        settings.encoding = encoding;
        settings.tonemap = tonemap;
    });
    rig.render();
    rig.frame.ldr().unwrap()
}

#[test]
fn bright_displays_show_the_same_picture_up_to_white() {
    for tonemap in [Tonemap::None, Tonemap::Agx] {
        let srgb = picture(Encoding::Srgb, tonemap);
        assert!(srgb.iter().any(|pixel| pixel[0] > 100));
        for encoding in [Encoding::ScRgb, Encoding::Hdr10] {
            let shown = picture(encoding, tonemap);
            let worst = srgb.as_flattened().iter().zip(shown.as_flattened());
            let worst = worst.map(|(a, b)| a.abs_diff(*b)).max();
            assert!(worst <= Some(1), "{encoding:?}, {tonemap:?}: {worst:?} of 255");
        }
    }
}

#[test]
fn encoded_values_are_those_of_the_standards() {
    // Values that BT.2408 and BT.2100 print: white at 203 cd/m² is 58 % of the perceptual quantizer, 1000 cd/m² 75 %.
    for (encoding, white, bright) in
        [(Encoding::ScRgb, 203.0 / 80.0, 1000.0 / 80.0), (Encoding::Hdr10, 0.5807, 0.7518)]
    {
        for (luminance, want) in [(203.0, white), (1000.0, bright)] {
            let radiance = luminance / 203.0;
            let text = format!(
                "[render]\nsize = [4, 4]\ntonemap = \"none\"\nbackground = [{radiance:?}, {radiance:?}, {radiance:?}]\n\
                 [[camera]]\nposition = [0, 0, 1]\ntarget = [0, 0, 0]\nvertical_fov = 40\n"
            );
            let mut rig = Rig::with(scene(&text), |settings| settings.encoding = encoding);
            rig.render();
            let encoded: Vec<[f16; 4]> =
                rig.frame.picture().fetch(Use::TransferRead, Use::TransferRead).unwrap();
            for value in encoded.iter().flat_map(|pixel| &pixel[..3]) {
                let error = (value.to_f64() / want - 1.0).abs();
                assert!(error < 1.5e-3, "{encoding:?}, {luminance} cd/m²: {value}, not {want}");
            }
        }
    }
}

/// From a display's primaries and white, as chromaticities, to CIE XYZ with white at Y = 1.
fn to_xyz(primaries: [[f64; 2]; 3]) -> DMat3 {
    let xyz = |[x, y]: [f64; 2]| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let columns = DMat3::from_cols(xyz(primaries[0]), xyz(primaries[1]), xyz(primaries[2]));
    // D65, which both have.
    columns * DMat3::from_diagonal(columns.inverse() * xyz([0.3127, 0.3290]))
}

/// SMPTE ST 2084, equation 5.2: a luminance in cd/m².
fn perceptual_quantizer(luminance: f64) -> f64 {
    let (m1, m2) = (2610.0 / 16384.0, 128.0 * 2523.0 / 4096.0);
    let (c1, c2, c3) = (3424.0 / 4096.0, 32.0 * 2413.0 / 4096.0, 32.0 * 2392.0 / 4096.0);
    let y = (luminance / 10_000.0).powf(m1);
    ((c1 + c2 * y) / (1.0 + c3 * y)).powf(m2)
}

/// Colours, whose channels mix on the way to the primaries of BT.2020. Values are halves, which are off by 4.9e-4 at most.
#[test]
fn colours_keep_their_chromaticity() {
    let bt709 = to_xyz([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]]);
    let bt2020 = to_xyz([[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]]);
    for color in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.2, 0.5, 4.0)] {
        let wide = bt2020.inverse() * bt709 * color * 203.0;
        let wants = [
            (Encoding::ScRgb, (color * 203.0 / 80.0).to_array()),
            (Encoding::Hdr10, wide.to_array().map(perceptual_quantizer)),
        ];
        for (encoding, want) in wants {
            let text = format!(
                "[render]\nsize = [4, 4]\ntonemap = \"none\"\nbackground = {:?}\n\
                 [[camera]]\nposition = [0, 0, 1]\ntarget = [0, 0, 0]\nvertical_fov = 40\n",
                color.to_array()
            );
            let mut rig = Rig::with(scene(&text), |settings| settings.encoding = encoding);
            rig.render();
            let encoded: Vec<[f16; 4]> =
                rig.frame.picture().fetch(Use::TransferRead, Use::TransferRead).unwrap();
            for (got, want) in encoded.iter().flat_map(|pixel| pixel[..3].iter().zip(want)) {
                let error = (got.to_f64() - want).abs();
                assert!(error <= 1e-3 * want, "{encoding:?}, {color}: {got}, not {want}");
            }
        }
    }
}
