//! Devices: those that are there, and status 3 where none is usable.

use crate::{Folder, Run};

#[test]
fn a_name_that_no_device_has() {
    let folder = Folder::new();
    for wanted in ["nonsense", "4096"] {
        for command in
            [&["render", "scene.toml", "-o", "a.png"][..], &["bench", "scene.toml", "--json", "b.json"]]
        {
            let arguments = [command, &["--device", wanted]].concat();
            folder.fails(3, &arguments, &["no usable Vulkan device", wanted, "--device"]);
        }
    }
    let arguments = ["render", "scene.toml"];
    let run = Run::of(folder.command(&arguments).env("AMAS_DEVICE", "nonsense"), &arguments);
    run.fails(3, &["nonsense"]);
    assert_eq!(folder.names(), ["scene.toml"]);
}

#[test]
fn no_driver() {
    let folder = Folder::new();
    for arguments in [
        &["render", "scene.toml", "-o", "a.png"][..],
        &["render", "scene.toml", "-o", "a.png", "--validate"],
        &["bench", "scene.toml"],
        &["report", "--quick"],
        &["info"],
        &["info", "--json"],
        &[],
    ] {
        let mut command = folder.command(arguments);
        for variable in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
            command.env(variable, folder.path("none.json"));
        }
        command.env_remove("VK_ADD_DRIVER_FILES");
        let run = Run::of(&mut command, arguments);
        run.fails(3, &["no usable Vulkan device", "mesa-vulkan-drivers"]);
        assert_eq!(folder.names(), ["scene.toml"], "{arguments:?}");
    }
}

/// The oracle and the comparison need no device.
#[test]
fn work_without_a_device() {
    let folder = Folder::new();
    for arguments in [&["reference", "scene.toml", "-o", "a.exr"][..], &["compare", "a.exr", "a.exr"]] {
        let mut command = folder.command(arguments);
        for variable in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
            command.env(variable, folder.path("none.json"));
        }
        let run = Run::of(&mut command, arguments);
        assert_eq!(run.status, Some(0), "{run:?}");
    }
}

#[test]
fn info() {
    let folder = Folder::new();
    let json: serde_json::Value = serde_json::from_str(&folder.done(&["info", "--json"])).unwrap();
    assert_eq!(json["schema"], 1);
    let devices = json["devices"].as_array().unwrap();
    assert!(devices.iter().any(|device| device["usable"] == true));
    for device in devices {
        for key in ["name", "driver", "api", "type"] {
            let text = device[key].as_str().unwrap_or_default();
            assert!(!text.is_empty(), "{key} in {device:#}");
        }
        let needs = device["needs"].as_array().unwrap();
        assert!(needs.len() > 10, "{device:#}");
        let met = needs.iter().all(|need| need["ok"] == true);
        assert_eq!(device["usable"], met, "{device:#}");
        for need in needs {
            for key in ["name", "found", "why"] {
                assert!(need[key].is_string(), "{key} in {need}");
            }
        }
    }
    let text = folder.done(&["info"]);
    for device in devices {
        assert!(text.contains(device["name"].as_str().unwrap()), "{text}");
    }
    let first = devices[0]["name"].as_str().unwrap();
    if devices[0]["usable"] == true {
        for wanted in ["0", first, &first.to_uppercase()] {
            folder.done(&["render", "scene.toml", "--device", wanted]);
        }
    }
}
