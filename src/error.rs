//! The one error type: every variant names what the user can do about it.

use std::path::{Path, PathBuf};

/// Everything that can go wrong, as sentences with a cause and a remedy.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file that the user gave is wrong.
    #[error("{}{}: {cause}\n  remedy: {remedy}", .file.display(), Line(*.line))]
    Input {
        /// The file at fault.
        file: PathBuf,
        /// 1-based line, where the format has lines.
        line: Option<usize>,
        /// What is wrong.
        cause: String,
        /// What to change.
        remedy: String,
    },
    /// The command line or a setting is wrong.
    #[error("{cause}\n  remedy: {remedy}")]
    Usage {
        /// What is wrong.
        cause: String,
        /// What to change.
        remedy: String,
    },
    /// No Vulkan device can run amas.
    #[error("no usable Vulkan device: {cause}\n  remedy: {remedy}")]
    NoDevice {
        /// What was found, and what it lacks.
        cause: String,
        /// What to install or choose.
        remedy: String,
    },
    /// There is nothing to open a window on.
    #[error("{cause}\n  remedy: {remedy}")]
    NoDisplay {
        /// What is missing.
        cause: String,
        /// What to start or install.
        remedy: String,
    },
    /// A Vulkan call failed.
    #[error("{call} failed: {result}\n  remedy: {remedy}")]
    Vulkan {
        /// The call, or the object that it was to make.
        call: String,
        /// The driver's answer.
        result: String,
        /// What may help.
        remedy: String,
    },
    /// An output could not be written.
    #[error("{}: cannot write: {source}\n  remedy: check the folder's rights and the space on its disk", .file.display())]
    Write {
        /// The file that was to be written; nothing is left of it.
        file: PathBuf,
        /// The operating system's answer.
        source: std::io::Error,
    },
    /// The user ended a long job early.
    #[error("interrupted: {0}\n  remedy: run it again to the end")]
    Interrupted(
        /// How far it came.
        String,
    ),
    /// The validation layers spoke.
    #[error(
        "the validation layers reported {count} message(s); the first: {first}\n  remedy: this is a bug in amas or in the driver; please report it with this text"
    )]
    Validation {
        /// How many messages.
        count: usize,
        /// The first of them.
        first: String,
    },
}

/// `:LINE`, or nothing.
struct Line(Option<usize>);

impl std::fmt::Display for Line {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.map_or(Ok(()), |line| write!(f, ":{line}"))
    }
}

/// `Result` with this crate's [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

impl Error {
    /// An [`Error::Input`] about `file`, at `line` if the format has lines.
    pub fn input(
        file: impl AsRef<Path>,
        line: impl Into<Option<usize>>,
        cause: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::Input {
            file: file.as_ref().to_path_buf(),
            line: line.into(),
            cause: cause.into(),
            remedy: remedy.into(),
        }
    }

    /// An [`Error::Usage`].
    pub fn usage(cause: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Usage { cause: cause.into(), remedy: remedy.into() }
    }

    /// The process's exit status: 2 bad usage or input, 3 no device or display, 1 any other failure.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Input { .. } | Self::Usage { .. } => 2,
            Self::NoDevice { .. } | Self::NoDisplay { .. } => 3,
            Self::Vulkan { .. } | Self::Write { .. } | Self::Interrupted(_) | Self::Validation { .. } => 1,
        }
    }
}
