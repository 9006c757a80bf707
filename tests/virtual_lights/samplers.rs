//! Chi-square tests of places and directions. 400 cells of the same probability, or expected counts by quadrature where
//! an outline cuts them; 100 rays a cell; significance 1e-4 on either side: numbers that are too regular fail as well.

use std::f64::consts::TAU;

use amas::scene::Scene;
use amas::virtual_lights::emit::{Emission, Sources};
use glam::{DVec2, DVec3};

use crate::scene;
use crate::tree::random;

const CELLS: usize = 20;
const RAYS: usize = 40_000;

/// χ² as a normal deviate (Wilson and Hilferty 1931); ±3.72 is a significance of 1e-4.
fn deviate(counts: &[f64], expected: &[f64]) -> f64 {
    let cells = || counts.iter().zip(expected).filter(|(_, expected)| **expected >= 5.0);
    let chi2: f64 = cells().map(|(count, expected)| (count - expected).powi(2) / expected).sum();
    let freedom = (cells().count() - 1) as f64;
    let spread = 2.0 / (9.0 * freedom);
    ((chi2 / freedom).cbrt() - (1.0 - spread)) / spread.sqrt()
}

/// The deviate of pairs of numbers in [0, 1) that should be uniform.
fn uniform(pairs: impl Iterator<Item = DVec2>) -> f64 {
    let mut counts = vec![0.0; CELLS * CELLS];
    for pair in pairs {
        assert!(pair.cmpge(DVec2::ZERO).all() && pair.cmple(DVec2::splat(1.0 + 1e-9)).all(), "{pair}");
        let cell = (pair * CELLS as f64).floor().min(DVec2::splat(CELLS as f64 - 1.0));
        counts[cell.y as usize * CELLS + cell.x as usize] += 1.0;
    }
    deviate(&counts, &vec![RAYS as f64 / (CELLS * CELLS) as f64; CELLS * CELLS])
}

fn accept(what: &str, deviate: f64) {
    println!("{what}: {deviate:.2}");
    assert!(deviate.abs() < 3.72, "{what}: {deviate}");
}

fn lit(light: &str) -> Scene {
    scene(0.5, 1, &format!("[[light]]\n{light}\n[[mesh]]\nshape = \"box\"\nsize = 4\nmaterial = \"m\"\n"))
}

fn rays(scene: &Scene) -> Vec<Emission> {
    let sources = Sources::new(scene, 0.0);
    let mut next = random(11);
    let mut pair = || DVec2::new(next(), next());
    (0..RAYS).map(|_| sources.ray(pair().x, [pair(), pair()]).unwrap()).collect()
}

/// [0, 1) of an angle.
fn turn(p: DVec2) -> f64 {
    p.to_angle().rem_euclid(TAU) / TAU
}

/// Cosine-weighted directions about +y: sin² is uniform.
fn about_y(direction: DVec3) -> DVec2 {
    DVec2::new(direction.x.powi(2) + direction.z.powi(2), turn(DVec2::new(direction.x, direction.z)))
}

#[test]
fn flat_lights() {
    let rect = rays(&lit(
        "type = \"rect\"\ncenter = [0.1, 0, 0]\nu = [0, 0, 0.4]\nv = [0.5, 0, 0]\nradiance = [1, 1, 1]",
    ));
    let place = |e: &Emission| DVec2::new((e.ray.origin.x + 0.4) / 1.0, (e.ray.origin.z + 0.4) / 0.8);
    accept("rectangle", uniform(rect.iter().map(place)));
    accept("cosine", uniform(rect.iter().map(|e| about_y(e.ray.direction))));
    let ellipse = rays(&lit(
        "type = \"disk\"\ncenter = [0, 0, 0]\nu = [0, 0, 0.4]\nv = [0.5, 0, 0]\nradiance = [1, 1, 1]",
    ));
    let place = |e: &Emission| {
        let p = DVec2::new(e.ray.origin.x / 0.5, e.ray.origin.z / 0.4);
        DVec2::new(p.length_squared(), turn(p))
    };
    accept("ellipse", uniform(ellipse.iter().map(place)));
    // Both sides alike: the square of the height tells nothing of the side.
    let both = rays(&lit(
        "type = \"rect\"\ncenter = [0, 0, 0]\nu = [0, 0, 0.4]\nv = [0.5, 0, 0]\nradiance = [1, 1, 1]\ntwo_sided = true",
    ));
    accept("both sides", uniform(both.iter().map(|e| about_y(e.ray.direction))));
    let up = both.iter().filter(|e| e.ray.direction.y > 0.0).count() as f64;
    assert!((up - 0.5 * RAYS as f64).abs() < 4.0 * 0.5 * (RAYS as f64).sqrt(), "{up}");
}

#[test]
fn a_concave_polygon_with_a_hole() {
    let outer = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.75, 0.25], [0.0, 1.0]];
    let hole = [[0.2, 0.1], [0.5, 0.1], [0.4, 0.3]];
    let text = |points: &[[f64; 2]]| {
        let corners: Vec<_> = points.iter().map(|[x, y]| format!("[{x}, {y}, 0]")).collect();
        format!("[{}]", corners.join(", "))
    };
    let light = format!(
        "type = \"polygon\"\nvertices = {}\nholes = [{}]\nradiance = [1, 1, 1]",
        text(&outer),
        text(&hole)
    );
    let crossed = |points: &[[f64; 2]], p: DVec2| {
        let edges = points.iter().zip(points.iter().cycle().skip(1));
        let crosses = |([ax, ay], [bx, by]): &(&[f64; 2], &[f64; 2])| {
            (*ay > p.y) != (*by > p.y) && p.x < ax + (p.y - ay) / (by - ay) * (bx - ax)
        };
        edges.filter(crosses).count() % 2 == 1
    };
    let (mut counts, mut expected) = (vec![0.0; CELLS * CELLS], vec![0.0; CELLS * CELLS]);
    let fine = CELLS * 50;
    for i in 0..fine * fine {
        let p = DVec2::new((i % fine) as f64 + 0.5, (i / fine) as f64 + 0.5) / fine as f64;
        if crossed(&outer, p) && !crossed(&hole, p) {
            expected[i / fine / 50 * CELLS + i % fine / 50] += 1.0;
        }
    }
    let inside: f64 = expected.iter().sum();
    expected.iter_mut().for_each(|count| *count *= RAYS as f64 / inside);
    for emission in rays(&lit(&light)) {
        let cell = (emission.ray.origin.truncate() * CELLS as f64).floor();
        counts[cell.y as usize * CELLS + cell.x as usize] += 1.0;
    }
    for (count, expected) in counts.iter().zip(&expected) {
        assert!(*expected > 0.0 || *count == 0.0, "outside");
    }
    accept("polygon", deviate(&counts, &expected));
}

#[test]
fn lines() {
    let line =
        rays(&lit("type = \"line\"\na = [0, -0.5, 0]\nb = [0, 0.5, 0]\nradius = 0.1\nradiance = [1, 1, 1]"));
    let out = |e: &Emission| DVec2::new(e.ray.origin.x, e.ray.origin.z);
    assert!(line.iter().all(|e| (out(e).length() - 0.1).abs() < 1e-6));
    accept("line", uniform(line.iter().map(|e| DVec2::new(e.ray.origin.y + 0.5, turn(out(e))))));
    let cosine = |e: &Emission| {
        let normal = (out(e) / 0.1).normalize();
        let normal = DVec3::new(normal.x, 0.0, normal.y);
        let across = DVec2::new(e.ray.direction.y, e.ray.direction.dot(normal.cross(DVec3::Y)));
        DVec2::new(1.0 - e.ray.direction.dot(normal).powi(2), turn(across))
    };
    accept("cosine about a line", uniform(line.iter().map(cosine)));
}

#[test]
fn points_and_sky() {
    let point = rays(&lit("type = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]"));
    let sphere = |e: &Emission| {
        DVec2::new(0.5 + 0.5 * e.ray.direction.y, turn(DVec2::new(e.ray.direction.x, e.ray.direction.z)))
    };
    accept("point", uniform(point.iter().map(sphere)));
    let mut dark = lit("type = \"point\"\nposition = [0, 0, 0]\nintensity = [0, 0, 0]");
    dark.render.background = [1.0; 3];
    let sky = rays(&dark);
    accept("sky", uniform(sky.iter().map(sphere)));
    // Where the ray is closest to the centre, on axes of its own.
    let place = |e: &Emission| {
        let closest = e.ray.origin - e.ray.direction * e.ray.origin.dot(e.ray.direction);
        let x = e.ray.direction.any_orthonormal_vector();
        let p = DVec2::new(closest.dot(x), closest.dot(x.cross(e.ray.direction)));
        DVec2::new(p.length_squared() / 12.0, turn(p))
    };
    accept("places of the sky", uniform(sky.iter().map(place)));
}

/// The tests can fail: uniform directions are no cosine-weighted ones, and a rectangle a fiftieth too wide is seen.
#[test]
fn what_is_wrong_is_rejected() {
    let point = rays(&lit("type = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]"));
    let wrong = uniform(point.iter().map(|e| about_y(e.ray.direction)));
    assert!(wrong > 50.0, "{wrong}");
    let mut next = random(3);
    let narrow = uniform((0..RAYS).map(|_| DVec2::new(next() * 0.98, next())));
    assert!(narrow > 3.72, "{narrow}");
    let regular = (0..RAYS).map(|i| DVec2::new((i % 200) as f64 / 200.0, (i / 200) as f64 / 200.0));
    assert!(uniform(regular) < -3.72);
}
