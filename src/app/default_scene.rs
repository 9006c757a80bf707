//! The scene that is part of the program.

use crate::scene::Origin;

/// Where to load it from; see `scenes/default.toml`.
pub(super) const ORIGIN: Origin<'static> = Origin::Embedded("scenes/default.toml (embedded)", TOML, FILES);

pub(super) const TOML: &str = include_str!("../../scenes/default.toml");

macro_rules! files {
    ($($name:literal)*) => { &[$(($name, include_bytes!(concat!("../../scenes/", $name)))),*] };
}

pub(super) const FILES: &[(&str, &[u8])] = files! {
    "default.obj"
    "default_arcade.obj"
    "default_lights.csv"
    "default_lattice.png"
    "default_leaf.png"
    "default_leaf_mask.png"
    "default_ripples.png"
    "default_rug.png"
    "default_tiles.png"
    "default_tiles_normal.png"
    "default_wood.png"
    "default_zellige.png"
};
