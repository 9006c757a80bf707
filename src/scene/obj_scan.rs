//! The lines of an OBJ file: each is checked, and attributes and faces are noted.

use std::borrow::Cow;
use std::ops::Range;

use glam::Vec3;

use super::parse::LARGEST;

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
pub(super) type Bad = (String, &'static str);

/// A polygon of three corners or more.
pub(super) struct Face {
    /// Of [`Scan::corners`].
    pub(super) corners: Range<usize>,
    /// Index into [`Scan::materials`].
    pub(super) material: Option<usize>,
    /// Every corner has texture coordinates.
    pub(super) uvs: bool,
    /// Every corner has a normal.
    pub(super) normals: bool,
}

/// What a file's lines say.
#[derive(Default)]
pub(super) struct Scan {
    pub(super) positions: Vec<Vec3>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) normals: Vec<Vec3>,
    /// 0-based indices of position, texture coordinates and normal; 0 for what the face's corners have not all.
    pub(super) corners: Vec<[u32; 3]>,
    pub(super) faces: Vec<Face>,
    /// Names by `usemtl`, in order of appearance.
    pub(super) materials: Vec<String>,
    pub(super) libraries: Vec<String>,
    /// The `usemtl` in force, as an index into `materials`.
    material: Option<usize>,
}

impl Scan {
    /// Takes one line.
    pub(super) fn line(&mut self, line: &str) -> Result<(), Bad> {
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match keyword {
            "v" => {
                let position = within("v", numbers("v", rest, 3)?)?;
                self.positions.push(position.into());
                Ok(())
            }
            "vt" => {
                let [u, v, _] = within("vt", numbers("vt", rest, 2)?)?;
                self.uvs.push([u, v]);
                Ok(())
            }
            "vn" => {
                // A zero normal is recomputed from the faces.
                let normal = within("vn", numbers("vn", rest, 3)?).unwrap_or_default();
                self.normals.push(normal.into());
                Ok(())
            }
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

    fn use_material(&mut self, name: &str) {
        let known = self.materials.iter().position(|other| other == name);
        self.material = known.or_else(|| {
            self.materials.push(name.to_owned());
            Some(self.materials.len() - 1)
        });
    }

    fn face(&mut self, rest: &str) -> Result<(), Bad> {
        let first = self.corners.len();
        let (mut uvs, mut normals) = (true, true);
        for token in rest.split_whitespace().take_while(|token| !token.starts_with('#')) {
            let [v, vt, vn] = self.corner(token)?;
            (uvs, normals) = (uvs && vt.is_some(), normals && vn.is_some());
            self.corners.push([v, vt, vn].map(|index| index.unwrap_or_default() as u32));
        }
        let corners = first..self.corners.len();
        if corners.len() < 3 {
            self.corners.truncate(first);
        } else {
            self.faces.push(Face { corners, material: self.material, uvs, normals });
        }
        Ok(())
    }

    /// 0-based indices of position, texture coordinates and normal in `1/2/3`.
    fn corner(&self, token: &str) -> Result<[Option<usize>; 3], Bad> {
        const KINDS: [&str; 3] = ["vertex", "texture coordinate", "normal"];
        let bad = || (format!("`f` has the corner \"{token}\""), "write corners as 1, 1/2, 1//3 or 1/2/3");
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut corner = [None; 3];
        for (attribute, part) in token.split('/').enumerate() {
            let count = *counts.get(attribute).ok_or_else(bad)?;
            if part.is_empty() {
                continue;
            }
            let index = part.parse::<i64>().map_err(|_| bad())?;
            let absolute = if index < 0 { count as i64 + index } else { index - 1 };
            let absolute = usize::try_from(absolute).ok().filter(|absolute| *absolute < count);
            corner[attribute] = Some(absolute.ok_or_else(|| {
                let cause =
                    format!("`f` refers to {} {index}, but {count} are defined before it", KINDS[attribute]);
                (cause, "use indices from 1 to that number, or from -1 downwards; the file may be cut off")
            })?);
        }
        if corner[0].is_none() { Err(bad()) } else { Ok(corner) }
    }
}

/// The first `count` numbers of `v`, `vt` or `vn`. What may follow (weights, colours, a third texture coordinate) has no
/// meaning here; a second texture coordinate may be missing.
fn numbers(keyword: &str, rest: &str, count: usize) -> Result<[f32; 3], Bad> {
    let mut values = [0.0_f32; 3];
    let mut found = 0;
    for (value, token) in values.iter_mut().zip(rest.split_whitespace()).take(count) {
        *value = number(token).ok_or_else(|| {
            (format!("`{keyword}` has \"{token}\", which is not a number"), "write numbers")
        })?;
        found += 1;
    }
    let least = if count == 2 { 1 } else { count };
    if found < least {
        let cause = format!("`{keyword}` has {found} numbers instead of {count}");
        return Err((cause, "export the model again; the file is damaged"));
    }
    Ok(values)
}

/// Numbers that are finite and sane.
fn within(keyword: &str, values: [f32; 3]) -> Result<[f32; 3], Bad> {
    match values.iter().all(|x| x.abs() <= LARGEST as f32) {
        true => Ok(values),
        false => Err((
            format!("`{keyword}` is not finite, or larger than {LARGEST:e}"),
            "correct the number, or export the model again",
        )),
    }
}

/// A number; what C and Microsoft libraries print for «not a number» is one, too.
fn number(token: &str) -> Option<f32> {
    let parsed = token.parse::<f32>().ok();
    let lower = || token.to_ascii_lowercase();
    parsed.or_else(|| (lower().contains("nan") || lower().contains("#in")).then_some(f32::NAN))
}
