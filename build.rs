//! Compiles every shader in `glsl/` to SPIR-V and writes two files into `OUT_DIR`:
//! `shared.glsl`, the declarations of `src/shared.rs` as GLSL, and `shaders.rs`, one constant per shader,
//! so that a missing or renamed shader is a compile error. Also names the commit.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

#[path = "src/shared.rs"]
#[allow(dead_code, missing_docs, unreachable_pub, reason = "only GLSL is used here")]
mod shared;

const STAGES: [(&str, shaderc::ShaderKind, &str); 3] = [
    ("vert", shaderc::ShaderKind::Vertex, "Vertex"),
    ("frag", shaderc::ShaderKind::Fragment, "Fragment"),
    ("comp", shaderc::ShaderKind::Compute, "Compute"),
];

fn main() {
    if let Err(message) = compile_all() {
        // Cargo shows a build script's stderr only on failure; the message already names file and line.
        eprintln!("{message}");
        std::process::exit(1);
    }
}

/// Tells the benchmark which commit it measures; nothing outside a checkout.
fn name_commit() {
    // Every commit appends to this log. A file that is not there would rerun this script at every build.
    let log = Path::new(".git/logs/HEAD");
    if log.exists() {
        println!("cargo:rerun-if-changed={}", log.display());
    }
    let output = std::process::Command::new("git").args(["rev-parse", "--short=12", "HEAD"]).output();
    let hash = output.ok().filter(|output| output.status.success());
    if let Some(hash) = hash.and_then(|output| String::from_utf8(output.stdout).ok()) {
        println!("cargo:rustc-env=AMAS_COMMIT={}", hash.trim());
    }
}

fn compile_all() -> Result<(), String> {
    name_commit();
    let out = PathBuf::from(std::env::var("OUT_DIR").map_err(|error| error.to_string())?);
    println!("cargo:rerun-if-changed=src/shared.rs");
    println!("cargo:rerun-if-changed=src/shared");
    // The whole folder: every include is in it, and so is every shader that is added.
    println!("cargo:rerun-if-changed=glsl");
    write(&out.join("shared.glsl"), shared::GLSL)?;

    let mut sources = Vec::new();
    collect(Path::new("glsl"), &mut sources)?;
    sources.sort();
    let compiler = shaderc::Compiler::new().map_err(|error| format!("shaderc: {error}"))?;
    let mut table = String::new();
    for source in &sources {
        let (_, kind, stage) = STAGES
            .into_iter()
            .find(|(extension, ..)| source.extension().is_some_and(|e| e == *extension))
            .ok_or_else(|| format!("{}: no stage", source.display()))?;
        let words = compile(&compiler, source, kind)?;
        let name = constant_name(source);
        let spirv = out.join(format!("{name}.spv"));
        fs::write(&spirv, words).map_err(|error| format!("{}: {error}", spirv.display()))?;
        let label = source.strip_prefix("glsl").unwrap_or(source).display().to_string();
        writeln!(
            table,
            "/// `glsl/{label}`.\npub const {name}: Shader = Shader {{ name: {label:?}, stage: Stage::{stage}, \
             spirv: Words(include_bytes!({spirv:?})) }};"
        )
        .map_err(|error| error.to_string())?;
    }
    let names: Vec<String> = sources.iter().map(|source| constant_name(source)).collect();
    writeln!(table, "/// Every shader.\npub const ALL: &[Shader] = &[{}];", names.join(", "))
        .map_err(|error| error.to_string())?;
    write(&out.join("shaders.rs"), &table)
}

/// `glsl/cluster/slices.comp` → `CLUSTER_SLICES_COMP`.
fn constant_name(source: &Path) -> String {
    let path = source.strip_prefix("glsl").unwrap_or(source);
    path.to_string_lossy().replace(['/', '.', '-'], "_").to_uppercase()
}

fn collect(folder: &Path, sources: &mut Vec<PathBuf>) -> Result<(), String> {
    for entry in fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))? {
        let path = entry.map_err(|error| error.to_string())?.path();
        if path.is_dir() {
            collect(&path, sources)?;
        } else if STAGES.iter().any(|(extension, ..)| path.extension().is_some_and(|e| e == *extension)) {
            sources.push(path);
        }
    }
    Ok(())
}

fn compile(
    compiler: &shaderc::Compiler,
    source: &Path,
    kind: shaderc::ShaderKind,
) -> Result<Vec<u8>, String> {
    let mut options = shaderc::CompileOptions::new().map_err(|error| error.to_string())?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_2 as u32);
    options.set_optimization_level(shaderc::OptimizationLevel::Performance);
    options.set_warnings_as_errors();
    // Names and lines survive optimisation: captures stay readable, and tests compare layouts by name.
    options.set_generate_debug_info();
    options.set_include_callback(|name, _, _, _| {
        let text = if name == "shared.glsl" {
            shared::GLSL.to_owned()
        } else {
            fs::read_to_string(Path::new("glsl").join(name))
                .map_err(|error| format!("glsl/{name}: {error}"))?
        };
        let resolved_name =
            if name == "shared.glsl" { "src/shared.rs".into() } else { format!("glsl/{name}") };
        Ok(shaderc::ResolvedInclude { resolved_name, content: text })
    });
    let text = fs::read_to_string(source).map_err(|error| format!("{}: {error}", source.display()))?;
    let artifact = compiler
        .compile_into_spirv(&text, kind, &source.to_string_lossy(), "main", Some(&options))
        .map_err(|error| error.to_string())?;
    Ok(artifact.as_binary_u8().to_vec())
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}
