//! How well a walk down the tree draws: glsl/gather/trees.glsl in double precision, for places on lights.

use amas::shared::VirtualLight;
use amas::virtual_lights::octahedral::{Cone, unpack_normal};
use amas::virtual_lights::{Tracer, VirtualTree};
use glam::{DVec3, Vec3};

use crate::tree::{Child, children};
use crate::{color, scene};

/// What is lit: a place, its normal, and the largest geometry term.
struct Lit {
    place: DVec3,
    normal: DVec3,
    bound: f64,
}

impl Lit {
    fn on(light: &VirtualLight, bound: f64) -> Self {
        let place = Vec3::from(light.position).as_dvec3();
        Self { place, normal: unpack_normal(light.normal), bound }
    }

    /// What it gets of a light that nothing hides.
    fn gets(&self, light: &VirtualLight) -> f64 {
        let offset = Vec3::from(light.position).as_dvec3() - self.place;
        let d2 = offset.length_squared();
        let [here, there] = [self.normal.dot(offset), -unpack_normal(light.normal).dot(offset)];
        let geometry = here.max(0.0) * there.max(0.0) / (d2 * d2).max(1e-30);
        color(light).element_sum() / 3.0 * geometry.min(self.bound)
    }

    fn importance(&self, child: &Child<'_>) -> f64 {
        let [lower, upper] = [child.lower, child.upper].map(|corner| corner.as_dvec3());
        let (extent, offset) = (0.5 * (upper - lower), 0.5 * (lower + upper) - self.place);
        let (r2, d2) = (extent.length_squared(), offset.length_squared());
        let inverse = d2.max(r2).sqrt().recip();
        let above = self.normal.dot(offset) + self.normal.abs().dot(extent);
        let mut geometry = (above * inverse).clamp(0.0, 1.0);
        if d2 > r2 {
            let cone = Cone::unpack(child.cone);
            let angle = (-cone.axis.dot(offset) * inverse).clamp(-1.0, 1.0).acos();
            let least = angle - cone.angle - (r2.sqrt() * inverse).asin();
            geometry *= least.max(0.0).cos().max(0.0);
        }
        f64::from(child.power) * (geometry / d2.max(0.25 * r2)).min(self.bound)
    }

    /// Sums over lights of what each gives, and of its square over the probability that it is drawn.
    fn moments(&self, tree: &VirtualTree) -> [f64; 2] {
        let mut sums = [0.0; 2];
        let mut open = vec![(&tree.lights[..], &tree.pairs[..], 1.0)];
        while let Some((lights, pairs, probability)) = open.pop() {
            if let [light] = lights {
                let gets = self.gets(light);
                assert!(gets == 0.0 || probability > 0.0, "{gets} is never drawn");
                sums[0] += gets;
                sums[1] += if gets > 0.0 { gets * gets / probability } else { 0.0 };
                continue;
            }
            let both = children(lights, pairs).map(|child| (self.importance(&child), child));
            let sum = both[0].0 + both[1].0;
            open.extend(both.map(|(share, child)| {
                (child.lights, child.pairs, if sum > 0.0 { probability * share / sum } else { 0.0 })
            }));
        }
        sums
    }
}

/// A room with a box and a lamp. With as many lights in each half along a curve, the mean second moment of 65,536 was 129 in
/// a room like it; 1 is what no way of drawing comes below.
#[test]
fn every_light_is_drawn_about_as_often_as_it_counts() {
    let wall = |place: &str, turn: &str| {
        format!(
            "[[mesh]]\nshape = \"plane\"\nsize = 2\nmaterial = \"m\"\ntranslate = {place}\nrotate = {turn}\n"
        )
    };
    let text = [
        wall("[0, 0, 0]", "[0, 0, 0]"),
        wall("[0, 2, 0]", "[180, 0, 0]"),
        wall("[0, 1, -1]", "[90, 0, 0]"),
        wall("[-1, 1, 0]", "[0, 0, -90]"),
        wall("[1, 1, 0]", "[0, 0, 90]"),
        "[[mesh]]\nshape = \"box\"\nsize = 0.6\nmaterial = \"m\"\ntranslate = [0.35, 0.3, -0.1]\nrotate = [0, 25, 0]\n".into(),
        "[[mesh]]\nshape = \"sphere\"\nradius = 0.3\nmaterial = \"m\"\ntranslate = [-0.4, 0.3, 0.2]\n".into(),
        "[[light]]\ntype = \"rect\"\ncenter = [0, 1.98, 0]\nu = [0.25, 0, 0]\nv = [0, 0, 0.25]\nradiance = [9, 9, 9]\n".into(),
    ];
    let scene = scene(0.7, 4, &text.concat());
    let tracer = Tracer::new(&scene, Vec3::ZERO);
    for count in [4096, 65_536] {
        let set = tracer.trace(count, 6);
        // As glsl/gather/path.glsl has it of vertices that draw alone.
        let bound = 0.25 / (16.0 * f64::from(set.spacing)).powi(2);
        let tree = VirtualTree::new(&set.bounced);
        let places = tracer.trace(400, 7).bounced;
        let moments = places.iter().map(|light| Lit::on(light, bound).moments(&tree));
        let seconds: Vec<f64> =
            moments.filter(|sums| sums[0] > 0.0).map(|sums| sums[1] / sums[0].powi(2)).collect();
        let mean = seconds.iter().sum::<f64>() / seconds.len() as f64;
        let worst = seconds.iter().fold(0.0, |a: f64, &b| a.max(b));
        println!("{count} lights, {} places: mean second moment {mean:.2}, worst {worst:.1}", seconds.len());
        assert!(seconds.len() > 200 && seconds.iter().all(|&second| second >= 1.0 - 1e-9));
        assert!(mean < 2.6 && worst < 10.0, "{mean} {worst}");
    }
}
