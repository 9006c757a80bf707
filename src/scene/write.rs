//! Parts of a scene as the text of a scene file; what is written is read again to the last bit.

use glam::DVec3;

use super::{Camera, Projection};

/// A `[[camera]]` without its path.
#[must_use]
pub fn camera(camera: &Camera) -> String {
    let Camera { name, position, target, up, projection, near, far, .. } = camera;
    let mut text = format!(
        "[[camera]]\nname = {}\nposition = {}\ntarget = {}\nup = {}\n",
        string(name),
        vector(*position),
        vector(*target),
        vector(*up)
    );
    text += &match projection {
        Projection::Perspective { vertical_fov } => format!("vertical_fov = {vertical_fov:?}\n"),
        Projection::Orthographic { height } => format!("orthographic_height = {height:?}\n"),
    };
    text += &format!("near = {near:?}\n");
    if let Some(far) = far {
        text += &format!("far = {far:?}\n");
    }
    text
}

/// A string between its quotes.
pub(super) fn string(text: &str) -> String {
    let escaped = text.chars().map(|c| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
        c => c.into(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}

fn vector(v: DVec3) -> String {
    format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
}
