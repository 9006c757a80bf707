//! The display-referred picture for displays of high dynamic range, against the standards' formulas in double precision.

use amas::gpu::Use;
use amas::scene::settings::{Encoding, Tonemap};
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
