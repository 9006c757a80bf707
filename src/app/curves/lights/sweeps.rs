//! The knobs, and the scenes that they are turned in.

use super::order::Order;
use crate::camera_constants::ClusterShape;
use crate::error::Result;
use crate::reference::sampler::Random;
use crate::scene::{PointLight, RenderSettings, Scene, load_embedded};

/// Ground, walls and sixty spheres of all five BSDFs, in a box of lights.
const HALL: &str = include_str!("../../../../scenes/million.toml");

/// A position of a knob.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Setting {
    /// `light_error` for lights without a range; 0 evaluates every light.
    LightError(f64),
    /// As many lights as these, drawn at random by their intensity, in the place of all: the sampling that a knob is judged
    /// beside.
    Random(u32),
    /// `max_lights_per_cluster` for lights with one.
    Cap(u32),
    /// log2 of the number of lights, as many of them reaching a pixel whatever the number.
    Lights(u32),
    /// Of the most lights, on the device.
    Order(Order),
    /// Depth of a cluster, relative to its tile's side.
    Depth(f64),
    /// The least side of a tile, relative to the lights' range, that has clusters for each quadrant.
    Split(f64),
}

impl Setting {
    /// The number it stands for, in its scene.
    pub(super) fn value(self, scene: &Scene) -> f64 {
        match self {
            Self::LightError(error) => error,
            Self::Cap(count) | Self::Random(count) => count.into(),
            Self::Lights(_) => scene.point_lights.len() as f64,
            Self::Order(order) => f64::from(order as u8),
            Self::Depth(depth) => depth,
            Self::Split(split) => split,
        }
    }

    /// What it is called.
    pub(super) fn label(self, scene: &Scene) -> String {
        match self {
            Self::Random(count) => format!("{count} at random"),
            Self::Order(order) => order.name().to_owned(),
            Self::Split(0.0) => "4 pixels".to_owned(),
            Self::Split(NEVER) => "8 pixels".to_owned(),
            Self::Split(split) => format!("4 where 8 are {split} of a range"),
            _ => self.value(scene).to_string(),
        }
    }

    /// Which lights are on the device.
    pub(super) fn lights(self) -> Lights {
        match self {
            Self::Order(order) => Lights::All(order),
            Self::Random(count) => Lights::Random(count),
            _ => Lights::All(Order::Hilbert),
        }
    }

    /// Whether it is what ships.
    pub(super) fn is_default(self) -> bool {
        let (render, shape) = (RenderSettings::default(), ClusterShape::default());
        match self {
            Self::LightError(error) => error as f32 == render.light_error,
            Self::Cap(cap) => cap == render.max_lights_per_cluster,
            Self::Order(order) => order == Order::Hilbert,
            Self::Depth(depth) => depth == shape.depth,
            Self::Split(split) => split == shape.split,
            Self::Random(_) | Self::Lights(_) => false,
        }
    }

    /// How pixels are parted into clusters.
    pub(super) fn clusters(self) -> ClusterShape {
        let ships = ClusterShape::default();
        match self {
            Self::Depth(depth) => ClusterShape { depth, ..ships },
            Self::Split(split) => ClusterShape { split, ..ships },
            _ => ships,
        }
    }
}

/// Which of a scene's lights are on the device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Lights {
    /// All, in that order.
    All(Order),
    /// As many, drawn by their intensity.
    Random(u32),
}

/// A knob and where it is put.
pub(super) struct Sweep {
    pub(super) name: &'static str,
    /// What is swept, for the axis.
    pub(super) what: &'static str,
    /// Why the default is what it is.
    pub(super) why: &'static str,
    pub(super) settings: &'static [Setting],
}

/// The sweep of the number of lights.
pub(super) const GROWTH: &str = "lights";

/// The sweep of the order of the lights.
pub(super) const ORDER: &str = "order";

/// The sweeps of how pixels are parted into clusters.
pub(super) const SLICES: &str = "slices";
pub(super) const TILES: &str = "tiles";

/// Share of the lights' range that no tile's side has.
const NEVER: f64 = 1e9;

/// log2 of the most lights.
const MOST: u32 = 20;

/// All knobs, each with its positions in order.
pub(super) const SWEEPS: &[Sweep] = &[
    Sweep {
        name: "light_error",
        what: "light_error, lights without a range",
        why: "The default is 0.01: what it saves over half of it is more than what twice as much saves over it.",
        settings: &[
            Setting::LightError(0.0),
            Setting::LightError(0.002),
            Setting::LightError(0.005),
            Setting::LightError(0.01),
            Setting::LightError(0.02),
            Setting::LightError(0.05),
            Setting::LightError(0.1),
            Setting::Random(64),
            Setting::Random(512),
            Setting::Random(4096),
        ],
    },
    Sweep {
        name: "max_lights_per_cluster",
        what: "max_lights_per_cluster, lights that overlap",
        why: "The default is 1024, which lists reach in crowds only: to fold what lies beyond a cap takes longer here than to evaluate it. Scene \
              files have 128 at least.",
        settings: &[
            Setting::Cap(8),
            Setting::Cap(16),
            Setting::Cap(32),
            Setting::Cap(64),
            Setting::Cap(128),
            Setting::Cap(256),
            Setting::Cap(1024),
        ],
    },
    Sweep {
        name: GROWTH,
        what: "number of lights, as many of them at each pixel",
        why: "Nothing is chosen here.",
        settings: &[
            Setting::Lights(10),
            Setting::Lights(12),
            Setting::Lights(14),
            Setting::Lights(16),
            Setting::Lights(18),
            Setting::Lights(MOST),
        ],
    },
    // Behind that sweep: its last truth is this one's.
    Sweep {
        name: ORDER,
        what: "order of the lights on the device, with their number as above",
        why: "The default is Hilbert's, whose boxes of 32 strewn lights are the smallest (`src/hilbert.rs`).",
        settings: &[
            Setting::Order(Order::Hilbert),
            Setting::Order(Order::Morton),
            Setting::Order(Order::AsStrewn),
        ],
    },
    Sweep {
        name: SLICES,
        what: "depth of clusters, relative to their width",
        why: "The default is as deep as wide (Olsson et al. 2012): deeper clusters evaluate more pairs in vain, flatter ones are more.",
        settings: &[
            Setting::Depth(0.25),
            Setting::Depth(0.5),
            Setting::Depth(1.0),
            Setting::Depth(2.0),
            Setting::Depth(4.0),
            Setting::Depth(16.0),
        ],
    },
    Sweep {
        name: TILES,
        what: "width of clusters",
        why: "The default splits a tile whose side is .18 of the lights' range or more: the quadrants of smaller ones have nearly the same lights.",
        settings: &[
            Setting::Split(0.0),
            Setting::Split(0.09),
            Setting::Split(0.18),
            Setting::Split(0.36),
            Setting::Split(NEVER),
        ],
    },
];

/// log2 of the least number of lights of the sweep of it.
const LEAST: u32 = 10;
/// Ranges, metres, at which 28.1 of 2¹⁰, 2¹², 2¹⁴ … 2²⁰ lights reach a pixel in the mean, to 0.3 %: by the counts of useful
/// pairs at 320 × 180, for the larger a range is the farther it goes beyond the box of lights.
const RANGES: [f32; 6] = [14.608, 8.2544, 4.8726, 3.0099, 1.8255, 1.15];

/// log2 of the lights of the first two sweeps.
const LIGHTS: u32 = 16;

impl Sweep {
    /// Every so many-th position is measured, where as many would be of most knobs: orders have no positions between.
    pub(super) fn step(&self, step: usize) -> usize {
        if self.name == ORDER { 1 } else { step }
    }

    /// Whether it is plotted: what leaves the picture as it is has no error to plot.
    pub(super) fn is_plotted(&self) -> bool {
        ![ORDER, SLICES, TILES].contains(&self.name)
    }

    /// The scene for a position of the knob, with 2^`fewer` times fewer lights than told, but 2¹⁰ at least where that is the knob.
    pub(super) fn scene(&self, setting: Setting, size: [u32; 2], fewer: u32) -> Result<Scene> {
        let mut scene = load_embedded("million.toml", HALL, &[], &[])?;
        scene.render.size = size;
        scene.render.background = [0.0; 3];
        // The range at which as many of the lights reach a point as of the hall's million, were the box without end.
        let range = |log2: u32| 1.15 * f32::exp2((20 - log2) as f32 / 3.0);
        let log2 = match setting {
            Setting::Lights(log2) => log2.saturating_sub(fewer).max(LEAST),
            // Brute force over these is a large part of the quick chapter.
            Setting::Order(_) | Setting::Depth(_) | Setting::Split(_) => MOST - fewer * 3 / 2,
            _ => LIGHTS - fewer,
        };
        let lights = &mut scene.point_lights;
        // The generator's lights are independent: the first of them are spread as all are.
        lights.truncate(1 << log2);
        // Equally bright pictures.
        let brighter = 1.0 / f32::exp2((log2 as f32 - 20.0) / 3.0).powi(2);
        let range = match setting {
            Setting::LightError(error) => {
                scene.render.light_error = error as f32;
                None
            }
            Setting::Random(_) => {
                scene.render.light_error = 0.0;
                None
            }
            Setting::Cap(cap) => {
                scene.render.max_lights_per_cluster = cap;
                Some(2.0 * range(log2))
            }
            Setting::Lights(_) | Setting::Order(_) | Setting::Depth(_) | Setting::Split(_) => {
                Some(RANGES[(log2 - LEAST) as usize / 2])
            }
        };
        lights.iter_mut().for_each(|light| change(light, range, brighter));
        Ok(scene)
    }
}

/// So many of the lights, drawn with replacement by their intensity, each as bright as those that it stands for: the mean over
/// many draws is the picture of all.
pub(super) fn drawn(lights: &[PointLight], count: u32) -> Vec<PointLight> {
    let power = |light: &PointLight| f64::from(light.intensity.element_sum());
    let sums: Vec<f64> = lights
        .iter()
        .scan(0.0, |sum, light| {
            *sum += power(light);
            Some(*sum)
        })
        .collect();
    let total = sums.last().copied().unwrap_or(0.0);
    let mut random = Random::new(u64::from(count));
    let draw = |_| {
        let at = random.next() * total;
        let light = lights[sums.partition_point(|&sum| sum <= at).min(lights.len() - 1)];
        let share = power(&light) / total * f64::from(count);
        PointLight { intensity: light.intensity / share as f32, ..light }
    };
    (0..count).map(draw).collect()
}

fn change(light: &mut PointLight, range: Option<f32>, brighter: f32) {
    light.range = range;
    light.intensity *= brighter;
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// Drawn lights have the power of all, whichever they are, and are drawn as often as they are bright.
    #[test]
    fn drawn_lights_stand_for_all() {
        let light = |i: u8| PointLight {
            position: Vec3::splat(f32::from(i)),
            intensity: Vec3::new(1.0, 2.0, 3.0) * f32::from(i),
            range: None,
        };
        let lights: Vec<_> = (0..10).map(light).collect();
        let drawn = drawn(&lights, 9000);
        let sum = |lights: &[PointLight]| lights.iter().map(|l| l.intensity.as_dvec3()).sum::<glam::DVec3>();
        assert!((sum(&drawn) / sum(&lights) - 1.0).abs().max_element() < 1e-4);
        // Of 45 parts, 9: 1,800 of 9,000 times, with a standard deviation of 38.
        let brightest = drawn.iter().filter(|light| light.position.x == 9.0).count();
        assert!((1650..1950).contains(&brightest), "{brightest}");
        assert!(drawn.iter().all(|light| light.position.x > 0.0));
    }
}
