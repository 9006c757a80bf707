//! Which scene the window shows: the first, others that are dropped on it, and all of them again when their files change.

use super::Viewer;
use super::loading::{Aim, Loading, Progress};
use super::picture::{Picture, Shape};
use super::pilot::Pilot;
use super::worker::Worker;
use crate::app::args::SceneOptions;
use crate::app::terminal::complain;
use crate::error::{Error, Result};
use crate::image::extension;
use crate::scene::Scene;
use std::path::PathBuf;

impl Viewer<'_> {
    /// A job has come to something. An error where there is no picture to go on with.
    pub(super) fn progress(&mut self, ticket: u64, progress: Progress) -> Result<()> {
        let Some(mut loading) = self.loading.take_if(|loading| loading.ticket == ticket) else {
            return Ok(());
        };
        let (result, ends) = match progress {
            Progress::Read(Ok(scene)) => (self.upload(&mut loading, *scene), false),
            Progress::Read(Err(error)) => (Err(error), true),
            Progress::Ready(picture) => (picture.and_then(|picture| self.present(&loading, picture)), true),
        };
        if ends || result.is_err() {
            self.worker = Some(loading.end());
        } else {
            self.loading = Some(loading);
        }
        self.redraw();
        match result {
            Err(error) if self.picture.is_some() => {
                self.refuse(&error);
                if let Error::Input { file, .. } = &error {
                    // It may be one that the scene did not have before.
                    self.watch.also(file);
                }
                Ok(())
            }
            result => result,
        }
    }

    /// Says why a scene is not shown.
    fn refuse(&mut self, error: &Error) {
        complain(error);
        self.gui.complain(error.to_string());
        self.notice = Some("not loaded");
        self.redraw();
    }

    /// The files are read: on to the device.
    fn upload(&mut self, loading: &mut Loading, scene: Scene) -> Result<()> {
        if loading.aim != Aim::Other {
            // Also where the device refuses it: then a file has to change.
            self.watch.files(&scene.files, loading.since);
        }
        let home = loading.camera(&scene)?;
        let Some(stage) = &self.stage else {
            return Ok(());
        };
        self.startup.reached("scene read");
        let shape = Shape { size: stage.size().map(|side| side.max(1)), encoding: stage.encoding() };
        let camera = match (&loading.aim, &self.pilot) {
            (Aim::Again, Some(pilot)) => pilot.camera().clone(),
            _ => scene.cameras[home].clone(),
        };
        loading.upload(&stage.device, scene, &camera, shape);
        Ok(())
    }

    /// The scene is on the device: into the window.
    fn present(&mut self, loading: &Loading, picture: Box<Picture>) -> Result<()> {
        let home = loading.camera(&picture.scene)?;
        let cameras = &picture.scene.cameras;
        match (&loading.aim, &mut self.pilot) {
            (Aim::Again, Some(pilot)) => pilot.rehome(cameras),
            _ => self.pilot = Some(Pilot::new(cameras, home, picture.diagonal())),
        }
        if loading.aim == Aim::Other {
            self.watch.files(&picture.scene.files, loading.since);
        }
        let size = picture.scene.render.size;
        if loading.aim != Aim::Other
            && size != self.size
            && let Some(stage) = &mut self.stage
        {
            stage.ask_size(size);
        }
        self.size = size;
        self.current = loading.options.clone();
        self.gui.begin(&picture.scene, self.current.scene.as_deref());
        self.picture = Some(picture);
        self.notice = None;
        self.startup.reached("scene on the device");
        Ok(())
    }

    /// Loads the scene in the window once more.
    pub(super) fn reload(&mut self) {
        let aim = match &self.loading {
            Some(Loading { aim: Aim::First(camera), .. }) => Aim::First(camera.clone()),
            // What is being loaded is read anew, too.
            _ => Aim::Again,
        };
        self.load(self.current.clone(), aim);
    }

    /// A file was dropped on the window, or chosen among those that were shown before.
    pub(super) fn dropped(&mut self, path: PathBuf) {
        if !["toml", "obj"].contains(&extension(&path).as_str()) {
            self.refuse(&Error::input(path, None, "this is no scene", "drop a scene (.toml) or an OBJ file"));
            return;
        }
        let options = SceneOptions { scene: Some(path), ..self.current.clone() };
        let aim = if self.picture.is_some() { Aim::Other } else { Aim::First(None) };
        self.load(options, aim);
    }

    fn load(&mut self, options: SceneOptions, aim: Aim) {
        self.abandon();
        self.ticket += 1;
        let worker = self.worker.take().unwrap_or_else(Worker::start);
        self.loading = Some(Loading::start(options, aim, self.ticket, &self.proxy, worker));
        self.redraw();
    }

    /// Ends what is being loaded, if anything is.
    pub(super) fn abandon(&mut self) -> bool {
        self.abandoned.retain(|thread| !thread.is_finished());
        let loading = self.loading.take();
        let loads = loading.is_some();
        self.abandoned.extend(loading.and_then(Loading::cancel));
        loads
    }

    /// Ends loading, or closes the window where there is nothing else to end.
    pub(super) fn cancel_or_close(&mut self) {
        // The first scene has no picture to go back to.
        let loads = self.abandon();
        if self.picture.is_none() || !loads {
            self.closing = true;
        }
    }

    /// Has the window's title say what there is to say.
    pub(super) fn entitle(&mut self) {
        let Some(stage) = &mut self.stage else { return };
        let shown = self.loading.as_ref().map_or(&self.current, |loading| &loading.options);
        let mut title = match &shown.scene {
            Some(path) => format!("amas: {}", path.display()),
            None => "amas".into(),
        };
        if let Some(loading) = &self.loading {
            title += &format!(" (loading, {:.0} %)", 100.0 * loading.fraction());
        } else if let Some(notice) = self.notice {
            title += &format!(" ({notice})");
        }
        stage.entitle(title);
    }
}
