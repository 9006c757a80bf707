//! What the CPU parts cost: `cargo bench --features bench`, with a name for one of them.
#![allow(clippy::unwrap_used, reason = "a benchmark that panics is none")]

use amas::hilbert;
use amas::light_tree::LightTree;
use amas::ltc::{Layer, Objective, fit_texel};
use amas::reference::{Options, Oracle};
use amas::scene::{Scene, load_embedded};
use criterion::{Criterion, criterion_group, criterion_main};
use glam::Vec3;
use std::hint::black_box;

/// 400 spheres as tables of the scene file, and 4,096 lights in a file of their own.
const GRID: &str = include_str!("../../scenes/light_grid.toml");
const GRID_LIGHTS: &[u8] = include_bytes!("../../scenes/light_grid_4096.csv");
const HALL: &str = include_str!("../../scenes/million.toml");
const ARCADE: &[u8] = include_bytes!("../../scenes/default_arcade.obj");

fn scene(toml: &str, files: &[(&str, &[u8])]) -> Scene {
    load_embedded("bench.toml", toml, files, &[]).unwrap()
}

/// Text to meshes, materials and lights.
fn parse(c: &mut Criterion) {
    let files = [("light_grid_4096.csv", GRID_LIGHTS)];
    c.bench_function("parse light_grid.toml", |b| b.iter(|| scene(GRID, &files)));
}

/// 648 kB of OBJ to a mesh.
fn obj(c: &mut Criterion) {
    let toml = "[[camera]]\nname = \"main\"\nposition = [0, 0, 1]\ntarget = [0, 0, 0]\nvertical_fov = 45\n\
         [[mesh]]\nobj = \"arcade.obj\"\n";
    let files = [("arcade.obj", ARCADE)];
    c.bench_function("load default_arcade.obj", |b| b.iter(|| scene(toml, &files)));
}

/// The order of a million lights alone, and with their tree.
fn lights(c: &mut Criterion) {
    let lights = scene(HALL, &[]).point_lights;
    let places: Vec<_> = lights.iter().map(|light| light.position).collect();
    c.bench_function("Hilbert order of 1048576 points", |b| {
        b.iter(|| hilbert::order(black_box(&places).iter().copied()));
    });
    c.bench_function("tree of 1048576 lights", |b| b.iter(|| LightTree::new(black_box(&lights), Vec3::ZERO)));
}

/// A texel in the middle of the table of metals, started from the analytic limit alone.
fn fitter(c: &mut Criterion) {
    let [columns, rows] = Layer::Metal.size();
    let parameters = Layer::Metal.parameters(columns as f64 / 2.0, rows as f64 / 2.0);
    c.bench_function("fit of a texel, metal", |b| {
        b.iter(|| fit_texel(Layer::Metal, black_box(parameters), Objective::L1, None));
    });
}

/// A pixel of the hall in double precision, every light summed that reaches it.
fn oracle(c: &mut Criterion) {
    let scene = scene(HALL, &[]);
    let oracle = Oracle::new(&scene, &scene.cameras[0], &Options::of_scene(&scene)).unwrap();
    let [width, height] = scene.render.size;
    c.bench_function("pixel of the oracle, million.toml", |b| {
        b.iter(|| oracle.pixel(black_box(width / 2), black_box(height / 2)));
    });
}

criterion_group!(cpu, parse, obj, lights, fitter, oracle);
criterion_main!(cpu);
