//! The window's overlay: textured triangles over a finished picture, in a copy of it.
//!
//! 1. Columns of the picture, and of another beside it where there is one, are copied to the canvas.
//! 2. One render pass draws the triangles over them; colours blend encoded, as the canvas holds them.
//!
//! The picture itself stays as it is: while the view rests, the overlay alone is drawn anew.

use crate::error::Result;
use crate::gpu::{
    Attachment, Blend, Buffer, BufferUse, Commands, Cull, DepthTest, DescriptorSets, Device, Format,
    Framebuffer, GraphicsDescription, GraphicsPipeline, Image, ImageDescription, Outside, PipelineLayout,
    RenderPass, Sampler, Specialization, Subpass, Use, Vertices, shaders,
};
use crate::scene::settings::Encoding;
use crate::shared::{self, OverlayConstants};
use crate::targets::ldr_format;
use bytemuck::{Pod, Zeroable};
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

/// A corner of a triangle, as [`Vertices::Window`] says.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Corner {
    /// Points of the window, from its upper left.
    pub position: [f32; 2],
    /// Texture coordinate.
    pub uv: [f32; 2],
    /// sRGB-encoded, premultiplied with alpha.
    pub color: [u8; 4],
}

/// Triangles under one texture and within one rectangle.
#[derive(Clone, Debug)]
pub struct Batch {
    /// Number of the texture.
    pub texture: u64,
    /// Corner of the rectangle, in pixels of the canvas.
    pub corner: [u32; 2],
    /// Its size, within the canvas.
    pub size: [u32; 2],
    /// Triangles.
    pub triangles: Range<u32>,
}

/// What is drawn.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// Pixels a point.
    pub scale: f32,
    /// Corners of all triangles.
    pub corners: Vec<Corner>,
    /// Triangles: their corners.
    pub triangles: Vec<[u32; 3]>,
    /// What of them to draw, from back to front.
    pub batches: Vec<Batch>,
}

/// What lies below: a picture, and from a column on another.
pub struct Ground<'a> {
    /// The picture, in use [`Use::TransferRead`].
    pub picture: &'a Image,
    /// Another of its size and format, in the same use, and its first column.
    pub beside: Option<(&'a Image, u32)>,
}

/// The overlay's pipeline, textures and canvas.
pub struct Overlay {
    pass: RenderPass,
    pipeline: GraphicsPipeline,
    layout: Arc<PipelineLayout>,
    sampler: Sampler,
    canvas: Option<Canvas>,
    textures: HashMap<u64, Texture>,
    format: Format,
    corners: Buffer<Corner>,
    triangles: Buffer<[u32; 3]>,
    device: Arc<Device>,
}

struct Canvas {
    framebuffer: Framebuffer,
    image: Arc<Image>,
}

struct Texture {
    set: DescriptorSets,
    image: Image,
}

impl Overlay {
    /// Compiles the pass for pictures of that encoding.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(device: &Arc<Device>, encoding: Encoding) -> Result<Self> {
        let format = ldr_format(encoding);
        let layout = Arc::new(PipelineLayout::new(device, &[shared::overlay::BINDINGS])?);
        let pass = RenderPass::new(
            device,
            "overlay",
            &[Attachment { format, before: Use::TransferWrite, after: Use::TransferRead }],
            &[Subpass { color: &[0], input: &[], depth: None }],
            &[],
            &[
                Outside::Before(Use::TransferWrite, Use::ColorWrite),
                Outside::After(Use::ColorWrite, Use::TransferRead),
            ],
        )?;
        let pipeline = GraphicsPipeline::new(
            device,
            &layout,
            &GraphicsDescription {
                name: "overlay",
                vertex: shaders::OVERLAY_OVERLAY_VERT,
                fragment: Some(shaders::OVERLAY_OVERLAY_FRAG),
                specialization: &Specialization::default().with(shared::SPEC_ENCODING, encoding as u32),
                vertices: Vertices::Window,
                depth: DepthTest::Off,
                blend: Some(Blend::Over),
                cull: Cull::None,
                pass: &pass,
                subpass: 0,
            },
        )?;
        Ok(Self {
            pass,
            pipeline,
            layout,
            sampler: Sampler::clamped(device)?,
            canvas: None,
            textures: HashMap::new(),
            format,
            corners: Buffer::new(device, "overlay corners", BufferUse::Stream, 0)?,
            triangles: Buffer::new(device, "overlay triangles", BufferUse::Stream, 0)?,
            device: device.clone(),
        })
    }

    /// Sets a texture: its size, and its texels, sRGB-encoded and premultiplied with alpha.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] where memory is short.
    pub fn set_texture(&mut self, number: u64, size: [u32; 2], texels: &[[u8; 4]]) -> Result<()> {
        if self.textures.get(&number).is_none_or(|texture| texture.image.size() != size) {
            let image = Image::new(
                &self.device,
                &ImageDescription {
                    name: "overlay texture",
                    format: ldr_format(Encoding::Srgb),
                    size,
                    layers: None,
                    mips: 1,
                    uses: &[Use::TransferWrite, Use::Texture],
                },
            )?;
            let set = self.layout.allocate(shared::overlay::SET, 1)?;
            set.get(0).textures(shared::overlay::OVERLAY_TEXTURE, &[&image], &self.sampler);
            self.textures.insert(number, Texture { set, image });
        }
        self.textures[&number].image.upload(&[texels], Use::Texture)
    }

    /// Forgets a texture.
    pub fn free_texture(&mut self, number: u64) {
        self.textures.remove(&number);
    }

    /// Draws over a picture; the result, in use [`Use::TransferRead`], stays as it is until the next.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn draw(&mut self, ground: &Ground<'_>, drawing: &Drawing) -> Result<Arc<Image>> {
        let size = ground.picture.size();
        // The window may still copy what was drawn before.
        let (canvas, before) = match self.canvas.take().filter(|canvas| canvas.image.size() == size) {
            Some(canvas) => (canvas, Use::TransferRead),
            None => (Canvas::new(&self.device, &self.pass, self.format, size)?, Use::Nothing),
        };
        grow(&self.device, &mut self.corners, drawing.corners.len())?;
        grow(&self.device, &mut self.triangles, drawing.triangles.len())?;
        self.corners.write(&drawing.corners)?;
        self.triangles.write(&drawing.triangles)?;
        self.device.run("overlay", |cmd| {
            cmd.transition(&canvas.image, before, Use::TransferWrite);
            let first = ground.beside.map_or(size[0], |(_, column)| column.min(size[0]));
            cmd.copy_columns(ground.picture, &canvas.image, 0..first);
            if let Some((beside, _)) = ground.beside {
                cmd.copy_columns(beside, &canvas.image, first..size[0]);
            }
            cmd.begin_pass(&self.pass, &canvas.framebuffer);
            self.record(cmd, size, drawing);
            cmd.end_pass();
            Ok(())
        })?;
        Ok(self.canvas.insert(canvas).image.clone())
    }

    fn record(&self, cmd: &mut Commands, size: [u32; 2], drawing: &Drawing) {
        cmd.bind_graphics(&self.pipeline);
        cmd.push(&OverlayConstants { clip_per_point: size.map(|side| 2.0 * drawing.scale / side as f32) });
        cmd.bind_triangles(&self.corners, &self.triangles);
        for batch in &drawing.batches {
            let Some(texture) = self.textures.get(&batch.texture) else { continue };
            cmd.bind_sets(shared::overlay::SET, &[texture.set.get(0)]);
            cmd.clip(batch.corner, batch.size);
            cmd.draw_triangles(batch.triangles.start, batch.triangles.end - batch.triangles.start);
        }
    }
}

impl Canvas {
    fn new(device: &Arc<Device>, pass: &RenderPass, format: Format, size: [u32; 2]) -> Result<Self> {
        let image = Image::new(
            device,
            &ImageDescription {
                name: "canvas",
                format,
                size,
                layers: None,
                mips: 1,
                uses: &[Use::TransferWrite, Use::ColorWrite, Use::TransferRead],
            },
        )?;
        Ok(Self { framebuffer: Framebuffer::new(device, pass, &[&image])?, image: Arc::new(image) })
    }
}

/// Room for `len` elements, and for half as many again, so that a growing window does not allocate for every picture.
fn grow<T: Pod>(device: &Arc<Device>, buffer: &mut Buffer<T>, len: usize) -> Result<()> {
    if buffer.len() < len {
        *buffer = Buffer::new(device, "overlay", BufferUse::Stream, len + len / 2)?;
    }
    Ok(())
}
