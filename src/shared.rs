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
        /// Pixels along a tile's side; a column is one invocation of the cluster pass.
        TILE_SIZE = 8;
        /// Pixels of a tile.
        TILE_PIXELS = 64;
        /// 32-bit words of a mask of slices.
        SLICE_WORDS = 8;
        /// Words of a tile's masks: one for each quadrant.
        TILE_WORDS = 32;
        /// Tiles along a block's side.
        BLOCK_TILES = 4;
        /// Bands of slices; a block's clusters of one band have one parent.
        BANDS = 32;
        /// log2 of the slices of a band.
        BAND_SLICES_LOG2 = 3;
        /// Clusters that one invocation tests a light against; all have one parent.
        SIBLINGS = 4;
        /// Tiles that a workgroup of its steps by tile takes at most: their sums fill 14 of 16 KiB of shared memory.
        MOST_TILES = 4;
        /// Entries that a parent's list has room for.
        PARENT_ROOM = 2048;
        /// Bits of a parent's count of entries; what they are lies above.
        PARENT_COUNT_BITS = 30;
        /// Nodes that the lights beyond a list's cap are folded into: one for each octant of directions.
        FOLD_NODES = 8;
        /// Texels of such a node: direction, and how it turns; irradiance; its slope and constant.
        FOLD_TEXELS = 3;
        /// Texels of a folded list's nodes, behind the point that they are relative to.
        FOLD_ROOM = 25;
        /// Invocations of the workgroup that folds a list, at most.
        FOLD_LANES = 32;
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
        /// Bits of the material in the last word of a surface; the bits above them are 0 where compute shades nothing, else
        /// 1 + the variant among those that it does.
        SURFACE_MATERIAL_BITS = 24;
        /// Variants that compute shades at most: one bit each.
        RESOLVE_VARIANTS = 32;
        /// Pixels that an invocation of the resolve shades at most.
        RESOLVE_PIXELS = 4;
        /// Set in a resolve's entry, a cluster's id: the second half of its pixels.
        RESOLVE_SECOND = 2147483648;
        /// log2 of the materials across the texture of their records.
        MATERIALS_PER_ROW_LOG2 = 6;
        /// log2 of the texels of a record.
        MATERIAL_RECORD_LOG2 = 4;
        /// Lights across the light texture: places in one layer, powers in the next. A power of two.
        LIGHTS_PER_ROW = 512;
        /// log2 of it.
        LIGHTS_PER_ROW_LOG2 = 9;
        /// log2 of the rows of a layer of it.
        LIGHT_ROWS_LOG2 = 12;
        /// log2 of the texels across a layer of light lists.
        LIST_WIDTH_LOG2 = 10;
        /// log2 of the rows of a layer of light lists.
        LIST_HEIGHT_LOG2 = 9;
        /// log2 of the nodes across the texture of the light tree.
        NODES_PER_ROW_LOG2 = 8;
        /// Lights of a leaf of the light tree; at most 32, one bit each.
        LEAF_LIGHTS = 32;
        /// Leaves of a top node.
        TOP_LEAVES = 64;
        /// Lights of a leaf of the tree over lights without a range.
        MOMENT_LEAF = 8;
        /// Texels of a node of it.
        MOMENT_TEXELS = 6;
        /// log2 of the texels from one to the next: two lines of a processor's cache.
        MOMENT_STRIDE_LOG2 = 3;
        /// log2 of its nodes across the texture of the light trees.
        MOMENTS_PER_ROW_LOG2 = 6;
        /// log2 of the texels across the occluders' texture.
        BVH_WIDTH_LOG2 = 12;
        /// Texels before the nodes.
        BVH_HEADER_TEXELS = 2;
        /// Texels of a triangle.
        BVH_TRIANGLE_TEXELS = 3;
        /// Triangles of a leaf at most.
        BVH_LEAF = 4;
        /// Bits of a leaf's triangle count in its node's last word.
        BVH_COUNT_BITS = 3;
        /// Set in the last word of a leaf.
        BVH_LEAF_BIT = 2147483648;
        /// Cells of the nodes' grid along an axis: their corners are 16-bit numbers.
        BVH_CELLS = 65535;
        /// Triangle of a ray that met nothing.
        NO_HIT = 4294967295;
        /// Orders of the nodes for the nearest hit: one for each octant of directions, near children first.
        HIT_ORDERS = 8;
        /// Texels of a [`HitTriangle`].
        HIT_TRIANGLE_TEXELS = 4;
        /// Of a [`HitTriangle`]'s surface: the material's number.
        HIT_MATERIAL_BITS = 24;
        /// Set in it where tangents follow, see [`HitTangents`].
        HIT_TANGENTS = 2147483648;
        /// Set in it where the triangle is a luminaire's.
        HIT_LUMINAIRE = 1073741824;
        /// Bits of the model in `HitMaterial::kind`.
        HIT_MODEL_BITS = 3;
        /// Set in it: alpha = roughness².
        HIT_SQUARED_ROUGHNESS = 8;
        /// Set in it: both sides are drawn.
        HIT_TWO_SIDED = 16;
        /// Texels of a [`HitMaterial`]; its [`HitTexture`]s follow.
        HIT_MATERIAL_TEXELS = 5;
        /// Normal of a virtual light that shines alike in all directions: no unit vector's octahedral code.
        VIRTUAL_ISOTROPIC = 2147516416;
        /// `AreaRecord::kind`: a polygon, rectangles among them.
        AREA_POLYGON = 0;
        /// An ellipse.
        AREA_ELLIPSE = 1;
        /// A thin cylinder.
        AREA_LINE = 2;
        /// Bits of the kind proper.
        AREA_KIND_BITS = 2;
        /// Flag in `AreaRecord::kind`: emits on both sides.
        AREA_TWO_SIDED = 4;
        /// Flag in `AreaRecord::kind`: has a texture.
        AREA_TEXTURED = 8;
        /// log2 of the texels of an area light's record.
        AREA_RECORD_LOG2 = 3;
        /// log2 of the texels across a layer of the area lights' texture.
        AREA_WIDTH_LOG2 = 11;
        /// log2 of the rows of such a layer.
        AREA_HEIGHT_LOG2 = 11;
        /// Area lights of a scene at most.
        MAX_AREA_LIGHTS = 4096;
        /// Area lights in a texel of a cluster's mask: a bit each.
        AREA_MASK_LIGHTS = 128;
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
        /// Encoding of the picture: `ENCODING_*`.
        SPEC_ENCODING = 61;
        /// `Encoding::Srgb`.
        ENCODING_SRGB = 0;
        /// `Encoding::ScRgb`.
        ENCODING_SCRGB = 1;
        /// `Encoding::Hdr10`.
        ENCODING_HDR10 = 2;
        /// Arbitrary output variable to write: `AOV_*`.
        SPEC_AOV = 11;
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
        /// Number of the cluster.
        AOV_CLUSTER = 5;
        /// Depth slice.
        AOV_SLICE = 6;
        /// Lights of the list over those within range.
        AOV_PAIR_RATIO = 7;
        /// Lights beyond the cap of the cluster's list.
        AOV_FOLDED = 8;
        /// Estimated relative error of the cluster.
        AOV_LIGHT_ERROR = 9;
        /// The material's colour.
        AOV_ALBEDO = 10;
        /// Alpha of the specular lobe.
        AOV_ROUGHNESS = 11;
        /// Distance along the view.
        AOV_DEPTH = 12;
        /// Bound of the error of the specular lobe's closed form.
        AOV_LTC_BOUND = 13;
        /// Pixels to the nearest edge of the triangle.
        AOV_WIREFRAME = 14;
        /// Table of the specular lobe of area lights.
        SPEC_LTC_SPECULAR = 12;
        /// Table of the clear coat.
        SPEC_LTC_COAT = 13;
        /// The specular lobe's closed form may be exact enough somewhere.
        SPEC_CLOSED_FORM = 14;
        /// Principled: the table is that of F = 1, not of a dielectric.
        SPEC_LTC_METALLIC = 15;
        /// Rows of a table's layer; one more holds its axes.
        LTC_ROWS = 32;
        /// Columns.
        LTC_COLUMNS = 32;
        /// Specialisation constant of parameter p's texture slot is this + p.
        SPEC_SLOT = 16;
        /// Specialisation constants of area lights: some are polygons.
        SPEC_POLYGONS = 32;
        /// Some are ellipses.
        SPEC_ELLIPSES = 33;
        /// Some are lines.
        SPEC_LINES = 34;
        /// Some have textures.
        SPEC_TEXTURED_LIGHTS = 35;
        /// Some emit on both sides.
        SPEC_TWO_SIDED_LIGHTS = 36;
        /// Clusters have masks that say which area lights reach them.
        SPEC_LIGHT_MASKS = 37;
        /// Area lights cast shadows.
        SPEC_SHADOWS = 38;
        /// Function of the area lights' probe: `PROBE_*`.
        SPEC_AREA_PROBE = 39;
        /// Form factor of rings of vertices.
        PROBE_POLYGON = 0;
        /// Form factor of an ellipse, and its azimuths.
        PROBE_ELLIPSE = 1;
        /// An ellipse at one azimuth.
        PROBE_INTERVAL = 2;
        /// Form factor of the outline of a cylinder.
        PROBE_LINE = 3;
        /// Function of the probe of BSDFs whose model is known at run time only: `BSDF_PROBE_*`.
        SPEC_BSDF_PROBE = 70;
        /// f, and the density of the sampling.
        BSDF_PROBE_EVAL = 0;
        /// A sampled direction, and its density.
        BSDF_PROBE_SAMPLE = 1;
        /// The Lambertian share.
        BSDF_PROBE_LAMBERT = 2;
        /// As the first, of the material as it comes out of its packing.
        BSDF_PROBE_PACKED = 3;
        /// Formula of the probe of hard cases: `HARD_*`.
        SPEC_HARD_FORMULA = 71;
        /// Trowbridge and Reitz' D times π alpha².
        HARD_DISTRIBUTION = 0;
        /// Schlick's weight of white.
        HARD_SCHLICK = 1;
        /// Cosine at the half vector.
        HARD_HALF_COSINE = 2;
        /// Smith's height-correlated visibility times 2 cosθi.
        HARD_VISIBILITY = 3;
        /// Fresnel reflectance of a dielectric.
        HARD_DIELECTRIC = 4;
        /// Of a conductor.
        HARD_CONDUCTOR = 5;
        /// 1 − (1 − x)⁵.
        HARD_COMPLEMENT = 6;
        /// Oren and Nayar's rough share.
        HARD_OREN_NAYAR = 7;
        /// GTR1 without its constant.
        HARD_CLEARCOAT = 8;
        /// Principled subsurface.
        HARD_SUBSURFACE = 9;
        /// Square of a tangent's length.
        HARD_TANGENT = 10;
        /// Form factor of a quadrilateral.
        HARD_FORM_FACTOR = 11;
        /// Of its quarters together.
        HARD_PARTS = 12;
        /// Of an L.
        HARD_NOTCH = 13;
        /// Of a parallelogram with a hole.
        HARD_HOLE = 14;
        /// Of an ellipse.
        HARD_ELLIPSE = 15;
        /// Of a line.
        HARD_LINE = 16;
        /// Of a cube's upper half in the coordinates of a lobe.
        HARD_FURNACE = 17;
        /// Part of the view in the surface, along the plane of incidence.
        HARD_INCIDENCE = 18;
        /// Specialisation constants of the probe of area lights' estimators: which, `TIER_*`.
        SPEC_TIER = 40;
        /// How many points it takes; of `TIER_SHIPPED` the `light_error` in thousandths.
        SPEC_TIER_POINTS = 41;
        /// Invocations that share a row.
        SPEC_TIER_INVOCATIONS = 42;
        /// Lights of a row at most.
        TIER_LIGHTS = 8;
        /// Loads surface and light only.
        TIER_NONE = 0;
        /// The representative point of Karis 2013.
        TIER_REPRESENTATIVE = 1;
        /// The points of cubature that come with the light: 4, the coarse ones, or 16, the fine ones.
        TIER_CUBATURE = 2;
        /// The closed form of transformed cosines.
        TIER_CLOSED_FORM = 3;
        /// Quadrature in the lobe's coordinates: 2, 4 or 8 nodes of azimuth a panel.
        TIER_QUADRATURE = 4;
        /// What `glsl/direct/` chooses.
        TIER_SHIPPED = 5;
        /// Random points of the light's area.
        TIER_AREA_SAMPLES = 6;
        /// Random points in each lobe's coordinates.
        TIER_PROXY_SAMPLES = 7;
        /// Specialisation constant of the loops that measure the device's floors: `FLOOR_*`.
        SPEC_FLOOR = 43;
        /// No loop: to be subtracted.
        FLOOR_NOTHING = 0;
        /// Lights made up, not fetched.
        FLOOR_ARITHMETIC = 1;
        /// Lights fetched and added up.
        FLOOR_FETCH = 2;
        /// Lights fetched and reflected.
        FLOOR_BOTH = 3;
        /// Invocations of a small workgroup: on lavapipe a vector, so that barriers cost nothing; elsewhere a warp.
        SPEC_LANES = 46;
        /// The variant that the pipeline resolves.
        SPEC_RESOLVED = 44;
        /// Some lists are folded.
        SPEC_FOLDED = 60;
        /// Folded lights fall on glossy surfaces too.
        SPEC_GLOSSY = 48;
        /// One of how many blocks of pixels is shaded.
        SPEC_ONE_IN = 61;
        /// Clusters note their pixels.
        SPEC_NOTE_PIXELS = 47;
        /// Masks cut some of what hides lights.
        SPEC_OCCLUDER_MASKS = 49;
        /// Clusters note the variants of their pixels.
        SPEC_NOTE_VARIANTS = 45;
        /// Lights that are gathered cast shadows.
        SPEC_GATHER_SHADOWS = 54;
        /// The scene's point lights are gathered, not shaded one by one: they cast shadows.
        SPEC_GATHER_POINTS = 55;
        /// There is indirect light.
        SPEC_GATHER_INDIRECT = 56;
        /// Every surface is Lambertian, and the background black: only what is near has to be looked for.
        SPEC_GATHER_LAMBERT = 57;
        /// Of models known at run time only, a bit for each that there is.
        SPEC_BSDF_MODELS = 58;
        /// Some surface that a ray may hit has a normal map.
        SPEC_HIT_NORMAL_MAPS = 59;
        /// Pixels along a side of a workgroup that gathers.
        GATHER_SIDE = 8;
        /// Pixels of a workgroup.
        GATHER_PIXELS = 64;
        /// Lights that are drawn from a tree for each half of a workgroup's pixels to choose from; a quarter of all pixels.
        GATHER_DRAWN = 16;
        /// Frames of a round, which have the same virtual lights.
        GATHER_FRAMES = 16;
        /// Independent sums of rounds, from which the error is told.
        GATHER_SUBSETS = 4;
        /// log2 of the texels across the texture of gathered lights and their trees.
        GATHERED_WIDTH_LOG2 = 12;
        /// Bits of a Hilbert key along an axis, a multiple of the three levels that the host makes in a step.
        HILBERT_BITS = 12;
        /// Bits of a Hilbert key that are sorted by, from the first on.
        HILBERT_KEY_BITS = 32;
        /// Bits of a key that a pass of the sort on the device goes by.
        ORDER_DIGIT_BITS = 8;
        /// Values of such a digit: one for each invocation of `SCAN_GROUP`.
        ORDER_DIGITS = 256;
        /// Points that an invocation of that sort goes through, one by one.
        ORDER_BLOCK = 2048;
    }
    sets {
        /// Descriptors of a frame: targets and clusters.
        frame = 0 {
            /// [`FrameConstants`](super::FrameConstants).
            FRAME_CONSTANTS = 0: Uniform;
            /// Depth of the prepass.
            FRAME_DEPTH = 1: Sampled;
            /// Cluster id per pixel, as written.
            FRAME_CLUSTER_IDS_OUT = 2: StorageImage in Compute;
            /// Cluster id per pixel, as read.
            FRAME_CLUSTER_IDS = 3: Sampled;
            /// Light lists, as written.
            FRAME_LISTS_OUT = 4: StorageImage in Compute;
            /// Light lists, as read: four indices a texel.
            FRAME_LISTS = 5: Sampled;
            /// [`Tile`](super::Tile) per tile.
            FRAME_TILES = 6: Storage;
            /// [`Cluster`](super::Cluster) per occupied cluster.
            FRAME_CLUSTERS = 7: Storage;
            /// [`Counters`](super::Counters).
            FRAME_COUNTERS = 8: Storage;
            /// Scene-linear colour, read by the present subpass.
            FRAME_HDR = 9: Input in Fragment;
            /// What the prepass notes of each pixel's surface: the interpolated normal's bits; material and variant, see
            /// `SURFACE_MATERIAL_BITS`. 0 where a light is seen, or nothing.
            FRAME_SURFACE = 10: Sampled in Compute;
            /// Scene-linear colour; its fourth value is not 0 where a pixel's cut was given up.
            FRAME_HDR_READ = 11: Sampled in Compute;
            /// Gathered light: a layer for each subset, of indirect light, then of the scene's point lights.
            FRAME_GATHERED = 12: Sampled in Fragment;
        }
        /// Descriptors of a scene.
        scene = 1 {
            /// Lights, a texel of place and one of power each.
            SCENE_LIGHTS = 0: StorageImage;
            /// [`LightNode`](super::LightNode)s, two texels each: the top nodes, then their leaves.
            SCENE_LIGHT_NODES = 1: Sampled;
            /// What hides lights: a [`BvhHeader`](super::BvhHeader), [`BvhNode`](super::BvhNode)s in depth-first order,
            /// [`BvhTriangle`](super::BvhTriangle)s, [`MaskedTriangle`](super::MaskedTriangle)s and masks.
            SCENE_BVH = 2: Sampled;
            /// Area lights: [`AreaRecord`](super::AreaRecord)s from texel 0, then vertices, points of cubature, and
            /// the texels of their textures.
            SCENE_AREA_LIGHTS = 3: Sampled;
            /// Tables of linearly transformed cosines, two layers each: shapes, moments.
            SCENE_LTC = 4: Sampled;
            /// What a nearest hit is found and shaded by: [`BvhNode`](super::BvhNode)s in `HIT_ORDERS` orders,
            /// [`HitTriangle`](super::HitTriangle)s, [`HitTangents`](super::HitTangents), and textures.
            SCENE_HITS = 5: Sampled in Compute;
            /// A [`HitMaterial`](super::HitMaterial) and up to `MATERIAL_TEXTURES` [`HitTexture`](super::HitTexture)s every
            /// `1 << MATERIAL_RECORD_LOG2` texels.
            SCENE_HIT_MATERIALS = 6: Sampled in Compute;
            /// The triangles of `SCENE_BVH` in their order, for ray queries.
            SCENE_RAY_TREE = 7: RayTree;
        }
        /// A material: its textures and constants.
        material = 2 {
            /// The material's textures; unused slots hold a white texel.
            MATERIAL_SLOTS = 0: Combined[8] in Fragment;
            /// Its [`MaterialRecord`](super::MaterialRecord).
            MATERIAL_RECORD = 1: Uniform in Fragment;
        }
        /// The resolve's own, in the place of a material's.
        resolve = 2 {
            /// [`ResolveDispatch`](super::ResolveDispatch) per variant and pixels an invocation, then the entries of all.
            RESOLVE_WORK = 0: Storage in Compute;
            /// [`MaterialRecord`](super::MaterialRecord)s.
            RESOLVE_MATERIALS = 1: Sampled in Compute;
            /// Scene-linear colour, added to.
            RESOLVE_HDR = 2: StorageImage in Compute;
        }
        /// What gathers light, in the place of a material's.
        gather = 2 {
            /// Words 0 … 3 of a pixel's surface, see `glsl/gather/words.glsl`.
            GATHER_WORDS_A = 0: Sampled in Compute;
            /// Words 4 … 7.
            GATHER_WORDS_B = 1: Sampled in Compute;
            /// Words 8 … 11.
            GATHER_WORDS_C = 2: Sampled in Compute;
            /// [`VirtualPair`](super::VirtualPair)s, four texels each, and [`VirtualLight`](super::VirtualLight)s, two.
            GATHER_LIGHTS = 3: Sampled in Compute;
            /// What `FRAME_GATHERED` reads.
            GATHER_SUMS = 4: StorageImage in Compute;
        }
        /// The accounting's own, in the place of a material's.
        pairs = 2 {
            /// [`TilePairs`](super::TilePairs) per tile.
            PAIRS_TILES = 0: Storage in Compute;
        }
        /// The order of points on the device: a set of its own.
        order = 0 {
            /// Points, a vector each.
            ORDER_POINTS = 0: Storage in Compute;
            /// Keys and indices that a pass goes through; of that which makes the keys the table of the curve.
            ORDER_FROM = 1: Storage in Compute;
            /// Keys and indices, by one digit more in order.
            ORDER_TO = 2: Storage in Compute;
            /// Of each block of points and value of a digit: how many, then where the next goes.
            ORDER_COUNTS = 3: Storage in Compute;
        }
        /// A texture of the window's overlay.
        overlay = 0 {
            /// Letters, mostly: sRGB-encoded, premultiplied with alpha.
            OVERLAY_TEXTURE = 0: Combined in Fragment;
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
            /// Point lights without a range begin here among the lights: cut, or evaluated one by one.
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
            /// Top nodes of the light tree.
            top_nodes: uint;
            /// Added to the level of detail of material textures.
            texture_bias: float;
            /// Which sample of the picture this is.
            sample_index: uint;
            /// Relative error that a light may have.
            light_error: float;
            /// Area lights in all.
            area_lights: uint;
            /// Texels of a cluster's mask of area lights, which lie before the lists; 0: every light reaches every pixel.
            area_texels: uint;
            /// From this slice on each quadrant of a tile has clusters of its own.
            split_slice: uint;
            /// Room for parents.
            parent_capacity: uint;
            /// First texel of their lists.
            parent_texels: uint;
            /// First texel of the masks of their children.
            sibling_texels: uint;
            /// First texel of lists of clusters.
            list_texels: uint;
            /// Nodes of the tree over lights without a range, which clusters cut; 0: `direct_begin` says which are evaluated.
            moment_nodes: uint;
            /// First row of them in the texture of the light trees.
            moment_row: uint;
            /// Least squared distance from a node that is not opened, in its radii.
            cut_open2: float;
            /// Largest error of a node, as a share of a cluster's light.
            cut_share: float;
            /// Largest squared radius of a node, of the scale on which a lobe changes.
            cut_lobe2: float;
            /// Nodes of a list beyond the cap; 0 until there is a pass that writes such lists.
            fold_nodes: uint;
            /// Largest error at a pixel's horizon, as a share of the pixel's irradiance.
            cut_horizon: float;
        }
        /// Push constants of a draw.
        DrawConstants {
            /// Index into the material records.
            material: uint;
            /// Present: factor on the accumulated colour.
            scale: float;
            /// Direct: first light to evaluate, and the one behind the last.
            lights: uvec2;
            /// Prepass: last word of the surface.
            surface: uint;
            /// Present: factor on the sum of gathered light.
            gathered: float;
        }
        /// Push constants of a gathering. A tree: its first texel, where its lights follow its nodes, and its leaves, a power
        /// of two; 0: no lights.
        GatherConstants {
            /// Of the scene's point lights.
            points: uvec2;
            /// Of points on area lights.
            emitters: uvec2;
            /// Of virtual lights.
            virtuals: uvec2;
            /// Largest geometry term that gathering takes over, m⁻².
            bound: float;
            /// Bounces between the eye's surface and a light, at most.
            bounces: uint;
            /// Frame, of all rounds.
            index: uint;
            /// First row of pixels.
            row: uint;
        }
        /// Push constants of the order of points on the device.
        OrderConstants {
            /// Corner of the curve's first cell.
            lower: vec3;
            /// Cells a metre.
            scale: float;
            /// Points.
            count: uint;
            /// Blocks of `ORDER_BLOCK` points.
            blocks: uint;
            /// Bits of a key below this pass's digit.
            shift: uint;
            /// 0.
            spare: uint;
        }
        /// Push constants of the window's overlay.
        OverlayConstants {
            /// Clip space per point of the window, across and down.
            clip_per_point: vec2;
        }
        /// A tile's occupied slices. Behind the tiles lie the blocks.
        Tile {
            /// Bit per slice, of each quadrant; before the split all are in the first. Of a block: its clusters in each
            /// band, and later the band's parent.
            slices: uint[32];
            /// Clusters of the band in the block's earlier tiles. Of a block: the band's first cluster.
            first: uint[32];
        }
        /// An occupied cluster: bounds of its samples in world space, and its list. Behind the clusters lie their parents,
        /// whose lists hold every light that may reach a child.
        Cluster {
            /// Lower corner.
            lower: vec3;
            /// Lights that reach it, before the cap. Of a parent: entries of its list, and what these are.
            reaching: uint;
            /// Upper corner.
            upper: vec3;
            /// First texel of its list.
            list: uint;
            /// A bit for each pixel of its tile that lies in it, row by row.
            pixels: uvec2;
            /// Its tile.
            tile: uint;
            /// A bit for each variant that the resolve finds in it.
            variants: uint;
            /// Number of its parent. Of a parent: its first child.
            parent: uint;
            /// Of a parent: its children.
            children: uint;
            /// Entry k: the k-th cluster that is folded.
            folded: uint;
            /// Estimate of the relative error that folding causes in it.
            error: float;
            /// First texel of its cut: nodes that are far, roots of what each pixel opens, first lights of near leaves, each
            /// padded to whole texels.
            cut: uint;
            /// Nodes.
            cut_nodes: uint;
            /// Roots.
            cut_roots: uint;
            /// Leaves.
            cut_leaves: uint;
            /// Σ power/d² over lights without a range, about.
            cut_power: float;
            /// Relative error that the cut is estimated to have.
            cut_error: float;
            /// Largest error of a node in the cut: irradiance at normal incidence.
            cut_limit: float;
            /// Its pixels.
            pixel_count: uint;
        }
        /// Work of one pipeline of the resolve; the first three words are an indirect dispatch.
        ResolveDispatch {
            /// Workgroups, at most `MAX_GROUPS` a row.
            groups_x: uint;
            /// Rows of them.
            groups_y: uint;
            /// 1.
            groups_z: uint;
            /// First of its entries: clusters, or halves of them.
            first: uint;
            /// How many.
            count: uint;
        }
        /// What the cluster pass counts; the first words are indirect dispatches.
        Counters {
            /// Workgroups over clusters, at most `MAX_GROUPS` a row.
            groups_x: uint;
            /// Rows of them.
            groups_y: uint;
            /// 1.
            groups_z: uint;
            /// Workgroups over parents to be gathered, one each.
            parents_x: uint;
            /// Rows of them.
            parents_y: uint;
            /// 1.
            parents_z: uint;
            /// Workgroups over folded clusters, one each.
            folds_x: uint;
            /// Rows of them.
            folds_y: uint;
            /// 1.
            folds_z: uint;
            /// Parents.
            parents: uint;
            /// Ids of clusters, some of them unused: each parent's first is a multiple of `SIBLINGS`.
            clusters: uint;
            /// Occupied clusters.
            occupied: uint;
            /// Texels needed in all.
            list_texels: uint;
            /// Indices in all lists.
            entries: uint;
            /// Longest list before the cap.
            longest: uint;
            /// Lists over the cap: clusters with folded lights.
            overflowed: uint;
            /// Lights that are folded, summed over lists.
            folded: uint;
            /// Bits of the largest estimate of the relative error that folding causes in a cluster.
            fold_error: uint;
            /// Nodes, roots and leaves in all cuts.
            cut_entries: uint;
            /// Longest cut.
            cut_longest: uint;
            /// The first parent of those to be gathered.
            first_parent: uint;
            /// Pixels that did not come to the end of theirs.
            cut_given_up: uint;
        }
        /// A node of the light tree: a box that holds its lights' spheres.
        LightNode {
            /// Lower corner.
            lower: vec3;
            /// First light.
            first: uint;
            /// Upper corner.
            upper: vec3;
            /// Lights.
            count: uint;
        }
        /// A node of the tree over lights without a range; the power of a light is the mean of its channels' intensities.
        MomentNode {
            /// Centroid of power.
            center: vec3;
            /// Of a sphere about the centre that holds the lights.
            radius: float;
            /// Power of the lights.
            power: float;
            /// Relative error at distance d: this times (radius/d)³.
            error: float;
            /// Next node where this one is not opened; of a leaf, the next one.
            skip: uint;
            /// First of the lights.
            first: uint;
            /// Covariance of power: xx, yy, zz.
            diagonal: vec3;
            /// From the centre to each channel's centroid, along x: three times 10 bits with a sign, in radii.
            shift_x: uint;
            /// xy, xz, yz.
            mixed: vec3;
            /// Along y.
            shift_y: uint;
            /// Radiant intensity.
            intensity: vec3;
            /// Along z.
            shift_z: uint;
            /// Extent below and above the centre along x, in radii, as 16-bit fractions a | b << 16.
            extent_x: uint;
            /// Along y.
            extent_y: uint;
            /// Along z.
            extent_z: uint;
            /// Lights.
            count: uint;
        }
        /// A light on a surface that stands for reflected light, a point of an area light, or a point light.
        VirtualLight {
            /// Relative to the device's origin, a little off the surface; metres.
            position: vec3;
            /// Octahedral, two 16-bit numbers with a sign (`unpackSnorm2x16`): geometric normal of the lit side, or
            /// `VIRTUAL_ISOTROPIC`.
            normal: uint;
            /// A receiver at distance d gets this times cosθ/d² of the light; of an isotropic light its intensity.
            color: vec3;
            /// Bounces before it, 0 is emission; of a point light the bits of 1/range², 0 without a range.
            extra: uint;
        }
        /// Both children of a node of the tree over virtual lights, left and right. Nodes stand in the order of a walk that
        /// goes left first: behind node i are the `left_count` − 1 nodes of its left child, then those of its right one.
        VirtualPair {
            /// Lower corner of the left lights' positions.
            left_lower: vec3;
            /// Lights of the left child.
            left_count: uint;
            /// Upper corner.
            left_upper: vec3;
            /// Cone of the normals: its axis octahedral, x and y of 12 bits with a sign each, in 2047ths; above them the
            /// cosine of the half angle in 255ths, rounded down; 0 is the whole sphere. Of point lights the bits of
            /// their largest range, infinite without one.
            left_cone: uint;
            /// Lower corner of the right lights' positions.
            right_lower: vec3;
            /// Sums of the lights' mean channels, the upper halves of two floats: left | right << 16. 0 only where there is
            /// no light.
            powers: uint;
            /// Upper corner.
            right_upper: vec3;
            /// As the left one's.
            right_cone: uint;
        }
        /// An area light. Vectors that a kind does not have are 0; first vertices and points are those of the texture.
        AreaRecord {
            /// Centre; of a line, its first end. A polygon's is that of its bounding rectangle along its first edge.
            center: vec3;
            /// `AREA_*`: kind and flags.
            kind: uint;
            /// Half axis; of a line, from its first end to its second.
            u: vec3;
            /// Radius of a sphere about the centre, or a line's middle, that holds it.
            extent: float;
            /// Half axis.
            v: vec3;
            /// Of a line.
            radius: float;
            /// Unit, towards the front.
            normal: vec3;
            /// First vertex of its rings.
            ring_first: uint;
            /// Emitted, without the texture.
            radiance: vec3;
            /// Vertices of all rings.
            ring_count: uint;
            /// First vertex of its convex pieces.
            piece_first: uint;
            /// Vertices of all pieces.
            piece_count: uint;
            /// The point that stands for the whole light; the coarse ones and then the fine ones follow.
            point_first: uint;
            /// Coarse points, and fine ones << 16.
            points: uint;
            /// (s, t, 1) to the first texture coordinate.
            uv_s: vec3;
            /// First texel of its texture.
            heap: uint;
            /// (s, t, 1) to the second.
            uv_t: vec3;
            /// Texels across and down << 16; 0: no texture.
            size: uint;
        }
        /// The grid of a tree's nodes.
        BvhHeader {
            /// Lower corner.
            lower: vec3;
            /// Nodes; 0: nothing hides anything.
            nodes: uint;
            /// Sides of a cell.
            cell: vec3;
            /// Triangles, for captures.
            triangles: uint;
        }
        /// A node over occluding triangles.
        BvhNode {
            /// Along x: the lower corner's cell | the upper corner's << 16.
            x: uint;
            /// Along y.
            y: uint;
            /// Along z.
            z: uint;
            /// Inner node: the next node where this one is missed. Leaf, which the next one follows in any case:
            /// `BVH_LEAF_BIT` | texel of the first triangle << `BVH_COUNT_BITS` | count.
            next: uint;
        }
        /// An occluding triangle.
        BvhTriangle {
            /// First corner.
            a: vec3;
            /// Texel of its [`MaskedTriangle`]; 0: no mask.
            masked: uint;
            /// Second corner.
            b: vec3;
            /// Mesh, for captures; a luminaire's follow the scene's.
            mesh: uint;
            /// Third corner.
            c: vec3;
            /// Triangle of the mesh, for captures.
            triangle: uint;
        }
        /// How a mask cuts a triangle.
        MaskedTriangle {
            /// Texture coordinates of two corners.
            uv_ab: vec4;
            /// Of the third.
            uv_c: vec2;
            /// First word of the mask, which has one for each texel: it and its right, lower and lower right neighbours
            /// as bytes.
            words: uint;
            /// Texels across and down, 16 bits each.
            size: uint;
        }
        /// What a hit needs of a triangle, in the order of the tree's.
        HitTriangle {
            /// Shading normal of the first corner.
            normal_a: vec3;
            /// The material's number, or with `HIT_TANGENTS` the texel of [`HitTangents`] in this texture; or
            /// `HIT_LUMINAIRE`.
            surface: uint;
            /// Of the second corner.
            normal_b: vec3;
            /// First texture coordinate of the first corner.
            u_a: float;
            /// Of the third.
            normal_c: vec3;
            /// Second.
            v_a: float;
            /// Texture coordinates of the other corners.
            uv_bc: vec4;
        }
        /// Tangents of a triangle whose material has a direction or a normal map, zero without texture coordinates.
        HitTangents {
            /// First corner.
            a: vec3;
            /// The material's number.
            material: uint;
            /// Second corner.
            b: vec3;
            /// Side of the bitangent, by its sign.
            handed: float;
            /// Third corner.
            c: vec3;
            /// 0.
            spare: uint;
        }
        /// A material's constants: rows by `Parameter`.
        HitMaterial {
            /// `Parameter::Color`.
            color: vec3;
            /// Model and `HIT_*` flags.
            kind: uint;
            /// `Parameter::Specular`.
            specular: vec3;
            /// How many parameters have textures.
            textures: uint;
            /// `Parameter::Roughness`.
            roughness: float;
            /// `Parameter::Aspect`; 1 for models without one.
            aspect: float;
            /// `Parameter::Sigma`.
            sigma: float;
            /// `Parameter::Eta`.
            eta: float;
            /// `Parameter::Metallic`.
            metallic: float;
            /// `Parameter::SpecularTint`.
            specular_tint: float;
            /// `Parameter::Sheen`.
            sheen: float;
            /// `Parameter::SheenTint`.
            sheen_tint: float;
            /// `Parameter::Clearcoat`.
            clearcoat: float;
            /// `Parameter::ClearcoatGloss`.
            clearcoat_gloss: float;
            /// `Parameter::Subsurface`.
            subsurface: float;
            /// 0.
            spare: uint;
        }
        /// A parameter's texture.
        HitTexture {
            /// `Parameter`.
            parameter: uint;
            /// First texel. Each holds four halves of the texture's and four of its right neighbour's.
            first: uint;
            /// Texels across.
            width: uint;
            /// Texels down.
            height: uint;
        }
        /// What the probe of hits answers.
        HitProbeRow {
            /// Of the surface.
            position: vec3;
            /// Distance.
            t: float;
            /// On the ray's side.
            geometric_normal: vec3;
            /// Of the tree, or `NO_HIT`.
            triangle: uint;
            /// First axis of the shading frame.
            tangent: vec3;
            /// 1: met from the front.
            front: uint;
            /// Second.
            bitangent: vec3;
            /// 1: has a material on this side.
            drawn: uint;
            /// Third.
            normal: vec3;
            /// `MODEL_*`.
            model: uint;
            /// Color rgb, alpha_x.
            color_alpha_x: vec4;
            /// Specular rgb, alpha_y.
            specular_alpha_y: vec4;
            /// Sigma in degrees, eta, metallic, roughness.
            surface: vec4;
            /// Specular tint, sheen, sheen tint, clearcoat.
            tints: vec4;
            /// Clearcoat gloss, subsurface; weights of the second and third corner.
            rest: vec4;
        }
        /// A row of the occlusion probe.
        RayProbeRow {
            /// Start.
            origin: vec3;
            /// Distances between which something is in the way.
            t_min: float;
            /// Unit.
            direction: vec3;
            /// Greatest.
            t_max: float;
            /// Unit geometric normal along which the start is moved.
            normal: vec3;
            /// How far the start was found along a ray.
            way: float;
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
            /// Clearcoat gloss, subsurface, model.
            rest: vec4;
            /// Local frame.
            wo: vec4;
            /// Local frame; where a direction is sampled, two numbers in [0, 1).
            wi: vec4;
        }
        /// A row of the probe of hard cases: directions, or the corners of a quadrilateral, then parameters.
        HardProbeRow {
            /// Towards the viewer; of an area light the first corner, its center, or a line's first end.
            a: vec4;
            /// Towards the light; the second corner, a half axis, the other end, the normal, or a lobe's shape.
            b: vec4;
            /// Parameters; the third corner, a half axis, or a line's radius.
            c: vec4;
            /// The fourth corner, or a hole's size.
            d: vec4;
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
        /// A row of the probe of area lights' estimators: a surface with normal +z and tangent +x, and its lights.
        AreaTierRow {
            /// Plastic: diffuse; metal: eta; and alpha.
            color_alpha: vec4;
            /// Specular, or k; and the index of refraction.
            specular_eta: vec4;
            /// Towards the viewer, unit.
            wo: vec3;
            /// First of its lights.
            light_first: uint;
            /// World.
            position: vec3;
            /// How many, at most `TIER_LIGHTS`.
            light_count: uint;
        }
        /// Pairs of pixel and light in a tile.
        TilePairs {
            /// Evaluated by the shading passes.
            evaluated: uint;
            /// Within the light's range, or before an area light.
            useful: uint;
            /// Area lights among those evaluated.
            area: uint;
            /// Area lights that no mask would have left out.
            area_all: uint;
        }
    }
}
