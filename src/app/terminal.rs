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

/// A share as a percentage: two decimals, or as many as show two digits.
pub(super) fn percent(share: f64) -> String {
    let percentage = 100.0 * share;
    if percentage == 0.0 || percentage.abs() >= 0.1 {
        format!("{percentage:.2} %")
    } else if percentage.abs() >= 1e-6 {
        let decimals = (1.0 - percentage.abs().log10().floor()) as usize;
        format!("{percentage:.decimals$} %")
    } else {
        format!("{percentage:.1e} %")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_shares_keep_two_digits() {
        for (share, text) in [
            (0.0, "0.00 %"),
            (0.02, "2.00 %"),
            (1.0, "100.00 %"),
            (0.001, "0.10 %"),
            (0.000_23, "0.023 %"),
            (1e-5, "0.0010 %"),
            (1e-12, "1.0e-10 %"),
        ] {
            assert_eq!(percent(share), text);
        }
    }
}
