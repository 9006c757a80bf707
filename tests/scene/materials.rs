//! Materials: the five models, presets, roughness and anisotropy.

use amas::scene::{Model, Parameter, Scene};

use crate::{close, load};

fn material(keys: &str) -> Scene {
    load(&format!("[[material]]\nname = \"m\"\n{keys}\n"), &[])
}

fn row(scene: &Scene, parameter: Parameter) -> [f32; 3] {
    scene.materials[0].value(parameter).constant
}

#[test]
fn constants_arrive_in_their_rows() {
    let scene = material("type = \"matte\"\ncolor = [0.1, 0.2, 0.3]\nsigma = 20\ntwo_sided = false");
    assert_eq!(scene.materials[0].model, Model::Matte);
    assert!(!scene.materials[0].two_sided);
    close(&row(&scene, Parameter::Color), &[0.1, 0.2, 0.3]);
    close(&row(&scene, Parameter::Sigma), &[20.0, 0.0, 0.0]);
    let scene = material(
        "type = \"principled\"\nbase_color = [0.1, 0.2, 0.3]\nmetallic = 0.1\nroughness = 0.2\neta = 1.3\n\
        specular_tint = 0.3\nsheen = 0.4\nsheen_tint = 0.6\nclearcoat = 0.7\nclearcoat_gloss = 0.8\nsubsurface = 0.9",
    );
    let rows = [
        (Parameter::Metallic, 0.1),
        (Parameter::Roughness, 0.2),
        (Parameter::Eta, 1.3),
        (Parameter::SpecularTint, 0.3),
        (Parameter::Sheen, 0.4),
        (Parameter::SheenTint, 0.6),
        (Parameter::Clearcoat, 0.7),
        (Parameter::ClearcoatGloss, 0.8),
        (Parameter::Subsurface, 0.9),
        (Parameter::Aspect, 1.0),
    ];
    rows.iter().for_each(|(parameter, value)| close(&row(&scene, *parameter)[..1], &[*value]));
    assert!(scene.materials[0].squared_roughness && scene.materials[0].two_sided);
}

#[test]
fn defaults_are_the_documented_ones() {
    let plastic = material("type = \"plastic\"");
    close(&row(&plastic, Parameter::Specular), &[1.0; 3]);
    close(&[row(&plastic, Parameter::Eta)[0], row(&plastic, Parameter::Roughness)[0]], &[1.5, 0.5]);
    assert!(plastic.materials[0].squared_roughness);
    let principled = material("type = \"principled\"");
    close(
        &[row(&principled, Parameter::SheenTint)[0], row(&principled, Parameter::ClearcoatGloss)[0]],
        &[0.5, 1.0],
    );
    close(&row(&material("type = \"substrate\""), Parameter::Specular), &[0.05; 3]);
    assert_eq!(row(&material("type = \"matte\""), Parameter::Roughness), [0.0; 3]);
}

#[test]
fn alpha_pairs_and_anisotropic_become_alpha_and_aspect() {
    let gold = "type = \"metal\"\npreset = \"gold\"\n";
    let scene = material(&format!("{gold}alpha = [0.1, 0.4]"));
    assert!(!scene.materials[0].squared_roughness);
    let (alpha, aspect) = (row(&scene, Parameter::Roughness)[0], row(&scene, Parameter::Aspect)[0]);
    close(&[alpha / aspect, alpha * aspect], &[0.1, 0.4]);
    let scene = material(&format!("{gold}alpha = 0.3\nanisotropic = 0.5"));
    close(
        &[row(&scene, Parameter::Roughness)[0], row(&scene, Parameter::Aspect)[0]],
        &[0.3, 0.55_f32.sqrt()],
    );
    let scene = material(&format!("{gold}alpha = [0, 0.4]"));
    assert!(row(&scene, Parameter::Aspect)[0].is_finite() && row(&scene, Parameter::Roughness)[0] > 0.0);
}

#[test]
fn presets_have_the_colour_of_their_metal() {
    for name in ["gold", "silver", "copper", "aluminium", "iron", "chromium"] {
        let scene = material(&format!("type = \"metal\"\npreset = \"{name}\""));
        let (eta, k) = (row(&scene, Parameter::Color), row(&scene, Parameter::Specular));
        let reflectance = |i: usize| {
            let (n, k) = (eta[i], k[i]);
            ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k)
        };
        let [r, g, b] = [0, 1, 2].map(reflectance);
        let warm = r > g && g > b;
        match name {
            "gold" | "copper" => assert!(warm && r > 0.9 && b < 0.6, "{name} {r} {g} {b}"),
            "silver" | "aluminium" => assert!(r.min(g).min(b) > 0.9, "{name} {r} {g} {b}"),
            _ => assert!((0.45..0.65).contains(&r) && (r - b).abs() < 0.1, "{name} {r} {g} {b}"),
        }
    }
}

#[test]
fn anisotropy_without_texture_coordinates_is_a_warning() {
    let toml = "[[material]]\nname = \"m\"\ntype = \"metal\"\npreset = \"gold\"\nalpha = [0.1, 0.2]\n\
        [[mesh]]\nobj = \"m.obj\"\nmaterial = \"m\"\n[[mesh]]\nshape = \"plane\"\nmaterial = \"m\"\n";
    let scene = load(toml, &[("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")]);
    assert_eq!(scene.warnings.len(), 1, "the plane has coordinates: {:?}", scene.warnings);
    assert!(scene.warnings[0].contains("isotropic"), "{:?}", scene.warnings);
}

#[test]
fn a_colour_above_one_is_a_warning() {
    let scene = material("type = \"matte\"\ncolor = [1.5, 0, 0]");
    assert!(scene.warnings[0].contains("\"m\""), "{:?}", scene.warnings);
}
