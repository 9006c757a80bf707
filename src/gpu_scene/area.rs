//! Area lights on the device.

use crate::area_lights::{AreaLights, MOST_VERTICES};
use crate::draws::Draw;
use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Format, Image, ImageDescription, Use};
use crate::shared::{self, AREA_HEIGHT_LOG2, AREA_KIND_BITS, AREA_WIDTH_LOG2, AreaRecord};
use std::sync::Arc;

/// lavapipe ends a shader's loops, without a word, after 65,535 iterations in all, and a GPU's watchdog draws that last
/// seconds.
const MAX_ITERATIONS: u32 = 60_000;

/// Iterations that a light may take of a pixel: three lobes; of each vertex of its pieces, and one more where the horizon
/// cuts, twelve azimuths; of each, up to nine planes and four points. A shadow is a ray and its candidates a lobe. Points
/// of cubature are asked twice. [`MOST_VERTICES`] keep every light below [`MAX_ITERATIONS`].
fn iterations(record: &AreaRecord, shadows: bool) -> u32 {
    let quadrature = 3 * (record.piece_count.max(4) * 5 / 4) * 12 * (9 + 4 + 1);
    let points = 2 * (record.points >> 16).max(record.points & 0xffff);
    quadrature + record.ring_count * 2 + points + if shadows { 3 * 500 } else { 0 }
}

/// How a light that is seen is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Luminaire {
    /// From both sides.
    Flat,
    /// From outside.
    Line,
}

/// The area lights, and what shaders are specialised by for them.
pub struct Area {
    /// How many.
    pub count: u32,
    /// Specialisation constants of what evaluates them.
    pub specialization: Vec<(u32, u32)>,
    /// How many a draw may take.
    pub per_draw: u32,
    /// Those that are seen: variants by [`Luminaire`], materials are lights.
    pub luminaires: Vec<Draw>,
    texels: Image,
    /// Of the texels: across, down, layers.
    extent: [u32; 3],
    shadows: bool,
}

impl Area {
    /// Uploads the lights; where there are none, a single texel.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn new(
        device: &Arc<Device>,
        lights: &AreaLights,
        luminaires: Vec<Draw>,
        shadows: bool,
    ) -> Result<Self> {
        let (texels, [width, height, layers]) = padded(lights);
        let image = Image::new(
            device,
            &ImageDescription {
                name: "area lights",
                format: Format::R32G32B32A32_UINT,
                size: [width, height],
                layers: Some(layers),
                mips: 1,
                uses: &[Use::TransferWrite, Use::Texture],
            },
        )?;
        image.upload(&[&texels], Use::Texture)?;
        const { assert!(58_200 > 3 * (MOST_VERTICES * 5 / 4) * 12 * (9 + 4 + 1) + 2 * MOST_VERTICES) };
        let worst = lights.records.iter().map(|record| iterations(record, shadows)).max();
        let per_draw = (MAX_ITERATIONS / worst.unwrap_or(1)).max(1);
        Ok(Self {
            count: lights.records.len() as u32,
            per_draw,
            specialization: specialization(&lights.records, shadows),
            luminaires,
            texels: image,
            extent: [width, height, layers],
            shadows,
        })
    }

    /// Uploads lights of other radiance; `false` where more than that is different.
    pub(super) fn adopt(&mut self, lights: &AreaLights) -> Result<bool> {
        let (texels, extent) = padded(lights);
        let same = lights.records.len() as u32 == self.count
            && extent == self.extent
            && specialization(&lights.records, self.shadows) == self.specialization;
        if same {
            self.texels.upload(&[&texels], Use::Texture)?;
        }
        Ok(same)
    }

    /// Puts them into the scene's set.
    pub fn bind(&self, scene: DescriptorSet<'_>) {
        scene.image(shared::scene::SCENE_AREA_LIGHTS, &self.texels, Use::Texture);
    }
}

/// The lights' texels in whole layers: a row at least, a single texel where there are no lights.
fn padded(lights: &AreaLights) -> (Vec<[u32; 4]>, [u32; 3]) {
    let mut texels = lights.texels();
    let (width, most) = (1 << AREA_WIDTH_LOG2, 1 << AREA_HEIGHT_LOG2);
    let rows = texels.len().div_ceil(width).max(1);
    let layers = rows.div_ceil(most);
    let height = if layers > 1 { most } else { rows };
    let width = if texels.is_empty() { 1 } else { width };
    texels.resize(layers * height * width, [0; 4]);
    (texels, [width, height, layers].map(|side| side as u32))
}

fn specialization(records: &[AreaRecord], shadows: bool) -> Vec<(u32, u32)> {
    let kind =
        |wanted| u32::from(records.iter().any(|record| record.kind & ((1 << AREA_KIND_BITS) - 1) == wanted));
    let flag = |wanted| u32::from(records.iter().any(|record| record.kind & wanted != 0));
    vec![
        (shared::SPEC_SHADOWS, u32::from(shadows)),
        (shared::SPEC_POLYGONS, kind(shared::AREA_POLYGON)),
        (shared::SPEC_ELLIPSES, kind(shared::AREA_ELLIPSE)),
        (shared::SPEC_LINES, kind(shared::AREA_LINE)),
        (shared::SPEC_TEXTURED_LIGHTS, flag(shared::AREA_TEXTURED)),
        (shared::SPEC_TWO_SIDED_LIGHTS, flag(shared::AREA_TWO_SIDED)),
    ]
}
