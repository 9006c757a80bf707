//! What other programs take for `scenes/light_grid.toml`: facts that were measured once, as they were.

/// A program on a driver.
pub(super) struct Peer {
    pub(super) name: &'static str,
    pub(super) driver: &'static str,
    /// Frames of 640 × 360 pixels.
    pub(super) frames: &'static [Frame],
    /// Frame of 1280 × 720 pixels with 4,096 lights.
    pub(super) large: Option<Frame>,
}

/// Median milliseconds of a frame.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) lights: u64,
    pub(super) wall_ms: f64,
    /// CPU time of the whole process; `None`: not measured, of a browser.
    pub(super) cpu_ms: Option<f64>,
}

const fn frame(lights: u64, wall_ms: f64, cpu_ms: f64) -> Frame {
    Frame { lights, wall_ms, cpu_ms: Some(cpu_ms) }
}

const fn wall(lights: u64, wall_ms: f64) -> Frame {
    Frame { lights, wall_ms, cpu_ms: None }
}

/// Of each the median, with a depth prepass, on a machine with two cores and no GPU.
pub(super) const PEERS: [Peer; 5] = [
    Peer {
        name: "Bevy 0.19.1",
        driver: "lavapipe, Mesa 22.3.6",
        frames: &[
            frame(0, 261.0, 477.0),
            frame(256, 364.0, 696.0),
            frame(1024, 763.0, 1425.0),
            frame(4096, 2724.0, 5400.0),
        ],
        large: None,
    },
    Peer {
        name: "Bevy 0.19.1",
        driver: "lavapipe, Mesa 25.0.7",
        frames: &[
            frame(0, 122.0, 168.0),
            frame(256, 105.0, 170.0),
            frame(1024, 341.0, 337.0),
            frame(4096, 696.0, 1170.0),
            frame(16_384, 2375.0, 5360.0),
            frame(65_536, 22_276.0, 26_023.0),
        ],
        large: Some(frame(4096, 1701.0, 3440.0)),
    },
    Peer {
        name: "Godot 4.6.3",
        driver: "lavapipe, Mesa 25.0.7",
        frames: &[
            frame(0, 106.0, 144.0),
            frame(256, 161.0, 244.0),
            frame(1024, 288.0, 489.0),
            frame(4096, 761.0, 1430.0),
            frame(16_384, 2940.0, 5613.0),
        ],
        large: Some(frame(4096, 1664.0, 3203.0)),
    },
    Peer {
        name: "three.js r187",
        driver: "SwiftShader",
        frames: &[wall(256, 391.0), wall(1024, 1077.0), wall(4096, 3377.0)],
        large: None,
    },
    Peer {
        name: "Babylon.js 9.34",
        driver: "SwiftShader",
        frames: &[wall(256, 331.0), wall(1024, 712.0), wall(4096, 2392.0)],
        large: None,
    },
];

/// What to think of before comparing.
pub(super) const CAVEATS: &str = "\
- The others were measured once, on a machine with two cores and no GPU, with a depth prepass, and are not measured by this \
command. Compare only where the device named at the top is lavapipe on such a machine, and no closer than to a factor of two.\n\
- Drivers differ: amas takes 10 to 13 % less CPU time on Mesa 25.0.7 than on 22.3.6. SwiftShader is another rasteriser \
altogether. Of browsers only wall time is known; elsewhere CPU time is the fairer figure.\n\
- The scene is the same, the pictures are not: each program shades with its own standard material and lets lights fade in its \
own way. Bevy and Godot have one shader for many features, of which this scene uses few; Mesa 22.3.6 runs both sides of a \
branch, which is the likeliest reason for their times there. amas compiles only what a scene uses.\n\
- Of lights that are dense three.js evaluates 64 a cluster at most, and above 8,192 it draws none: it has no figures there. Bevy's \
lists grow by what earlier frames report, which are wrong until then.\n";
