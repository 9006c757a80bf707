//! What is noticed and goes on nevertheless: a warning with a remedy, and status 0.

use crate::{Folder, SCENE};

/// What the program says on stderr of a job that it does; each warning with a remedy.
fn said(folder: &Folder, arguments: &[&str]) -> String {
    let run = folder.run(arguments);
    assert_eq!(run.status, Some(0), "{run:?}");
    let [warnings, remedies] =
        ["amas: warning: ", "\n  remedy: "].map(|part| run.stderr.matches(part).count());
    assert_eq!(warnings, remedies, "{run:?}");
    run.stderr
}

#[test]
fn options_that_mean_nothing_here() {
    let folder = Folder::new();
    let render = |words: &[&str]| said(&folder, &[&["render", "scene.toml", "-o", "a.pfm"], words].concat());
    assert_eq!(render(&[]), "");
    for words in [["--time-limit", "5"], ["--indirect-error", "0.1"]] {
        assert!(render(&words).contains("no light is gathered here"), "{words:?}");
    }
    let shadows = ["--set", "shadows=true", "--time-limit", "1", "--indirect-error", "0.5"];
    assert!(!render(&shadows).contains("gathered here"));
    let reference = ["reference", "scene.toml", "--size", "4x3", "-o", "a.pfm"];
    let reference = |words: &[&str]| said(&folder, &[&reference, words].concat());
    assert_eq!(reference(&[]), "");
    let both = reference(&["--paths", "9", "--bounces", "1"]);
    assert!(both.contains("--paths is for the path integrator") && both.contains("--bounces is"), "{both}");
    assert_eq!(reference(&["--paths", "2", "--bounces", "1", "--integrator", "path"]), "");
    let missing = reference(&["--set", "shadows=true"]);
    assert!(missing.contains("--integrator shadowed"), "{missing}");
}

#[test]
fn scenes_without_light() {
    let folder = Folder::new();
    let (dark, _) = SCENE.split_once("[[light]]").unwrap();
    folder.write("dark.toml", dark);
    let render = |words: &[&str]| said(&folder, &[&["render", "dark.toml", "-o", "a.pfm"], words].concat());
    assert!(render(&[]).contains("dark.toml: the scene has no light"));
    assert_eq!(render(&["--set", "background=[0, 0.1, 0]"]), "");
}

/// File and line of what is odd in a scene.
#[test]
fn places() {
    let folder = Folder::new();
    let line =
        "[[light]]\ntype = \"line\"\na = [0, 3, 0]\nb = [0.2, 3, 0]\nradius = 0.6\nradiance = [1, 1, 1]\n";
    let mesh = "[[mesh]]\nshape = \"box\"\nsize = 0.1\n";
    folder.write("odd.toml", format!("{SCENE}{line}{mesh}").replace("[0.5, 0.5, 0.5]", "[0.5, 1.5, 0.5]"));
    let text = said(&folder, &["render", "odd.toml", "-o", "a.pfm"]);
    let first = SCENE.lines().count();
    for part in [
        "warning: odd.toml:15: the material \"floor\" reflects more".into(),
        format!("warning: odd.toml:{}: the line is thicker", first + 5),
        format!("warning: odd.toml:{}: faces without a material", first + 7),
    ] {
        assert!(text.contains(&part), "no `{part}` in {text}");
    }
    assert_eq!(text.matches("warning: ").count(), 3, "{text}");
}
