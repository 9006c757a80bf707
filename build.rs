//! Compiles every shader in `glsl/` to SPIR-V and writes two files into `OUT_DIR`:
//! `shared.glsl`, the declarations of `src/shared.rs` as GLSL, and `shaders.rs`, one constant per shader,
//! so that a missing or renamed shader is a compile error. Also names the commit.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

#[path = "src/shared.rs"]
#[allow(dead_code, missing_docs, unreachable_pub, reason = "only GLSL is used here")]
mod shared;

#[path = "src/gpu/compile.rs"]
mod compile;

/// What shaders that ask about rays include.
const RAYS: &str = "bind/bvh.glsl";

fn main() {
    if let Err(message) = compile_all() {
        // Cargo shows a build script's stderr only on failure; the message already names file and line.
        eprintln!("{message}");
        std::process::exit(1);
    }
}

/// Tells the benchmark which commit it measures; nothing outside a checkout.
fn name_commit() {
    // Every commit appends to this log, in a worktree to one of its own. A file that is not there would rerun this script at
    // every build.
    if let Some(log) = git(&["--git-path", "logs/HEAD"]).filter(|log| Path::new(log).exists()) {
        println!("cargo:rerun-if-changed={log}");
    }
    if let Some(hash) = git(&["--short=12", "HEAD"]) {
        println!("cargo:rustc-env=AMAS_COMMIT={hash}");
    }
}

/// What `git rev-parse` answers; `None` where it fails.
fn git(arguments: &[&str]) -> Option<String> {
    let output = std::process::Command::new("git").arg("rev-parse").args(arguments).output().ok()?;
    let answer = output.status.success().then_some(output.stdout)?;
    String::from_utf8(answer).ok().map(|text| text.trim().to_owned())
}

fn compile_all() -> Result<(), String> {
    name_commit();
    let out = PathBuf::from(std::env::var("OUT_DIR").map_err(|error| error.to_string())?);
    println!("cargo:rerun-if-changed=src/shared.rs");
    println!("cargo:rerun-if-changed=src/shared");
    // The whole folder: every include is in it, and so is every shader that is added.
    println!("cargo:rerun-if-changed=glsl");
    write(&out.join("shared.glsl"), shared::GLSL)?;

    let root = Path::new("glsl");
    let mut names = compile::files(root)?;
    names.retain(|name| stage(name).is_some());
    let compiler = shaderc::Compiler::new().map_err(|error| format!("shaderc: {error}"))?;
    let mut table = String::new();
    for name in &names {
        let constant = constant_name(name);
        let spirv = |queries| -> Result<PathBuf, String> {
            let words = compile::compile(&compiler, (root, name), shared::GLSL, queries)?;
            let file = out.join(format!("{constant}{}.spv", if queries { "_RAY_QUERIES" } else { "" }));
            let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
            fs::write(&file, bytes).map_err(|error| format!("{}: {error}", file.display()))?;
            Ok(file)
        };
        let walks = spirv(false)?;
        let queries = if compile::parts(root, name).contains(RAYS) {
            format!("Some(Words(include_bytes!({:?})))", spirv(true)?)
        } else {
            "None".into()
        };
        let stage = stage(name).unwrap_or_default();
        writeln!(
            table,
            "/// `glsl/{name}`.\npub const {constant}: Shader = Shader {{ name: {name:?}, stage: Stage::{stage}, \
             spirv: Words(include_bytes!({walks:?})), ray_queries: {queries} }};"
        )
        .map_err(|error| error.to_string())?;
    }
    let constants: Vec<String> = names.iter().map(|name| constant_name(name)).collect();
    writeln!(table, "/// Every shader.\npub const ALL: &[Shader] = &[{}];", constants.join(", "))
        .map_err(|error| error.to_string())?;
    write(&out.join("shaders.rs"), &table)
}

/// The stage of a shader as [`shared`]'s readers call it; `None` for what shaders include.
fn stage(name: &str) -> Option<&'static str> {
    let stages = ["Vertex", "Fragment", "Compute"];
    let is = |extension: &str| Path::new(name).extension().is_some_and(|found| found == extension);
    compile::STAGES.iter().zip(stages).find(|((extension, _), _)| is(extension)).map(|(_, stage)| stage)
}

/// `cluster/slices.comp` → `CLUSTER_SLICES_COMP`.
fn constant_name(name: &str) -> String {
    name.replace(['/', '.', '-'], "_").to_uppercase()
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}
