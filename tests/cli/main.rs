//! The program as its users run it: arguments and files in, exit status, messages and files out.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod bad_assets;
mod bad_compare;
mod bad_outputs;
mod bad_scenes;
mod bad_usage;
mod bench;
mod compare;
mod curves;
mod devices;
mod fit;
mod help;
mod indirect;
mod pictures;
mod report;
mod warnings;

use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

/// A floor under one light with a range, at 64 × 48.
const SCENE: &str = r#"
[render]
size = [64, 48]

[[camera]]
name = "main"
position = [0, 2, 5]
target = [0, 0, 0]
vertical_fov = 45.0
path = [
  { t = 0.0, position = [0, 2, 5], target = [0, 0, 0] },
  { t = 1.0, position = [3, 2, 5], target = [0, 0, 0] },
]

[[material]]
name = "floor"
type = "matte"
color = [0.5, 0.5, 0.5]

[[mesh]]
shape = "plane"
size = 4.0
material = "floor"

[[light]]
type = "point"
position = [0, 1, 0]
intensity = [3, 2, 1]
range = 1.5
"#;

/// A temporary folder in which the program runs.
struct Folder(TempDir);

impl Folder {
    /// Holds `scene.toml`, which is [`SCENE`].
    fn new() -> Self {
        let folder = Self(TempDir::new().unwrap());
        folder.write("scene.toml", SCENE);
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).unwrap();
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn json(&self, name: &str) -> serde_json::Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }

    /// Names of everything in the folder, hidden files too.
    fn names(&self) -> Vec<String> {
        let entries = self.0.path().read_dir().unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_amas"));
        command.args(arguments).current_dir(self.0.path()).stdin(Stdio::null());
        command
    }

    fn run(&self, arguments: &[&str]) -> Run {
        Run::of(&mut self.command(arguments), arguments)
    }

    /// Runs to success and returns what was printed.
    fn done(&self, arguments: &[&str]) -> String {
        let run = self.run(arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
        run.stdout
    }

    /// Runs to exit status 2 with `parts` in the message, and without a trace in the folder.
    fn refused(&self, arguments: &[&str], parts: &[&str]) {
        self.fails(2, arguments, parts);
    }

    /// Runs to exit status `status`; see [`Folder::refused`].
    fn fails(&self, status: i32, arguments: &[&str], parts: &[&str]) {
        let before = self.names();
        self.run(arguments).fails(status, parts);
        assert_eq!(self.names(), before, "{arguments:?} leaves something");
    }
}

/// A run of the program that has ended.
#[derive(Debug)]
#[allow(dead_code, reason = "the arguments are for the message of a failure")]
struct Run {
    arguments: Vec<String>,
    status: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Run {
    fn of(command: &mut Command, arguments: &[&str]) -> Self {
        let Output { status, stdout, stderr } = command.output().unwrap();
        Self {
            arguments: arguments.iter().map(|&word| word.into()).collect(),
            status: status.code(),
            stdout: String::from_utf8(stdout).unwrap(),
            stderr: String::from_utf8(stderr).unwrap(),
        }
    }

    /// Asserts exit status, `parts` in the message, its form, and that it is not a panic.
    fn fails(&self, status: i32, parts: &[&str]) {
        assert_eq!(self.status, Some(status), "{self:#?}");
        for part in parts {
            assert!(self.stderr.contains(part), "no `{part}` in {self:#?}");
        }
        assert!(!self.stderr.contains("panicked"), "{self:#?}");
        // Ours, or that of the parser of the command line.
        let ours = self
            .stderr
            .lines()
            .any(|line| line.strip_prefix("  remedy: ").is_some_and(|remedy| remedy.len() > 5));
        let sentence = |line: &&str| ["amas: ", "error: "].iter().any(|who| line.starts_with(who));
        let begins = |line: &&str| sentence(line) && line.len() > 20;
        assert!(self.stderr.lines().any(|line| begins(&line)), "{self:#?}");
        assert!(ours || self.stderr.contains("--help"), "{self:#?}");
    }
}

/// A PNG of 8-bit RGBA.
fn png(width: u32, height: u32, texel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let picture = image::RgbaImage::from_fn(width, height, |x, y| image::Rgba(texel(x, y)));
    let mut bytes = Vec::new();
    picture.write_to(&mut Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
    bytes
}

/// A PNG that only announces its size: signature, a correct header, and no pixels.
fn empty_png(width: u32, height: u32) -> Vec<u8> {
    let mut header = b"IHDR".to_vec();
    header.extend(width.to_be_bytes());
    header.extend(height.to_be_bytes());
    header.extend([8, 2, 0, 0, 0]);
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0d".to_vec();
    bytes.extend(&header);
    bytes.extend(crc32(&header).to_be_bytes());
    bytes
}

/// CRC-32 as PNG uses it.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 })
    })
}

/// The picture in `path`, which is not empty and finite throughout.
fn picture(path: &Path) -> amas::HdrImage {
    let picture = amas::HdrImage::load(path).unwrap();
    assert_eq!(picture.non_finite_count(), 0, "{path:?}");
    assert!(!picture.pixels.is_empty(), "{path:?}");
    picture
}
