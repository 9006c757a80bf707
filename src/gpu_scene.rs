//! A scene on the device: triangles sorted by what draws them, materials, textures, lights.

mod area;
mod coincident;
mod geometry;
pub mod occluders;
mod tables;
mod textures;

use crate::area_lights::AreaLights;
use crate::bvh::Bvh;
use crate::draws::{Draw, is_closed};
use crate::error::{Error, Result};
use crate::gpu::{
    Buffer, BufferUse, Cull, DescriptorSets, Device, Format, Image, ImageDescription, PipelineLayout,
    Specialization, Use,
};
use crate::light_tree::LightTree;
use crate::scene::material::PARAMETER_COUNT;
use crate::scene::{Luminaire as Surface, Material, Model, Parameter, PointLight, Scene, Vertex};
use crate::shared::{self, LightNode, MaterialRecord, MomentNode};
pub use area::{Area, Luminaire};
use geometry::{Geometry, bounds, origin};
use glam::Vec3;
use occluders::Occluders;
use rayon::prelude::*;
use std::sync::Arc;
use tables::Tables;
use textures::Textures;

/// How a material is drawn: everything its pipelines are specialised by.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Variant {
    /// Whether the prepass tests the material's mask.
    pub masked: bool,
    /// Whether back faces are drawn.
    pub both_sides: bool,
    /// BSDF model, lobes and texture slots.
    pub specialization: Specialization,
}

impl Variant {
    /// Faces to drop.
    #[must_use]
    pub fn cull(&self) -> Cull {
        if self.both_sides { Cull::None } else { Cull::Back }
    }
}

/// A scene's buffers and sets.
pub struct GpuScene {
    /// Set 1.
    pub set: DescriptorSets,
    /// Set 2 of each material.
    pub materials: DescriptorSets,
    /// All vertices.
    pub vertices: Buffer<Vertex>,
    /// All triangles.
    pub triangles: Buffer<[u32; 3]>,
    /// One per mesh, sorted by variant.
    pub draws: Vec<Draw>,
    /// Distinct variants, sorted.
    pub variants: Vec<Variant>,
    /// Point lights in device order.
    pub lights: LightTree,
    /// Area lights.
    pub area: Area,
    /// World position of the device's origin. A scene far from the world's is moved to its own, where float32 is fine
    /// enough: 1e5 m out, 46 % of pixels were more than 1 % off.
    pub origin: Vec3,
    /// Lower and upper corner of all triangles; `None` without any.
    pub bounds: Option<[glam::DVec3; 2]>,
    /// Layout that every pipeline of the frame shares.
    pub layout: Arc<PipelineLayout>,
    // What the sets refer to.
    _tables: Tables,
    _textures: Textures,
    _records: Buffer<MaterialRecord>,
    _nodes: Image,
    _light_image: Image,
    _occluders: Occluders,
}

impl GpuScene {
    /// Uploads a scene.
    ///
    /// # Errors
    /// [`Error::Usage`] for what is not supported yet, [`Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, scene: &Scene) -> Result<Self> {
        reject_unsupported(scene)?;
        let layout = Arc::new(PipelineLayout::new(
            device,
            &[shared::frame::BINDINGS, shared::scene::BINDINGS, shared::material::BINDINGS],
        )?);
        let tables = Tables::new(device, scene)?;
        let (variants, of_mesh) = variants(scene, &tables)?;
        let seen = scene.area_lights.iter().map(|light| light.visible.then(|| Surface::new(light)));
        let seen: Vec<Option<Surface>> = seen.collect();
        let origin = origin(scene, &seen);
        let geometry = Geometry::new(scene, &of_mesh, &seen, origin);
        let lights: Vec<_> = scene
            .point_lights
            .iter()
            .map(|&light| PointLight { position: light.position - origin, ..light })
            .collect();
        let lights = LightTree::new(&lights);
        let light_image = light_image(device, &lights.lights)?;
        let nodes = node_image(device, &lights)?;
        let records: Vec<_> = scene.materials.iter().map(record).collect();
        let records = Buffer::with(device, "materials", BufferUse::Uniform, &records)?;
        let set = layout.allocate(shared::scene::SET, 1)?;
        set.get(0).image(shared::scene::SCENE_LIGHTS, &light_image, Use::Texture);
        set.get(0).image(shared::scene::SCENE_LIGHT_NODES, &nodes, Use::Texture);
        // Where shadows are not asked for, or nothing casts any, nothing hides anything.
        let shadows = scene.render.shadows && !scene.area_lights.is_empty();
        let bvh = if shadows { Bvh::new(scene, origin) } else { Bvh::default() };
        let occluders = Occluders::new(device, &bvh)?;
        occluders.bind(set.get(0));
        let area = Area::new(device, &AreaLights::new(scene, origin)?, geometry.luminaires, shadows)?;
        area.bind(set.get(0));
        tables.bind(set.get(0));
        let textures = Textures::new(device, scene)?;
        let materials = textures.bind(&layout, scene)?;
        for index in 0..scene.materials.len() {
            materials.get(index).element(shared::material::MATERIAL_RECORD, &records, index);
        }
        Ok(Self {
            set,
            materials,
            vertices: Buffer::with(device, "vertices", BufferUse::Vertex, &geometry.vertices)?,
            triangles: Buffer::with(device, "triangles", BufferUse::Index, &geometry.triangles)?,
            draws: geometry.draws,
            variants,
            origin,
            bounds: bounds(&geometry.vertices),
            lights,
            area,
            layout,
            _tables: tables,
            _textures: textures,
            _records: records,
            _nodes: nodes,
            _light_image: light_image,
            _occluders: occluders,
        })
    }
}

fn reject_unsupported(scene: &Scene) -> Result<()> {
    let unsupported = [(scene.render.vpls > 0, "indirect light", "set indirect.vpls = 0")];
    match unsupported.into_iter().find(|(used, ..)| *used) {
        Some((_, what, remedy)) => {
            Err(Error::usage(format!("{what}: not supported yet by the renderer"), remedy))
        }
        None => Ok(()),
    }
}

/// Distinct variants, and for each mesh its own, and the one from outside if it is closed.
fn variants(scene: &Scene, tables: &Tables) -> Result<(Vec<Variant>, Vec<MeshVariants>)> {
    let of_material: Vec<_> =
        scene.materials.iter().map(|material| variant(material, tables)).collect::<Result<_>>()?;
    let of_mesh: Vec<_> = scene
        .meshes
        .par_iter()
        .map(|mesh| {
            let own = of_material[mesh.material as usize].clone();
            let solid = own.both_sides && !own.masked && is_closed(mesh);
            (own.clone(), solid.then_some(Variant { both_sides: false, ..own }))
        })
        .collect();
    let mut distinct: Vec<_> =
        of_mesh.iter().flat_map(|(own, outside)| [Some(own), outside.as_ref()]).flatten().cloned().collect();
    distinct.sort();
    distinct.dedup();
    let index = |variant: &Variant| distinct.binary_search(variant).unwrap_or(0);
    let indices = of_mesh
        .iter()
        .map(|(own, outside)| MeshVariants { own: index(own), from_outside: outside.as_ref().map(index) })
        .collect();
    Ok((distinct, indices))
}

/// Indices of a mesh's variants.
#[derive(Clone, Copy, Debug)]
struct MeshVariants {
    own: usize,
    from_outside: Option<usize>,
}

fn variant(material: &Material, tables: &Tables) -> Result<Variant> {
    let used = |parameter| {
        let value = material.value(parameter);
        u32::from(value.texture.is_some() || value.constant[0] > 0.0)
    };
    let aspect = material.value(Parameter::Aspect);
    let anisotropic = material.model != Model::Matte
        && material.model != Model::Plastic
        && (aspect.texture.is_some() || (aspect.constant[0] - 1.0).abs() > 1e-6);
    let mut specialization = Specialization::default()
        .with(shared::SPEC_MODEL, material.model as u32)
        .with(shared::SPEC_ANISOTROPIC, u32::from(anisotropic))
        .with(shared::SPEC_SQUARED_ROUGHNESS, u32::from(material.squared_roughness))
        .with(shared::SPEC_ROUGH_MATTE, used(Parameter::Sigma))
        .with(shared::SPEC_LOBE_SHEEN, used(Parameter::Sheen))
        .with(shared::SPEC_LOBE_CLEARCOAT, used(Parameter::Clearcoat))
        .with(shared::SPEC_LOBE_SUBSURFACE, used(Parameter::Subsurface))
        .with(shared::SPEC_LOBE_METALLIC, used(Parameter::Metallic))
        .with(shared::SPEC_TWO_SIDED, u32::from(material.two_sided));
    specialization = tables.specialize(material, specialization)?;
    let slots = slots(material);
    if slots.iter().flatten().any(|&slot| slot >= shared::MATERIAL_TEXTURES) {
        return Err(Error::usage(
            format!("material {:?} uses more than {} textures", material.name, shared::MATERIAL_TEXTURES),
            "give some of its parameters constants",
        ));
    }
    for (id, slot) in (shared::SPEC_SLOT..).zip(slots) {
        if let Some(slot) = slot {
            specialization = specialization.with(id, slot);
        }
    }
    Ok(Variant {
        masked: material.value(Parameter::Mask).texture.is_some(),
        both_sides: material.two_sided,
        specialization,
    })
}

/// Texture slot of each parameter: textured parameters take slots in order.
fn slots(material: &Material) -> [Option<u32>; PARAMETER_COUNT] {
    let mut next = 0;
    material.parameters.map(|value| {
        value.texture.map(|_| {
            next += 1;
            next - 1
        })
    })
}

fn record(material: &Material) -> MaterialRecord {
    let mut record = MaterialRecord::default();
    for (row, value) in record.rows.iter_mut().zip(&material.parameters) {
        row[..3].copy_from_slice(&value.constant);
    }
    record
}

/// Lights as two RGBA32F texels each, with null lights behind them: the padding of the lists, and of the last leaf.
fn light_image(device: &Arc<Device>, lights: &[PointLight]) -> Result<Image> {
    let null = PointLight { position: glam::Vec3::ZERO, intensity: glam::Vec3::ZERO, range: None };
    let row = shared::LIGHTS_PER_ROW as usize;
    let nulls = shared::MOMENT_LEAF as usize;
    let rows = (lights.len() + nulls).div_ceil(row);
    let layer_rows = 1 << shared::LIGHT_ROWS_LOG2;
    let layers = rows.div_ceil(layer_rows);
    let height = if layers > 1 { layer_rows } else { rows };
    let mut texels: Vec<[f32; 4]> = lights.iter().chain(&vec![null; nulls]).flat_map(light_texels).collect();
    texels.resize(layers * height * row * 2, [0.0; 4]);
    let image = Image::new(
        device,
        &ImageDescription {
            name: "lights",
            format: Format::R32G32B32A32_SFLOAT,
            size: [2 * shared::LIGHTS_PER_ROW, height as u32],
            layers: Some(layers as u32),
            mips: 1,
            uses: &[Use::TransferWrite, Use::Texture],
        },
    )?;
    image.upload(&[&texels], Use::Texture)?;
    Ok(image)
}

/// First row, in the texture of the light trees, of the nodes over lights without a range.
#[must_use]
pub fn moment_row(lights: &LightTree) -> usize {
    lights.nodes.len().div_ceil(1 << shared::NODES_PER_ROW_LOG2)
}

/// The trees in RGBA32UI texels: two a node over lights with a range, eight a node over those without.
fn node_image(device: &Arc<Device>, lights: &LightTree) -> Result<Image> {
    type Texel = [u32; 4];
    const STRIDE: usize = 1 << shared::MOMENT_STRIDE_LOG2;
    const { assert!(size_of::<MomentNode>() == shared::MOMENT_TEXELS as usize * size_of::<Texel>()) };
    let row = 2 << shared::NODES_PER_ROW_LOG2;
    let rows = moment_row(lights) + (lights.moments.len() * STRIDE).div_ceil(row);
    let mut texels: Vec<Texel> = bytemuck::cast_slice::<LightNode, _>(&lights.nodes).to_vec();
    texels.resize(moment_row(lights) * row, [0; 4]);
    for node in &lights.moments {
        texels.extend(bytemuck::cast::<_, [Texel; shared::MOMENT_TEXELS as usize]>(*node));
        texels.resize(texels.len().next_multiple_of(STRIDE), [0; 4]);
    }
    texels.resize(rows.max(1) * row, [0; 4]);
    let image = Image::new(
        device,
        &ImageDescription {
            name: "light tree",
            format: Format::R32G32B32A32_UINT,
            size: [row as u32, rows.max(1) as u32],
            layers: None,
            mips: 1,
            uses: &[Use::TransferWrite, Use::Texture],
        },
    )?;
    image.upload(&[&texels], Use::Texture)?;
    Ok(image)
}

fn light_texels(light: &PointLight) -> [[f32; 4]; 2] {
    let (inverse_range2, floor) = match light.range {
        // The square of the smallest ranges is 0.
        Some(range) => ((1.0 / (range * range)).min(f32::MAX), 1e-4),
        None => (0.0, 1e-12),
    };
    let (p, i) = (light.position, light.intensity);
    [[p.x, p.y, p.z, inverse_range2], [i.x, i.y, i.z, floor]]
}
