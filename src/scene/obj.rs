//! Wavefront OBJ.
//!
//! [`Scan`] checks every line and notes attributes and faces; here faces become loose triangles by material.
//!
//! Faces of fewer than three corners, points, lines, curves, smoothing groups and object names are ignored.

use std::collections::HashMap;
use std::path::Path;

use glam::Vec3;

use super::geometry::{Corner, Group};
use super::obj_scan::{Face, Scan, logical_lines};
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
    if scan.faces.is_empty() {
        return Err(Error::input(file, None, "the OBJ has no faces", "export the model as a polygon mesh"));
    }
    Ok(Obj { groups: groups(&scan), libraries: scan.libraries })
}

fn groups(scan: &Scan) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut places: HashMap<Option<usize>, usize> = HashMap::new();
    let mut corners = Vec::new();
    for face in &scan.faces {
        let place = *places.entry(face.material).or_insert_with(|| {
            let material = face.material.map(|material| scan.materials[material].clone());
            groups.push(Group { material, corners: Vec::new() });
            groups.len() - 1
        });
        corners.clear();
        corners.extend(scan.corners[face.corners.clone()].iter().map(|indices| corner(scan, face, *indices)));
        append(&mut groups[place].corners, &corners);
    }
    groups
}

/// With the attributes that all corners of the face have.
fn corner(scan: &Scan, face: &Face, [v, vt, vn]: [u32; 3]) -> Corner {
    Corner {
        position: scan.positions[v as usize],
        normal: if face.normals { scan.normals[vn as usize] } else { Vec3::ZERO },
        uv: face.uvs.then(|| scan.uvs[vt as usize]),
    }
}

/// Triangulates a polygon.
fn append(corners: &mut Vec<Corner>, face: &[Corner]) {
    match face {
        [_, _, _] => corners.extend(face),
        _ => triangulate(face)
            .into_iter()
            .for_each(|triangle| corners.extend(triangle.map(|index| face[index]))),
    }
}
