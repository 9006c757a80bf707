//! What is measured: a frame that is rendered again and again, or all from nothing to the first picture.

use super::super::args::BenchOptions;
use super::super::default_scene;
use super::super::report;
use super::super::{FRAME_RATE, camera, in_scene, load_scene, of_size, warn_of_gathered_light};
use super::suites::{Case, Measured};
use crate::error::Result;
use crate::frame::{Frame, FrameInputs, FrameSettings, PassTime, Timings};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::passes::floors::Floors;
use crate::passes::pairs::PairCount;
use crate::refine::Rounds;
use crate::scene::{Camera, Origin, RenderSettings, Scene};
use cpu_time::ProcessTime;
use glam::Vec3;
use indicatif::ProgressBar;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// Where a point's scene comes from.
pub(super) enum Source {
    /// A scene file, or the embedded scene.
    File(Option<PathBuf>),
    /// A point of a suite.
    Suite(Case),
}

/// A point and what was measured of it.
pub(super) struct Subject {
    source: Source,
    stage: Stage,
    /// Frames in one piece.
    pub(super) whole: Vec<Timings>,
    /// Frames pass by pass: that is what tells each pass's CPU time, but makes it slower.
    pub(super) split: Vec<Timings>,
    /// Of the picture after the warm-up; outside the frame.
    pub(super) pairs: Option<PairCount>,
    pub(super) floors: Option<Floors>,
}

/// A frame and all that it needs. Each point has a device of its own, whose peak of memory is the point's.
pub(super) struct Stage {
    pub(super) device: Arc<Device>,
    pub(super) frame: Frame,
    pub(super) render: RenderSettings,
    camera: Camera,
    /// Frames so far: lights that move do so from frame to frame; the camera stands.
    frames: u32,
}

impl Source {
    pub(super) fn name(&self) -> String {
        match self {
            Self::File(path) => {
                path.as_ref().map_or_else(|| "default".into(), |path| path.display().to_string())
            }
            Self::Suite(case) => case.name.clone(),
        }
    }

    fn measured(&self) -> Measured {
        match self {
            Self::File(_) => Measured::Frame,
            Self::Suite(case) => case.measured,
        }
    }

    fn load(&self, options: &BenchOptions) -> Result<Scene> {
        match self {
            Self::File(path) => load_scene(&options.scene(path.clone())),
            Self::Suite(case) => {
                let origin = Origin::Embedded(&case.name, &case.toml, default_scene::FILES);
                let scene = origin.load(&options.scene(None).overrides(), &ProgressBar::hidden());
                scene.map_err(|error| of_size(error, options.size))
            }
        }
    }
}

/// Times one step after the other.
struct Laps {
    begin: (Instant, ProcessTime),
    last: ProcessTime,
    passes: Vec<PassTime>,
}

impl Laps {
    fn start() -> Self {
        let now = ProcessTime::now();
        Self { begin: (Instant::now(), now), last: now, passes: Vec::new() }
    }

    fn lap(&mut self, name: &'static str) {
        let cpu_ms = Some(1e3 * self.last.elapsed().as_secs_f64());
        self.last = ProcessTime::now();
        self.passes.push(PassTime { name, gpu_ms: None, cpu_ms });
    }

    fn stop(self) -> Timings {
        let (wall, cpu) = self.begin;
        Timings {
            passes: self.passes,
            wall_ms: 1e3 * wall.elapsed().as_secs_f64(),
            cpu_ms: 1e3 * cpu.elapsed().as_secs_f64(),
        }
    }
}

impl Stage {
    fn new(source: &Source, options: &BenchOptions, laps: &mut Laps) -> Result<Self> {
        let scene = source.load(options)?;
        let camera = camera(&scene, None)?.clone();
        laps.lap("scene");
        let chosen = options.device.asked();
        let device = Device::open(&chosen)?;
        laps.lap("device");
        let uploaded = GpuScene::new(&device, &scene);
        let gpu_scene = Arc::new(match source {
            Source::File(path) => in_scene(&options.scene(path.clone()), uploaded)?,
            Source::Suite(_) => uploaded?,
        });
        laps.lap("upload");
        if matches!(source, Source::File(_)) {
            warn_of_gathered_light(&scene);
        }
        let frame = Frame::new(&device, &gpu_scene, FrameSettings::new(&scene.render, &camera))?;
        laps.lap("pipelines");
        let mut stage = Self { device, frame, render: scene.render.clone(), camera, frames: 0 };
        if source.measured() == Measured::Gathering {
            stage.begin_gathering(&scene, gpu_scene.origin)?;
        }
        Ok(stage)
    }

    fn render(&mut self, split: bool) -> Result<Timings> {
        self.frames += 1;
        self.frame.render(&inputs(&self.camera, &self.render, self.frames, split))
    }

    /// The picture that light is gathered for, and the lights of a round, from which all frames gather.
    fn begin_gathering(&mut self, scene: &Scene, origin: Vec3) -> Result<()> {
        self.render(false)?;
        let rounds = Rounds::new(scene, origin, self.frame.gathers(), 0.0);
        rounds.light(&mut self.frame, &self.device, 0)
    }

    fn gather(&mut self) -> Result<Timings> {
        self.frame.gather(&inputs(&self.camera, &self.render, self.frames, false))
    }
}

fn inputs<'a>(camera: &'a Camera, render: &RenderSettings, frame: u32, split: bool) -> FrameInputs<'a> {
    FrameInputs {
        camera,
        time: f64::from(frame) / FRAME_RATE,
        samples: render.samples,
        exposure: render.exposure,
        split,
        progress: ProgressBar::hidden(),
    }
}

impl Subject {
    pub(super) fn new(source: Source, options: &BenchOptions) -> Result<Self> {
        let stage = Stage::new(&source, options, &mut Laps::start())?;
        Ok(Self { source, stage, whole: Vec::new(), split: Vec::new(), pairs: None, floors: None })
    }

    pub(super) fn name(&self) -> String {
        self.source.name()
    }

    /// What makes it the same point in another run.
    pub(super) fn key(&self) -> (String, [u32; 2]) {
        (self.name(), self.stage.render.size)
    }

    pub(super) fn stage(&self) -> &Stage {
        &self.stage
    }

    /// A repetition that is not measured.
    pub(super) fn warm_up(&mut self, options: &BenchOptions) -> Result<()> {
        self.repeat(options, false).map(drop)
    }

    /// Counts what the picture that was last rendered has.
    pub(super) fn count(&mut self, options: &BenchOptions) -> Result<()> {
        if self.source.measured() == Measured::Frame {
            // Without warm-up no picture is there yet.
            self.stage.render(false)?;
            self.pairs = Some(self.stage.frame.pairs()?);
            self.floors = if options.floors { self.stage.frame.floors()? } else { None };
        }
        Ok(())
    }

    /// One repetition, and another pass by pass where `split` asks for it.
    pub(super) fn measure(&mut self, options: &BenchOptions, split: bool) -> Result<()> {
        let timings = self.repeat(options, false)?;
        self.whole.push(timings);
        if split && self.source.measured() == Measured::Frame {
            let timings = self.repeat(options, true)?;
            self.split.push(timings);
        }
        Ok(())
    }

    fn repeat(&mut self, options: &BenchOptions, split: bool) -> Result<Timings> {
        match self.source.measured() {
            Measured::Frame => self.stage.render(split),
            Measured::Gathering => self.stage.gather(),
            Measured::Start => self.start(options),
        }
    }

    fn start(&mut self, options: &BenchOptions) -> Result<Timings> {
        let mut laps = Laps::start();
        let mut stage = Stage::new(&self.source, options, &mut laps)?;
        stage.render(false)?;
        laps.lap("picture");
        let timings = laps.stop();
        stage.device.require_silence()?;
        // The one before it goes, outside the measurement.
        self.stage = stage;
        Ok(timings)
    }

    /// What tells the passes' CPU time: the steps of a start, and gathering alone, are timed in any case.
    pub(super) fn passes(&self) -> Vec<report::Pass> {
        let split = if self.source.measured() == Measured::Frame { &self.split } else { &self.whole };
        report::passes(&self.whole, split)
    }
}
