//! `amas report`: speed against error. Times are not judged: the machine may be busy.

use crate::Folder;

const FILES: [&str; 8] =
    ["area.csv", "area.json", "area.md", "area.png", "area.svg", "scene.toml", "sizes.png", "sizes.svg"];

#[test]
fn area_lights() {
    let folder = Folder::new();
    let printed = folder.done(&["report", "--chapter", "area", "--quick", "--validate"]);
    assert_eq!(folder.names(), FILES);
    let json = folder.json("area.json");
    assert_eq!(json["schema"], 1);
    assert_eq!(json["quick"], true);
    for key in ["device", "version", "distribution", "floor"] {
        assert!(!json[key].is_null(), "{key}");
    }
    let points = json["points"].as_array().unwrap();
    let sizes = json["sizes"].as_array().unwrap();
    let csv = String::from_utf8(folder.read("area.csv")).unwrap();
    assert_eq!(csv.lines().count(), points.len() + sizes.len() + 1);
    // However small or large the light: what ships, and points that are all of a tiny light.
    for p in sizes {
        let [share, error] = ["share", "error"].map(|key| p[key].as_f64().unwrap());
        let most = match p["tier"].as_str().unwrap() {
            "amas, error 0" => 0.005,
            "amas, error .01" => 0.01,
            "cubature 2x2" | "cubature 4x4" if share < 1e-3 => 0.005,
            _ => f64::INFINITY,
        };
        assert!(error < most, "{p}");
    }
    let counts = [1e-4, 0.1].map(|share| sizes.iter().filter(|p| p["share"] == share).count());
    assert_eq!(counts, [34, 34]);
    for band in ["sharp", "rough"] {
        let of = |tier: &str, key: &str| {
            let point = points.iter().find(|p| p["band"] == band && p["model"] == "all" && p["tier"] == tier);
            point.and_then(|p| p[key].as_f64()).unwrap_or_else(|| panic!("{band}, {tier}: no {key}"))
        };
        // What ships, and what it is made of; then what is known to be worse.
        for (tier, most) in [
            ("quadrature 8", 0.003),
            ("quadrature 4", 0.005),
            ("amas, error 0", 0.005),
            ("amas, error .01", 0.01),
            ("LTC closed form", 0.06),
            ("cubature 4x4", 0.06),
            ("area samples 64", 0.12),
            ("LTC samples 64", 0.12),
        ] {
            let error = of(tier, "error");
            assert!(error > 0.0 && error < most, "{band}, {tier}: {error}");
        }
        assert!(of("representative point", "error") > 0.05);
        // Neither is biased, and the error of both falls as the root of the count.
        for family in ["area", "LTC"] {
            let [one, all] = [4, 64].map(|count| format!("{family} samples {count}"));
            assert!(of(&all, "bias").abs() < 0.03, "{band}, {all}: {}", of(&all, "bias"));
            let ratio = of(&one, "error") / of(&all, "error");
            assert!((2.5..6.0).contains(&ratio), "{band}, {family}: {ratio}");
        }
        assert!(printed.contains(band), "{printed}");
    }
    let png = image::load_from_memory(&folder.read("area.png")).unwrap();
    assert_eq!((png.width(), png.height()), (1560, 800));
    let sizes = String::from_utf8(folder.read("sizes.svg")).unwrap();
    assert!(sizes.contains("equal time"), "{sizes}");
    let svg = String::from_utf8(folder.read("area.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    for text in [svg, String::from_utf8(folder.read("area.md")).unwrap()] {
        assert!(text.contains("quadrature 4") && text.contains("LTC closed form"), "{text}");
    }
}

#[test]
fn many_lights() {
    let folder = Folder::new();
    let printed = folder.done(&["report", "--chapter", "lights", "--quick", "--validate"]);
    let files = ["lights.csv", "lights.json", "lights.md", "lights.png", "lights.svg", "scene.toml"];
    assert_eq!(folder.names(), files);
    let json = folder.json("lights.json");
    let points = json["points"].as_array().unwrap();
    let csv = String::from_utf8(folder.read("lights.csv")).unwrap();
    assert_eq!(csv.lines().count(), points.len() + 1);
    let of = |sweep: &str| -> Vec<[f64; 2]> {
        let own = points.iter().filter(|point| point["sweep"] == sweep && point["sampled"] == false);
        own.map(|point| ["setting", "error"].map(|key| point[key].as_f64().unwrap())).collect()
    };
    for [error, measured] in of("light_error") {
        // Rounding where every light is evaluated, and the promise elsewhere.
        assert!(measured <= error.max(1e-5), "light_error {error}: {measured}");
    }
    // One draw of 4,096 of 4,096 lights, of which 28 matter at a pixel: about its root's inverse.
    let sampled = points.iter().filter(|point| point["sampled"] == true);
    let sampled: Vec<f64> = sampled.map(|point| point["error"].as_f64().unwrap()).collect();
    assert!(!sampled.is_empty() && sampled.iter().all(|error| (0.01..0.5).contains(error)), "{sampled:?}");
    // Clusters of any shape leave the picture alone.
    for sweep in ["slices", "tiles"] {
        let own = of(sweep);
        assert!(own.len() == 2 && own.iter().all(|point| point[1] < 1e-5), "{sweep}: {own:?}");
    }
    let defaults = points.iter().filter(|point| point["default"] == true);
    let defaults: Vec<_> = defaults.map(|point| point["sweep"].as_str().unwrap()).collect();
    assert_eq!(defaults, ["light_error", "max_lights_per_cluster", "order"]);
    let caps = of("max_lights_per_cluster");
    assert!(caps.windows(2).all(|pair| pair[0][1] >= pair[1][1]), "{caps:?}");
    assert!(caps.last().unwrap()[1] < 1e-5, "{caps:?}");
    assert_eq!(of("lights").iter().map(|point| point[0]).collect::<Vec<_>>(), [1024.0, 4096.0]);
    // The same lists whatever the order, and more nodes to test for them without one.
    let order = |key: &str| -> Vec<f64> {
        let own = points.iter().filter(|point| point["sweep"] == "order");
        own.map(|point| point[key].as_f64().unwrap()).collect()
    };
    assert_eq!(order("setting"), [2.0, 1.0, 0.0]);
    assert!(order("error").into_iter().all(|error| error < 1e-5));
    assert!(order("pair_ratio").windows(2).all(|pair| pair[0] == pair[1]));
    let visited = order("nodes_visited");
    assert!(visited[..2].iter().all(|&along_curve| 1.5 * along_curve < visited[2]), "{visited:?}");
    for sweep in
        ["light_error", "at random", "max_lights_per_cluster", "as strewn", "Morton", "slices", "tiles"]
    {
        assert!(printed.contains(sweep), "{printed}");
    }
    let orders = &json["orders"];
    assert_eq!(orders["lights"], 16384);
    for key in ["host_cpu_ms", "device_cpu_ms"] {
        assert!(orders[key]["median"].as_f64().unwrap() > 0.0, "{orders}");
    }
    assert!(printed.contains("The Hilbert order of 16384 lights"), "{printed}");
    let svg = String::from_utf8(folder.read("lights.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
}

#[test]
fn gathered_light() {
    let folder = Folder::new();
    let printed = folder.done(&["report", "--chapter", "indirect", "--quick", "--validate"]);
    let files =
        ["indirect.csv", "indirect.json", "indirect.md", "indirect.png", "indirect.svg", "scene.toml"];
    assert_eq!(folder.names(), files);
    let json = folder.json("indirect.json");
    let points = json["points"].as_array().unwrap();
    let csv = String::from_utf8(folder.read("indirect.csv")).unwrap();
    assert_eq!(csv.lines().count(), points.len() + 1);
    let of = |family: &str, count: u32, rounds: u32, key: &str| {
        let point =
            points.iter().find(|p| p["family"] == family && p["count"] == count && p["rounds"] == rounds);
        point.and_then(|p| p[key].as_f64()).unwrap_or_else(|| panic!("{family}, {count}, {rounds}: no {key}"))
    };
    assert!(json["truth_error"].as_f64().unwrap() < 0.01);
    for count in [1024, 16384] {
        // Eight times the rounds are √8 times as exact.
        let ratio = of("gathered", count, 1, "error") / of("gathered", count, 8, "error");
        assert!((1.8..4.5).contains(&ratio), "{count}: {ratio}");
        assert!(of("gathered", count, 8, "error") < 0.03);
        assert!(of("gathered", count, 8, "bias").abs() < 0.03, "{count}");
        for rounds in [2, 4, 8] {
            let ratio = of("gathered", count, rounds, "estimate") / of("gathered", count, rounds, "error");
            assert!((1.0 / 1.5..1.5).contains(&ratio), "{count}, {rounds}: {ratio}");
        }
    }
    let ratio = of("paths", 1, 1, "error") / of("paths", 64, 1, "error");
    assert!((5.0..12.0).contains(&ratio), "{ratio}");
    assert!(of("paths", 64, 1, "bias").abs() < 0.03);
    // The clamp takes light away, and what is not Lambertian is missing.
    let [plain, clamped] = ["plain", "clamped"].map(|family| of(family, 256, 1, "bias"));
    assert!(-0.3 < clamped && clamped < plain && plain < 0.1, "{clamped} {plain}");
    assert_eq!(points.iter().filter(|p| p["default"] == true).count(), 1);
    assert!(points.iter().any(|p| p["pareto"] == true));
    assert!(printed.contains("plain VPLs, clamped"), "{printed}");
    let page = String::from_utf8(folder.read("indirect.md")).unwrap();
    assert!(page.contains("--chapter indirect --quick") && page.contains("| 16384 | 8 |"), "{page}");
}

#[test]
fn hard_cases() {
    let folder = Folder::new();
    let printed = folder.done(&["report", "--chapter", "hard", "--quick", "--validate"]);
    assert_eq!(folder.names(), ["hard.csv", "hard.json", "hard.md", "scene.toml"]);
    let json = folder.json("hard.json");
    let points = json["points"].as_array().unwrap();
    let csv = String::from_utf8(folder.read("hard.csv")).unwrap();
    assert_eq!(csv.lines().count(), points.len() + 1);
    let worst = |verdict: &serde_json::Value| {
        (verdict["worst"].as_f64().unwrap(), verdict["not_finite"].as_u64().unwrap())
    };
    let mut formulas: Vec<&str> = points.iter().map(|p| p["formula"].as_str().unwrap()).collect();
    formulas.dedup();
    assert_eq!(formulas.len(), 19, "{formulas:?}");
    // Where an end of a thin line is far along its axis, vertices on both sides of it round to more than its width: the
    // relative error may be anything, which is known and shown, and the absolute one is held to a third of the 3e-4 that
    // such a line gives at most, end-on to a tenth of the 1e-6.
    let thin = [
        ("radius 3e-4 of its distance, 2 long, 1e-3 to .2 up", 1e-4),
        ("end-on: from 1–10 to 20–100 away, its axis .1 aside", 1e-7),
        ("radius 3e-4 of its distance, across the horizon", 1e-4),
    ];
    let thin_line = |point: &serde_json::Value| {
        let known =
            |case: &&(&str, f64)| point["formula"] == "form factor of a line" && point["case"] == case.0;
        thin.iter().find(known).map(|case| case.1)
    };
    assert_eq!(points.iter().filter_map(thin_line).count(), thin.len());
    for point in points {
        // What ships is finite everywhere and right to what the contract grants form factors.
        let most = if point["absolute"].as_bool().unwrap() { 2e-6 } else { 2e-3 };
        for shipped in
            ["shipped_cpu", "shipped_device"].map(|key| &point[key]).into_iter().filter(|v| !v.is_null())
        {
            let (error, not_finite) = worst(shipped);
            let right = thin_line(point)
                .map_or(error <= most, |most| shipped["worst_absolute"].as_f64().unwrap() <= most);
            assert!(not_finite == 0 && right, "{point}");
        }
    }
    for formula in formulas {
        let own = points.iter().filter(|p| p["formula"] == formula);
        let breaks = |p: &serde_json::Value| {
            let (naive, shipped) = (worst(&p["naive_device"]), worst(&p["shipped_device"]));
            naive.1 > 0 || naive.0 > 10.0 * shipped.0
        };
        assert!(own.clone().any(breaks), "{formula} is not hard");
        assert!(printed.contains(formula), "{printed}");
    }
    let pictures = json["pictures"].as_array().unwrap();
    assert!(pictures.len() >= 11, "{pictures:?}");
    for picture in pictures {
        assert_eq!(picture["not_finite"], 0, "{picture}");
        let worst = picture["worst"].as_f64();
        let [got, want] = [0, 1].map(|which| picture["largest"][which].as_f64().unwrap());
        match picture["what"].as_str().unwrap() {
            // Both evaluate the same lights in another order.
            "clusters" => assert!(want > 0.0 && worst.unwrap() < 1e-4, "{picture}"),
            // No firefly is many times the largest value that paths find, and where they find nothing, nothing is.
            _ => assert!(worst.map_or(got == 0.0, |ratio| (0.2..5.0).contains(&ratio)), "{picture}"),
        }
    }
}

#[test]
fn samples() {
    let folder = Folder::new();
    let printed = folder.done(&["report", "--chapter", "samples", "--quick", "--validate"]);
    let files = ["samples.csv", "samples.json", "samples.md", "samples.png", "samples.svg", "scene.toml"];
    assert_eq!(folder.names(), files);
    let json = folder.json("samples.json");
    let points = json["points"].as_array().unwrap();
    let csv = String::from_utf8(folder.read("samples.csv")).unwrap();
    assert_eq!(csv.lines().count(), points.len() + 1);
    for law in json["laws"].as_array().unwrap() {
        // Independent samples would have −½; those of a pixel are better spread.
        let exponent = law["exponent"].as_f64().unwrap();
        assert!((-1.2..=-0.35).contains(&exponent), "{law}");
    }
    assert_eq!(json["laws"].as_array().unwrap().len(), 2);
    for family in ["shadows", "unshadowed", "paths"] {
        let last = points.iter().rfind(|point| point["family"] == family).unwrap();
        assert!(last["bias"].as_f64().unwrap().abs() < 0.02, "{last}");
        let error = last["error"].as_f64().unwrap();
        assert!(error < if family == "unshadowed" { 0.01 } else { 0.1 }, "{last}");
        assert!(points.iter().any(|point| point["family"] == family && point["samples"] == 1));
    }
    assert_eq!(points.iter().filter(|point| point["default"] == true).count(), 2);
    assert!(printed.contains("paths, shadows"), "{printed}");
}

#[test]
fn choices() {
    let folder = Folder::new();
    let printed = folder.done(&["report", "--chapter", "choices", "--quick"]);
    let files = ["choices.csv", "choices.json", "choices.md", "choices.png", "choices.svg", "scene.toml"];
    assert_eq!(folder.names(), files);
    let json = folder.json("choices.json");
    let tables = json["tables"].as_array().unwrap();
    for layer in ["metal", "plastic"] {
        let of = |side: Option<u32>, format: &str| {
            let found = tables.iter().find(|t| {
                t["layer"] == layer && t["side"] == serde_json::json!(side) && t["format"] == format
            });
            found.and_then(|t| t["mean"].as_f64()).unwrap_or_else(|| panic!("{layer}, {side:?}, {format}"))
        };
        let [own, ships] = [of(None, "float"), of(Some(32), "float")];
        // Fewer texels are worse, as many as ship are as good as own fits, and 16 bits as good as all.
        assert!(
            of(Some(4), "float") > of(Some(16), "float") && of(Some(16), "float") >= 0.999 * ships,
            "{layer}"
        );
        assert!((own..1.1 * own).contains(&ships), "{layer}: {ships} for {own}");
        // A code of 16 bits over the least albedo of a dielectric.
        assert!((of(Some(32), "snorm16") - ships).abs() < 1.5e-5 / 0.04, "{layer}");
        assert!(of(Some(32), "snorm8") > ships, "{layer}");
    }
    for texture in json["halves"].as_array().unwrap() {
        // Half a unit in the last of 11 bits, but for what is below the least normal half.
        let [mean, worst] = ["mean", "worst"].map(|key| texture[key].as_f64().unwrap());
        assert!(mean <= 4.9e-4 && worst < 0.02, "{texture}");
    }
    for scene in json["cones"].as_array().unwrap() {
        assert!((0.0..0.5).contains(&scene["behind"].as_f64().unwrap()), "{scene}");
    }
    assert!(printed.contains("own fits"), "{printed}");
}

#[test]
fn cost_of_features() {
    let folder = Folder::new();
    let printed = folder.done(&["report", "--chapter", "features", "--quick", "--validate"]);
    assert_eq!(folder.names(), ["features.csv", "features.json", "features.md", "scene.toml"]);
    let json = folder.json("features.json");
    let points = json["points"].as_array().unwrap();
    assert_eq!(points[0]["feature"], "nothing");
    for point in points {
        assert!(printed.contains(point["feature"].as_str().unwrap()), "{printed}");
        assert_eq!(point["base_ms"]["n"], json["rounds"], "{point}");
        for key in ["unused", "used"] {
            let ratio = &point[format!("{key}_ratio")];
            assert_eq!(ratio.is_null(), point[key].is_null(), "{point}");
            if let Some(ratio) = ratio.as_object() {
                let [low, middle, high] = ["low", "ratio", "high"].map(|key| ratio[key].as_f64().unwrap());
                assert!(0.0 < low && low <= middle && middle <= high, "{point}");
            }
        }
    }
}

#[test]
fn scaling() {
    let folder = Folder::new();
    let printed = folder.done(&["report", "--chapter", "scaling", "--quick", "--validate"]);
    let files = ["scaling.csv", "scaling.json", "scaling.md", "scaling.png", "scaling.svg", "scene.toml"];
    assert_eq!(folder.names(), files);
    let json = folder.json("scaling.json");
    let points = json["points"].as_array().unwrap();
    let csv = String::from_utf8(folder.read("scaling.csv")).unwrap();
    assert_eq!(csv.lines().count(), points.len() + 1);
    let of = |sweep: &str, key: &str| -> Vec<f64> {
        let own = points.iter().filter(|point| point["sweep"] == sweep);
        own.map(|point| point[key].as_f64().unwrap()).collect()
    };
    assert_eq!(of("pixels", "count"), [3600.0, 14400.0]);
    assert_eq!(of("area lights", "count"), [1.0, 4.0]);
    assert_eq!(of("point lights", "count"), [0.0, 256.0]);
    assert!(
        of("triangles", "count").iter().zip([1e3, 3162.0]).all(|(n, want)| (n / want - 1.0).abs() < 0.05)
    );
    // Every panel reaches every surface, of which there are as many: but for the half of the ball that faces away from some.
    let panels = of("area lights", "pairs_per_pixel");
    assert!((3.0..=4.0).contains(&(panels[1] / panels[0])), "{panels:?}");
    // The floor of the grid has the density of its lights, whatever the picture's size; without lights there are no pairs.
    let pixels = of("pixels", "pairs_per_pixel");
    assert!((0.5..1.5).contains(&(pixels[1] / pixels[0])), "{pixels:?}");
    assert_eq!(of("point lights", "pairs_per_pixel")[0], 0.0);
    for growth in json["growth"].as_array().unwrap() {
        assert!(["slope", "ns_each"].iter().all(|key| growth[key].is_number()), "{growth}");
        assert!(printed.contains(growth["sweep"].as_str().unwrap()), "{printed}");
    }
    let page = String::from_utf8(folder.read("scaling.md")).unwrap();
    assert!(
        page.contains("| Bevy 0.19.1, lavapipe, Mesa 25.0.7 |") && page.contains("## By triangles"),
        "{page}"
    );
}
