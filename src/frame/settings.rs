//! What a frame is made for, and what changes from picture to picture.

use crate::camera_constants::ClusterShape;
use crate::scene::settings::{Encoding, FrontEnd, Tonemap};
use crate::scene::{Camera, Projection, RenderSettings};
use indicatif::ProgressBar;

/// What a frame is made for; changing it means a new [`Frame`](super::Frame).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameSettings {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Tone curve.
    pub tonemap: Tonemap,
    /// Encoding of the display-referred picture; sRGB but for a window that shows more.
    pub encoding: Encoding,
    /// Radiance where no surface is.
    pub background: [f32; 3],
    /// Relative error that a light may have.
    pub light_error: f32,
    /// Longest light list.
    pub max_lights_per_cluster: u32,
    /// How pixels are parted into clusters.
    pub clusters: ClusterShape,
    /// Perspective camera; orthographic otherwise.
    pub perspective: bool,
    /// What shades the lights in lists.
    pub front_end: FrontEnd,
    /// Light that comes by way of other surfaces.
    pub indirect: bool,
    /// Bounces of it at most.
    pub bounces: u32,
    /// Every light casts shadows.
    pub shadows: bool,
    /// Point lights whose light is gathered can be seen without shadows, until it is.
    pub preview: bool,
    /// Every light on every pixel, without clusters: what the clustered picture is measured against.
    pub brute_force: bool,
    /// Invocations of small workgroups: 8, 16 or 32; `None`: what suits the device. No picture depends on it.
    pub lanes: Option<u32>,
}

impl FrameSettings {
    /// The settings of a scene under one of its cameras.
    #[must_use]
    pub fn new(render: &RenderSettings, camera: &Camera) -> Self {
        Self {
            size: render.size,
            tonemap: render.tonemap,
            encoding: Encoding::Srgb,
            background: render.background,
            light_error: render.light_error,
            max_lights_per_cluster: render.max_lights_per_cluster,
            clusters: ClusterShape::default(),
            perspective: matches!(camera.projection, Projection::Perspective { .. }),
            front_end: render.front_end,
            indirect: render.vpls > 0,
            bounces: render.bounces,
            shadows: render.shadows,
            preview: false,
            brute_force: false,
            lanes: None,
        }
    }
}

/// What changes from picture to picture.
#[derive(Clone, Debug)]
pub struct FrameInputs<'a> {
    /// Camera, of the kind that the frame was made for.
    pub camera: &'a Camera,
    /// Seconds, where lights move.
    pub time: f64,
    /// Samples a pixel; 1 goes through its centre.
    pub samples: u32,
    /// Exposure in EV, for the display-referred picture.
    pub exposure: f32,
    /// Submit pass by pass, so that each pass's CPU time is known; slower.
    pub split: bool,
    /// Advances by one for each sample.
    pub progress: ProgressBar,
}
