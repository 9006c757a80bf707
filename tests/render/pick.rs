//! Positions picked from the depth, against the positions that the shaders write.

use amas::passes::aov::Quantity;
use glam::DVec3;

use crate::support::{FIVE_MATERIALS, Rig, scene};

#[test]
fn picked_positions_are_those_of_the_surfaces() {
    for camera in ["vertical_fov = 40", "orthographic_height = 4"] {
        for far in ["", "\nfar = 50"] {
            let text = FIVE_MATERIALS.replace("vertical_fov = 40", &format!("{camera}{far}"));
            let mut rig = Rig::new(scene(&text));
            assert_eq!(rig.frame.position_at([0, 0]).unwrap(), None, "before anything is rendered");
            rig.render();
            let positions = rig.aov(Quantity::Position);
            let mut surfaces = 0;
            for y in (0..64).step_by(9) {
                for x in (0..96).step_by(7) {
                    let [px, py, pz, there] = positions[y * 96 + x];
                    let picked = rig.frame.position_at([x as u32, y as u32]).unwrap();
                    assert_eq!(picked.is_some(), there > 0.0, "{x}, {y}");
                    if let Some(picked) = picked {
                        let want = DVec3::new(px.into(), py.into(), pz.into());
                        let error = picked.distance(want);
                        // Of a distance of 5 m: float32's depth and interpolation.
                        assert!(error < 2e-5, "{x}, {y}: {picked}, not {want}");
                        surfaces += 1;
                    }
                }
            }
            assert!(surfaces > 30, "{surfaces} surfaces");
        }
    }
}

/// A frame that was resized renders what one of that size renders, bit by bit, and refines to the same.
#[test]
fn resized_frames_are_new_ones() {
    let text = FIVE_MATERIALS.replace("[render]", "[render]\nsamples = 3");
    let mut rig = Rig::new(scene(&text));
    rig.render();
    for size in [[1, 1], [33, 70], [96, 64]] {
        rig.frame.resize(size).unwrap();
        let resized = rig.render();
        let fresh = Rig::with(scene(&text), |settings| settings.size = size).render();
        assert!(resized == fresh, "{size:?}");
        assert_eq!(rig.frame.samples(), 3);
    }
}
