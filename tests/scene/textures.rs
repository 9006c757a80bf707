//! Image files: encoding by use, masks, height maps, sharing.

use std::io::Cursor;

use amas::scene::{Parameter, Scene, Texels};

use crate::{load, png};

fn material(keys: &str, files: &[(&str, &[u8])]) -> Scene {
    load(&format!("[[material]]\nname = \"m\"\ntype = \"principled\"\n{keys}\n"), files)
}

fn linear(scene: &Scene, index: usize) -> &[[u8; 4]] {
    match &scene.textures[index].texels {
        Texels::Linear8(texels) => texels,
        other => panic!("not linear: {other:?}"),
    }
}

#[test]
fn the_use_decides_the_encoding_and_a_file_is_loaded_once_per_use() {
    let file = png(2, 1, |x, _| [x as u8 * 100, 2, 3, 255]);
    let keys = "base_color = { texture = \"t.png\" }\nroughness = { texture = \"t.png\" }\n\
        metallic = { texture = \"t.png\" }\nanisotropic = { texture = \"t.png\" }";
    let scene = material(keys, &[("t.png", &file)]);
    assert_eq!(scene.textures.len(), 2);
    let texels = vec![[0, 2, 3, 255], [100, 2, 3, 255]];
    assert_eq!(scene.textures[0].texels, Texels::Srgb8(texels.clone()));
    assert_eq!(scene.textures[1].texels, Texels::Linear8(texels));
    let row = |parameter| scene.materials[0].value(parameter).texture;
    assert_eq!((row(Parameter::Color), row(Parameter::Roughness)), (Some(0), Some(1)));
    assert_eq!((row(Parameter::Metallic), row(Parameter::Aspect)), (Some(1), Some(1)));
    let texture = &scene.textures[0];
    assert_eq!((texture.name.as_str(), texture.width, texture.height), ("t.png", 2, 1));
}

#[test]
fn a_mask_is_the_alpha_channel_if_it_says_anything_else_red() {
    let with_alpha = png(2, 1, |x, _| [9, 9, 9, x as u8 * 255]);
    let without = png(2, 1, |x, _| [x as u8 * 7, 9, 9, 255]);
    let files: [(&str, &[u8]); 2] = [("a.png", &with_alpha), ("r.png", &without)];
    let red = |scene: &Scene| linear(scene, 0).iter().map(|t| t[0]).collect::<Vec<_>>();
    assert_eq!(red(&material("alpha_mask = \"a.png\"", &files)), [0, 255]);
    assert_eq!(red(&material("alpha_mask = { texture = \"r.png\" }", &files)), [0, 7]);
}

#[test]
fn a_normal_map_stays_and_a_height_map_becomes_one() {
    let normals = png(1, 1, |_, _| [128, 128, 255, 255]);
    // A slope that rises to the right, and one that rises to the top (row 0).
    let right = png(4, 4, |x, _| [x as u8 * 40, x as u8 * 40, x as u8 * 40, 255]);
    let top = png(4, 4, |_, y| [(3 - y as u8) * 40, (3 - y as u8) * 40, (3 - y as u8) * 40, 255]);
    let files: [(&str, &[u8]); 3] = [("n.png", &normals), ("x.png", &right), ("y.png", &top)];
    let scene = |name: &str| material(&format!("normal_map = \"{name}\""), &files);
    assert_eq!(linear(&scene("n.png"), 0), [[128, 128, 255, 255]]);
    let texel = |name| linear(&scene(name), 0)[5];
    let [x, y, z, _] = texel("x.png");
    assert!(x < 127 && y == 128 && z > 200, "leans left: {x} {y} {z}");
    let [x, y, z, _] = texel("y.png");
    assert!(x == 128 && y < 127 && z > 200, "leans down: {x} {y} {z}");
}

#[test]
fn jpeg_tga_hdr_and_exr_load() {
    let rgb = image::DynamicImage::ImageRgb8(image::RgbImage::from_pixel(8, 8, image::Rgb([200, 100, 50])));
    let float = image::Rgb32FImage::from_pixel(4, 4, image::Rgb([4.0, 0.5, 0.25]));
    let float = image::DynamicImage::ImageRgb32F(float);
    let write = |picture: &image::DynamicImage, format| {
        let mut bytes = Vec::new();
        picture.write_to(&mut Cursor::new(&mut bytes), format).unwrap();
        bytes
    };
    let jpeg = write(&rgb, image::ImageFormat::Jpeg);
    let tga = write(&rgb, image::ImageFormat::Tga);
    let (hdr, exr) = (write(&float, image::ImageFormat::Hdr), write(&float, image::ImageFormat::OpenExr));
    let files: [(&str, &[u8]); 4] = [("a.jpg", &jpeg), ("a.tga", &tga), ("a.hdr", &hdr), ("a.exr", &exr)];
    let color = |name: &str| {
        let scene = material(&format!("base_color = {{ texture = \"{name}\" }}"), &files);
        scene.textures.into_iter().next().unwrap().texels
    };
    assert_eq!(color("a.tga"), Texels::Srgb8(vec![[200, 100, 50, 255]; 64]));
    assert!(matches!(color("a.jpg"), Texels::Srgb8(texels) if texels[0][0].abs_diff(200) < 8));
    assert_eq!(color("a.exr"), Texels::Float(vec![[4.0, 0.5, 0.25, 1.0]; 16]));
    assert_eq!(color("a.hdr"), Texels::Float(vec![[4.0, 0.5, 0.25, 1.0]; 16]));
}

#[test]
fn texels_that_are_not_finite_become_zero_with_a_warning() {
    let picture =
        image::Rgb32FImage::from_fn(2, 1, |x, _| image::Rgb([[f32::NAN, -1.0, 2.0], [1.0; 3]][x as usize]));
    let mut bytes = Vec::new();
    let picture = image::DynamicImage::ImageRgb32F(picture);
    picture.write_to(&mut Cursor::new(&mut bytes), image::ImageFormat::OpenExr).unwrap();
    let scene = material("base_color = { texture = \"a.exr\" }", &[("a.exr", &bytes)]);
    assert_eq!(scene.textures[0].texels, Texels::Float(vec![[0.0, 0.0, 2.0, 1.0], [1.0; 4]]));
    assert!(scene.warnings[0].contains("a.exr"), "{:?}", scene.warnings);
}
