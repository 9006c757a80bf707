//! What is left of a texture's texels in halves.

use crate::app::default_scene;
use crate::error::Result;
use crate::scene::load_embedded;
use crate::scene::mips::levels;
use half::f16;
use serde::Serialize;

/// A texture of the embedded scene: errors of its linear texels, relative, 0 where they are 0.
#[derive(Serialize)]
pub(super) struct Rounding {
    pub(super) texture: String,
    pub(super) texels: usize,
    pub(super) mean: f64,
    pub(super) worst: f64,
}

/// Of all textures and all their levels.
pub(super) fn measure() -> Result<Vec<Rounding>> {
    let scene = load_embedded("default.toml", default_scene::TOML, default_scene::FILES, &[])?;
    let of = |texture| {
        let levels = levels(texture);
        let values = levels.iter().flat_map(|level| level.texels.as_flattened()).filter(|&&v| v != 0.0);
        let errors = values.map(|&v| f64::from((f16::from_f32(v).to_f32() - v).abs() / v.abs()));
        let (sum, worst, count) =
            errors.fold((0.0, 0.0_f64, 0), |(sum, worst, n), e| (sum + e, worst.max(e), n + 1));
        Rounding {
            texture: texture.name.clone(),
            texels: levels[0].texels.len(),
            mean: sum / f64::from(count.max(1)),
            worst,
        }
    };
    Ok(scene.textures.iter().map(of).collect())
}
