//! `amas compare`: error figures between two pictures.

use super::args::CompareOptions;
use crate::error::Result;

pub(super) fn run(_: &CompareOptions) -> Result<()> {
    Ok(())
}
