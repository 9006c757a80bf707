//! Help, and the subcommands that it lists.

use crate::Folder;

/// Names of the subcommands, as `amas --help` lists them.
fn subcommands(folder: &Folder) -> Vec<String> {
    let help = folder.done(&["--help"]);
    let list = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names = list
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(str::to_owned).collect()
}

#[test]
fn every_subcommand_shows_an_example() {
    let folder = Folder::new();
    let names = subcommands(&folder);
    for needed in ["render", "reference", "compare", "fit", "bench", "report", "info"] {
        assert!(names.iter().any(|name| name == needed), "no {needed} in {names:?}");
    }
    for name in names {
        let help = folder.done(&[&name, "--help"]);
        let (_, examples) =
            help.split_once("Example").unwrap_or_else(|| panic!("{name}: no example: {help}"));
        assert!(
            examples.lines().any(|line| line.trim().starts_with(&format!("amas {name}"))),
            "{name}: {examples}"
        );
        assert_eq!(folder.done(&["help", &name]), help);
    }
}

#[test]
fn the_program_itself() {
    let folder = Folder::new();
    assert!(folder.done(&["--help"]).contains("Example"));
    let version = format!("amas {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(folder.done(&["--version"]), version);
}

/// The README shows the examples of the help, and no others that would fail.
#[test]
fn the_readme_names_what_exists() {
    let folder = Folder::new();
    let readme = include_str!("../../README.md");
    let names = subcommands(&folder);
    for rest in readme.split("`amas ").skip(1) {
        let name: String = rest.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
        assert!(name.starts_with('-') || names.contains(&name), "amas {name}");
    }
}
