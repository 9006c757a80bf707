//! What programs pass to one another through the X server: the clipboard, and files that are dropped.

use super::display::{Client, full, words};
use std::path::Path;

const SELECTION_REQUEST: u8 = 30;
const SELECTION_NOTIFY: u8 = 31;
const CLIENT_MESSAGE: u8 = 33;

impl Client {
    /// Text of the clipboard, from whoever has it.
    pub(super) fn clipboard(&mut self) -> String {
        let window = self.make_window();
        let [selection, target, property] = ["CLIPBOARD", "UTF8_STRING", "AMAS_TEST"].map(|n| self.atom(n));
        self.send(24, 0, &words(&[window, selection, target, property, 0]));
        let answer = self.event(SELECTION_NOTIFY);
        assert_ne!(full(&answer, 20), 0, "nobody has the clipboard");
        let reply = self.ask(20, 0, &words(&[window, property, 0, 0, 1 << 16]));
        let length = full(&reply, 16) as usize;
        String::from_utf8(reply[32..32 + length].to_vec()).unwrap()
    }

    /// Drags a file onto a window and lets it go there (XDND, version 5).
    pub(super) fn drop_file(&mut self, window: u32, file: &Path) {
        let source = self.make_window();
        let names = ["XdndSelection", "text/uri-list", "XdndActionCopy"];
        let [selection, uris, copy] = names.map(|name| self.atom(name));
        self.send(22, 0, &words(&[source, selection, 0]));
        self.message(window, "XdndEnter", [source, 5 << 24, uris, 0, 0]);
        self.message(window, "XdndPosition", [source, 0, 10 << 16 | 10, 0, copy]);
        let request = self.event(SELECTION_REQUEST);
        let [requestor, target, property] = [12, 20, 24].map(|at| full(&request, at));
        let mut text = format!("file://{}\r\n", file.display()).into_bytes();
        let length = text.len() as u32;
        text.resize(text.len().next_multiple_of(4), 0);
        let change = [words(&[requestor, property, target, 8, length]), text].concat();
        self.send(18, 0, &change);
        let notice = words(&[SELECTION_NOTIFY.into(), 0, requestor, selection, target, property, 0, 0]);
        self.send(25, 0, &[words(&[requestor, 0]), notice].concat());
        self.message(window, "XdndDrop", [source, 0, 0, 0, 0]);
    }

    /// Asks for a window's end, as the cross in its frame does.
    pub(super) fn ask_to_close(&mut self, window: u32) {
        let delete = self.atom("WM_DELETE_WINDOW");
        self.message(window, "WM_PROTOCOLS", [delete, 0, 0, 0, 0]);
    }

    /// Takes a window off the screen, or back, as window managers do (EWMH).
    pub(super) fn minimise(&mut self, window: u32, away: bool) {
        const ATOM: u32 = 4;
        let [state, hidden] = ["_NET_WM_STATE", "_NET_WM_STATE_HIDDEN"].map(|name| self.atom(name));
        let states = if away { vec![hidden] } else { vec![] };
        let change = words(&[window, state, ATOM, 32, states.len() as u32]);
        self.send(18, 0, &[change, words(&states)].concat());
        self.send(if away { 10 } else { 8 }, 0, &words(&[window]));
    }

    fn message(&mut self, window: u32, name: &str, data: [u32; 5]) {
        let kind = self.atom(name);
        let head = u32::from_le_bytes([CLIENT_MESSAGE, 32, 0, 0]);
        let event = [words(&[head, window, kind]), words(&data)].concat();
        self.send(25, 0, &[words(&[window, 0]), event].concat());
    }

    fn atom(&mut self, name: &str) -> u32 {
        let mut body = words(&[name.len() as u32]);
        body.extend(name.bytes());
        body.resize(body.len().next_multiple_of(4), 0);
        full(&self.ask(16, 0, &body), 8)
    }

    /// One that is never shown.
    fn make_window(&mut self) -> u32 {
        const INPUT_ONLY: u32 = 2;
        self.id += 1;
        let (id, root) = (self.id, self.root);
        self.send(1, 0, &words(&[id, root, 0, 1 | 1 << 16, INPUT_ONLY << 16, 0, 0]));
        id
    }
}
