//! The keys, as the window lists them and as `amas view --help` does.

use egui::Context;

/// Keys and what they do, in the words of the help.
const KEYS: [(&str, &str); 18] = [
    ("W A S D", "forward, left, backward, right"),
    ("Q E", "down, up"),
    ("drag", "look around"),
    ("right drag", "turn around the point where the drag began; also Ctrl + drag"),
    ("wheel", "fly faster or slower"),
    ("pinch", "nearer to and farther from what is looked at"),
    ("1 … 9", "the scene's cameras, in the file's order"),
    ("P", "walk along the camera's path, or stop"),
    ("R", "reset the camera"),
    ("C", "print the camera as TOML, and copy it"),
    ("V", "wait for the display's refresh, or not"),
    ("O", "panels: times, counts, settings"),
    ("I", "inspect what is under the pointer"),
    ("F2 … F11", "debug views; again: the picture"),
    ("X", "beside the reference, the error against it, the picture alone"),
    ("?", "these keys; also F1"),
    ("Esc", "stop loading; else close"),
    ("", "letters by their place on the keyboard"),
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
