//! How long it takes until there is something to see.

use crate::app::terminal::print;
use crate::error::Result;
use std::time::Instant;

/// Times since the program's start.
pub(super) struct Startup {
    begin: Instant,
    /// `None` where nobody asked.
    steps: Option<Vec<String>>,
}

impl Startup {
    /// From now on; silent unless they are `wanted`.
    pub(super) fn new(wanted: bool) -> Self {
        Self { begin: Instant::now(), steps: wanted.then(Vec::new) }
    }

    /// Something was reached.
    pub(super) fn reached(&mut self, step: &str) {
        if let Some(steps) = &mut self.steps {
            steps.push(format!("{step} {:.0} ms", self.begin.elapsed().as_secs_f64() * 1e3));
        }
    }

    /// As [`Startup::reached`], unless it was before.
    pub(super) fn reached_once(&mut self, step: &str) {
        let before = self.steps.iter().flatten().any(|line| line.split(' ').next() == Some(step));
        if !before {
            self.reached(step);
        }
    }

    /// As [`Startup::reached`], the last of all: prints them.
    pub(super) fn done(&mut self, step: &str) -> Result<()> {
        self.reached(step);
        self.steps.take().map_or(Ok(()), |steps| print(steps.join(", ")))
    }
}
