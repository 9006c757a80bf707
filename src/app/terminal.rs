//! What the user reads: results on stdout, warnings and errors on stderr.
//!
//! Neither panics where `println!` would: a full disk behind stdout is an error like any other, a reader that has gone
//! away (`amas info | head -1`) is none, and where stderr is closed there is nobody left to tell.

use crate::error::{Error, Result};
use std::fmt::Display;
use std::io::{ErrorKind, Write, stderr, stdout};

/// Prints `text` and a line feed to stdout.
pub(super) fn print(text: impl Display) -> Result<()> {
    let mut out = stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Error::Write { file: "stdout".into(), source: error })
        }
        _ => Ok(()),
    }
}

/// Prints `amas: ` and `text` to stderr.
pub(super) fn complain(text: impl Display) {
    // If this fails, the message has no other way out.
    let _ = writeln!(stderr(), "amas: {text}");
}
