//! What a scene's frame has to do; nothing else is compiled or recorded.

use super::{FrameSettings, cut, gather};
use crate::gpu::Device;
use crate::gpu_scene::GpuScene;
use crate::passes::forward::Work;
use crate::scene::settings::FrontEnd;

/// Up to so many area lights every pixel evaluates them all.
const AREA_LIGHTS_WITHOUT_MASKS: u32 = 8;

/// Of a scene and its settings on a device.
pub(super) fn work(device: &Device, scene: &GpuScene, settings: &FrameSettings) -> Work {
    let lights = &scene.lights;
    let drawn = !scene.draws.is_empty();
    let gathered = gather::wanted(scene, settings);
    let first_unranged = if settings.brute_force { 0 } else { lights.ranged };
    let shaded = drawn && (settings.preview || !gathered.points);
    let lists = shaded && first_unranged > 0;
    let compute = match settings.front_end {
        FrontEnd::Auto => device.is_cpu(),
        FrontEnd::Fragment => false,
        FrontEnd::Compute => true,
    };
    let resolve = lists && compute && !scene.resolved.specializations.is_empty();
    let area = if drawn { scene.area.count } else { 0 };
    let unranged = shaded && lights.lights.len() > first_unranged;
    let cut = unranged
        && !lights.moments.is_empty()
        && settings.light_error >= cut::LEAST_ERROR
        && !settings.brute_force;
    Work {
        unranged: unranged && !cut,
        cut,
        first_unranged: first_unranged as u32,
        background: settings.background != [0.0; 3],
        lists,
        resolve,
        indirect: lists && !(resolve && scene.resolved.has_all()),
        folded: false,
        area,
        masks: area > AREA_LIGHTS_WITHOUT_MASKS && !settings.brute_force,
        luminaires: !scene.area.luminaires.is_empty(),
        gathered,
        tonemap: settings.tonemap,
        encoding: settings.encoding,
    }
}

/// Whether anything is sorted into clusters.
pub(super) fn clustered(work: Work) -> bool {
    work.lists || work.cut || work.masks
}

/// In frame order.
pub(super) fn pass_names(work: Work) -> Vec<&'static str> {
    let passes = [
        ("prepass", true),
        ("cluster", clustered(work)),
        ("resolve", work.resolve),
        ("direct", true),
        ("indirect", work.indirect),
        ("present", true),
    ];
    passes.into_iter().filter(|(_, recorded)| *recorded).map(|(name, _)| name).collect()
}
