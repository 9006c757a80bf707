//! The user's folders (XDG Base Directory Specification).

use std::path::PathBuf;

/// For what can be made again, if there is one.
pub(super) fn cache() -> Option<PathBuf> {
    below("XDG_CACHE_HOME", ".cache")
}

/// For what is remembered from one start to the next, if there is one.
pub(super) fn state() -> Option<PathBuf> {
    below("XDG_STATE_HOME", ".local/state")
}

fn below(variable: &str, in_home: &str) -> Option<PathBuf> {
    let named = |name| std::env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let folder = named(variable).or_else(|| named("HOME").map(|home| home.join(in_home)))?;
    Some(folder.join("amas"))
}
