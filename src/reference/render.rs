//! A whole picture: camera rays, the nearest surface or luminaire, and the light that it sends back.

use glam::DVec3;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

use super::area::{self, Emitter, Estimate};
use super::lights::PointLights;
use super::path::Transport;
use super::rays::{CameraRay, Geometry, Hit, Ray, camera_ray};
use super::sampler::{Random, Sequence, hash};
use super::shading::Surface;
use super::visibility::{Occluders, Shadow};
use crate::scene::{Camera, Scene};
use crate::{Error, HdrImage, Result};

/// Which light is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Direct light without visibility: the exact sum over points, an estimate with its error over area lights.
    #[default]
    Direct,
    /// Direct light with visibility.
    Shadowed,
    /// Full light transport, the background's too.
    Path,
}

/// How to compute a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Camera rays a pixel: 1 goes through the centre, more are spread over the pixel (box filter).
    pub spp: u32,
    /// Random shifts; the same seed gives the same picture on any number of threads.
    pub seed: u64,
    /// Which light.
    pub integrator: Integrator,
    /// Standard error at which a pixel's area lights are done, relative to what they reflect there.
    pub tolerance: f64,
    /// Paths of each camera ray, for [`Integrator::Path`].
    pub paths: u32,
    /// Most bounces between the surface that is seen and the light, for [`Integrator::Path`]; 0 is direct light.
    pub bounces: u32,
    /// Fewest bounces, for [`Integrator::Path`]: 1 leaves out direct light, and the luminaires and background that are seen.
    pub fewest_bounces: u32,
    /// Shows a bar, if stderr is a terminal.
    pub progress: bool,
}

impl Options {
    /// As the scene says, with a tolerance of 1e-3, 64 paths a ray, any number of bounces.
    #[must_use]
    pub fn of_scene(scene: &Scene) -> Self {
        Self {
            size: scene.render.size,
            spp: scene.render.samples,
            seed: 0,
            integrator: Integrator::Direct,
            tolerance: 1e-3,
            paths: 64,
            bounces: u32::MAX,
            fewest_bounces: 0,
            progress: false,
        }
    }
}

/// A picture with what is known of its error.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered {
    /// Scene-linear radiance.
    pub image: HdrImage,
    /// Standard error of every value: 0 where only points shine and spp = 1. With several rays a pixel, that of their
    /// mean as if they were independent, which overstates it, because they are well spread.
    pub standard_error: HdrImage,
}

/// Renders `scene` from `camera`, which stands still ([`Camera::at`] places it in time).
///
/// # Errors
/// [`Error::Usage`] for an empty size, no samples or no paths.
pub fn render(scene: &Scene, camera: &Camera, options: &Options) -> Result<Rendered> {
    let oracle = Oracle::new(scene, camera, options)?;
    let [width, height] = options.size;
    let bar = progress_bar(u64::from(height), options.progress);
    let row = |y: u32| {
        let row: Vec<_> = (0..width).map(|x| oracle.estimate(x, y)).collect();
        bar.inc(1);
        row
    };
    let pixels: Vec<Vec<Estimate>> = (0..height).into_par_iter().map(row).collect();
    bar.finish_and_clear();
    let picture = |channel: fn(&Estimate) -> DVec3| HdrImage {
        width,
        height,
        pixels: pixels.iter().flatten().map(|e| channel(e).as_vec3().to_array()).collect(),
    };
    Ok(Rendered { image: picture(|e| e.value), standard_error: picture(|e| e.standard_error) })
}

/// A picture of which any pixel can be asked for, in any order.
pub struct Oracle<'a> {
    world: World<'a>,
    camera: &'a Camera,
}

impl<'a> Oracle<'a> {
    /// Makes ready what every pixel needs; see [`render`].
    ///
    /// # Errors
    /// As [`render`].
    pub fn new(scene: &'a Scene, camera: &'a Camera, options: &Options) -> Result<Self> {
        check(options)?;
        let world = World {
            scene,
            geometry: Geometry::new(scene),
            points: PointLights::new(&scene.point_lights),
            emitters: scene.area_lights.iter().map(|l| Emitter::new(l, &scene.textures)).collect(),
            options: *options,
            tolerance: options.tolerance * f64::from(options.spp).sqrt(),
        };
        Ok(Self { world, camera })
    }

    /// Scene-linear radiance of a pixel.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> [f32; 3] {
        self.estimate(x, y).value.as_vec3().to_array()
    }

    fn estimate(&self, x: u32, y: u32) -> Estimate {
        self.world.pixel(self.camera, x, y)
    }
}

fn check(options: &Options) -> Result<()> {
    if options.size.contains(&0) || options.spp == 0 || options.paths == 0 {
        let cause = "a picture without pixels or without samples";
        return Err(Error::usage(cause, "give a width, a height, an spp and paths of at least 1"));
    }
    Ok(())
}

fn progress_bar(rows: u64, shown: bool) -> ProgressBar {
    if !shown {
        return ProgressBar::hidden();
    }
    // indicatif itself draws nothing where stderr is no terminal.
    let style = ProgressStyle::with_template("reference {bar:40} {pos}/{len} rows, {eta} left");
    let bar = ProgressBar::new(rows);
    match style {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// What every ray needs.
struct World<'a> {
    scene: &'a Scene,
    geometry: Geometry<'a>,
    points: PointLights,
    emitters: Vec<Emitter<'a>>,
    options: Options,
    tolerance: f64,
}

impl World<'_> {
    fn pixel(&self, camera: &Camera, x: u32, y: u32) -> Estimate {
        let options = &self.options;
        let seed = hash(&[options.seed, u64::from(x), u64::from(y)]);
        let (left, top) = (f64::from(x), f64::from(y));
        if options.spp == 1 {
            let view = camera_ray(camera, options.size, left + 0.5, top + 0.5);
            return self.radiance(&view, seed);
        }
        let jitter = Sequence::new(seed);
        let sample = |index| {
            let at = jitter.point(index);
            let view = camera_ray(camera, options.size, left + at.x, top + at.y);
            self.radiance(&view, hash(&[seed, u64::from(index)])).value
        };
        area::mean(&(0..options.spp).map(sample).collect::<Vec<_>>())
    }

    fn radiance(&self, view: &CameraRay, seed: u64) -> Estimate {
        let hit = self.geometry.closest(view);
        let beyond = hit.map_or(view.t_max, |hit| hit.t);
        let luminaires = self.emitters.iter().filter_map(|emitter| emitter.seen_by(&view.ray));
        let in_view = luminaires.filter(|(t, _)| (view.t_min..=beyond).contains(t));
        let at_once = |radiance| {
            let wanted = self.options.integrator != Integrator::Path || self.options.fewest_bounces == 0;
            Estimate { value: if wanted { radiance } else { DVec3::ZERO }, standard_error: DVec3::ZERO }
        };
        if let Some((_, radiance)) = in_view.min_by(|a, b| a.0.total_cmp(&b.0)) {
            return at_once(radiance);
        }
        let Some(hit) = hit else { return at_once(self.scene.render.background.map(f64::from).into()) };
        let surface = Surface::new(self.scene, &view.ray, &hit);
        let occluders = Occluders { geometry: &self.geometry, emitters: &self.emitters };
        if self.options.integrator == Integrator::Path {
            return self.paths(&occluders, &view.ray, &hit, seed);
        }
        let shadowed = self.options.integrator == Integrator::Shadowed;
        let shadow = shadowed.then(|| Shadow::new(&occluders, &view.ray, &hit));
        let shadow = shadow.as_ref();
        let area = area::reflected_where(&surface, &self.emitters, shadow, self.tolerance, seed);
        Estimate { value: area.value + self.points.reflected(&surface, shadow), ..area }
    }

    fn paths(&self, occluders: &Occluders, ray: &Ray, hit: &Hit, seed: u64) -> Estimate {
        let Options { paths, bounces, fewest_bounces, .. } = self.options;
        let points = &self.points;
        let transport = Transport { scene: self.scene, occluders, points, bounces, fewest_bounces };
        let mut random = Random::new(seed);
        area::mean(&(0..paths).map(|_| transport.radiance(ray, hit, &mut random)).collect::<Vec<_>>())
    }
}
