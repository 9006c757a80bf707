//! A scene on the device: triangles sorted by what draws them, materials, textures, lights.

mod area;
mod coincident;
mod edit;
mod geometry;
pub mod hits;
mod lights;
mod models;
pub mod occluders;
mod resolved;
mod tables;
mod textures;

use crate::area_lights::AreaLights;
use crate::bvh::Bvh;
use crate::draws::{Draw, is_closed};
use crate::error::{Error, Result};
use crate::gpu::{Buffer, BufferUse, Cull, DescriptorSets, Device, PipelineLayout, Specialization};
use crate::light_tree::{LightTree, median_range};
use crate::scene::material::PARAMETER_COUNT;
use crate::scene::{Luminaire as Surface, Material, Model, Parameter, Scene, Vertex};
use crate::shared::{self, MaterialRecord};
pub use area::{Area, Luminaire};
pub use edit::Edit;
use geometry::{Geometry, bounds, origin};
use glam::Vec3;
use hits::Hits;
pub use lights::moment_row;
use lights::{LightImages, Moving, placed};
use models::models;
use occluders::Occluders;
use rayon::prelude::*;
use resolved::Resolved;
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

/// A scene's triangles, in the order of its draws.
#[derive(Clone, Copy)]
pub struct Triangles<'a> {
    /// Vertices.
    pub vertices: &'a Buffer<Vertex>,
    /// Indices of three of them each.
    pub triangles: &'a Buffer<[u32; 3]>,
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
    /// Which of them compute shades.
    pub resolved: Resolved,
    /// Constants of the materials.
    pub records: Vec<MaterialRecord>,
    /// Models and lobes that any surface has: specialisation constants of shaders that meet them all.
    pub models: Vec<(u32, u32)>,
    /// Whether every surface is Lambertian.
    pub lambertian: bool,
    /// Median of the point lights' ranges, metres; 0 without any.
    pub median_range: f32,
    /// Point lights in device order, at time 0.
    pub lights: LightTree,
    /// Area lights.
    pub area: Area,
    /// What hides lights.
    pub occluders: Occluders,
    /// What the nearest hits of rays are found and shaded by.
    pub hits: Hits,
    /// World position of the device's origin. A scene far from the world's is moved to its own, where float32 is fine
    /// enough: 1e5 m out, 46 % of pixels were more than 1 % off.
    pub origin: Vec3,
    /// Lower and upper corner of all triangles; `None` without any.
    pub bounds: Option<[glam::DVec3; 2]>,
    /// Layout that every pipeline of the frame shares.
    pub layout: Arc<PipelineLayout>,
    /// `None` where no light moves.
    moving: Option<Moving>,
    light_images: LightImages,
    /// Variant of each material.
    of_material: Vec<Variant>,
    tables: Tables,
    record_buffer: Buffer<MaterialRecord>,
    // What the sets refer to.
    _textures: Textures,
}

impl GpuScene {
    /// Uploads a scene.
    ///
    /// # Errors
    /// [`Error::Usage`] for what is not supported yet, [`Error::Vulkan`] where memory is short.
    pub fn new(device: &Arc<Device>, scene: &Scene) -> Result<Self> {
        let layout = Arc::new(PipelineLayout::new(
            device,
            &[shared::frame::BINDINGS, shared::scene::BINDINGS, shared::material::BINDINGS],
        )?);
        let tables = Tables::new(device, scene)?;
        let of_material: Vec<_> =
            scene.materials.iter().map(|material| variant(material, &tables)).collect::<Result<_>>()?;
        let (variants, of_mesh) = variants(scene, &of_material);
        let seen = scene.area_lights.iter().map(|light| light.visible.then(|| Surface::new(light)));
        let seen: Vec<Option<Surface>> = seen.collect();
        let origin = origin(scene, &seen);
        let geometry = Geometry::new(scene, &of_mesh, &seen, origin);
        let lights = placed(scene, origin);
        let light_images = LightImages::new(device, &lights)?;
        let records: Vec<_> = scene.materials.iter().map(record).collect();
        let record_buffer = Buffer::with(device, "materials", BufferUse::Uniform, &records)?;
        let set = layout.allocate(shared::scene::SET, 1)?;
        light_images.bind(set.get(0));
        let bvh = if meets_rays(scene) { Bvh::new(scene, origin) } else { Bvh::default() };
        let occluders = Occluders::new(device, &bvh)?;
        occluders.bind(set.get(0));
        let hits = if scene.render.vpls > 0 { Hits::new(device, scene, &bvh)? } else { Hits::none(device)? };
        hits.bind(set.get(0));
        let shadows = scene.render.shadows && !scene.area_lights.is_empty();
        let area = Area::new(device, &AreaLights::new(scene, origin)?, geometry.luminaires, shadows)?;
        area.bind(set.get(0));
        tables.bind(set.get(0));
        let textures = Textures::new(device, scene)?;
        let materials = textures.bind(&layout, scene)?;
        for index in 0..scene.materials.len() {
            materials.get(index).element(shared::material::MATERIAL_RECORD, &record_buffer, index);
        }
        Ok(Self {
            set,
            materials,
            vertices: Buffer::with(device, "vertices", BufferUse::Vertex, &geometry.vertices)?,
            triangles: Buffer::with(device, "triangles", BufferUse::Index, &geometry.triangles)?,
            draws: geometry.draws,
            resolved: Resolved::new(&variants, records.len()),
            models: models(&of_material),
            lambertian: scene.materials.iter().all(is_lambertian),
            records,
            variants,
            origin,
            bounds: bounds(&geometry.vertices),
            median_range: median_range(&lights.lights),
            lights,
            area,
            hits,
            layout,
            of_material,
            tables,
            record_buffer,
            _textures: textures,
            moving: Moving::new(device, scene, origin)?,
            light_images,
            occluders,
        })
    }

    /// What draws take their triangles from.
    #[must_use]
    pub fn geometry(&self) -> Triangles<'_> {
        Triangles { vertices: &self.vertices, triangles: &self.triangles }
    }

    /// Whether lights move.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.moving.is_some()
    }

    /// Moves the lights that move to where they are at time `t`, seconds.
    ///
    /// # Errors
    /// [`Error::Vulkan`] from the driver.
    pub fn move_lights(&self, t: f64) -> Result<()> {
        self.moving.as_ref().map_or(Ok(()), |moving| moving.move_to(t, &self.light_images))
    }
}

/// Whether its tangents matter.
fn is_anisotropic(material: &Material) -> bool {
    let aspect = material.value(Parameter::Aspect);
    let round = [Model::Matte, Model::Plastic].contains(&material.model);
    !round && (aspect.texture.is_some() || (aspect.constant[0] - 1.0).abs() > 1e-6)
}

fn is_lambertian(material: &Material) -> bool {
    let sigma = material.value(Parameter::Sigma);
    material.model == Model::Matte && sigma.texture.is_none() && sigma.constant[0] == 0.0
}

/// Whether rays are traced: where shadows are not asked for, or nothing casts any, nothing hides anything.
fn meets_rays(scene: &Scene) -> bool {
    let lights = !scene.area_lights.is_empty() || !scene.point_lights.is_empty();
    scene.render.vpls > 0 || (scene.render.shadows && lights)
}

/// Distinct variants, and for each mesh its own, and the one from outside if it is closed.
fn variants(scene: &Scene, of_material: &[Variant]) -> (Vec<Variant>, Vec<MeshVariants>) {
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
    (distinct, indices)
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
    let mut specialization = Specialization::default()
        .with(shared::SPEC_MODEL, material.model as u32)
        .with(shared::SPEC_ANISOTROPIC, u32::from(is_anisotropic(material)))
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
