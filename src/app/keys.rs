//! The window's keys and gestures, as `amas view --help` and the window list them.

/// Keys, and what they do.
pub(super) const KEYS: [(&str, &str); 24] = [
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
    ("O", "panels: times, counts, view, settings, what is picked"),
    ("I", "inspect what is under the pointer"),
    ("F2 F3 F4", "debug views: albedo, normal, roughness; again: the picture"),
    ("F6 F7 F8", "depth, depth slice, cluster"),
    ("F9 F10 F11", "lights evaluated, lights evaluated per useful one, estimated error"),
    ("B", "bound of the error of area lights' closed form"),
    ("G", "wireframe: the edges of triangles"),
    ("X", "beside the reference, the error against it, the picture alone"),
    ("V", "wait for the display's refresh, or not"),
    ("F5", "load the scene again, as also happens when one of its files changes"),
    ("L", "scenes shown before; a number loads one"),
    ("F12", "save the picture to amas_0001.png and .exr, or the next free number"),
    ("? F1", "these keys"),
    ("Esc", "stop loading; else close"),
];

/// What stands below the options of `amas view --help`.
pub(super) fn help() -> String {
    let rows: String = KEYS.iter().map(|(key, what)| format!("  {key:<11} {what}\n")).collect();
    format!(
        "Keys, letters by their place on the keyboard:\n{rows}\
         A scene or an OBJ file that is dropped on the window is shown there.\n\n\
         Example:\n  amas view scene.toml --size 1280x720 --camera main"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Where the window handles keys.
    const HANDLERS: [&str; 5] = [
        include_str!("view/input.rs"),
        include_str!("view/fly.rs"),
        include_str!("view/pilot.rs"),
        include_str!("view/overlay/mod.rs"),
        include_str!("view/overlay/views.rs"),
    ];

    fn listed() -> BTreeSet<&'static str> {
        KEYS.iter()
            .flat_map(|(keys, _)| keys.split(' '))
            .filter(|key| !key.chars().any(char::is_lowercase) || *key == "Esc")
            .collect()
    }

    /// As the list has it, from winit's name.
    fn name(code: &str) -> &str {
        match code {
            "Slash" => "?",
            "Escape" => "Esc",
            code => code.strip_prefix("Key").or(code.strip_prefix("Digit")).unwrap_or(code),
        }
    }

    #[test]
    fn every_key_that_does_something_is_listed_and_no_other() {
        let code = |rest: &'static str| rest.split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or("");
        let sources = HANDLERS.iter().map(|source| source.split("#[cfg(test)]").next().unwrap_or(""));
        let mut handled: BTreeSet<_> = sources
            .flat_map(|source| source.split("KeyCode::").skip(1))
            .map(|rest| name(code(rest)))
            .collect();
        for number in ["2", "3", "4", "5", "6", "7", "8"] {
            assert!(handled.remove(number), "{number}");
        }
        // Between the first and the last of them.
        handled.insert("…");
        assert_eq!(handled, listed());
    }

    #[test]
    fn no_key_is_listed_twice() {
        assert_eq!(listed().len(), KEYS.iter().flat_map(|(keys, _)| keys.split(' ')).count() - 5);
    }

    /// Its paragraph on the window names keys in backticks, and every key but those that all such windows have.
    #[test]
    fn the_readme_names_the_keys() {
        let readme = include_str!("../../README.md");
        let paragraph = readme.split("\n\n").find(|text| text.starts_with("In the window, ")).unwrap();
        let quoted = paragraph.split('`').skip(1).step_by(2);
        let named: BTreeSet<_> =
            quoted.filter(|quoted| quoted.len() <= 3 && !quoted.starts_with("--")).collect();
        let listed = listed();
        let unknown: Vec<_> = named.difference(&listed).collect();
        assert!(unknown.is_empty(), "{unknown:?}");
    }
}
