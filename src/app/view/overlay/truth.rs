//! What a picture is compared with: the oracle's, computed beside the window's thread and refined as it goes, or one of a
//! file.

use crate::error::Result;
use crate::image::HdrImage;
use crate::reference::{Integrator, Options, Oracle};
use crate::scene::{Camera, Scene};
use rayon::prelude::*;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

/// Sides of the blocks that one pixel stands for, from the first look to the last.
const BLOCKS: [u32; 5] = [16, 8, 4, 2, 1];

/// A picture to compare with.
pub(super) struct Truth {
    state: Arc<Mutex<State>>,
    cancelled: Arc<AtomicBool>,
    /// What it shows; `None` for a picture of a file.
    pub(super) camera: Option<Camera>,
    worker: Option<JoinHandle<()>>,
}

/// How far the picture is.
struct State {
    image: HdrImage,
    rows: u32,
    of: u32,
    /// Grows with every row.
    version: u64,
    failed: Option<String>,
}

impl Truth {
    /// A picture of a file, or why there is none.
    pub(super) fn load(path: &Path) -> Self {
        let (image, failed) = match HdrImage::load(path) {
            Ok(image) => (image, None),
            Err(error) => (HdrImage::new(0, 0), Some(error.to_string())),
        };
        Self::of(State { image, rows: 1, of: 1, version: 1, failed }, None)
    }

    /// Begins to compute a picture: the scene's samples, shadows and indirect light where it asks for them.
    pub(super) fn compute(scene: &Scene, camera: &Camera, size: [u32; 2]) -> Self {
        let [width, height] = size;
        let image = HdrImage { width, height, pixels: vec![[0.0; 3]; width as usize * height as usize] };
        let of = BLOCKS.iter().map(|&block| height.div_ceil(block)).sum();
        let mut truth =
            Self::of(State { image, rows: 0, of, version: 0, failed: None }, Some(camera.clone()));
        let (state, cancelled) = (truth.state.clone(), truth.cancelled.clone());
        // A copy of its own, which edits in the window do not touch.
        let (scene, camera) = (scene.clone(), camera.clone());
        truth.worker = Some(std::thread::spawn(move || {
            let done = work(&scene, &camera, size, &state, &cancelled);
            if let Err(error) = done {
                lock(&state).failed = Some(error.to_string());
            }
        }));
        truth
    }

    fn of(state: State, camera: Option<Camera>) -> Self {
        Self { state: Arc::new(Mutex::new(state)), cancelled: Arc::default(), camera, worker: None }
    }

    /// The picture as far as it is, if it is another than that of `version`, and its version.
    pub(super) fn newer(&self, version: Option<u64>) -> Option<(HdrImage, u64)> {
        let state = lock(&self.state);
        (version != Some(state.version)).then(|| (state.image.clone(), state.version))
    }

    /// Part of the work that is done, or why it cannot be.
    pub(super) fn done(&self) -> std::result::Result<f32, String> {
        let state = lock(&self.state);
        match &state.failed {
            Some(cause) => Err(cause.clone()),
            None => Ok(state.rows as f32 / state.of.max(1) as f32),
        }
    }

    pub(super) fn size(&self) -> [u32; 2] {
        let state = lock(&self.state);
        [state.image.width, state.image.height]
    }
}

impl Drop for Truth {
    fn drop(&mut self) {
        self.cancelled.store(true, Ordering::Relaxed);
        // It touches no device, and ends after the rows that it is at: not waited for.
        self.worker.take();
    }
}

fn lock(state: &Mutex<State>) -> std::sync::MutexGuard<'_, State> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

fn work(
    scene: &Scene,
    camera: &Camera,
    size: [u32; 2],
    state: &Mutex<State>,
    cancelled: &AtomicBool,
) -> Result<()> {
    let integrator = match &scene.render {
        render if render.vpls > 0 => Integrator::Path,
        render if render.shadows => Integrator::Shadowed,
        _ => Integrator::Direct,
    };
    // No more bounces than the picture has.
    let bounces = scene.render.bounces;
    let options = Options { size, integrator, bounces, ..Options::of_scene(scene) };
    let oracle = Oracle::new(scene, camera, &options)?;
    // Half the processors: the window needs some, and on a software device the picture does.
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get().div_ceil(2));
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else {
        return Ok(());
    };
    for (level, &block) in BLOCKS.iter().enumerate() {
        let rows: Vec<u32> = (0..size[1]).step_by(block as usize).collect();
        pool.install(|| {
            rows.into_par_iter().for_each(|y| {
                if !cancelled.load(Ordering::Relaxed) {
                    let row = row(&oracle, size[0], y, (block, level > 0));
                    fill(&mut lock(state), &row, y, block);
                }
            });
        });
    }
    Ok(())
}

/// Pixels of a row of blocks that no earlier level has: their columns and values.
fn row(oracle: &Oracle<'_>, width: u32, y: u32, (block, later): (u32, bool)) -> Vec<(u32, [f32; 3])> {
    let known = |x: u32| later && x.is_multiple_of(2 * block) && y.is_multiple_of(2 * block);
    let columns = (0..width).step_by(block as usize).filter(|&x| !known(x));
    columns.map(|x| (x, oracle.pixel(x, y))).collect()
}

fn fill(state: &mut State, row: &[(u32, [f32; 3])], y: u32, block: u32) {
    let HdrImage { width, height, pixels } = &mut state.image;
    for &(x, value) in row {
        for line in y..(y + block).min(*height) {
            let begin = (line * *width) as usize;
            pixels[begin + x as usize..begin + (x + block).min(*width) as usize].fill(value);
        }
    }
    state.rows += 1;
    state.version += 1;
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    /// The last look is what the oracle renders at once, to the bit.
    #[test]
    fn refinement_ends_at_the_oracles_picture() {
        let toml = "render = { size = [37, 21] }
            camera = [{ name = \"main\", position = [0, 2, 4], target = [0, 0, 0], vertical_fov = 45 }]
            material = [{ name = \"clay\", type = \"matte\", color = [0.5, 0.4, 0.3] }]
            mesh = [{ shape = \"plane\", size = [3, 3], material = \"clay\" }]
            light = [{ type = \"point\", position = [0.5, 1, 0], intensity = [3, 2, 1] }]";
        let scene = crate::scene::load_embedded("test", toml, &[], &[]).unwrap();
        let camera = &scene.cameras[0];
        let truth = Truth::compute(&scene, camera, scene.render.size);
        let start = Instant::now();
        while truth.done().unwrap() < 1.0 {
            assert!(start.elapsed() < Duration::from_secs(60));
            std::thread::sleep(Duration::from_millis(5));
        }
        let expected = crate::reference::render(&scene, camera, &Options::of_scene(&scene)).unwrap();
        let (image, version) = truth.newer(None).unwrap();
        assert_eq!(image, expected.image);
        assert!(truth.newer(Some(version)).is_none());
    }
}
