//! How far gathered light is, and how far from the truth.

use crate::app::view::gathering::{State, Status};
use egui::Ui;

pub(super) fn show(ui: &mut Ui, status: Status) {
    ui.strong(headline(status));
    let rows = [
        ("state", state(status.state).to_owned()),
        ("frames", format!("{} in {} rounds", status.frames, status.rounds)),
        ("virtual lights", status.virtuals.map_or("none yet".into(), |count| count.to_string())),
    ];
    let rows = rows.into_iter().filter(|(name, _)| status.what.indirect || *name != "virtual lights");
    egui::Grid::new("gathered").num_columns(2).striped(true).show(ui, |ui| {
        for (name, value) in rows {
            ui.weak(name);
            ui.label(value);
            ui.end_row();
        }
    });
}

/// What is gathered, and its estimated error.
fn headline(status: Status) -> String {
    let what = if status.what.indirect { "indirect" } else { "shadows" };
    match status.error {
        Some(error) => format!("{what} ± {} %", digits(100.0 * error)),
        None => format!("{what}, no estimate yet"),
    }
}

/// Two digits of a percentage, and no more than that.
fn digits(percent: f64) -> String {
    match percent {
        p if p < 0.995 => format!("{p:.2}"),
        p if p < 9.95 => format!("{p:.1}"),
        p => format!("{p:.0}"),
    }
}

fn state(state: State) -> &'static str {
    match state {
        State::Waiting => "when the view rests",
        State::Tracing => "tracing",
        State::Gathering => "gathering",
        State::Done => "done",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::gather::Gathered;

    #[test]
    fn errors_have_two_digits() {
        let what = Gathered { indirect: true, ..Gathered::default() };
        let status = Status {
            what,
            state: State::Gathering,
            frames: 40,
            rounds: 2,
            error: Some(0.0131),
            virtuals: None,
        };
        let of = |error| headline(Status { error, ..status });
        assert_eq!(of(Some(0.0131)), "indirect ± 1.3 %");
        assert_eq!(of(Some(0.123)), "indirect ± 12 %");
        assert_eq!(of(Some(0.002)), "indirect ± 0.20 %");
        assert_eq!(of(None), "indirect, no estimate yet");
    }
}
