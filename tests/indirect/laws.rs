//! Laws of the refinement: how fast it converges, that it repeats, that it costs nothing where nothing is wanted.

use amas::HdrImage;

use crate::support::{LAMP, MATTE, Rig, THINGS, Truth, room, scene};

const THREE: &str = "size = [32, 24]\nindirect = { vpls = 2048, bounces = 3 }";

/// The error of means of n rounds falls as n^-½ or faster.
#[test]
fn convergence() {
    const ROUNDS: usize = 32;
    let scene = scene(&room(THREE, MATTE, &[LAMP, THINGS].concat()), &[]);
    let truth = Truth::gathered(&scene, 600);
    let mut rig = Rig::new(scene);
    // Sums of the first n rounds.
    let mut sums = vec![HdrImage::new(32, 24)];
    for round in 1..=ROUNDS {
        rig.refine(1);
        sums.push(scaled(rig.gathered(), round as f32));
    }
    // Of 1 to 16 rounds all runs that are disjoint.
    let error = |n: usize| {
        let square = |start: usize| {
            let own = sums[start + n].clone().plus(&scaled(sums[start].clone(), -1.0));
            truth.rmse(&scaled(own, 1.0 / n as f32)).powi(2)
        };
        let mean = (0..ROUNDS).step_by(n).map(square).sum::<f64>() * n as f64 / ROUNDS as f64;
        [(n as f64).ln(), 0.5 * mean.ln()]
    };
    let points = [1, 2, 4, 8, 16].map(error);
    let slope = slope(&points);
    println!("slope {slope:.3}, errors {:?}", points.map(|point| point[1].exp()));
    assert!(slope <= -0.45, "{slope}: {points:?}");
}

fn scaled(mut image: HdrImage, factor: f32) -> HdrImage {
    image.pixels.iter_mut().flatten().for_each(|value| *value *= factor);
    image
}

/// Of the line that fits best.
fn slope(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let [x, y] = [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / n);
    let [over, under] = [1, 0].map(|axis| {
        let middle = [x, y][axis];
        points.iter().map(|point| (point[0] - x) * (point[axis] - middle)).sum::<f64>()
    });
    over / under
}

/// The same bytes on every run, on any number of threads.
#[test]
fn repeats() {
    let light = "[[light]]\ntype = \"point\"\nposition = [0.5, 1.5, 0.6]\nintensity = [1, 1, 1]\n";
    let text = room(THREE, MATTE, &[LAMP, light, THINGS].concat());
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut rig = Rig::new(scene(&text, &[]));
            rig.refine(2);
            (rig.gathered(), rig.picture(), rig.frame.ldr().unwrap())
        })
    };
    assert!(run(1) == run(3));
}

/// A scene that wants none of it makes and records none of it.
#[test]
fn nothing_for_nothing() {
    let text =
        room("size = [32, 24]", MATTE, &[LAMP, THINGS].concat()).replace("shadows = true", "shadows = false");
    let mut rig = Rig::new(scene(&text, &[]));
    assert!(!rig.frame.gathers().anything());
    assert!(!rig.gpu_scene.hits.exist(), "nothing that hits are shaded by");
    assert_eq!(rig.frame.rows_to_gather(), 0);
    rig.refine(1);
    assert_eq!(rig.frame.gathered(), 0);
    assert!(rig.frame.gathered_light().unwrap().is_none() && rig.frame.gathered_error().unwrap().is_none());
}
