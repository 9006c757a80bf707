//! An X server of the tests' own, its screen, and a client that does what a user and a window manager do.

use std::io::{BufRead, BufReader, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

/// A running Xvfb.
pub(super) struct Display {
    /// For the environment variable DISPLAY.
    pub(super) name: String,
    server: Child,
    folder: tempfile::TempDir,
}

impl Display {
    pub(super) fn start() -> Self {
        Self::of_size([320, 240])
    }

    pub(super) fn of_size([width, height]: [usize; 2]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0"])
            .arg(format!("{width}x{height}x24"))
            .args(["-nolisten", "tcp", "-fbdir"])
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("Xvfb: {error}; run ./setup, which installs it"));
        let mut number = String::new();
        let answer = BufReader::new(server.stdout.take().unwrap()).read_line(&mut number);
        let display = Self { name: format!(":{}", number.trim()), server, folder };
        assert!(answer.unwrap() > 0, "Xvfb does not start");
        display
    }

    /// The screen's upper left corner, row by row.
    pub(super) fn corner(&self, [width, height]: [usize; 2]) -> Vec<[u8; 3]> {
        // An XWD file: a header of big-endian words, a colour map, rows of pixels.
        let file = std::fs::read(self.folder.path().join("Xvfb_screen0")).unwrap();
        let word = |index: usize| u32::from_be_bytes(file[4 * index..][..4].try_into().unwrap()) as usize;
        let (header, row, colors) = (word(0), word(12), word(19));
        assert_eq!((word(7), word(11)), (0, 32), "pixels are not BGRX");
        let pixels = &file[header + 12 * colors..];
        (0..height)
            .flat_map(|y| pixels[y * row..][..4 * width].chunks_exact(4))
            .map(|pixel| [pixel[2], pixel[1], pixel[0]])
            .collect()
    }

    pub(super) fn connect(&self) -> Client {
        Client::new(&self.name)
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        // Asked to end, it removes its lock and socket; done from here, that might hit the server that has its number next.
        let _ = Command::new("kill").arg(self.server.id().to_string()).status();
        let _ = self.server.wait();
    }
}

/// As much of the X protocol as it takes to move a window and to use keyboard and mouse.
pub(super) struct Client {
    stream: UnixStream,
    pub(super) root: u32,
    xtest: u8,
    /// The next window's.
    pub(super) id: u32,
    events: Vec<[u8; 32]>,
}

impl Client {
    pub(super) fn new(display: &str) -> Self {
        let socket = PathBuf::from(format!("/tmp/.X11-unix/X{}", &display[1..]));
        let mut stream = UnixStream::connect(socket).unwrap();
        // Little-endian, protocol 11, no authorisation.
        stream.write_all(&[b'l', 0, 11, 0, 0, 0, 0, 0, 0, 0, 0, 0]).unwrap();
        let mut head = [0; 8];
        stream.read_exact(&mut head).unwrap();
        assert_eq!(head[0], 1, "the X server refuses");
        let mut setup = vec![0; 4 * usize::from(half(&head, 6))];
        stream.read_exact(&mut setup).unwrap();
        // The first screen follows the vendor's name and the pixmap formats.
        let vendor = usize::from(half(&setup, 16)).next_multiple_of(4);
        let screen = 32 + vendor + 8 * usize::from(setup[21]);
        stream.set_read_timeout(Some(super::PATIENCE)).unwrap();
        let (root, id) = (full(&setup, screen), full(&setup, 4));
        let mut client = Self { stream, root, xtest: 0, id, events: Vec::new() };
        let extension = client.ask(98, 0, b"\x05\0\0\0XTEST\0\0\0");
        assert_eq!(extension[8], 1, "the X server has no XTEST");
        client.xtest = extension[9];
        client
    }

    pub(super) fn window_of_size(&mut self, size: [u16; 2]) -> Option<u32> {
        let tree = self.ask(15, 0, &self.root.to_le_bytes());
        let windows: Vec<u32> = (0..usize::from(half(&tree, 16))).map(|i| full(&tree, 32 + 4 * i)).collect();
        windows.into_iter().find(|window| {
            let geometry = self.ask(14, 0, &window.to_le_bytes());
            [half(&geometry, 16), half(&geometry, 18)] == size
        })
    }

    pub(super) fn resize(&mut self, window: u32, [width, height]: [u32; 2]) {
        const WIDTH_AND_HEIGHT: u32 = 4 | 8;
        self.send(12, 0, &words(&[window, WIDTH_AND_HEIGHT, width, height]));
    }

    pub(super) fn place(&mut self, window: u32, [x, y]: [u32; 2]) {
        const X_AND_Y: u32 = 1 | 2;
        self.send(12, 0, &words(&[window, X_AND_Y, x, y]));
    }

    /// A window of that size in front of all others, in the screen's upper left corner.
    pub(super) fn cover(&mut self, [width, height]: [u32; 2]) -> u32 {
        const INPUT_OUTPUT: u32 = 1;
        const OVERRIDE_REDIRECT: u32 = 0x200;
        self.id += 1;
        let (id, root) = (self.id, self.root);
        let size = width | height << 16;
        self.send(1, 0, &words(&[id, root, 0, size, INPUT_OUTPUT << 16, 0, OVERRIDE_REDIRECT, 1]));
        self.send(8, 0, &words(&[id]));
        id
    }

    pub(super) fn destroy(&mut self, window: u32) {
        self.send(4, 0, &words(&[window]));
    }

    pub(super) fn focus(&mut self, window: u32) {
        const REVERT_TO_POINTER: u8 = 1;
        self.send(42, REVERT_TO_POINTER, &words(&[window, 0]));
    }

    /// Presses or releases a key, as the hardware would.
    pub(super) fn key(&mut self, code: u8, down: bool) {
        self.fake([if down { 2 } else { 3 }, code], [0; 2]);
    }

    /// Presses and releases a key.
    pub(super) fn tap(&mut self, code: u8) {
        self.key(code, true);
        self.key(code, false);
    }

    /// Presses or releases a button: 1 left, 3 right, 4 and 5 the wheel.
    pub(super) fn button(&mut self, number: u8, down: bool) {
        self.fake([if down { 4 } else { 5 }, number], [0; 2]);
    }

    /// Moves the pointer to a place on the screen.
    pub(super) fn point(&mut self, at: [u16; 2]) {
        self.fake([6, 0], at);
    }

    fn fake(&mut self, [kind, detail]: [u8; 2], [x, y]: [u16; 2]) {
        let event = u32::from_le_bytes([kind, detail, 0, 0]);
        let at = u32::from(x) | u32::from(y) << 16;
        self.send(self.xtest, 2, &words(&[event, 0, self.root, 0, 0, at, 0, 0]));
    }

    pub(super) fn send(&mut self, opcode: u8, detail: u8, body: &[u8]) {
        let [low, high] = (1 + body.len() as u16 / 4).to_le_bytes();
        let request = [&[opcode, detail, low, high], body].concat();
        self.stream.write_all(&request).unwrap();
    }

    /// Sends a request and waits for its reply.
    pub(super) fn ask(&mut self, opcode: u8, detail: u8, body: &[u8]) -> Vec<u8> {
        self.send(opcode, detail, body);
        loop {
            let head = self.read();
            if head[0] == 1 {
                let mut reply = head.to_vec();
                reply.resize(32 + 4 * full(&head, 4) as usize, 0);
                self.stream.read_exact(&mut reply[32..]).unwrap();
                return reply;
            }
            self.events.push(head);
        }
    }

    /// Waits for an event of that kind.
    pub(super) fn event(&mut self, kind: u8) -> [u8; 32] {
        loop {
            // The upper bit tells what another client sent.
            if let Some(index) = self.events.iter().position(|event| event[0] & 0x7f == kind) {
                return self.events.remove(index);
            }
            let event = self.read();
            self.events.push(event);
        }
    }

    fn read(&mut self) -> [u8; 32] {
        let mut head = [0; 32];
        self.stream.read_exact(&mut head).unwrap();
        assert_ne!(head[0], 0, "the X server reports error {}", head[1]);
        head
    }
}

pub(super) fn words(words: &[u32]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn half(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([bytes[at], bytes[at + 1]])
}

pub(super) fn full(bytes: &[u8], at: usize) -> u32 {
    u32::from(half(bytes, at)) | u32::from(half(bytes, at + 2)) << 16
}
