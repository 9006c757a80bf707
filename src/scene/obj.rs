//! Wavefront OBJ, through tobj.
//!
//! tobj reports no lines, shifts attributes where only some faces have them, forgets `usemtl` names that no
//! MTL defines, and refuses vertices with unusual extras. So a first pass checks every line, and hands tobj the
//! same file in a plain dialect: `v`, `vt` and `vn` of fixed length, faces of absolute indices, and `usemtl`
//! with a tag that stands for the material together with the attributes that the following faces have.
//!
//! Faces of fewer than three corners, points, lines, curves, smoothing groups and object names are ignored.

use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Write;
use std::io::Read;
use std::path::Path;

use glam::Vec3;

use super::geometry::{Corner, Group};
use super::parse::LARGEST;
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
        scan.line(&line)
            .map_err(|(cause, remedy)| Error::input(file, number, cause, remedy))?;
    }
    if scan.tags.is_empty() {
        return Err(Error::input(
            file,
            None,
            "the OBJ has no faces",
            "export the model as a polygon mesh",
        ));
    }
    let models = plain_models(&scan).map_err(|error| {
        Error::input(
            file,
            None,
            format!("tobj cannot read the OBJ: {error}"),
            "export the model again",
        )
    })?;
    Ok(Obj {
        groups: groups(&scan, &models),
        libraries: scan.libraries,
    })
}

/// Lines with their 1-based numbers; a `\` at the end of a line joins the next one to it.
pub(super) fn logical_lines(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (index, first) = lines.next()?;
        let mut line = Cow::Borrowed(first.trim());
        while !line.starts_with('#')
            && let Some(head) = line.strip_suffix('\\')
            && let Some((_, next)) = lines.next()
        {
            line = Cow::Owned(format!("{head} {}", next.trim()));
        }
        Some((index + 1, line))
    })
}

/// Cause and remedy of a bad line.
type Bad = (String, &'static str);

/// The first pass over the file.
#[derive(Default)]
struct Scan {
    /// The file in tobj's plain dialect.
    plain: String,
    /// How many `v`, `vt` and `vn` there are so far.
    counts: [usize; 3],
    /// Names by `usemtl`, in order of appearance.
    materials: Vec<String>,
    libraries: Vec<String>,
    /// The `usemtl` in force, as an index into `materials`.
    material: Option<usize>,
    /// Material, and whether texture coordinates and normals are there.
    tags: Vec<(Option<usize>, bool, bool)>,
    tag_index: HashMap<(Option<usize>, bool, bool), usize>,
    tag: Option<usize>,
    face: Vec<[Option<usize>; 3]>,
}

impl Scan {
    fn line(&mut self, line: &str) -> Result<(), Bad> {
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match keyword {
            "v" => self.numbers(0, "v", rest, 3),
            "vt" => self.numbers(1, "vt", rest, 2),
            "vn" => self.numbers(2, "vn", rest, 3),
            "f" | "fo" => self.face(rest),
            "usemtl" => {
                self.use_material(rest.trim());
                Ok(())
            }
            "mtllib" => {
                self.libraries.push(rest.trim().to_owned());
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// `v`, `vt` or `vn`: the first `count` numbers. What may follow (weights, colours, a third texture
    /// coordinate) has no meaning here.
    fn numbers(
        &mut self,
        attribute: usize,
        keyword: &str,
        rest: &str,
        count: usize,
    ) -> Result<(), Bad> {
        let mut values = [0.0_f32; 3];
        let mut found = 0;
        for (value, token) in values.iter_mut().zip(rest.split_whitespace()).take(count) {
            *value = number(token).ok_or_else(|| {
                (
                    format!("`{keyword}` has \"{token}\", which is not a number"),
                    "write numbers",
                )
            })?;
            found += 1;
        }
        let least = if attribute == 1 { 1 } else { count };
        if found < least {
            let cause = format!("`{keyword}` has {found} numbers instead of {count}");
            return Err((cause, "export the model again; the file is damaged"));
        }
        if !values.iter().all(|x| x.abs() <= LARGEST as f32) {
            if attribute != 2 {
                let cause = format!("`{keyword}` is not finite, or larger than {LARGEST:e}");
                return Err((cause, "correct the number, or export the model again"));
            }
            // A zero normal is recomputed from the faces.
            values = [0.0; 3];
        }
        self.counts[attribute] += 1;
        let [x, y, z] = values;
        // Writing to a String cannot fail.
        let _ = if count == 3 {
            writeln!(self.plain, "{keyword} {x} {y} {z}")
        } else {
            writeln!(self.plain, "{keyword} {x} {y}")
        };
        Ok(())
    }

    fn use_material(&mut self, name: &str) {
        let known = self.materials.iter().position(|other| other == name);
        self.material = known.or_else(|| {
            self.materials.push(name.to_owned());
            Some(self.materials.len() - 1)
        });
    }

    fn face(&mut self, rest: &str) -> Result<(), Bad> {
        let mut face = std::mem::take(&mut self.face);
        face.clear();
        for token in rest
            .split_whitespace()
            .take_while(|token| !token.starts_with('#'))
        {
            face.push(self.corner(token)?);
        }
        if face.len() >= 3 {
            let has = |attribute: usize| face.iter().all(|corner| corner[attribute].is_some());
            self.switch_tag((self.material, has(1), has(2)));
            self.write_face(&face, has(1), has(2));
        }
        self.face = face;
        Ok(())
    }

    /// 0-based indices of position, texture coordinates and normal in `1/2/3`.
    fn corner(&self, token: &str) -> Result<[Option<usize>; 3], Bad> {
        const KINDS: [&str; 3] = ["vertex", "texture coordinate", "normal"];
        let bad = || {
            (
                format!("`f` has the corner \"{token}\""),
                "write corners as 1, 1/2, 1//3 or 1/2/3",
            )
        };
        let mut corner = [None; 3];
        for (attribute, part) in token.split('/').enumerate() {
            let count = *self.counts.get(attribute).ok_or_else(bad)?;
            if part.is_empty() {
                continue;
            }
            let index = part.parse::<i64>().map_err(|_| bad())?;
            let absolute = if index < 0 {
                count as i64 + index
            } else {
                index - 1
            };
            let absolute = usize::try_from(absolute)
                .ok()
                .filter(|absolute| *absolute < count);
            corner[attribute] = Some(absolute.ok_or_else(|| {
                let cause = format!("`f` refers to {} {index}, but {count} are defined before it", KINDS[attribute]);
                (cause, "use indices from 1 to that number, or from -1 downwards; the file may be cut off")
            })?);
        }
        if corner[0].is_none() {
            Err(bad())
        } else {
            Ok(corner)
        }
    }

    fn switch_tag(&mut self, key: (Option<usize>, bool, bool)) {
        let tag = *self.tag_index.entry(key).or_insert_with(|| {
            self.tags.push(key);
            self.tags.len() - 1
        });
        if self.tag != Some(tag) {
            self.tag = Some(tag);
            let _ = writeln!(self.plain, "usemtl {tag}");
        }
    }

    fn write_face(&mut self, face: &[[Option<usize>; 3]], with_uv: bool, with_normal: bool) {
        self.plain.push('f');
        for corner in face {
            let [v, vt, vn] = corner.map(|index| index.unwrap_or_default() + 1);
            let _ = match (with_uv, with_normal) {
                (true, true) => write!(self.plain, " {v}/{vt}/{vn}"),
                (true, false) => write!(self.plain, " {v}/{vt}"),
                (false, true) => write!(self.plain, " {v}//{vn}"),
                (false, false) => write!(self.plain, " {v}"),
            };
        }
        self.plain.push('\n');
    }
}

/// A number; what C and Microsoft libraries print for «not a number» is one, too.
fn number(token: &str) -> Option<f32> {
    let parsed = token.parse::<f32>().ok();
    let lower = || token.to_ascii_lowercase();
    parsed.or_else(|| (lower().contains("nan") || lower().contains("#in")).then_some(f32::NAN))
}

fn plain_models(scan: &Scan) -> Result<Vec<tobj::Model>, tobj::LoadError> {
    let options = tobj::LoadOptions {
        single_index: true,
        ..Default::default()
    };
    let library = |_: &Path| -> tobj::MTLLoadResult {
        let names = (0..scan.tags.len()).map(|tag| tag.to_string());
        let material = |name: &String| tobj::Material {
            name: name.clone(),
            ..Default::default()
        };
        let materials = names.clone().map(|name| material(&name)).collect();
        Ok((
            materials,
            names.enumerate().map(|(tag, name)| (name, tag)).collect(),
        ))
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
            groups.push(Group {
                material: material.map(|m| scan.materials[m].clone()),
                corners: Vec::new(),
            });
            groups.len() - 1
        });
        append(&mut groups[place].corners, mesh);
    }
    groups
}

/// Triangulates the polygons of `mesh`, whose vertices have all attributes that the mesh has.
fn append(corners: &mut Vec<Corner>, mesh: &tobj::Mesh) {
    let three =
        |values: &[f32], index: usize| values.get(index * 3..index * 3 + 3).map(Vec3::from_slice);
    let corner = |index: &u32| Corner {
        position: three(&mesh.positions, *index as usize).unwrap_or_default(),
        normal: three(&mesh.normals, *index as usize).unwrap_or_default(),
        uv: mesh
            .texcoords
            .get(*index as usize * 2..*index as usize * 2 + 2)
            .map(|uv| [uv[0], uv[1]]),
    };
    let mut rest = mesh.indices.as_slice();
    let mut arities = mesh.face_arities.iter();
    while !rest.is_empty() {
        // tobj leaves the arities out where all faces are triangles.
        let arity = arities
            .next()
            .map_or(3, |arity| *arity as usize)
            .min(rest.len());
        let (face, tail) = rest.split_at(arity);
        rest = tail;
        let face: Vec<Corner> = face.iter().map(corner).collect();
        for triangle in triangulate(&face) {
            corners.extend(triangle.map(|index| face[index]));
        }
    }
}
