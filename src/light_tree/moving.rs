//! Point lights that move: their order, kept for as long as it is good, and where they are.
//!
//! 1. Time is cut into intervals in which no light goes farther than a share of a leaf's side. All times of an interval have
//!    the order of its middle: it depends on the time alone, not on the frames before.
//! 2. The lights lie in that order, each with all that its motion needs. For a frame they are placed one after the other
//!    in the memory that the device copies from, and boxes are fitted to them.
//!
//! A million lights that drift take 20 CPU ms with their upload in a frame within an interval; ordered anew in each frame
//! they took 188.

use super::{LEAF, Reach, moments_of, order, place_texel, with_tops};
use crate::scene::motion::Placement;
use crate::scene::{Motion, PointLight, Scene};
use crate::shared::{LightNode, MomentNode};
use glam::Vec3;
use rayon::prelude::*;

/// What a light goes away from where it was ordered, of a leaf's side, at most.
const SHARE: f64 = 1.0 / 16.0;

/// A scene's point lights, of which some move.
#[derive(Clone, Debug)]
pub struct MovingLights {
    /// In file order, where they are at time 0.
    lights: Vec<PointLight>,
    motions: Vec<Motion>,
    /// Of each light: see `Course::direction`.
    directions: Vec<Vec3>,
    /// World position of the device's origin.
    origin: Vec3,
    /// Seconds that have one order.
    interval: f64,
    /// The time whose order this is, seconds; NaN: none yet.
    ordered_at: f64,
    /// Indices into `lights`.
    order: Vec<u32>,
    /// How many have a range: the first of the order.
    ranged: usize,
    travellers: Vec<Traveller>,
}

/// A light in its place in the order.
#[derive(Clone, Copy, Debug)]
struct Traveller {
    /// World position at time 0.
    start: Vec3,
    /// `f32::MAX` for none.
    range: f32,
    direction: Vec3,
    /// 0: it stands; else 1 + its motion.
    course: u32,
}

/// The trees over lights where they are at a time.
#[derive(Debug, Default)]
pub struct PlacedTrees {
    /// See [`super::LightTree`].
    pub nodes: Vec<LightNode>,
    /// See [`super::LightTree`].
    pub moments: Vec<MomentNode>,
}

impl MovingLights {
    /// Those of a scene, about the device's origin.
    #[must_use]
    pub fn new(scene: &Scene, origin: Vec3) -> Self {
        let mut directions = vec![Vec3::ZERO; scene.point_lights.len()];
        for motion in &scene.motions {
            let group = directions[motion.lights.clone()].par_iter_mut().enumerate();
            group.for_each(|(index, direction)| *direction = motion.course.direction(index as u32));
        }
        Self {
            interval: interval(&scene.point_lights, &scene.motions),
            lights: scene.point_lights.clone(),
            motions: scene.motions.clone(),
            directions,
            origin,
            ordered_at: f64::NAN,
            order: Vec::new(),
            ranged: 0,
            travellers: Vec::new(),
        }
    }

    /// Orders the lights for time `t`, in seconds; whether that changed their order.
    pub fn order_for(&mut self, t: f64) -> bool {
        let middle = (t / self.interval).round() * self.interval;
        // Where nothing moves far, or all lights are at one place, there are no intervals.
        let time = if middle.is_finite() { middle } else { t };
        if self.ordered_at == time {
            return false;
        }
        let places = self.places_at(time);
        (self.order, self.ranged) = order(&self.lights, |index| places[index]);
        let mut courses = vec![0; self.lights.len()];
        for (motion, course) in self.motions.iter().zip(1..) {
            courses[motion.lights.clone()].fill(course);
        }
        let traveller = |&index: &u32| {
            let light = &self.lights[index as usize];
            Traveller {
                start: light.position,
                range: light.range.unwrap_or(f32::MAX),
                direction: self.directions[index as usize],
                course: courses[index as usize],
            }
        };
        self.order.par_iter().map(traveller).collect_into_vec(&mut self.travellers);
        self.ordered_at = time;
        true
    }

    /// The lights in their order, where they are at time 0.
    pub fn in_order(&self) -> impl Iterator<Item = &PointLight> {
        self.order.iter().map(|&index| &self.lights[index as usize])
    }

    /// Writes where the ordered lights are at time `t`, in seconds, to as many texels, and builds their trees.
    #[must_use]
    pub fn place(&self, t: f64, texels: &mut [[f32; 4]]) -> PlacedTrees {
        let placements = self.placements(t);
        let (ranged, unranged) = texels[..self.travellers.len()].split_at_mut(self.ranged);
        let (with_range, without) = self.travellers.split_at(self.ranged);
        let leaves = ranged.par_chunks_mut(LEAF).zip(with_range.par_chunks(LEAF)).enumerate();
        let leaves = leaves.map(|(number, (texels, travellers))| {
            let mut reach = Reach::default();
            self.place_some(&placements, travellers, texels, |position, range| reach.add(position, range));
            reach.leaf(number, travellers.len())
        });
        let nodes = with_tops(leaves.collect(), self.ranged);
        let mut lights: Vec<PointLight> = self.in_order().skip(self.ranged).copied().collect();
        let mut left = lights.iter_mut();
        self.place_some(&placements, without, unranged, |position, _| {
            left.next().into_iter().for_each(|light| light.position = position);
        });
        PlacedTrees { nodes, moments: moments_of(&lights, self.ranged) }
    }

    /// Writes the texels of lights, and hands on where they are and their ranges.
    #[inline]
    fn place_some(
        &self,
        placements: &[Placement],
        travellers: &[Traveller],
        texels: &mut [[f32; 4]],
        mut also: impl FnMut(Vec3, f32),
    ) {
        // Texels are only written: to read memory that devices share may be slow.
        let mut texels = texels.iter_mut();
        for group in travellers.chunk_by(|a, b| a.course == b.course) {
            let lights = group.iter().zip(&mut texels);
            let lights = lights
                .map(|(traveller, texel)| (traveller.start, traveller.direction, (texel, traveller.range)));
            placements[group[0].course as usize].place(lights, |(texel, range), position| {
                let position = position - self.origin;
                *texel = place_texel(position, range);
                also(position, range);
            });
        }
    }

    /// In file order, world.
    fn places_at(&self, t: f64) -> Vec<Vec3> {
        let mut places: Vec<Vec3> = self.lights.iter().map(|light| light.position).collect();
        for (motion, placement) in self.motions.iter().zip(&self.placements(t)[1..]) {
            let group = places[motion.lights.clone()].iter_mut().zip(&self.directions[motion.lights.clone()]);
            let group = group.map(|(place, direction)| (*place, *direction, place));
            placement.place(group, |place, position| *place = position);
        }
        places
    }

    /// By a traveller's course.
    fn placements(&self, t: f64) -> Vec<Placement> {
        let moved = self.motions.iter().map(|motion| motion.course.at(t));
        std::iter::once(Placement::Still).chain(moved).collect()
    }
}

/// Seconds in which the fastest light goes twice its share of a leaf's side.
fn interval(lights: &[PointLight], motions: &[Motion]) -> f64 {
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (lower, upper) = lights
        .iter()
        .fold(start, |(lower, upper), light| (lower.min(light.position), upper.max(light.position)));
    let extent = f64::from((upper - lower).max_element()).max(0.0);
    let side = extent * (LEAF as f64 / lights.len().max(1) as f64).cbrt();
    let speeds = motions.iter().map(|motion| motion.speed(&lights[motion.lights.clone()]));
    2.0 * SHARE * side / speeds.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::motion::Course;
    use glam::DVec3;

    /// 3,000 lights of which a third each stands, orbits and drifts at 1 m/s in a box of 8 m.
    fn scene() -> Scene {
        let mut state = 3_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        let point_lights: Vec<PointLight> = (0..3000)
            .map(|i| PointLight {
                position: Vec3::new(next(), next(), next()) * 8.0,
                intensity: Vec3::splat(i as f32),
                range: (i % 10 > 0).then(|| 0.2 + next()),
            })
            .collect();
        let center = DVec3::splat(4.0);
        let motions = vec![
            Motion { lights: 0..1000, course: Course::Orbit { center, axis: DVec3::Y, period: 40.0 } },
            Motion {
                lights: 2000..3000,
                course: Course::Drift { speed: 1.0, seed: 5, walls: [DVec3::ZERO, DVec3::splat(8.0)] },
            },
        ];
        Scene { point_lights, motions, ..Scene::default() }
    }

    #[test]
    fn lights_are_where_the_scene_says_and_inside_their_boxes() {
        let (scene, origin) = (scene(), Vec3::new(1.0, 2.0, 3.0));
        let mut moving = MovingLights::new(&scene, origin);
        let mut texels = vec![[0.0; 4]; scene.point_lights.len()];
        for t in [0.0, 0.03, 12.5, 1e6] {
            moving.order_for(t);
            let trees = moving.place(t, &mut texels);
            let lights = scene.point_lights_at(t);
            let mut seen = vec![false; lights.len()];
            for (place, (texel, same)) in texels.iter().zip(moving.in_order()).enumerate() {
                // The intensity is the light's index.
                let index = same.intensity.x as usize;
                assert!(!std::mem::replace(&mut seen[index], true));
                let light = &lights[index];
                assert_eq!(*texel, place_texel(light.position - origin, light.range.unwrap_or(f32::MAX)));
                assert_eq!(light.range.is_some(), place < moving.ranged);
                if let Some(range) = light.range {
                    let tops = moving.ranged.div_ceil(LEAF * super::super::FAN);
                    let leaf = &trees.nodes[1 + tops + place / LEAF];
                    let position = light.position - origin;
                    assert!((position - range).cmpge(leaf.lower.into()).all());
                    assert!((position + range).cmple(leaf.upper.into()).all());
                }
            }
        }
    }

    #[test]
    fn an_order_depends_on_the_time_alone_and_lasts() {
        let scene = scene();
        let mut moving = MovingLights::new(&scene, Vec3::ZERO);
        // At 1 m/s, and 5.7 m from the axis in 40 s at 0.9: a share of 8 m · (32/3000)^⅓ to and fro.
        let expected = 2.0 * SHARE * 8.0 * (32.0_f64 / 3000.0).cbrt();
        assert!((moving.interval / expected - 1.0).abs() < 0.01, "{}", moving.interval);
        assert!(moving.order_for(0.2 * expected));
        let first = moving.order.clone();
        assert!(!moving.order_for(0.0) && !moving.order_for(0.45 * expected));
        assert!(moving.order_for(0.55 * expected));
        assert_ne!(first, moving.order);
        let mut afresh = MovingLights::new(&scene, Vec3::ZERO);
        afresh.order_for(1.3 * expected);
        assert_eq!(afresh.order, moving.order);
        assert!(moving.order_for(0.1 * expected));
        assert_eq!(first, moving.order);
    }
}
