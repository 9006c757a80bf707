//! Windows whose surface goes: let go of and taken up again, as a suspended program does, and destroyed by somebody else.
//!
//! No desktop suspends a program, so these have a window of their own, in a process of its own on the test's display.

use super::display::Display;
use amas::Gpu;
use amas::gpu::{Image, ImageDescription, Options, Shown, Swapchain, Use, WindowOptions};
use amas::scene::settings::Encoding;
use amas::targets::ldr_format;
use std::process::Command;
use std::sync::Arc;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::platform::x11::EventLoopBuilderExtX11;
use winit::window::{Window, WindowId};

/// Set where the test's body is to run.
const INSIDE: &str = "AMAS_TEST_WINDOW";

const SIZE: [u32; 2] = [64, 48];

/// An open window, and a picture for it.
struct Opened {
    device: Arc<Gpu>,
    swapchain: Swapchain,
    picture: Arc<Image>,
}

impl Opened {
    fn new(event_loop: &ActiveEventLoop) -> Self {
        let attributes = Window::default_attributes().with_inner_size(PhysicalSize::new(SIZE[0], SIZE[1]));
        let window = Arc::new(event_loop.create_window(attributes).unwrap());
        let options = Options { device: Some("llvmpipe".into()), validate: true, ray_queries: None };
        let display = event_loop.owned_display_handle();
        let (device, swapchain) =
            Gpu::open_for_window(&options, &window, display, &WindowOptions::default()).unwrap();
        let description = ImageDescription {
            name: "picture",
            format: ldr_format(Encoding::Srgb),
            size: SIZE,
            layers: None,
            mips: 1,
            uses: &[Use::TransferWrite, Use::TransferRead, Use::ColorWrite],
        };
        let picture = Image::new(&device, &description).unwrap();
        let texels = vec![[200_u8, 100, 50, 255]; (SIZE[0] * SIZE[1]) as usize];
        picture.upload(&[&texels], Use::TransferRead).unwrap();
        Self { device, swapchain, picture: Arc::new(picture) }
    }

    fn show(&mut self) -> Shown {
        self.swapchain.show(&self.picture, || ()).unwrap()
    }
}

/// Runs once the window system is there.
struct Body(fn(&ActiveEventLoop));

impl ApplicationHandler for Body {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        (self.0)(event_loop);
        event_loop.exit();
    }

    fn window_event(&mut self, _: &ActiveEventLoop, _: WindowId, _: WindowEvent) {}
}

/// Runs a test's body in a process of its own.
fn inside(test: &str, body: fn(&ActiveEventLoop)) {
    if std::env::var_os(INSIDE).is_some() {
        let event_loop = EventLoop::builder().with_any_thread(true).build().unwrap();
        event_loop.run_app(&mut Body(body)).unwrap();
        return;
    }
    let display = Display::start();
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", test, "--nocapture"])
        .env(INSIDE, "1")
        .env("DISPLAY", &display.name)
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .unwrap();
    let said =
        format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && said.contains("1 passed"), "{said}");
}

#[test]
fn a_suspended_window_shows_pictures_again() {
    inside("surface::a_suspended_window_shows_pictures_again", |event_loop| {
        let mut opened = Opened::new(event_loop);
        for _ in 0..3 {
            assert!(opened.swapchain.resize(SIZE).unwrap());
            for _ in 0..3 {
                assert_eq!(opened.show(), Shown::Yes);
            }
            opened.swapchain.suspend();
            assert_eq!(opened.show(), Shown::OutOfDate);
        }
        let device = opened.device.clone();
        drop(opened);
        device.require_silence().unwrap();
    });
}

/// The driver says that the surface is lost, and there is none to be made again.
#[test]
fn a_window_that_is_lost_is_said() {
    inside("surface::a_window_that_is_lost_is_said", |event_loop| {
        let mut opened = Opened::new(event_loop);
        assert!(opened.swapchain.resize(SIZE).unwrap());
        assert_eq!(opened.show(), Shown::Yes);
        let mut client = super::display::Client::new(&std::env::var("DISPLAY").unwrap());
        let window = client.window_of_size(SIZE.map(|side| side as u16)).unwrap();
        client.destroy(window);
        assert_eq!(client.window_of_size(SIZE.map(|side| side as u16)), None);
        for _ in 0..3 {
            assert_eq!(opened.show(), Shown::OutOfDate);
            let error = opened.swapchain.resize(SIZE).unwrap_err();
            assert_eq!(error.exit_code(), 3);
            assert!(error.to_string().contains("the window was lost"), "{error}");
        }
        let device = opened.device.clone();
        drop(opened);
        device.require_silence().unwrap();
    });
}
