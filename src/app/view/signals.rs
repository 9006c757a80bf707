//! SIGINT and SIGTERM close the window; a second one ends the program at once.

use super::Event;
use crate::error::{Error, Result};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use winit::event_loop::EventLoopProxy;

/// From now on the signals arrive as [`Event::Quit`].
pub(super) fn listen(proxy: EventLoopProxy<Event>) -> Result<()> {
    let mut signals = Signals::new([SIGINT, SIGTERM])
        .map_err(|error| Error::usage(format!("signals cannot be listened to: {error}"), "report this"))?;
    std::thread::spawn(move || {
        let mut signals = signals.forever();
        if signals.next().is_some() && proxy.send_event(Event::Quit).is_ok() {
            // Whoever asks twice does not want to wait for the picture that is being rendered.
            let number = signals.next().unwrap_or(SIGINT);
            signal_hook::low_level::exit(128 + number);
        }
    });
    Ok(())
}
