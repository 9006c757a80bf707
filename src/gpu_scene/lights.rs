//! Point lights on the device: their texels and trees, and how both follow lights that move.

use crate::error::Result;
use crate::gpu::{Buffer, BufferUse, DescriptorSet, Device, Format, Image, ImageDescription, Use};
use crate::light_tree::moving::MovingLights;
use crate::light_tree::{LightTree, place_texel};
use crate::scene::{PointLight, Scene};
use crate::shared::{self, LightNode, MomentNode};
use glam::Vec3;
use std::sync::{Arc, Mutex, PoisonError};

/// Null lights behind the others: the padding of lists, and of the last leaf.
const NULL_LIGHTS: u32 = shared::MOMENT_LEAF;
/// The floor of d² without a range, of null lights too, so that what they give is 0 and not NaN.
const UNRANGED_FLOOR: f32 = 1e-12;
/// Texels across the image of the trees.
const NODE_ROW: usize = 2 << shared::NODES_PER_ROW_LOG2;
/// Texels from one node over lights without a range to the next.
const MOMENT_STRIDE: usize = 1 << shared::MOMENT_STRIDE_LOG2;

/// The images that hold lights and tree.
pub(super) struct LightImages {
    /// Layers by turns of places and of powers: the tests of lights read only places, of which so twice as many share a
    /// line of the cache, and lights that move change only places.
    lights: Image,
    nodes: Image,
}

/// A texel of each light, in whole layers, on their way to the device.
struct Staging {
    texels: Buffer<[f32; 4]>,
    lights: usize,
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
                Some(2 * layers),
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
        images.upload(device, tree, Use::Nothing)?;
        Ok(images)
    }

    /// Uploads as many lights and nodes as the images were made for.
    pub(super) fn upload(&self, device: &Arc<Device>, tree: &LightTree, before: Use) -> Result<()> {
        let mut staging = Staging::new(device, tree.lights.len())?;
        staging.write_powers(tree.lights.iter())?;
        self.upload_powers(&staging, before)?;
        for (texel, light) in staging.lights()?.iter_mut().zip(&tree.lights) {
            *texel = place_texel(light.position, light.range.unwrap_or(f32::MAX));
        }
        self.upload_places(&staging)?;
        self.upload_nodes(&tree.nodes, &tree.moments)
    }

    fn upload_places(&self, staging: &Staging) -> Result<()> {
        self.lights.upload_every_other(&staging.texels, 0, Use::StorageRead, Use::StorageRead)
    }

    fn upload_powers(&self, staging: &Staging, before: Use) -> Result<()> {
        self.lights.upload_every_other(&staging.texels, 1, before, Use::StorageRead)
    }

    /// As many nodes as the image was made for.
    fn upload_nodes(&self, nodes: &[LightNode], moments: &[MomentNode]) -> Result<()> {
        self.nodes.upload(&[&node_texels(nodes, moments)], Use::Texture)
    }

    pub(super) fn bind(&self, set: DescriptorSet<'_>) {
        set.image(shared::scene::SCENE_LIGHTS, &self.lights, Use::StorageRead);
        set.image(shared::scene::SCENE_LIGHT_NODES, &self.nodes, Use::Texture);
    }
}

impl Staging {
    fn new(device: &Arc<Device>, lights: usize) -> Result<Self> {
        let texels = light_extent(lights).iter().product::<u32>() as usize;
        Ok(Self { texels: Buffer::new(device, "lights staging", BufferUse::Upload, texels)?, lights })
    }

    /// Texels of the lights; those behind them are null.
    fn lights(&mut self) -> Result<&mut [[f32; 4]]> {
        let (lights, behind) = self.texels.mapped()?.split_at_mut(self.lights);
        behind.fill([0.0; 4]);
        Ok(lights)
    }

    /// Radiant intensities and floors of d².
    fn write_powers<'a>(&mut self, lights: impl Iterator<Item = &'a PointLight>) -> Result<()> {
        let null = PointLight { position: Vec3::ZERO, intensity: Vec3::ZERO, range: None };
        let (own, behind) = self.texels.mapped()?.split_at_mut(self.lights);
        let floor = |light: &PointLight| if light.range.is_some() { 1e-4 } else { UNRANGED_FLOOR };
        let power = |light: &PointLight| light.intensity.extend(floor(light)).to_array();
        own.iter_mut().zip(lights).for_each(|(texel, light)| *texel = power(light));
        behind.fill(power(&null));
        Ok(())
    }
}

/// Lights that move, and where they are.
pub(super) struct Moving {
    state: Mutex<State>,
}

struct State {
    lights: MovingLights,
    staging: Staging,
    /// Seconds; `None` before the first frame, and while they are on their way.
    time: Option<f64>,
}

impl Moving {
    /// `None` where no light of the scene moves.
    pub(super) fn new(device: &Arc<Device>, scene: &Scene, origin: Vec3) -> Result<Option<Self>> {
        if scene.motions.is_empty() {
            return Ok(None);
        }
        let staging = Staging::new(device, scene.point_lights.len())?;
        let state = State { lights: MovingLights::new(scene, origin), staging, time: None };
        Ok(Some(Self { state: Mutex::new(state) }))
    }

    /// Uploads the lights where they are at time `t`, unless they are there already.
    pub(super) fn move_to(&self, t: f64, images: &LightImages) -> Result<()> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let State { lights, staging, time } = &mut *state;
        if *time == Some(t) {
            return Ok(());
        }
        // Powers go with the order.
        if lights.order_for(t) || time.is_none() {
            *time = None;
            staging.write_powers(lights.in_order())?;
            images.upload_powers(staging, Use::StorageRead)?;
        }
        *time = None;
        let trees = lights.place(t, staging.lights()?);
        images.upload_places(staging)?;
        images.upload_nodes(&trees.nodes, &trees.moments)?;
        *time = Some(t);
        Ok(())
    }
}

/// A scene's point lights at time 0, about the device's origin.
pub(super) fn placed(scene: &Scene, origin: Vec3) -> LightTree {
    LightTree::new(&scene.point_lights, origin)
}

/// Texels across, rows, and layers of places of so many lights and the null lights behind them.
fn light_extent(lights: usize) -> [u32; 3] {
    let rows = (lights as u32 + NULL_LIGHTS).div_ceil(shared::LIGHTS_PER_ROW);
    let layers = rows.div_ceil(1 << shared::LIGHT_ROWS_LOG2);
    let height = if layers > 1 { 1 << shared::LIGHT_ROWS_LOG2 } else { rows };
    [shared::LIGHTS_PER_ROW, height, layers]
}

/// First row, in the texture of the light trees, of the nodes over lights without a range.
#[must_use]
pub fn moment_row(lights: &LightTree) -> usize {
    node_rows(&lights.nodes)
}

fn node_rows(nodes: &[LightNode]) -> usize {
    nodes.len().div_ceil(1 << shared::NODES_PER_ROW_LOG2)
}

/// The trees in whole rows of RGBA32UI texels: two a node over lights with a range, eight a node over those without.
fn node_texels(nodes: &[LightNode], moments: &[MomentNode]) -> Vec<[u32; 4]> {
    type Texels = [[u32; 4]; shared::MOMENT_TEXELS as usize];
    const { assert!(size_of::<MomentNode>() == size_of::<Texels>()) };
    let mut texels: Vec<[u32; 4]> = bytemuck::cast_slice::<LightNode, _>(nodes).to_vec();
    texels.resize(node_rows(nodes) * NODE_ROW, [0; 4]);
    for node in moments {
        texels.extend(bytemuck::cast::<_, Texels>(*node));
        texels.resize(texels.len().next_multiple_of(MOMENT_STRIDE), [0; 4]);
    }
    texels.resize(texels.len().next_multiple_of(NODE_ROW).max(NODE_ROW), [0; 4]);
    texels
}
