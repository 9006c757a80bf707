//! Shaders that change while the window is open: their sources are watched, and compiled beside the window's thread.
//!
//! What Rust and GLSL share, `src/shared.rs`, is part of the program: a change there asks for a new build.

use super::Event;
use crate::error::Error;
use crate::gpu::{Replaced, compile, shaders};
use crate::shared;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use winit::event_loop::EventLoopProxy;

/// Time between two looks at the sources.
const LOOK: Duration = Duration::from_millis(250);

/// The folder of the checkout that the program was built from.
const CHECKOUT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/glsl");

/// Sizes and times of files, by their names.
type Stamps = BTreeMap<String, (u64, SystemTime)>;

/// Watches a folder of sources, or that of the checkout, until the window closes; `false` where it is not there.
pub(super) fn watch(folder: Option<&Path>, proxy: EventLoopProxy<Event>) -> bool {
    let root: PathBuf = folder.unwrap_or(Path::new(CHECKOUT)).into();
    if !root.is_dir() {
        return false;
    }
    let mut seen = stamps(&root);
    std::thread::spawn(move || {
        // Those that have changed since everything last compiled.
        let mut changed = BTreeSet::new();
        loop {
            std::thread::sleep(LOOK);
            let now = stamps(&root);
            if now == seen {
                continue;
            }
            let names = now.keys().chain(seen.keys());
            changed.extend(names.filter(|&name| now.get(name) != seen.get(name)).cloned());
            seen = now;
            let outcome = compile_changed(&root, &changed);
            if outcome.is_ok() {
                changed.clear();
            }
            if proxy.send_event(Event::Shaders(outcome)).is_err() {
                return;
            }
        }
    });
    true
}

/// A folder that the user names has sources of shaders.
pub(super) fn check(folder: &Path) -> crate::error::Result<()> {
    let cause = match () {
        () if !folder.is_dir() => "there is no such folder",
        () if !shaders::ALL.iter().any(|shader| folder.join(shader.name).is_file()) => {
            "it has none of amas's shaders"
        }
        () => return Ok(()),
    };
    let remedy = "name the folder `glsl` of a checkout of amas, or leave out --glsl";
    Err(Error::usage(format!("--glsl {}: {cause}", folder.display()), remedy))
}

fn stamps(root: &Path) -> Stamps {
    let stamp = |name: String| {
        let data = root.join(&name).metadata().ok()?;
        Some((name, (data.len(), data.modified().ok()?)))
    };
    compile::files(root).unwrap_or_default().into_iter().filter_map(stamp).collect()
}

/// Compiles the program's shaders that changed files are part of.
fn compile_changed(root: &Path, changed: &BTreeSet<String>) -> Result<Replaced, String> {
    let compiler = shaderc::Compiler::new().map_err(|error| format!("shaderc: {error}"))?;
    let touched =
        shaders::ALL.iter().filter(|shader| !compile::parts(root, shader.name).is_disjoint(changed));
    touched
        .flat_map(|shader| shader.kinds().map(move |ray_queries| (shader.name, ray_queries)))
        .map(|(name, ray_queries)| {
            let words = compile::compile(&compiler, (root, name), shared::GLSL, ray_queries)?;
            Ok(((name, ray_queries), words))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_reach_whatever_includes_them() {
        let root = Path::new(CHECKOUT);
        let of = |name| compile::parts(root, name);
        assert!(of("present/present.frag").contains("lib/tonemap.glsl"));
        assert!(of("direct/area.frag").contains("lib/bsdf/fresnel.glsl"));
        assert!(!of("overlay/overlay.vert").contains("lib/tonemap.glsl"));
        let changed = BTreeSet::from(["lib/tonemap.glsl".to_owned()]);
        let compiled = compile_changed(root, &changed).unwrap();
        // What is compiled anew is what the program was built with.
        for shader in shaders::ALL {
            for ray_queries in shader.kinds() {
                let words = compiled.get(&(shader.name, ray_queries));
                assert!(words.is_none_or(|words| *words == shader.words(ray_queries)), "{}", shader.name);
            }
        }
        assert!(compiled.contains_key(&("present/present.frag", false)));
        assert!(!compiled.contains_key(&("present/present.frag", true)));
    }
}
