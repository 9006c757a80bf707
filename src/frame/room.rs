//! Room for what a frame makes: images of its size, lists as long as they turn out to be.

use super::{Frame, pass_inputs, tiles_of};
use crate::error::Result;
use crate::passes::cluster::{Capacity, ClusterPass, ClusterTargets};
use crate::passes::forward::{Forward, Work};
use crate::passes::resolve::Resolve;
use crate::targets::Targets;

impl Frame {
    /// Makes the images anew for a picture of another size; pipelines stay.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<()> {
        self.settings.size = size;
        self.targets =
            Targets::new(&self.device, size, [self.work.resolve, self.work.cut], self.settings.encoding)?;
        self.prepass.resize(&self.device, &self.targets)?;
        self.forward.resize(&self.device, &self.targets)?;
        if let Some(gather) = &mut self.gather {
            gather.resize(&self.device, &self.targets)?;
        }
        let now = self.lists.capacity;
        let start = Capacity::start(tiles_of(size), self.work.lists, now.mask);
        let capacity = Capacity { folds: now.folds, ..start };
        if let Some(resolve) = &mut self.resolve {
            resolve.resize(&self.targets);
            resolve.grow(&self.device, &self.scene, capacity.clusters)?;
        }
        self.lists = ClusterTargets::new(&self.device, tiles_of(size), capacity)?;
        self.samples = 0;
        self.forget_gathered();
        self.bind();
        Ok(())
    }

    /// From now on evaluates every light without a range: some pixel's cut asked for more steps than a draw may have.
    pub(super) fn give_up_cuts(&mut self) -> Result<()> {
        self.renew(self.settings, Work { cut: false, unranged: true, ..self.work })
    }

    /// Makes room, and the passes that fold lists where this frame is the first to need them.
    pub(super) fn grow(&mut self, capacity: Capacity) -> Result<()> {
        let inputs = pass_inputs(&self.device, &self.scene, &self.settings);
        if capacity.folds && !self.work.folded {
            self.work.folded = true;
            self.cluster = Some(ClusterPass::new(&inputs, self.work)?);
            if self.work.resolve {
                self.resolve = Some(Resolve::new(&inputs, &self.targets, true, capacity.clusters)?);
            }
            self.forward = Forward::new(&inputs, &self.targets, self.work)?;
        } else if let Some(resolve) = &mut self.resolve {
            resolve.grow(&self.device, &self.scene, capacity.clusters)?;
        }
        self.lists = ClusterTargets::new(&self.device, tiles_of(self.settings.size), capacity)?;
        self.bind();
        Ok(())
    }
}
