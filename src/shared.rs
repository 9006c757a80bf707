//! Everything that Rust and GLSL both know: structs, constants, sets and bindings, declared once.
//!
//! `build.rs` compiles this file too and writes [`GLSL`] to `shared.glsl`, which every shader includes.
//! `tests/layout` compares the offsets and bindings below with those in the compiled SPIR-V.
//! Fields are laid out so that Rust's `repr(C)`, std140 and std430 agree: no field straddles its alignment.

#![allow(non_camel_case_types, reason = "field types are spelled as in GLSL")]

// An explicit path: `build.rs` includes this file from another folder.
#[path = "shared/declare.rs"]
#[macro_use]
mod declare;

pub use declare::*;

shared! {
    constants {
        /// Pixels along a tile's side; a tile is one workgroup of the cluster pass.
        TILE_SIZE = 8;
        /// Pixels of a tile.
        TILE_PIXELS = 64;
        /// 32-bit words of a tile's slice mask.
        SLICE_WORDS = 8;
        /// Depth slices at most.
        MAX_SLICES = 256;
        /// Invocations of one-dimensional compute work.
        LINEAR_GROUP = 64;
        /// Workgroups along one side of a dispatch that every device grants.
        MAX_GROUPS = 65535;
        /// Invocations of the single workgroup that scans.
        SCAN_GROUP = 256;
        /// Pixel without a surface in the image of cluster ids.
        NO_CLUSTER = 4294967295;
        /// Lights across the light texture; each is two texels wide. A power of two.
        LIGHTS_PER_ROW = 512;
        /// log2 of it.
        LIGHTS_PER_ROW_LOG2 = 9;
        /// log2 of the rows of a layer of the light texture.
        LIGHT_ROWS_LOG2 = 12;
        /// log2 of the texels across a layer of light lists.
        LIST_WIDTH_LOG2 = 10;
        /// log2 of the rows of a layer of light lists.
        LIST_HEIGHT_LOG2 = 9;
        /// log2 of the nodes across the texture of the light tree.
        NODES_PER_ROW_LOG2 = 8;
        /// Lights of a leaf of the light tree; at most 32, one bit each.
        LEAF_LIGHTS = 32;
        /// Bits of a leaf's light count in `LightNode::lights`.
        LEAF_COUNT_BITS = 6;
        /// Texture slots of a material.
        MATERIAL_TEXTURES = 8;
        /// A parameter without a texture.
        NO_TEXTURE = 255;
        /// `Model::Matte`.
        MODEL_MATTE = 0;
        /// `Model::Plastic`.
        MODEL_PLASTIC = 1;
        /// `Model::Metal`.
        MODEL_METAL = 2;
        /// `Model::Substrate`.
        MODEL_SUBSTRATE = 3;
        /// `Model::Principled`.
        MODEL_PRINCIPLED = 4;
        /// Specialisation constants of a surface: the BSDF model.
        SPEC_MODEL = 0;
        /// Roughness differs along tangent and bitangent.
        SPEC_ANISOTROPIC = 1;
        /// The roughness row is perceptual: alpha = roughness².
        SPEC_SQUARED_ROUGHNESS = 2;
        /// Matte with sigma > 0.
        SPEC_ROUGH_MATTE = 3;
        /// Principled with sheen > 0.
        SPEC_LOBE_SHEEN = 4;
        /// Principled with clearcoat > 0.
        SPEC_LOBE_CLEARCOAT = 5;
        /// Principled with subsurface > 0.
        SPEC_LOBE_SUBSURFACE = 6;
        /// Principled with metallic > 0.
        SPEC_LOBE_METALLIC = 7;
        /// Turn the normal to the viewer.
        SPEC_TWO_SIDED = 8;
        /// Perspective (1) or orthographic (0) camera.
        SPEC_PERSPECTIVE = 9;
        /// Tone curve: 0 none, 1 ACES, 2 AgX.
        SPEC_TONEMAP = 10;
        /// Arbitrary output variable to write: `AOV_*`.
        SPEC_AOV = 11;
        /// Function of the area lights' probe: `AREA_*`.
        SPEC_AREA = 12;
        /// Form factor of rings of vertices.
        AREA_POLYGON = 0;
        /// Form factor of an ellipse, and its azimuths.
        AREA_ELLIPSE = 1;
        /// An ellipse at one azimuth.
        AREA_INTERVAL = 2;
        /// Form factor of the outline of a cylinder.
        AREA_LINE = 3;
        /// World position.
        AOV_POSITION = 0;
        /// Shading normal, turned to the viewer.
        AOV_NORMAL = 1;
        /// Material index.
        AOV_MATERIAL = 2;
        /// Lights evaluated at the pixel.
        AOV_LIGHT_COUNT = 3;
        /// One for every fragment that is shaded.
        AOV_COVERAGE = 4;
        /// Specialisation constant of parameter p's texture slot is this + p.
        SPEC_SLOT = 16;
    }
    sets {
        /// Descriptors of a frame: targets and clusters.
        frame = 0 {
            /// [`FrameConstants`](super::FrameConstants).
            FRAME_CONSTANTS = 0: Uniform;
            /// Depth of the prepass.
            FRAME_DEPTH = 1: Sampled;
            /// Cluster id per pixel, as written.
            FRAME_CLUSTER_IDS_OUT = 2: StorageImage;
            /// Cluster id per pixel, as read.
            FRAME_CLUSTER_IDS = 3: Sampled;
            /// Light lists, as written.
            FRAME_LISTS_OUT = 4: StorageImage;
            /// Light lists, as read: four indices a texel.
            FRAME_LISTS = 5: Sampled;
            /// [`Tile`](super::Tile) per tile.
            FRAME_TILES = 6: Storage;
            /// [`Cluster`](super::Cluster) per occupied cluster.
            FRAME_CLUSTERS = 7: Storage;
            /// [`Counters`](super::Counters).
            FRAME_COUNTERS = 8: Storage;
            /// Scene-linear colour, read by the present subpass.
            FRAME_HDR = 9: Input;
            /// Pairs per tile: evaluated, useful.
            FRAME_PAIRS = 10: Storage;
        }
        /// Descriptors of a scene.
        scene = 1 {
            /// Lights, two texels each.
            SCENE_LIGHTS = 0: Sampled;
            /// [`LightNode`](super::LightNode)s in depth-first order, two texels each.
            SCENE_LIGHT_NODES = 1: Sampled;
        }
        /// A material: its textures and constants.
        material = 2 {
            /// The material's textures; unused slots hold a white texel.
            MATERIAL_SLOTS = 0: Combined[8];
            /// Its [`MaterialRecord`](super::MaterialRecord).
            MATERIAL_RECORD = 1: Uniform;
        }
        /// Rows in, rows out: how tests call the library functions of the shaders.
        probe = 0 {
            /// Input rows.
            PROBE_IN = 0: Storage;
            /// Output rows.
            PROBE_OUT = 1: Storage;
        }
    }
    structs {
        /// What a frame's shaders know of the camera and of the frame's sizes.
        FrameConstants {
            /// Clip space from world axes with the origin at the eye.
            clip_from_eye: mat4;
            /// Eye point, world.
            eye: vec3;
            /// Point lights without a range begin here in the light texture; they are evaluated one by one.
            direct_begin: uint;
            /// View direction, unit, world.
            forward: vec3;
            /// Point lights in all.
            light_count: uint;
            /// Relative to the eye: where the ray of pixel coordinate (0, 0) starts.
            ray_origin: vec3;
            /// Depth slices in use.
            slice_count: uint;
            /// Per pixel along x.
            ray_origin_dx: vec3;
            /// View depth where slice 1 starts; slice 0 reaches from the eye to it.
            slice_start: float;
            /// Per pixel along y.
            ray_origin_dy: vec3;
            /// Slices per octave of depth; negative: slices per metre, negated (orthographic).
            slice_scale: float;
            /// Advance along that ray per metre of view depth.
            ray_direction: vec3;
            /// Longest list.
            max_list: uint;
            /// Per pixel along x.
            ray_direction_dx: vec3;
            /// Room for list texels.
            list_capacity: uint;
            /// Per pixel along y.
            ray_direction_dy: vec3;
            /// Room for clusters.
            cluster_capacity: uint;
            /// View depth = (x + y·d) / (z + w·d) for stored depth d.
            view_depth: vec4;
            /// Pixels.
            size: uvec2;
            /// Tiles.
            tiles: uvec2;
            /// Radiance where no surface is.
            background: vec3;
            /// Nodes of the light tree.
            node_count: uint;
            /// Added to the level of detail of material textures.
            texture_bias: float;
        }
        /// Push constants of a draw.
        DrawConstants {
            /// Index into the material records.
            material: uint;
            /// Present: factor on the accumulated colour.
            scale: float;
            /// Direct: first light to evaluate, and the one behind the last.
            lights: uvec2;
        }
        /// A tile's occupied slices.
        Tile {
            /// Bit per slice.
            slices: uint[8];
            /// Occupied slices.
            count: uint;
            /// Id of the first of its clusters.
            first: uint;
        }
        /// An occupied cluster: bounds of its samples in world space, and its list.
        Cluster {
            /// Lower corner.
            lower: vec3;
            /// Lights that reach it, before the cap.
            reaching: uint;
            /// Upper corner.
            upper: vec3;
            /// First texel of its list.
            list: uint;
        }
        /// What the cluster pass counts; the first three words are an indirect dispatch over clusters.
        Counters {
            /// Workgroups over clusters, at most `MAX_GROUPS` a row.
            groups_x: uint;
            /// Rows of them.
            groups_y: uint;
            /// 1.
            groups_z: uint;
            /// Occupied clusters.
            clusters: uint;
            /// List texels needed.
            list_texels: uint;
            /// Indices in all lists.
            entries: uint;
            /// Longest list before the cap.
            longest: uint;
            /// Lists over the cap.
            overflowed: uint;
            /// Lights that the cap cut away, summed over lists.
            dropped: uint;
        }
        /// A node of the light tree: a box that holds its lights' spheres.
        LightNode {
            /// Lower corner.
            lower: vec3;
            /// Next node where this one is missed.
            skip: uint;
            /// Upper corner.
            upper: vec3;
            /// Leaf: first light << LEAF_COUNT_BITS | count; inner node: 0.
            lights: uint;
        }
        /// A material's constants; rows by `Parameter`, and one to fill the 256 bytes to which uniform buffers may have
        /// to be aligned.
        MaterialRecord {
            /// Constant of each row.
            rows: vec4[16];
        }
        /// A row of the BSDF probe.
        BsdfProbeRow {
            /// Color rgb, alpha_x.
            color_alpha_x: vec4;
            /// Specular rgb, alpha_y.
            specular_alpha_y: vec4;
            /// Sigma in degrees, eta, metallic, roughness.
            surface: vec4;
            /// Specular tint, sheen, sheen tint, clearcoat.
            tints: vec4;
            /// Clearcoat gloss, subsurface.
            rest: vec4;
            /// Local frame.
            wo: vec4;
            /// Local frame.
            wi: vec4;
        }
        /// A row of the area lights' probe.
        AreaProbeRow {
            /// What vertices and axes are relative to.
            center: vec3;
            /// Of a sphere around it that holds the light; of the cylinder.
            radius: float;
            /// Azimuth, as a unit vector of x and y.
            azimuth: vec3;
            /// Vertices in use.
            count: uint;
            /// xyz, and 1 for the last of its ring; half axes of the ellipse; ends of the cylinder.
            vertices: vec4[16];
        }
        /// Pairs of pixel and light in a tile.
        TilePairs {
            /// Evaluated by the shading passes.
            evaluated: uint;
            /// Within the light's range.
            useful: uint;
        }
    }
}
