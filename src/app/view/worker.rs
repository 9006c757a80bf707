//! The thread that loads.
//!
//! The same one for as long as nothing is cancelled, because glibc gives threads heaps of their own, each with its own gaps.

use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;

type Job = Box<dyn FnOnce() + Send>;

/// A thread that does one job after the other.
pub(super) struct Worker {
    jobs: Sender<Job>,
    thread: JoinHandle<()>,
}

impl Worker {
    pub(super) fn start() -> Self {
        let (jobs, incoming) = channel::<Job>();
        let thread = std::thread::spawn(move || incoming.iter().for_each(|job| job()));
        Self { jobs, thread }
    }

    pub(super) fn run(&self, job: impl FnOnce() + Send + 'static) {
        // Where the thread has panicked, the job is lost, and the panic was reported.
        let _ = self.jobs.send(Box::new(job));
    }

    /// No more jobs: the thread ends after the one it does.
    #[must_use]
    pub(super) fn retire(self) -> JoinHandle<()> {
        self.thread
    }
}
