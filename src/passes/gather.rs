//! Light that comes by way of other surfaces, and that of lights whose shadows are wanted.
//!
//! 1. *surface*: fragments note what reflects at each pixel: its frame, its BSDF with textures filtered.
//! 2. *gather* (compute): per pixel one light of each tree, and a path for what they do not stand for; added to the sum of
//!    a subset of the rounds.
//!
//! Reads depth, occluders and the trees over lights; the present subpass reads the sums.

mod lights;
mod surfaces;

pub use lights::GatheredLights;

use super::{PassInputs, View};
use crate::error::Result;
use crate::gpu::{
    Commands, ComputePipeline, DescriptorSets, Device, Image, ImageDescription, PipelineLayout,
    Specialization, Use, shaders,
};
use crate::shared::{self, GATHER_SIDE, GATHER_SUBSETS, GatherConstants};
use crate::targets::{HDR_FORMAT, Targets};
use std::ops::Range;
use std::sync::Arc;
use surfaces::Surfaces;

/// What is gathered; nothing else is compiled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gathered {
    /// Light that comes by way of other surfaces.
    pub indirect: bool,
    /// The scene's point lights, because their shadows are wanted.
    pub points: bool,
    /// Lights cast shadows.
    pub shadows: bool,
    /// Every surface is Lambertian, and the background black.
    pub lambert: bool,
    /// Bounces between the eye's surface and a light, at most.
    pub bounces: u32,
}

impl Gathered {
    /// Whether there is anything to be gathered.
    #[must_use]
    pub fn anything(&self) -> bool {
        self.indirect || self.points
    }

    /// Kinds of light that have layers of their own, as specialisation constants.
    pub(super) fn kinds(&self) -> [(u32, u32); 2] {
        [
            (shared::SPEC_GATHER_POINTS, u32::from(self.points)),
            (shared::SPEC_GATHER_INDIRECT, u32::from(self.indirect)),
        ]
    }
}

/// Pipelines and images of the pass.
pub struct Gather {
    what: Gathered,
    surfaces: Surfaces,
    gather: ComputePipeline,
    set: DescriptorSets,
    sums: Image,
}

impl Gather {
    /// Compiles what the scene needs.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(inputs: &PassInputs<'_>, targets: &Targets, what: Gathered) -> Result<Self> {
        let sets = [shared::frame::BINDINGS, shared::scene::BINDINGS, shared::gather::BINDINGS];
        let layout = Arc::new(PipelineLayout::new(inputs.device, &sets)?);
        let specialization = Specialization::default()
            .with_all(&inputs.scene.occluders.specialization)
            .with_all(&inputs.scene.models)
            .with(shared::SPEC_PERSPECTIVE, u32::from(inputs.perspective))
            .with(shared::SPEC_GATHER_SHADOWS, u32::from(what.shadows))
            .with_all(&what.kinds())
            .with(shared::SPEC_GATHER_LAMBERT, u32::from(what.lambert));
        let gather =
            ComputePipeline::new(inputs.device, &layout, shaders::GATHER_GATHER_COMP, &specialization)?;
        let pass = Self {
            what,
            surfaces: Surfaces::new(inputs, targets)?,
            gather,
            set: layout.allocate(shared::gather::SET, 1)?,
            sums: sums(inputs.device, targets.depth.size(), what)?,
        };
        pass.bind();
        Ok(pass)
    }

    /// Makes the images anew for a picture of another size.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn resize(&mut self, device: &Arc<Device>, targets: &Targets) -> Result<()> {
        self.surfaces.resize(device, targets)?;
        self.sums = sums(device, targets.depth.size(), self.what)?;
        self.bind();
        Ok(())
    }

    fn bind(&self) {
        let set = self.set.get(0);
        self.surfaces.bind(set);
        set.image(shared::gather::GATHER_SUMS, &self.sums, Use::ComputeWrite);
    }

    /// Gathers from other lights from now on.
    pub fn set_lights(&self, lights: &GatheredLights) {
        self.set.get(0).image(shared::gather::GATHER_LIGHTS, &lights.image, Use::Texture);
    }

    /// The sums: a layer for each subset of indirect light, then of point lights, of what there is; in use
    /// [`Use::FragmentRead`].
    #[must_use]
    pub fn sums(&self) -> &Image {
        &self.sums
    }

    /// Notes the surfaces of a frame, and forgets all light before the first one.
    pub fn begin(&self, cmd: &mut Commands, view: &View<'_>, index: u32) {
        cmd.labelled("gather surfaces", |cmd| self.surfaces.record(cmd, view));
        if index == 0 {
            clear(cmd, &self.sums);
        }
    }

    /// Workgroups across and down: one more than cover the picture, because they begin left of it and above.
    fn groups(&self) -> [u32; 2] {
        self.sums.size().map(|side| side.div_ceil(GATHER_SIDE) + 1)
    }

    /// Rows of workgroups of a frame.
    #[must_use]
    pub fn rows(&self) -> u32 {
        self.groups()[1]
    }

    /// Adds light to some of these rows: that of frame `index` of all rounds.
    pub fn record(
        &self,
        cmd: &mut Commands,
        view: &View<'_>,
        lights: &GatheredLights,
        index: u32,
        rows: Range<u32>,
    ) {
        cmd.labelled("gather", |cmd| {
            cmd.transition(&self.sums, Use::FragmentRead, Use::ComputeWrite);
            cmd.bind_compute(&self.gather, &[view.frame, view.scene.set.get(0), self.set.get(0)]);
            cmd.push(&GatherConstants {
                bounces: self.what.bounces,
                index,
                row: rows.start * GATHER_SIDE,
                ..lights.constants
            });
            cmd.dispatch([self.groups()[0], rows.len() as u32, 1]);
            cmd.transition(&self.sums, Use::ComputeWrite, Use::FragmentRead);
        });
    }
}

/// The image of the sums, black: it is read before anything is gathered.
fn sums(device: &Arc<Device>, size: [u32; 2], what: Gathered) -> Result<Image> {
    let kinds = u32::from(what.indirect) + u32::from(what.points);
    let image = Image::new(
        device,
        &ImageDescription {
            name: "gathered light",
            format: HDR_FORMAT,
            size,
            layers: Some(kinds * GATHER_SUBSETS),
            mips: 1,
            uses: &[Use::TransferWrite, Use::TransferRead, Use::ComputeWrite, Use::FragmentRead],
        },
    )?;
    device.run("gathered light", |cmd| {
        clear(cmd, &image);
        Ok(())
    })?;
    Ok(image)
}

fn clear(cmd: &mut Commands, sums: &Image) {
    cmd.transition(sums, Use::Nothing, Use::TransferWrite);
    cmd.clear(sums);
    cmd.transition(sums, Use::TransferWrite, Use::FragmentRead);
}
