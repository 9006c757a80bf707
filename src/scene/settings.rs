//! `[render]`: how the scene wants to be rendered.

use crate::shared;

/// `[render]` of the scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Picture width and height in pixels.
    pub size: [u32; 2],
    /// Exposure in EV: display-referred output is scaled by 2^exposure.
    pub exposure: f32,
    /// Jittered frames accumulated per picture; 1 is one ray through each pixel's centre.
    pub samples: u32,
    /// Tone curve for `.png` and the window.
    pub tonemap: Tonemap,
    /// Radiance where no surface is.
    pub background: [f32; 3],
    /// Relative error budget of the many lights.
    pub light_error: f32,
    /// Longest light list of a cluster.
    pub max_lights_per_cluster: u32,
    /// Virtual point lights; 0 is no indirect light.
    pub vpls: u32,
    /// Bounces of indirect light.
    pub bounces: u32,
    /// Visibility of every light.
    pub shadows: bool,
    /// What shades the lights in lists.
    pub front_end: FrontEnd,
}

/// What shades the lights that come in lists. The picture is the same, but for the last bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrontEnd {
    /// Compute on software devices, where it was measured to be faster; fragments on others.
    Auto,
    /// A subpass of the render pass.
    Fragment,
    /// A pass of compute; materials with textures or a tangent's direction stay with fragments.
    Compute,
}

/// Tone curve of display-referred output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tonemap {
    /// Clamp only.
    None,
    /// The ACES fit of Hill (RRT and sRGB ODT).
    Aces,
    /// AgX, base contrast.
    Agx,
}

/// How the display-referred picture is encoded, for the display that shows it. Display-linear 1 is white.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Encoding {
    /// 8-bit sRGB; what is brighter than white is white.
    Srgb = shared::ENCODING_SRGB,
    /// Linear, 1 is 80 cd/m² (IEC 61966-2-2), white at 203 cd/m².
    ScRgb = shared::ENCODING_SCRGB,
    /// Rec. 2020 primaries, perceptual quantizer (SMPTE ST 2084), white at 203 cd/m².
    Hdr10 = shared::ENCODING_HDR10,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            size: [1280, 720],
            exposure: 0.0,
            samples: 1,
            tonemap: Tonemap::Agx,
            background: [0.0; 3],
            light_error: 0.01,
            max_lights_per_cluster: 1024,
            vpls: 0,
            bounces: 3,
            shadows: false,
            front_end: FrontEnd::Auto,
        }
    }
}
