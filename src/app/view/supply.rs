//! Lights to gather from, made beside the window's thread and one round ahead of it.
//!
//! One thread does all of it: a window on a software device has to draw meanwhile. It waits while the view moves, and ends
//! within a task of its own when nobody wants its lights any more; it is not waited for.

use super::Event;
use crate::error::Result;
use crate::gpu::Device;
use crate::passes::gather::{Gathered, GatheredLights};
use crate::refine::Rounds;
use crate::scene::Scene;
use glam::Vec3;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use winit::event_loop::EventLoopProxy;

/// Lights of a round on the device.
pub(super) struct Lights {
    pub(super) lights: GatheredLights,
    /// Of them, those that stand for reflected light.
    pub(super) virtuals: usize,
}

/// The thread, and what it has made.
pub(super) struct Supply(Arc<Shared>);

struct Shared {
    state: Mutex<State>,
    changed: Condvar,
    /// Held while the thread uses it; taken away when the supply ends: then it is not used any more.
    device: Mutex<Option<Arc<Device>>>,
}

#[derive(Default)]
struct State {
    paused: bool,
    ended: bool,
    ready: Option<Result<Lights>>,
}

impl Supply {
    /// Begins with the first round; whenever one is ready, the event loop hears of it.
    pub(super) fn start(
        device: &Arc<Device>,
        scene: &Arc<Scene>,
        (origin, wanted): (Vec3, Gathered),
        proxy: &EventLoopProxy<Event>,
    ) -> Self {
        let shared = Arc::new(Shared {
            state: Mutex::default(),
            changed: Condvar::new(),
            device: Mutex::new(Some(device.clone())),
        });
        let (theirs, scene, proxy) = (shared.clone(), scene.clone(), proxy.clone());
        // Without its threads the system has none to spare, and the picture stays as it is.
        if let Ok(pool) =
            rayon::ThreadPoolBuilder::new().num_threads(1).thread_name(|_| "lights".into()).build()
        {
            pool.spawn(move || theirs.supply(&Rounds::new(&scene, origin, wanted, 0.0), &proxy));
        }
        Self(shared)
    }

    /// Keeps the thread waiting, or lets it go on.
    pub(super) fn pause(&self, paused: bool) {
        self.0.state().paused = paused;
        self.0.changed.notify_all();
    }

    /// The next round, if it is ready.
    pub(super) fn take(&self) -> Result<Option<Lights>> {
        let ready = self.0.state().ready.take();
        self.0.changed.notify_all();
        ready.transpose()
    }
}

impl Drop for Supply {
    fn drop(&mut self) {
        self.0.state().ended = true;
        self.0.changed.notify_all();
        // Waits for an upload that is under way.
        self.0.device.lock().unwrap_or_else(PoisonError::into_inner).take();
        self.0.state().ready = None;
    }
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits while `hindered`; whether to go on then.
    fn wait(&self, hindered: impl Fn(&State) -> bool) -> bool {
        let hindered = |state: &mut State| !state.ended && hindered(state);
        let state = self.changed.wait_while(self.state(), hindered);
        !state.unwrap_or_else(PoisonError::into_inner).ended
    }

    fn supply(&self, rounds: &Rounds<'_>, proxy: &EventLoopProxy<Event>) {
        for number in 0.. {
            let free = self.wait(|state| state.paused || state.ready.is_some());
            if !free || self.make(rounds, number).is_none() {
                return;
            }
            let told = proxy.send_event(Event::Lights);
            if told.is_err() || !rounds.differ() {
                return;
            }
        }
    }

    /// Makes a round ready, unless the supply ends meanwhile.
    fn make(&self, rounds: &Rounds<'_>, number: u32) -> Option<()> {
        let proceed = || self.wait(|state| state.paused);
        let round = rounds.round(number, &proceed)?;
        if !proceed() {
            return None;
        }
        let device = self.device.lock().unwrap_or_else(PoisonError::into_inner);
        let lights = round.upload(device.as_ref()?);
        let ready = lights.map(|lights| Lights { lights, virtuals: round.virtual_lights() });
        self.state().ready = Some(ready);
        Some(())
    }
}
