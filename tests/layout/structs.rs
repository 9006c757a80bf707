//! Offsets, names, sizes and strides of the shared structs, in uniform blocks, storage buffers and push constants.

use std::collections::BTreeSet;

use amas::shared::{self, LAYOUTS, StructLayout};

use crate::modules;
use crate::spirv::{Module, decoration};

/// Structs that shaders take from textures.
const IN_TEXELS: [&str; 13] = [
    "LightNode",
    "MomentNode",
    "BvhHeader",
    "BvhNode",
    "BvhTriangle",
    "MaskedTriangle",
    "HitTriangle",
    "HitTangents",
    "HitMaterial",
    "HitTexture",
    "AreaRecord",
    "VirtualLight",
    "VirtualPair",
];

#[test]
fn structs_lie_in_shaders_as_they_do_in_rust() {
    let mut found = BTreeSet::new();
    for (shader, module) in modules() {
        for (id, name, members) in module.laid_out_structs() {
            let Some(layout) = LAYOUTS.iter().find(|layout| layout.name == name) else {
                continue;
            };
            compare(shader.name, &module, layout, id, members);
            found.insert(layout.name);
        }
    }
    // Each of them is read or written by a shader: one that is not found is dead, or misnamed.
    // What lies in texels has no offsets in SPIR-V: see below.
    let in_blocks = |layout: &&StructLayout| !IN_TEXELS.contains(&layout.name);
    let all: BTreeSet<_> = LAYOUTS.iter().filter(in_blocks).map(|layout| layout.name).collect();
    assert_eq!(found, all, "structs found in shaders against structs declared");
}

/// `node_at` in glsl/cluster/reach.glsl takes a node from two texels of four words, a vector and a scalar each.
#[test]
fn light_nodes_fill_two_texels() {
    let layout = LAYOUTS.iter().find(|layout| layout.name == "LightNode").unwrap();
    assert_eq!(layout.fields, [("lower", 0), ("first", 12), ("upper", 16), ("count", 28)]);
    assert_eq!(layout.size, 32);
}

/// `moment_head` and `moments_at` in glsl/bind/moments.glsl take it apart.
#[test]
fn moment_nodes_fill_whole_texels() {
    let layout = LAYOUTS.iter().find(|layout| layout.name == "MomentNode").unwrap();
    let places: Vec<_> = layout.fields.iter().map(|field| field.1).collect();
    assert_eq!(places, [0, 12, 16, 20, 24, 28, 32, 44, 48, 60, 64, 76, 80, 84, 88, 92]);
    assert_eq!(layout.size, 16 * shared::MOMENT_TEXELS as usize);
    const { assert!(shared::MOMENT_TEXELS <= 1 << shared::MOMENT_STRIDE_LOG2) };
    assert_eq!(shared::MOMENTS_PER_ROW_LOG2 + shared::MOMENT_STRIDE_LOG2, shared::NODES_PER_ROW_LOG2 + 1);
}

/// So do those of the occluders, as glsl/bind/bvh.glsl reads them.
#[test]
fn occluders_fill_whole_texels() {
    let of = |name| LAYOUTS.iter().find(|layout| layout.name == name).unwrap();
    let header = of("BvhHeader");
    assert_eq!(header.fields, [("lower", 0), ("nodes", 12), ("cell", 16), ("triangles", 28)]);
    assert_eq!(header.size, 16 * shared::BVH_HEADER_TEXELS as usize);
    let node = of("BvhNode");
    assert_eq!(node.fields, [("x", 0), ("y", 4), ("z", 8), ("next", 12)]);
    assert_eq!(node.size, 16);
    let triangle = of("BvhTriangle");
    let corners = [("a", 0), ("masked", 12), ("b", 16), ("mesh", 28), ("c", 32), ("triangle", 44)];
    assert_eq!(triangle.fields, corners);
    assert_eq!(triangle.size, 16 * shared::BVH_TRIANGLE_TEXELS as usize);
    let masked = of("MaskedTriangle");
    assert_eq!(masked.fields, [("uv_ab", 0), ("uv_c", 16), ("words", 24), ("size", 28)]);
    assert_eq!(masked.size, 32);
}

/// As glsl/bind/hit.glsl reads them.
#[test]
fn hits_fill_whole_texels() {
    let of = |name| LAYOUTS.iter().find(|layout| layout.name == name).unwrap();
    let places = |name| of(name).fields.iter().map(|field| field.1).collect::<Vec<_>>();
    assert_eq!(places("HitTriangle"), [0, 12, 16, 28, 32, 44, 48]);
    assert_eq!(of("HitTriangle").size, 16 * shared::HIT_TRIANGLE_TEXELS as usize);
    assert_eq!(places("HitTangents"), [0, 12, 16, 28, 32, 44]);
    assert_eq!(of("HitTangents").size, 16 * 3);
    assert_eq!(places("HitMaterial"), [0, 12, 16, 28, 32, 36, 40, 44, 48, 52, 56, 60, 64, 68, 72, 76]);
    assert_eq!(of("HitMaterial").size, 16 * shared::HIT_MATERIAL_TEXELS as usize);
    assert_eq!((places("HitTexture"), of("HitTexture").size), (vec![0, 4, 8, 12], 16));
}

/// Texels of a vector and a scalar each.
#[test]
fn virtual_lights_fill_whole_texels() {
    let of = |name| LAYOUTS.iter().find(|layout| layout.name == name).unwrap();
    let [light, pair] = [of("VirtualLight"), of("VirtualPair")];
    assert_eq!(light.fields, [("position", 0), ("normal", 12), ("color", 16), ("extra", 28)]);
    let left = [("left_lower", 0), ("left_count", 12), ("left_upper", 16), ("left_cone", 28)];
    let right = [("right_lower", 32), ("powers", 44), ("right_upper", 48), ("right_cone", 60)];
    assert_eq!(pair.fields, [left, right].concat());
    assert_eq!([light.size, pair.size], [32, 64]);
}

/// `area_light` in glsl/bind/area_lights.glsl takes it apart.
#[test]
fn area_lights_fill_whole_texels() {
    let record = LAYOUTS.iter().find(|layout| layout.name == "AreaRecord").unwrap();
    let scalars = ["kind", "extent", "radius", "ring_first", "ring_count", "points", "heap", "size"];
    for (texel, name) in scalars.iter().enumerate() {
        assert!(record.fields.contains(&(name, 16 * texel + 12)), "{name} ends texel {texel}");
    }
    let vectors = ["center", "u", "v", "normal", "radiance", "piece_first", "uv_s", "uv_t"];
    for (texel, name) in vectors.iter().enumerate() {
        assert!(record.fields.contains(&(name, 16 * texel)), "{name} begins texel {texel}");
    }
    assert_eq!(record.size, 16 << shared::AREA_RECORD_LOG2);
}

fn compare(shader: &str, module: &Module, layout: &StructLayout, id: u32, members: &[u32]) {
    let context = format!("{shader}: struct {}", layout.name);
    assert_eq!(members.len(), layout.fields.len(), "{context}: number of fields");
    // No struct has padding, so each field ends where the next begins: its type has the right size too.
    let ends = layout.fields.iter().skip(1).map(|field| field.1);
    let ends = ends.chain([layout.size]);
    for ((member, &typed), (&(name, offset), end)) in (0..).zip(members).zip(layout.fields.iter().zip(ends)) {
        let context = format!("{context}, field {name}");
        let begin = module.member(id, member, decoration::OFFSET).unwrap() as usize;
        let extent = module.member_extent(id, member, typed) as usize;
        assert_eq!(module.member_name(id, member), name, "{context}: name");
        assert_eq!(begin, offset, "{context}: offset");
        assert_eq!(begin + extent, end, "{context}: end");
        let row_major = module.member(id, member, decoration::ROW_MAJOR);
        assert_eq!(row_major, None, "{context}: matrices are columns");
    }
    for stride in module.strides_of(id) {
        assert_eq!(stride as usize, layout.size, "{context}: array stride");
    }
}
