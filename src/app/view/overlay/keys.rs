//! The keys, as the window lists them and as `amas view --help` does.

use egui::Context;

/// Keys and what they do, in the words of the help.
const KEYS: [(&str, &str); 24] = [
    ("W A S D", "forward, left, backward, right"),
    ("Q E", "down, up"),
    ("drag", "look around"),
    ("right drag", "turn around the point where the drag began; also Ctrl + drag"),
    ("wheel", "fly faster or slower; two fingers on a touchpad do, too"),
    ("pinch", "nearer to and farther from what is looked at"),
    ("1 … 9", "the scene's cameras, in the file's order"),
    ("P", "walk along the camera's path, or stop"),
    ("R", "reset the camera"),
    ("C", "print the camera as TOML, and copy it to the clipboard"),
    ("V", "wait for the display's refresh, or not"),
    ("O", "panels: times, counts, view, settings, what is picked"),
    ("I", "inspect what is under the pointer"),
    ("F2 F3 F4", "debug views: albedo, normal, roughness; again: the picture"),
    ("F6 F7 F8", "depth, depth slice, cluster"),
    ("F9 F10 F11", "lights evaluated, lights evaluated per useful one, estimated error"),
    ("B", "bound of the error of area lights' closed form"),
    ("G", "wireframe: the edges of triangles"),
    ("X", "beside the reference, the error against it, the picture alone"),
    ("F5", "load the scene again, as also happens when one of its files changes"),
    ("L", "scenes shown before; a number loads one"),
    ("F12", "save the picture to amas_0001.png and .exr, or the next free number"),
    ("?", "these keys; also F1"),
    ("Esc", "stop loading; else close"),
];

pub(super) fn show(context: &Context, open: &mut bool) {
    let window = egui::Window::new("Keys").open(open).collapsible(false).resizable(false);
    window.anchor(egui::Align2::RIGHT_TOP, [-8.0, 8.0]).show(context, |ui| {
        egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
            for (key, what) in KEYS {
                ui.strong(key);
                ui.label(what);
                ui.end_row();
            }
        });
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Window and help say the same.
    #[test]
    fn the_help_has_every_key() {
        let source = include_str!("../../args.rs");
        for (key, what) in KEYS {
            let line = format!("  {key:<11} {what}\n");
            assert!(source.contains(&line), "{line}");
        }
    }
}
