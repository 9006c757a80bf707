//! The first pass over an OBJ file: checks every line, and writes the file again in a plain dialect.
//!
//! The dialect is `v`, `vt` and `vn` of fixed length, faces of absolute indices, and `usemtl` with the index of a
//! [`Scan::tags`] entry.

use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Write;

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

/// The first pass over the file.
#[derive(Default)]
pub(super) struct Scan {
    /// The file in tobj's plain dialect.
    pub(super) plain: String,
    /// How many `v`, `vt` and `vn` there are so far.
    counts: [usize; 3],
    /// Names by `usemtl`, in order of appearance.
    pub(super) materials: Vec<String>,
    pub(super) libraries: Vec<String>,
    /// The `usemtl` in force, as an index into `materials`.
    material: Option<usize>,
    /// Material, and whether texture coordinates and normals are there.
    pub(super) tags: Vec<(Option<usize>, bool, bool)>,
    tag_index: HashMap<(Option<usize>, bool, bool), usize>,
    tag: Option<usize>,
    face: Vec<[Option<usize>; 3]>,
}

impl Scan {
    /// Takes one line.
    pub(super) fn line(&mut self, line: &str) -> Result<(), Bad> {
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
    fn numbers(&mut self, attribute: usize, keyword: &str, rest: &str, count: usize) -> Result<(), Bad> {
        let mut values = [0.0_f32; 3];
        let mut found = 0;
        for (value, token) in values.iter_mut().zip(rest.split_whitespace()).take(count) {
            *value = number(token).ok_or_else(|| {
                (format!("`{keyword}` has \"{token}\", which is not a number"), "write numbers")
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
        for token in rest.split_whitespace().take_while(|token| !token.starts_with('#')) {
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
        let bad = || (format!("`f` has the corner \"{token}\""), "write corners as 1, 1/2, 1//3 or 1/2/3");
        let mut corner = [None; 3];
        for (attribute, part) in token.split('/').enumerate() {
            let count = *self.counts.get(attribute).ok_or_else(bad)?;
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
