//! Point lights on the device: their texels and tree, and how both follow lights that move.

use crate::error::Result;
use crate::gpu::{DescriptorSet, Device, Format, Image, ImageDescription, Use};
use crate::light_tree::LightTree;
use crate::scene::{PointLight, Scene};
use crate::shared::{self, LightNode, MomentNode};
use glam::Vec3;
use std::sync::{Arc, Mutex, PoisonError};

/// Null lights behind the others: the padding of lists, and of the last leaf.
const NULL_LIGHTS: u32 = shared::MOMENT_LEAF;
/// Texels across the image of the trees.
const NODE_ROW: usize = 2 << shared::NODES_PER_ROW_LOG2;
/// Texels from one node over lights without a range to the next.
const MOMENT_STRIDE: usize = 1 << shared::MOMENT_STRIDE_LOG2;

/// The images that hold lights and tree.
pub(super) struct LightImages {
    lights: Image,
    nodes: Image,
}

impl LightImages {
    /// Makes the images and uploads the lights.
    pub(super) fn new(device: &Arc<Device>, tree: &LightTree) -> Result<Self> {
        let image = |name, format, size, layers, used| {
            let uses = &[Use::TransferWrite, used];
            Image::new(device, &ImageDescription { name, format, size, layers, mips: 1, uses })
        };
        let [width, height, layers] = light_extent(tree.lights.len());
        let node_rows = moment_row(tree) + (tree.moments.len() * MOMENT_STRIDE).div_ceil(NODE_ROW);
        let images = Self {
            lights: image(
                "lights",
                Format::R32G32B32A32_SFLOAT,
                [width, height],
                Some(layers),
                Use::StorageRead,
            )?,
            nodes: image(
                "light tree",
                Format::R32G32B32A32_UINT,
                [NODE_ROW as u32, node_rows.max(1) as u32],
                None,
                Use::Texture,
            )?,
        };
        images.upload(tree)?;
        Ok(images)
    }

    /// Uploads lights, as many as the images were made for.
    pub(super) fn upload(&self, tree: &LightTree) -> Result<()> {
        self.lights.upload(&[&light_texels(&tree.lights)], Use::StorageRead)?;
        self.nodes.upload(&[&node_texels(tree)], Use::Texture)
    }

    pub(super) fn bind(&self, set: DescriptorSet<'_>) {
        set.image(shared::scene::SCENE_LIGHTS, &self.lights, Use::StorageRead);
        set.image(shared::scene::SCENE_LIGHT_NODES, &self.nodes, Use::Texture);
    }
}

/// Lights that move, and where they are.
pub(super) struct Moving {
    /// Nothing but the point lights and their motions.
    scene: Scene,
    /// Seconds; `None` while they are on their way.
    time: Mutex<Option<f64>>,
}

impl Moving {
    /// `None` where no light of the scene moves.
    pub(super) fn new(scene: &Scene) -> Option<Self> {
        let lights = || Scene {
            point_lights: scene.point_lights.clone(),
            motions: scene.motions.clone(),
            ..Scene::default()
        };
        (!scene.motions.is_empty()).then(|| Self { scene: lights(), time: Mutex::new(Some(0.0)) })
    }

    /// Uploads the lights where they are at time `t`, unless they are there already.
    pub(super) fn move_to(&self, t: f64, images: &LightImages, origin: Vec3) -> Result<()> {
        let mut time = self.time.lock().unwrap_or_else(PoisonError::into_inner);
        if *time != Some(t) {
            *time = None;
            images.upload(&placed(&self.scene, t, origin))?;
            *time = Some(t);
        }
        Ok(())
    }
}

/// A scene's point lights at a time, seconds, about the device's origin.
pub(super) fn placed(scene: &Scene, t: f64, origin: Vec3) -> LightTree {
    let mut lights = scene.point_lights_at(t);
    lights.iter_mut().for_each(|light| light.position -= origin);
    LightTree::new(&lights)
}

/// Texels across, rows, layers of the image of so many lights and the null lights behind them.
fn light_extent(lights: usize) -> [u32; 3] {
    let rows = (lights as u32 + NULL_LIGHTS).div_ceil(shared::LIGHTS_PER_ROW);
    let layers = rows.div_ceil(1 << shared::LIGHT_ROWS_LOG2);
    let height = if layers > 1 { 1 << shared::LIGHT_ROWS_LOG2 } else { rows };
    [2 * shared::LIGHTS_PER_ROW, height, layers]
}

/// Lights as two RGBA32F texels each, with null lights behind them.
fn light_texels(lights: &[PointLight]) -> Vec<[f32; 4]> {
    let null = PointLight { position: Vec3::ZERO, intensity: Vec3::ZERO, range: None };
    let size: u32 = light_extent(lights.len()).iter().product();
    let mut texels = Vec::with_capacity(size as usize);
    texels.extend(lights.iter().chain(&[null; NULL_LIGHTS as usize]).flat_map(texels_of));
    texels.resize(size as usize, [0.0; 4]);
    texels
}

fn texels_of(light: &PointLight) -> [[f32; 4]; 2] {
    let (inverse_range2, floor) = match light.range {
        // The square of the smallest ranges is 0.
        Some(range) => ((1.0 / (range * range)).min(f32::MAX), 1e-4),
        None => (0.0, 1e-12),
    };
    let (p, i) = (light.position, light.intensity);
    [[p.x, p.y, p.z, inverse_range2], [i.x, i.y, i.z, floor]]
}

/// First row, in the texture of the light trees, of the nodes over lights without a range.
#[must_use]
pub fn moment_row(lights: &LightTree) -> usize {
    lights.nodes.len().div_ceil(1 << shared::NODES_PER_ROW_LOG2)
}

/// The trees in whole rows of RGBA32UI texels: two a node over lights with a range, eight a node over those without.
fn node_texels(tree: &LightTree) -> Vec<[u32; 4]> {
    type Texels = [[u32; 4]; shared::MOMENT_TEXELS as usize];
    const { assert!(size_of::<MomentNode>() == size_of::<Texels>()) };
    let mut texels: Vec<[u32; 4]> = bytemuck::cast_slice::<LightNode, _>(&tree.nodes).to_vec();
    texels.resize(moment_row(tree) * NODE_ROW, [0; 4]);
    for node in &tree.moments {
        texels.extend(bytemuck::cast::<_, Texels>(*node));
        texels.resize(texels.len().next_multiple_of(MOMENT_STRIDE), [0; 4]);
    }
    texels.resize(texels.len().next_multiple_of(NODE_ROW).max(NODE_ROW), [0; 4]);
    texels
}
