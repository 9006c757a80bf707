//! `scenes/light_grid.toml` with any number of lights, by the generator that it names.

use crate::error::Result;
use crate::scene::{PointLight, Scene, load_embedded};
use glam::Vec3;

const GRID: &str = include_str!("../../../../scenes/light_grid.toml");
/// Its own lights.
const LIGHTS: (&str, &[u8]) =
    ("light_grid_4096.csv", include_bytes!("../../../../scenes/light_grid_4096.csv"));
/// Metres.
const RANGE: f32 = 2.0;

/// The scene with so many lights.
pub(super) fn light_grid(count: u32, size: [u32; 2]) -> Result<Scene> {
    let mut scene = load_embedded("light_grid.toml", GRID, &[LIGHTS], &[])?;
    scene.render.size = size;
    scene.point_lights = lights(count);
    scene.point_groups = std::iter::once(0..count as usize).collect();
    Ok(scene)
}

fn lights(count: u32) -> Vec<PointLight> {
    let mut state = 12345_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    let light = |_| {
        let [x, z, y, hue] = [next(), next(), next(), next()];
        let position = Vec3::new((40.0 * x - 20.0) as f32, (0.2 + 1.8 * y) as f32, (40.0 * z - 20.0) as f32);
        PointLight { position, intensity: color(hue), range: Some(RANGE) }
    };
    (0..count).map(light).collect()
}

/// HSV with saturation .8 and value 1.
fn color(hue: f64) -> Vec3 {
    let channel = |offset: f64| {
        let place = (6.0 * hue + offset).rem_euclid(6.0);
        (1.0 - 0.8 * place.min(4.0 - place).clamp(0.0, 1.0)) as f32
    };
    Vec3::new(channel(5.0), channel(3.0), channel(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As in the scene's own file, which has six digits.
    #[test]
    fn lights_of_the_file() {
        let scene = load_embedded("light_grid.toml", GRID, &[LIGHTS], &[]).unwrap();
        let made = lights(scene.point_lights.len() as u32);
        for (index, (light, want)) in made.iter().zip(&scene.point_lights).enumerate() {
            assert!(light.position.distance(want.position) < 1e-4, "{index}: {light:?} for {want:?}");
            assert!(light.intensity.distance(want.intensity) < 1e-4, "{index}: {light:?} for {want:?}");
            assert_eq!(light.range, want.range);
        }
        assert_eq!(made.len(), 4096);
    }
}
