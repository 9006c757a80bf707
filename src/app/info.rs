//! `amas info`: devices, and what each lacks.

use super::args::InfoOptions;
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
            .map(|info| Entry {
                info,
                usable: info.report.missing().is_none(),
                needs: &info.report.0,
            })
            .collect();
        let json = serde_json::json!({ "schema": 1, "devices": entries });
        println!("{json:#}");
    } else {
        devices
            .iter()
            .enumerate()
            .for_each(|(index, info)| print(index, info));
    }
    match devices.iter().any(|info| info.report.missing().is_none()) {
        true => Ok(()),
        false => Err(Error::NoDevice {
            cause: format!("{} device(s) found, none sufficient", devices.len()),
            remedy: "update the driver, or install mesa-vulkan-drivers".into(),
        }),
    }
}

fn print(index: usize, info: &DeviceInfo) {
    println!(
        "{index}: {} ({}), {}, Vulkan {}",
        info.name, info.kind, info.driver, info.api
    );
    for check in &info.report.0 {
        let mark = if check.ok { "yes" } else { "NO " };
        println!(
            "   {mark}  {:<44} has {:<12} for {}",
            check.name, check.found, check.why
        );
    }
}
