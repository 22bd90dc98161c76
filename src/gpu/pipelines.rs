//! The render pipelines: the layout of vertices, the depth test and the blending of each.

use super::scene::{Point, Vertex};
use super::target::{COLOR_FORMAT, DEPTH_FORMAT};
use super::upload::{Globals, Segment};
use wgpu::{CompareFunction, VertexAttribute, VertexStepMode, vertex_attr_array};

pub(super) const POINTS_WGSL: &str = concat!(include_str!("globals.wgsl"), include_str!("points.wgsl"));
pub(super) const LINES_WGSL: &str = concat!(include_str!("globals.wgsl"), include_str!("lines.wgsl"));
pub(super) const SOLIDS_WGSL: &str = concat!(include_str!("globals.wgsl"), include_str!("solids.wgsl"));

/// Opacity of the parts of a `Faint` line that nearer points hide, as a share of the line's own opacity.
const FAINT: f64 = 0.3;

/// Vertex attributes of a [`Point`].
const POINT: [VertexAttribute; 3] = vertex_attr_array![0 => Float32x3, 1 => Unorm8x4, 2 => Float32];
/// Vertex attributes of a [`Segment`].
const SEGMENT: [VertexAttribute; 5] =
    vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Float32, 4 => Float32];
/// Vertex attributes of a [`Vertex`].
const VERTEX: [VertexAttribute; 3] = vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4];

/// The render pipelines, and the buffer of globals that all pipelines read.
pub(super) struct Pipelines {
    /// Points.
    pub(super) points: wgpu::RenderPipeline,
    /// The visible parts of lines.
    pub(super) lines: wgpu::RenderPipeline,
    /// The hidden parts of lines, drawn faintly.
    pub(super) faint_lines: wgpu::RenderPipeline,
    /// Lines without a depth test.
    pub(super) over_lines: wgpu::RenderPipeline,
    pub(super) back_faces: wgpu::RenderPipeline,
    pub(super) front_faces: wgpu::RenderPipeline,
    pub(super) bind_group: wgpu::BindGroup,
    pub(super) globals: wgpu::Buffer,
}

/// The settings that differ between the pipelines.
struct PipelineSettings<'a> {
    shader: &'a wgpu::ShaderModule,
    stride: usize,
    attributes: &'a [VertexAttribute],
    step: VertexStepMode,
    topology: wgpu::PrimitiveTopology,
    /// The side of triangles that is not drawn.
    cull: Option<wgpu::Face>,
    passes: CompareFunction,
    writes_depth: bool,
    constants: &'a [(&'a str, f64)],
}

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let globals = globals_buffer(device);
        let bind_layout = bind_layout(device);
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("globals"),
            layout: &bind_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: globals.as_entire_binding() }],
        });
        let layout = pipeline_layout(device, &bind_layout);
        let shader = |label, text| shader(device, label, text);
        let points = shader("points", POINTS_WGSL);
        let lines = shader("lines", LINES_WGSL);
        let solids = shader("solids", SOLIDS_WGSL);
        let make = |settings: &PipelineSettings| pipeline(device, &layout, settings);
        let point = PipelineSettings {
            shader: &points,
            stride: size_of::<Point>(),
            attributes: &POINT,
            step: VertexStepMode::Instance,
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull: None,
            passes: CompareFunction::LessEqual,
            writes_depth: true,
            constants: &[],
        };
        let line = PipelineSettings {
            shader: &lines,
            stride: size_of::<Segment>(),
            attributes: &SEGMENT,
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            ..point
        };
        let solid = PipelineSettings {
            shader: &solids,
            stride: size_of::<Vertex>(),
            attributes: &VERTEX,
            step: VertexStepMode::Vertex,
            passes: CompareFunction::Less,
            writes_depth: false,
            ..point
        };
        let faint = [("strength", FAINT)];
        Self {
            points: make(&point),
            lines: make(&line),
            faint_lines: make(&PipelineSettings {
                passes: CompareFunction::Greater,
                writes_depth: false,
                constants: &faint,
                ..line
            }),
            over_lines: make(&PipelineSettings {
                passes: CompareFunction::Always,
                writes_depth: false,
                ..line
            }),
            back_faces: make(&PipelineSettings { cull: Some(wgpu::Face::Front), ..solid }),
            front_faces: make(&PipelineSettings { cull: Some(wgpu::Face::Back), ..solid }),
            bind_group,
            globals,
        }
    }
}

fn shader(device: &wgpu::Device, label: &str, text: &str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    })
}

fn globals_buffer(device: &wgpu::Device) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("globals"),
        size: size_of::<Globals>() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn pipeline_layout(device: &wgpu::Device, bind_layout: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("color space"),
        bind_group_layouts: &[Some(bind_layout)],
        immediate_size: 0,
    })
}

fn bind_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("globals"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    })
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::PipelineLayout,
    settings: &PipelineSettings,
) -> wgpu::RenderPipeline {
    let compilation_options =
        wgpu::PipelineCompilationOptions { constants: settings.constants, ..Default::default() };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("color space"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: settings.shader,
            entry_point: Some("vertex"),
            compilation_options: compilation_options.clone(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: settings.stride as u64,
                step_mode: settings.step,
                attributes: settings.attributes,
            })],
        },
        primitive: wgpu::PrimitiveState {
            topology: settings.topology,
            cull_mode: settings.cull,
            ..wgpu::PrimitiveState::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(settings.writes_depth),
            depth_compare: Some(settings.passes),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: settings.shader,
            entry_point: Some("fragment"),
            compilation_options,
            targets: &[Some(wgpu::ColorTargetState {
                format: COLOR_FORMAT,
                blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
