//! A frame under other settings: only what they change is made anew.

use super::{Frame, FrameSettings, pass_inputs, work};
use crate::error::Result;
use crate::passes::forward::Work;

impl Frame {
    /// Takes other settings, of any size. Limits are constants of the next picture, a tone curve is a pipeline; anything
    /// else makes the frame anew.
    ///
    /// # Errors
    /// As [`Frame::new`].
    pub fn retune(&mut self, settings: FrameSettings) -> Result<()> {
        let next = Work { folded: self.work.folded, ..work(&self.device, &self.scene, &settings) };
        let kept = FrameSettings {
            size: settings.size,
            perspective: settings.perspective,
            encoding: settings.encoding,
            ..self.settings
        };
        let curve = Work { tonemap: next.tonemap, ..self.work };
        if kept != self.settings || curve != next || settings.brute_force != self.settings.brute_force {
            return self.remake(settings);
        }
        if next.tonemap != self.work.tonemap {
            let inputs = pass_inputs(&self.device, &self.scene, &settings);
            self.forward.set_looks(&inputs, next.looks())?;
        }
        self.work = next;
        self.settings = settings;
        Ok(())
    }

    /// Compiles every pass anew; where that fails, the frame stays as it is.
    ///
    /// # Errors
    /// As [`Frame::new`].
    pub fn remake(&mut self, settings: FrameSettings) -> Result<()> {
        self.renew(settings, work(&self.device, &self.scene, &settings))
    }

    /// Makes everything anew but the lights to gather from, which are those of the scene.
    pub(super) fn renew(&mut self, settings: FrameSettings, work: Work) -> Result<()> {
        let made = Self::of(&self.device.clone(), &self.scene.clone(), settings, work)?;
        let before = std::mem::replace(self, made);
        self.previews = before.previews;
        if let Some(lights) = before.gathered_lights {
            self.set_gathered_lights(lights);
        }
        Ok(())
    }
}
