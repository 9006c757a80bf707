//! Wavefront OBJ, through tobj.
//!
//! tobj reports no lines, shifts attributes where only some faces have them, forgets `usemtl` names that no
//! MTL defines, and refuses vertices with unusual extras. So a first pass ([`Scan`]) checks every line, and hands
//! tobj the same file in a plain dialect, in which `usemtl` stands for the material together with the attributes
//! that the following faces have.
//!
//! Faces of fewer than three corners, points, lines, curves, smoothing groups and object names are ignored.

use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

use glam::Vec3;

use super::geometry::{Corner, Group};
use super::obj_scan::{Scan, logical_lines};
use super::triangulate::triangulate;
use crate::error::{Error, Result};

/// An OBJ file: triangles by material, in the order in which the materials first occur.
pub(super) struct Obj {
    pub(super) groups: Vec<Group>,
    /// What `mtllib` names.
    pub(super) libraries: Vec<String>,
}

/// Reads the text of an OBJ file; `file` is for messages.
///
/// # Errors
/// [`Error::Input`] with the line of a malformed or out-of-range statement, or if there is no face at all.
pub(super) fn read(file: &Path, text: &str) -> Result<Obj> {
    let mut scan = Scan::default();
    for (number, line) in logical_lines(text.trim_start_matches('\u{feff}')) {
        scan.line(&line).map_err(|(cause, remedy)| Error::input(file, number, cause, remedy))?;
    }
    if scan.tags.is_empty() {
        return Err(Error::input(file, None, "the OBJ has no faces", "export the model as a polygon mesh"));
    }
    let models = plain_models(&scan).map_err(|error| {
        Error::input(file, None, format!("tobj cannot read the OBJ: {error}"), "export the model again")
    })?;
    Ok(Obj { groups: groups(&scan, &models), libraries: scan.libraries })
}

fn plain_models(scan: &Scan) -> Result<Vec<tobj::Model>, tobj::LoadError> {
    let options = tobj::LoadOptions { single_index: true, ..Default::default() };
    let library = |_: &Path| -> tobj::MTLLoadResult {
        let names = (0..scan.tags.len()).map(|tag| tag.to_string());
        let material = |name: &String| tobj::Material { name: name.clone(), ..Default::default() };
        let materials = names.clone().map(|name| material(&name)).collect();
        Ok((materials, names.enumerate().map(|(tag, name)| (name, tag)).collect()))
    };
    let mut text = b"mtllib tags\n".chain(scan.plain.as_bytes());
    tobj::load_obj_buf(&mut text, &options, library).map(|(models, _)| models)
}

fn groups(scan: &Scan, models: &[tobj::Model]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut places: HashMap<Option<usize>, usize> = HashMap::new();
    for mesh in models.iter().map(|model| &model.mesh) {
        let Some((material, ..)) = mesh.material_id.and_then(|tag| scan.tags.get(tag)) else {
            continue;
        };
        let place = *places.entry(*material).or_insert_with(|| {
            groups.push(Group { material: material.map(|m| scan.materials[m].clone()), corners: Vec::new() });
            groups.len() - 1
        });
        append(&mut groups[place].corners, mesh);
    }
    groups
}

/// Triangulates the polygons of `mesh`, whose vertices have all attributes that the mesh has.
fn append(corners: &mut Vec<Corner>, mesh: &tobj::Mesh) {
    let three = |values: &[f32], index: usize| values.get(index * 3..index * 3 + 3).map(Vec3::from_slice);
    let corner = |index: &u32| Corner {
        position: three(&mesh.positions, *index as usize).unwrap_or_default(),
        normal: three(&mesh.normals, *index as usize).unwrap_or_default(),
        uv: mesh.texcoords.get(*index as usize * 2..*index as usize * 2 + 2).map(|uv| [uv[0], uv[1]]),
    };
    let mut rest = mesh.indices.as_slice();
    let mut arities = mesh.face_arities.iter();
    while !rest.is_empty() {
        // tobj leaves the arities out where all faces are triangles.
        let arity = arities.next().map_or(3, |arity| *arity as usize).min(rest.len());
        let (face, tail) = rest.split_at(arity);
        rest = tail;
        let face: Vec<Corner> = face.iter().map(corner).collect();
        for triangle in triangulate(&face) {
            corners.extend(triangle.map(|index| face[index]));
        }
    }
}
