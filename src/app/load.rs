//! What else runs on the machine, from the kernel's accounts: times taken on a busy one mislead.

use super::terminal::complain;
use cpu_time::ProcessTime;
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// Share of all processors that others may take before it is worth a warning. CPU time does not go by load alone: on two
/// processors of which others took 1.4 in one run and 0.9 in the next, 18 points of the same program, small frames of ten
/// samples, took 1.03 to 1.8 times as much, and 9 of them were called slower. Between 1.2 and 1.45, five points of whole size
/// lay 3 to 7 % lower in one run than in another.
const TOLERATED: f64 = 0.05;
/// The accounts are kept in hundredths of a second: over less time than this they say little.
const SHORTEST: Duration = Duration::from_millis(500);

/// A moment from which on load is measured.
pub(super) struct Since {
    wall: Instant,
    own: ProcessTime,
    ticks: Option<Ticks>,
}

/// Time of all processors since the system started, in the kernel's ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ticks {
    busy: u64,
    stolen: u64,
    all: u64,
    processors: u64,
}

/// Mean load over a time, in processors.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub(super) struct Load {
    /// Processors of the machine.
    processors: u64,
    /// Taken by other processes and the kernel.
    others: f64,
    /// Taken by other virtual machines, as far as the hypervisor tells.
    stolen: f64,
}

impl Since {
    pub(super) fn now() -> Self {
        let ticks = std::fs::read_to_string("/proc/stat").ok().and_then(|text| Ticks::parse(&text));
        Self { wall: Instant::now(), own: ProcessTime::now(), ticks }
    }

    /// The load since then, waited for until it can be told; `None` where the system does not tell.
    pub(super) fn load(&self) -> Option<Load> {
        let before = self.ticks?;
        std::thread::sleep(SHORTEST.saturating_sub(self.wall.elapsed()));
        let now = Self::now().ticks?;
        Load::between(before, now, self.own.elapsed().as_secs_f64() / self.wall.elapsed().as_secs_f64())
    }
}

impl Ticks {
    /// See proc_stat(5): user, nice, system, idle, iowait, irq, softirq, steal; guests are part of users.
    fn parse(stat: &str) -> Option<Self> {
        let first = stat.lines().next()?.strip_prefix("cpu ")?;
        let columns: Vec<u64> = first.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let [user, nice, system, idle, wait, irq, soft, stolen] = *columns.first_chunk()?;
        let busy = user + nice + system + irq + soft;
        let processors = stat.lines().skip(1).take_while(|line| line.starts_with("cpu")).count() as u64;
        Some(Self { busy, stolen, all: busy + idle + wait + stolen, processors })
    }
}

impl Load {
    /// `own`: processors that this process took.
    fn between(before: Ticks, now: Ticks, own: f64) -> Option<Self> {
        let all = now.all.checked_sub(before.all).filter(|ticks| *ticks > 0)?;
        let processors = now.processors;
        let part = |ticks: u64| ticks as f64 / all as f64 * processors as f64;
        Some(Self {
            processors,
            others: (part(now.busy.saturating_sub(before.busy)) - own).max(0.0),
            stolen: part(now.stolen.saturating_sub(before.stolen)),
        })
    }

    /// Whether times taken meanwhile are to be doubted.
    pub(super) fn is_busy(&self) -> bool {
        self.others + self.stolen > TOLERATED * self.processors as f64
    }

    /// What a page says of times taken meanwhile.
    pub(super) fn sentence(&self) -> String {
        let others = self.others + self.stolen;
        if self.is_busy() {
            return format!(
                "**The machine was busy meanwhile**: others took {others:.2} of its {} processors, so times are inflated by an \
                 unknown factor, and their order is to be doubted where they are close.",
                self.processors
            );
        }
        format!(
            "Nothing else ran to speak of: others took {others:.2} of {} processors meanwhile.",
            self.processors
        )
    }

    /// Warns of a busy machine.
    pub(super) fn warn(&self, when: &str) {
        if self.is_busy() {
            complain(format_args!(
                "warning: the machine is busy {when}: others take {:.2} of its {} processors\n  remedy: end them, or \
                 measure again on an idle machine; until then, doubt times and verdicts",
                self.others + self.stolen,
                self.processors
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEFORE: &str = "cpu  100 20 30 800 50 0 0 0 7 0\ncpu0 1\ncpu1 1\nintr 5\n";
    const AFTER: &str = "cpu  180 20 40 880 50 5 5 20 9 0\ncpu0 1\ncpu1 1\nintr 9\n";

    /// 200 ticks of two processors, one second: 100 busy, 20 stolen, of which 0.7 s were our own.
    #[test]
    fn load_of_the_others() {
        let [before, after] = [BEFORE, AFTER].map(|text| Ticks::parse(text).unwrap());
        assert_eq!(before, Ticks { busy: 150, stolen: 0, all: 1000, processors: 2 });
        let load = Load::between(before, after, 0.7).unwrap();
        assert_eq!(load.processors, 2);
        assert!((load.others - 0.3).abs() < 1e-12 && (load.stolen - 0.2).abs() < 1e-12, "{load:?}");
        assert!(load.is_busy());
        // Rounding of the accounts is no load, and does not become a negative one.
        let own = Load { stolen: 0.0, ..Load::between(before, after, 1.01).unwrap() };
        assert!(own.others == 0.0 && !own.is_busy(), "{own:?}");
    }

    #[test]
    fn accounts_that_do_not_tell() {
        for text in ["", "cpu\n", "cpu  1 2 3\n", "intr 5\n"] {
            assert_eq!(Ticks::parse(text), None, "{text:?}");
        }
        let still = Ticks::parse(BEFORE).unwrap();
        assert_eq!(Load::between(still, still, 0.0), None);
    }
}
