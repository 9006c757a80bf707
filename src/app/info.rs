//! `amas info`: devices, and what each lacks.

use super::args::InfoOptions;
use super::terminal::print;
use crate::error::{Error, Result};
use crate::gpu::{Check, Device, DeviceInfo};
use serde::Serialize;

#[derive(Serialize)]
struct Entry<'a> {
    #[serde(flatten)]
    info: &'a DeviceInfo,
    usable: bool,
    needs: &'a [Check],
}

pub(super) fn run(options: &InfoOptions) -> Result<()> {
    let devices = Device::enumerate()?;
    if options.json {
        let entries: Vec<_> = devices
            .iter()
            .map(|info| Entry { info, usable: info.report.missing().is_none(), needs: &info.report.0 })
            .collect();
        let json = serde_json::json!({ "schema": 1, "devices": entries });
        print(format_args!("{json:#}"))?;
    } else {
        devices.iter().enumerate().try_for_each(|(index, info)| print(Listed(index, info)))?;
    }
    match devices.iter().any(|info| info.report.missing().is_none()) {
        true => Ok(()),
        false => Err(Error::NoDevice {
            cause: format!("{} device(s) found, none sufficient", devices.len()),
            remedy: "update the driver, or install mesa-vulkan-drivers".into(),
        }),
    }
}

/// A device with its index, and what it has of what amas needs.
struct Listed<'a>(usize, &'a DeviceInfo);

impl std::fmt::Display for Listed<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(index, info) = self;
        write!(f, "{index}: {} ({}), {}, Vulkan {}", info.name, info.kind, info.driver, info.api)?;
        if info.ray_queries {
            write!(f, ", ray queries")?;
        }
        for check in &info.report.0 {
            let mark = if check.ok { "yes" } else { "NO " };
            write!(f, "\n   {mark}  {:<44} has {:<12} for {}", check.name, check.found, check.why)?;
        }
        Ok(())
    }
}
