//! Pipelines: a description with defaults, and what differs.

mod compiled;

use super::descriptor::PipelineLayout;
use super::device::Device;
use super::render_pass::RenderPass;
use super::{Called, Shader};
use crate::error::Result;
use crate::scene::Vertex;
use ash::vk;
pub(super) use compiled::Compiled;
use compiled::{Key, Raw, State};
use std::ffi::CStr;
use std::mem::offset_of;
use std::sync::Arc;

const MAIN: &CStr = c"main";

/// Specialisation constants: id and value, bools as 0 and 1.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Specialization(Vec<(u32, u32)>);

impl Specialization {
    /// Sets one constant.
    #[must_use]
    pub fn with(mut self, id: u32, value: u32) -> Self {
        self.0.push((id, value));
        self
    }

    /// Sets several.
    #[must_use]
    pub fn with_all(mut self, constants: &[(u32, u32)]) -> Self {
        self.0.extend_from_slice(constants);
        self
    }

    /// The constants set so far.
    #[must_use]
    pub fn values(&self) -> &[(u32, u32)] {
        &self.0
    }

    fn entries(&self) -> (Vec<vk::SpecializationMapEntry>, Vec<u8>) {
        let entries = (0_u32..)
            .zip(&self.0)
            .map(|(i, &(id, _))| vk::SpecializationMapEntry { constant_id: id, offset: 4 * i, size: 4 })
            .collect();
        (entries, self.0.iter().flat_map(|&(_, value)| value.to_ne_bytes()).collect())
    }
}

/// How fragments meet the depth buffer (reversed: nearer is greater).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DepthTest {
    /// No test.
    Off,
    /// Nearer fragments pass and are written.
    WriteNearest,
    /// Only the fragment that the prepass wrote passes: prepass and shading share one `invariant` vertex module.
    Equal,
}

/// How colours are combined with what is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Blend {
    /// Replaced.
    Replace,
    /// Added.
    Add,
    /// Laid over it: colours are premultiplied with their alpha.
    Over,
}

/// Which faces are dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cull {
    /// None.
    None,
    /// Clockwise ones.
    Back,
}

/// What a vertex shader reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Vertices {
    /// Nothing: a triangle over the whole screen.
    None,
    /// [`Vertex`] buffers.
    Surface,
    /// Points in the window: position and texture coordinate, two floats each, and four bytes of colour.
    Window,
}

/// A graphics pipeline.
pub struct GraphicsDescription<'a> {
    /// In captures.
    pub name: &'a str,
    /// Vertex shader.
    pub vertex: Shader,
    /// Fragment shader; without it only depth is written.
    pub fragment: Option<Shader>,
    /// Constants of both shaders.
    pub specialization: &'a Specialization,
    /// What its vertex shader reads.
    pub vertices: Vertices,
    /// Depth test.
    pub depth: DepthTest,
    /// Blending of the subpass's colour attachments, if it has any.
    pub blend: Option<Blend>,
    /// Culling.
    pub cull: Cull,
    /// The pass it is used in.
    pub pass: &'a RenderPass,
    /// Index of its subpass.
    pub subpass: u32,
}

/// A graphics pipeline; viewport and scissor are dynamic.
pub struct GraphicsPipeline {
    pub(super) raw: Arc<Raw>,
    pub(super) layout: Arc<PipelineLayout>,
}

/// A compute pipeline.
pub struct ComputePipeline {
    pub(super) raw: Arc<Raw>,
    pub(super) layout: Arc<PipelineLayout>,
}

impl ComputePipeline {
    /// Compiles a compute shader, unless a pipeline of it is there.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(
        device: &Arc<Device>,
        layout: &Arc<PipelineLayout>,
        shader: Shader,
        specialization: &Specialization,
    ) -> Result<Self> {
        let key = Key::new(device, &[shader], specialization, layout, None);
        let raw = device.compiled.get(key, || compile_compute(device, layout, shader, specialization))?;
        Ok(Self { raw, layout: layout.clone() })
    }
}

fn compile_compute(
    device: &Arc<Device>,
    layout: &PipelineLayout,
    shader: Shader,
    specialization: &Specialization,
) -> Result<Raw> {
    let module = Module::new(device, shader)?;
    let (entries, data) = specialization.entries();
    let constants = vk::SpecializationInfo::default().map_entries(&entries).data(&data);
    let info = [vk::ComputePipelineCreateInfo::default().stage(module.stage(&constants)).layout(layout.raw)];
    // SAFETY: module and layout are alive; the shader's bindings come from the layout's tables.
    let raws = unsafe { device.raw.create_compute_pipelines(device.cache.raw, &info, None) }
        .map_err(|(_, result)| super::failed(format!("pipeline {}", shader.name), result))?;
    device.name(raws[0], shader.name);
    Ok(Raw { pipeline: raws[0], device: device.clone() })
}

impl GraphicsPipeline {
    /// Compiles a graphics pipeline, unless one like it is there.
    ///
    /// # Errors
    /// [`crate::Error::Vulkan`] from the driver.
    pub fn new(
        device: &Arc<Device>,
        layout: &Arc<PipelineLayout>,
        description: &GraphicsDescription<'_>,
    ) -> Result<Self> {
        let &GraphicsDescription { vertices, depth, blend, cull, pass, subpass, .. } = description;
        let state = State { vertices, depth, blend, cull, pass: pass.shape.clone(), subpass };
        let shaders: Vec<_> = std::iter::once(description.vertex).chain(description.fragment).collect();
        let key = Key::new(device, &shaders, description.specialization, layout, Some(state));
        let raw = device.compiled.get(key, || compile_graphics(device, layout, description))?;
        Ok(Self { raw, layout: layout.clone() })
    }
}

fn compile_graphics(
    device: &Arc<Device>,
    layout: &PipelineLayout,
    description: &GraphicsDescription<'_>,
) -> Result<Raw> {
    let vertex = Module::new(device, description.vertex)?;
    let fragment = description.fragment.map(|shader| Module::new(device, shader)).transpose()?;
    let (entries, data) = description.specialization.entries();
    let constants = vk::SpecializationInfo::default().map_entries(&entries).data(&data);
    let stages: Vec<_> =
        std::iter::once(&vertex).chain(&fragment).map(|module| module.stage(&constants)).collect();
    let (stride, attributes) = description.vertices.layout();
    let binding = [vk::VertexInputBindingDescription {
        binding: 0,
        stride: stride as u32,
        input_rate: vk::VertexInputRate::VERTEX,
    }];
    let mut input = vk::PipelineVertexInputStateCreateInfo::default();
    if !attributes.is_empty() {
        input = input.vertex_binding_descriptions(&binding).vertex_attribute_descriptions(attributes);
    }
    let assembly =
        vk::PipelineInputAssemblyStateCreateInfo::default().topology(vk::PrimitiveTopology::TRIANGLE_LIST);
    let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
    let raster = rasterization(description.cull);
    let samples =
        vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(vk::SampleCountFlags::TYPE_1);
    let depth = depth_state(description.depth);
    let colors = description.pass.colors(description.subpass);
    let attachments: Vec<_> = description.blend.map(blend_state).into_iter().cycle().take(colors).collect();
    let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&attachments);
    let dynamic = vk::PipelineDynamicStateCreateInfo::default()
        .dynamic_states(&[vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR]);
    let info = [vk::GraphicsPipelineCreateInfo::default()
        .stages(&stages)
        .vertex_input_state(&input)
        .input_assembly_state(&assembly)
        .viewport_state(&viewport)
        .rasterization_state(&raster)
        .multisample_state(&samples)
        .depth_stencil_state(&depth)
        .color_blend_state(&blend)
        .dynamic_state(&dynamic)
        .layout(layout.raw)
        .render_pass(description.pass.raw)
        .subpass(description.subpass)];
    // SAFETY: everything `info` points to outlives the call.
    let raws = unsafe { device.raw.create_graphics_pipelines(device.cache.raw, &info, None) }
        .map_err(|(_, result)| super::failed(format!("pipeline {}", description.name), result))?;
    device.name(raws[0], description.name);
    Ok(Raw { pipeline: raws[0], device: device.clone() })
}

const ATTRIBUTES: [vk::VertexInputAttributeDescription; 4] = [
    attribute(0, vk::Format::R32G32B32_SFLOAT, offset_of!(Vertex, position)),
    attribute(1, vk::Format::R32G32B32_SFLOAT, offset_of!(Vertex, normal)),
    attribute(2, vk::Format::R32G32B32A32_SFLOAT, offset_of!(Vertex, tangent)),
    attribute(3, vk::Format::R32G32_SFLOAT, offset_of!(Vertex, uv)),
];

const WINDOW_ATTRIBUTES: [vk::VertexInputAttributeDescription; 3] = [
    attribute(0, vk::Format::R32G32_SFLOAT, 0),
    attribute(1, vk::Format::R32G32_SFLOAT, 8),
    attribute(2, vk::Format::R8G8B8A8_UNORM, 16),
];

impl Vertices {
    /// Bytes of a vertex, and what is in them.
    fn layout(self) -> (usize, &'static [vk::VertexInputAttributeDescription]) {
        match self {
            Self::None => (0, &[]),
            Self::Surface => (size_of::<Vertex>(), &ATTRIBUTES),
            Self::Window => (20, &WINDOW_ATTRIBUTES),
        }
    }
}

const fn attribute(location: u32, format: vk::Format, offset: usize) -> vk::VertexInputAttributeDescription {
    vk::VertexInputAttributeDescription { location, binding: 0, format, offset: offset as u32 }
}

fn rasterization(cull: Cull) -> vk::PipelineRasterizationStateCreateInfo<'static> {
    vk::PipelineRasterizationStateCreateInfo::default()
        .polygon_mode(vk::PolygonMode::FILL)
        .cull_mode(match cull {
            Cull::None => vk::CullModeFlags::NONE,
            Cull::Back => vk::CullModeFlags::BACK,
        })
        .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
        .line_width(1.0)
}

fn depth_state(test: DepthTest) -> vk::PipelineDepthStencilStateCreateInfo<'static> {
    let state = vk::PipelineDepthStencilStateCreateInfo::default();
    match test {
        DepthTest::Off => state,
        DepthTest::WriteNearest => {
            state.depth_test_enable(true).depth_write_enable(true).depth_compare_op(vk::CompareOp::GREATER)
        }
        DepthTest::Equal => state.depth_test_enable(true).depth_compare_op(vk::CompareOp::EQUAL),
    }
}

fn blend_state(blend: Blend) -> vk::PipelineColorBlendAttachmentState {
    let state =
        vk::PipelineColorBlendAttachmentState::default().color_write_mask(vk::ColorComponentFlags::RGBA);
    match blend {
        Blend::Replace => state,
        Blend::Add => state
            .blend_enable(true)
            .src_color_blend_factor(vk::BlendFactor::ONE)
            .dst_color_blend_factor(vk::BlendFactor::ONE)
            .src_alpha_blend_factor(vk::BlendFactor::ONE)
            .dst_alpha_blend_factor(vk::BlendFactor::ONE),
        Blend::Over => state
            .blend_enable(true)
            .src_color_blend_factor(vk::BlendFactor::ONE)
            .dst_color_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
            .src_alpha_blend_factor(vk::BlendFactor::ONE)
            .dst_alpha_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA),
    }
}

/// A shader module; needed only while pipelines are made.
struct Module {
    raw: vk::ShaderModule,
    shader: Shader,
    device: Arc<Device>,
}

impl Module {
    fn new(device: &Arc<Device>, shader: Shader) -> Result<Self> {
        let words = device.words(shader);
        let info = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: the words are SPIR-V that shaderc made for Vulkan 1.2.
        let raw = unsafe { device.raw.create_shader_module(&info, None) }.called("vkCreateShaderModule")?;
        Ok(Self { raw, shader, device: device.clone() })
    }

    fn stage<'a>(&self, constants: &'a vk::SpecializationInfo<'a>) -> vk::PipelineShaderStageCreateInfo<'a> {
        vk::PipelineShaderStageCreateInfo::default()
            .stage(self.shader.stage.flags())
            .module(self.raw)
            .name(MAIN)
            .specialization_info(constants)
    }
}

impl Drop for Module {
    fn drop(&mut self) {
        // SAFETY: pipelines do not need their modules.
        unsafe { self.device.raw.destroy_shader_module(self.raw, None) };
    }
}
