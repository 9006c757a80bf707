//! Light paths from every emitter, the lights that they leave, and the tree over these.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

mod emitters;
mod hard;
mod oracle;
mod samplers;
mod speed;
mod transport;
mod tree;
mod walk;

use amas::scene::{Scene, load_embedded};
use amas::shared::VirtualLight;
use amas::virtual_lights::{LightSet, Tracer};
use glam::{DVec3, Vec3};

/// The text of a scene file with so many bounces and a matte material `m` of that albedo.
fn scene(albedo: f64, bounces: u32, text: &str) -> Scene {
    let text = format!(
        "{text}\n[render]\nindirect = {{ vpls = 1024, bounces = {bounces} }}\n\
         [[camera]]\nname = \"main\"\nposition = [0, 0, 1]\ntarget = [0, 0, 0]\nvertical_fov = 45\n\
         [[material]]\nname = \"m\"\ntype = \"matte\"\ncolor = [{albedo}, {albedo}, {albedo}]\n"
    );
    load_embedded("test.toml", &text, &[], &[]).unwrap()
}

/// Sets of that many seeds.
fn sets(scene: &Scene, count: usize, seeds: u64) -> Vec<LightSet> {
    let tracer = Tracer::new(scene, Vec3::ZERO);
    (0..seeds).map(|seed| tracer.trace(count, seed)).collect()
}

fn color(light: &VirtualLight) -> DVec3 {
    DVec3::from_array(light.color.map(f64::from))
}

/// Sum of the colours of bounced lights that `counts`.
fn sum(set: &LightSet, counts: impl Fn(&VirtualLight) -> bool) -> DVec3 {
    set.bounced.iter().filter(|light| counts(light)).map(color).sum()
}

/// Mean of independent values, and its standard error.
fn mean(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (mean, (squares / (n * (n - 1.0))).sqrt())
}

/// The mean of the values is `want` within four of its standard errors, which are at most `noise` of it, and `rounding`.
fn expect(what: &str, values: &[f64], want: f64, noise: f64, rounding: f64) {
    let (value, error) = mean(values);
    println!("{what}: {value:.6} ± {error:.1e}, want {want:.6}");
    assert!(error <= noise * want, "{what}: {error:e}");
    assert!(
        (value - want).abs() <= 4.0 * error + rounding * want,
        "{what}: {value} ± {error:e}, want {want}"
    );
}

/// As [`expect`], for each channel.
fn expect_rgb(what: &str, values: &[DVec3], want: DVec3, noise: f64, rounding: f64) {
    for channel in 0..3 {
        let values: Vec<f64> = values.iter().map(|value| value[channel]).collect();
        expect(what, &values, want[channel], noise, rounding);
    }
}

/// All numbers are finite, and no light takes light away.
fn sane(lights: &[VirtualLight]) {
    for light in lights {
        assert!(light.position.iter().chain(&light.color).all(|v| v.is_finite()), "{light:?}");
        assert!(light.color.iter().all(|&v| v >= 0.0), "{light:?}");
    }
}
