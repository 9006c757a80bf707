//! Offsets, names, sizes and strides of the shared structs, in uniform blocks, storage buffers and push constants.

use std::collections::BTreeSet;

use amas::shared::{LAYOUTS, StructLayout};

use crate::modules;
use crate::spirv::{Module, decoration};

/// Structs that shaders put together from whole texels of 16 bytes, which have no layout of their own.
const TEXELS: [&str; 1] = ["LightNode"];

#[test]
fn structs_of_texels_fill_them() {
    for layout in LAYOUTS.iter().filter(|layout| TEXELS.contains(&layout.name)) {
        let offsets: Vec<_> = layout.fields.iter().map(|field| field.1).collect();
        assert_eq!(layout.size % 16, 0, "{}", layout.name);
        assert!((0..layout.size).step_by(16).all(|texel| offsets.contains(&texel)), "{}", layout.name);
    }
}

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
    let all = LAYOUTS.iter().filter(|layout| !TEXELS.contains(&layout.name));
    let all: BTreeSet<_> = all.map(|layout| layout.name).collect();
    assert_eq!(found, all, "structs found in shaders against structs declared");
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
