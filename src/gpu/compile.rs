//! GLSL to SPIR-V: what `build.rs` does to every shader, and the window to those that change while it runs.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Extension and kind of each stage.
pub(crate) const STAGES: [(&str, shaderc::ShaderKind); 3] = [
    ("vert", shaderc::ShaderKind::Vertex),
    ("frag", shaderc::ShaderKind::Fragment),
    ("comp", shaderc::ShaderKind::Compute),
];

/// Compiles the shader `name`, a path below the folder `root`, with the declarations that Rust shares with it, and with ray
/// queries where they are wanted.
pub(crate) fn compile(
    compiler: &shaderc::Compiler,
    (root, name): (&Path, &str),
    shared: &str,
    ray_queries: bool,
) -> Result<Vec<u32>, String> {
    let is = |extension: &str| Path::new(name).extension().is_some_and(|found| found == extension);
    let stage = STAGES.into_iter().find(|(extension, _)| is(extension));
    let (_, kind) = stage.ok_or_else(|| format!("glsl/{name}: no stage"))?;
    let mut options = shaderc::CompileOptions::new().map_err(|error| error.to_string())?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_2 as u32);
    options.set_optimization_level(shaderc::OptimizationLevel::Performance);
    options.set_warnings_as_errors();
    // Names and lines survive optimisation: captures stay readable, and tests compare layouts by name.
    options.set_generate_debug_info();
    options.set_include_callback(|name, _, _, _| {
        if name == "shared.glsl" {
            let resolved_name = "src/shared.rs".into();
            return Ok(shaderc::ResolvedInclude { resolved_name, content: shared.into() });
        }
        Ok(shaderc::ResolvedInclude { resolved_name: format!("glsl/{name}"), content: text(root, name)? })
    });
    let source = text(root, name)?;
    let source = if ray_queries { with_ray_queries(&source) } else { source };
    let artifact = compiler
        .compile_into_spirv(&source, kind, &format!("glsl/{name}"), "main", Some(&options))
        .map_err(|error| error.to_string())?;
    Ok(artifact.as_binary().to_vec())
}

/// Text of a shader that has its rays traced by the device; lines keep their numbers.
fn with_ray_queries(text: &str) -> String {
    const VERSION: &str = "#version 450\n";
    let before = text.split(VERSION).next().unwrap_or_default().lines().count();
    let asked = "#version 460\n#extension GL_EXT_ray_query : require\n#define RAY_QUERIES";
    let asked = format!("{asked}\n#line {}\n", before + 2);
    text.replacen(VERSION, &asked, 1)
}

/// The text of a file below `root`.
pub(crate) fn text(root: &Path, name: &str) -> Result<String, String> {
    fs::read_to_string(root.join(name)).map_err(|error| format!("glsl/{name}: {error}"))
}

/// A shader's file and all that it includes.
pub(crate) fn parts(root: &Path, name: &str) -> BTreeSet<String> {
    let mut parts = BTreeSet::new();
    let mut left = vec![name.to_owned()];
    while let Some(name) = left.pop() {
        let text = text(root, &name).unwrap_or_default();
        let included =
            text.lines().filter_map(|line| line.trim().strip_prefix("#include \"")?.split('"').next());
        left.extend(included.filter(|name| !parts.contains(*name)).map(str::to_owned));
        parts.insert(name);
    }
    parts
}

/// Every file below `root`, sorted, by its name there.
pub(crate) fn files(root: &Path) -> Result<Vec<String>, String> {
    let mut folders: Vec<PathBuf> = vec![root.to_path_buf()];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))? {
            let path = entry.map_err(|error| error.to_string())?.path();
            if path.is_dir() {
                folders.push(path);
            } else if let Ok(name) = path.strip_prefix(root) {
                files.push(name.to_string_lossy().replace('\\', "/"));
            }
        }
    }
    files.sort();
    Ok(files)
}
