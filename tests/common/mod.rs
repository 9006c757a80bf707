//! What several tests share.
#![allow(dead_code, reason = "every test binary uses its own part")]

pub(crate) mod albedo;
pub(crate) mod gpu;
pub(crate) mod png;
pub(crate) mod square;
pub(crate) mod tables;
