//! What amas asks of a device (`src/gpu/requirements.rs`), and that no shader asks for more.

use std::collections::BTreeSet;

use amas::gpu::{Stage, shaders};
use amas::shared::{Binding, BindingKind, Stages, frame, material, order, pairs, probe, resolve, scene};

use crate::spirv::{Module, Type, class, decoration};
use crate::{constant, kinds, modules};

/// Capabilities that shaders may declare, each with the reason that no feature has to be turned on for it. Not here:
/// Float64, Int64, Int16, Float16, subgroups, image queries, formatless storage images, non-uniform indexing.
const CAPABILITIES: [(u32, &str); 2] = [
    (1, "Shader: what a graphics device is"),
    (40, "InputAttachment: the present subpass reads the colour of its pixel; part of every render pass"),
];

/// RayQueryKHR: of devices that have it turned on, and of shaders that were made for these.
const RAY_QUERY: u32 = 4472;
/// `maxBoundDescriptorSets` of every device.
const DESCRIPTOR_SETS: u32 = 4;
/// `maxPushConstantsSize` of every device.
const PUSH_CONSTANT_BYTES: u32 = 128;
/// `maxComputeSharedMemorySize` of every device.
const SHARED_MEMORY_BYTES: u32 = 16_384;
/// `maxComputeWorkGroupInvocations` that amas asks for.
const WORKGROUP_INVOCATIONS: u32 = 256;
/// `maxPerStageDescriptorStorageBuffers` of every device.
const STORAGE_BUFFERS: u32 = 4;
/// `maxPerStageDescriptorSampledImages` of every device; combined ones count.
const SAMPLED_IMAGES: u32 = 16;
/// `maxPerStageDescriptorStorageImages` of every device.
const STORAGE_IMAGES: u32 = 4;

#[test]
fn capabilities_are_those_of_every_device() {
    for (shader, ray_queries) in kinds() {
        let module = Module::parse(&shader.words(ray_queries));
        for &capability in &module.capabilities {
            let allowed = CAPABILITIES.iter().any(|row| row.0 == capability);
            let allowed = allowed || ray_queries && capability == RAY_QUERY;
            assert!(allowed, "{}: capability {capability} is none of {CAPABILITIES:?}", shader.name);
        }
        let extensions: &[&str] = if ray_queries { &["SPV_KHR_ray_query"] } else { &[] };
        assert_eq!(module.extensions, extensions, "{}: extensions", shader.name);
    }
}

/// Whatever includes bind/bvh.glsl is there with ray queries, too; nothing else is.
#[test]
fn shaders_that_ask_about_rays_are_there_twice() {
    let asks =
        |module: &Module| module.variables.iter().any(|variable| module.name(variable.id) == "bvh_texels");
    for shader in shaders::ALL {
        let [walks, kinds] =
            [asks(&Module::parse(&shader.words(false))), shader.kinds().any(|queries| queries)];
        assert_eq!(walks, kinds, "{}", shader.name);
    }
    assert_eq!(shaders::ALL.iter().filter(|shader| shader.kinds().count() == 2).count(), 6);
}

#[test]
fn workgroups_have_the_size_that_dispatches_assume() {
    let sized = |name| constant(name).unwrap();
    let (linear, scan, tile) = (sized("LINEAR_GROUP"), sized("SCAN_GROUP"), sized("TILE_SIZE"));
    assert_eq!(sized("TILE_PIXELS"), tile * tile);
    assert_eq!([sized("ORDER_DIGITS"), 1 << sized("ORDER_DIGIT_BITS")], [scan; 2]);
    for (shader, module) in modules() {
        let want = match shader.name {
            _ if shader.stage != Stage::Compute => None,
            // Chosen when the pipeline is made: 8, or 32.
            "cluster/slices.comp" | "cluster/bounds.comp" | "cluster/gather.comp" | "cluster/fold.comp" => {
                Some([1, 1, 1])
            }
            "order/count.comp" | "order/scatter.comp" => Some([1, 1, 1]),
            name if name.starts_with("resolve/many_") => Some([1, 1, 1]),
            // One workgroup per tile: one invocation per pixel.
            "cluster/pairs.comp" | "cluster/floors.comp" | "cluster/given_up.comp" => Some([tile, tile, 1]),
            "gather/gather.comp" => Some([sized("GATHER_SIDE"), sized("GATHER_SIDE"), 1]),
            "cluster/bands.comp" => Some([sized("BANDS"), 1, 1]),
            "cluster/count.comp" => Some([linear / sized("SIBLINGS"), 1, 1]),
            "cluster/scan_tiles.comp"
            | "cluster/scan_lists.comp"
            | "cluster/scan_cuts.comp"
            | "cluster/split.comp"
            | "order/places.comp"
            | "resolve/gather.comp" => Some([scan, 1, 1]),
            // One invocation per element.
            _ => Some([linear, 1, 1]),
        };
        assert_eq!(module.local_size, want, "{}: local size", shader.name);
        let invocations: u32 = want.into_iter().flatten().product();
        assert!(invocations <= WORKGROUP_INVOCATIONS, "{}: {invocations} invocations", shader.name);
    }
}

#[test]
fn memory_and_descriptors_fit_every_device() {
    for (shader, module) in modules() {
        let sum = |class| bytes(&module, class);
        let (push, shared) = (sum(class::PUSH_CONSTANT), sum(class::WORKGROUP));
        assert!(push <= PUSH_CONSTANT_BYTES, "{}: {push} bytes of push constants", shader.name);
        assert!(shared <= SHARED_MEMORY_BYTES, "{}: {shared} bytes of shared memory", shader.name);
        let sets =
            module.variables.iter().filter_map(|v| module.decoration(v.id, decoration::DESCRIPTOR_SET));
        let sets = sets.max().map_or(0, |highest| highest + 1);
        assert!(sets <= DESCRIPTOR_SETS, "{}: {sets} descriptor sets", shader.name);
    }
}

/// A layout shows a stage every descriptor that is not another stage's alone: each carries the sum over all sets.
#[test]
fn pipeline_layouts_fit_the_device_that_amas_asks_for() {
    for last in [material::BINDINGS, resolve::BINDINGS, pairs::BINDINGS] {
        let sets = [frame::BINDINGS, scene::BINDINGS, last];
        for stage in [Stages::Fragment, Stages::Compute] {
            let count = |kinds: &[BindingKind]| -> u32 {
                let seen = |binding: &&Binding| [Stages::All, stage].contains(&binding.stages);
                let matching = sets.iter().copied().flatten().filter(seen);
                matching.filter(|binding| kinds.contains(&binding.kind)).map(|binding| binding.count).sum()
            };
            assert!(count(&[BindingKind::Storage]) <= STORAGE_BUFFERS, "{stage:?}: {last:?}");
            let sampled = count(&[BindingKind::Sampled, BindingKind::Combined]);
            assert!(sampled <= SAMPLED_IMAGES, "{stage:?}: {last:?}");
            assert!(count(&[BindingKind::StorageImage]) <= STORAGE_IMAGES, "{stage:?}: {last:?}");
        }
    }
    assert!(order::BINDINGS.len() <= STORAGE_BUFFERS as usize, "bound alone");
    let tables = [frame::BINDINGS, scene::BINDINGS, material::BINDINGS];
    let others = [resolve::BINDINGS, pairs::BINDINGS, order::BINDINGS, probe::BINDINGS];
    for table in tables.into_iter().chain(others) {
        let numbers: BTreeSet<_> = table.iter().map(|binding| binding.binding).collect();
        assert_eq!(numbers.len(), table.len(), "binding numbers are unique: {table:?}");
    }
}

/// Bytes of all variables of a storage class.
fn bytes(module: &Module, class: u32) -> u32 {
    let variables = module.variables.iter().filter(|variable| variable.class == class);
    variables
        .map(|variable| match module.typed(variable.pointer) {
            Type::Pointer { of } => module.extent(*of, 0),
            _ => 0,
        })
        .sum()
}
