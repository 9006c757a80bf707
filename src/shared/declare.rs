//! How `shared.rs` declares: the GLSL names of types, what a binding is, and the macro that makes Rust and GLSL of one
//! text.

/// GLSL `float`.
pub type float = f32;
/// GLSL `uint`.
pub type uint = u32;
/// GLSL `uvec2`.
pub type uvec2 = [u32; 2];
/// GLSL `vec2`.
pub type vec2 = [f32; 2];
/// GLSL `vec3`; takes its 16-byte slot only together with a scalar behind it.
pub type vec3 = [f32; 3];
/// GLSL `vec4`.
pub type vec4 = [f32; 4];
/// GLSL `mat4`, columns.
pub type mat4 = [[f32; 4]; 4];

/// What a descriptor is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BindingKind {
    /// `uniform` block.
    Uniform,
    /// `buffer` block.
    Storage,
    /// `texture2D` and its kin, read by `texelFetch`.
    Sampled,
    /// `sampler2D`.
    Combined,
    /// `image2D` and its kin.
    StorageImage,
    /// `subpassInput`.
    Input,
    /// `accelerationStructureEXT`; only where the device has ray queries.
    RayTree,
}

/// Which shaders see a binding. Limits count per stage, so what one stage alone reads costs the others nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stages {
    /// All of them.
    All,
    /// Fragment shaders.
    Fragment,
    /// Compute shaders.
    Compute,
}

/// One binding of a descriptor set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Binding {
    /// Number in the set.
    pub binding: u32,
    /// Kind of descriptor.
    pub kind: BindingKind,
    /// Array length.
    pub count: u32,
    /// Who sees it.
    pub stages: Stages,
}

/// Name and byte offset of every field of a shared struct.
#[derive(Clone, Copy, Debug)]
pub struct StructLayout {
    /// Struct name, the same in both languages.
    pub name: &'static str,
    /// Size in bytes.
    pub size: usize,
    /// Fields in order.
    pub fields: &'static [(&'static str, usize)],
}

macro_rules! field_type {
    ($type:ident) => {
        $type
    };
    ($type:ident $count:literal) => {
        [$type; $count]
    };
}

macro_rules! stages {
    () => {
        $crate::shared::Stages::All
    };
    ($stage:ident) => {
        $crate::shared::Stages::$stage
    };
}

macro_rules! shared {
    (
        constants { $($(#[$cdoc:meta])* $constant:ident = $value:literal;)* }
        sets { $($(#[$sdoc:meta])* $set:ident = $index:literal {
            $($(#[$bdoc:meta])* $binding:ident = $slot:literal: $kind:ident $([$array:literal])? $(in $stage:ident)?;)*
        })* }
        structs { $($(#[$tdoc:meta])* $struct:ident {
            $($(#[$fdoc:meta])* $field:ident: $type:ident $([$count:literal])?;)*
        })* }
    ) => {
        $($(#[$cdoc])* pub const $constant: u32 = $value;)*

        $($(#[$sdoc])* pub mod $set {
            /// Index of the set.
            pub const SET: u32 = $index;
            $($(#[$bdoc])* pub const $binding: u32 = $slot;)*
            /// The set's layout.
            pub const BINDINGS: &[super::Binding] = &[$(super::Binding {
                binding: $slot,
                kind: super::BindingKind::$kind,
                count: 1 $(- 1 + $array)?,
                stages: stages!($($stage)?),
            }),*];
        })*

        $($(#[$tdoc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        #[repr(C)]
        pub struct $struct { $($(#[$fdoc])* pub $field: field_type!($type $($count)?),)* })*

        /// Layout of every shared struct as Rust sees it.
        pub const LAYOUTS: &[StructLayout] = &[$(StructLayout {
            name: stringify!($struct),
            size: size_of::<$struct>(),
            fields: &[$((stringify!($field), std::mem::offset_of!($struct, $field))),*],
        }),*];

        /// The declarations as GLSL.
        pub const GLSL: &str = concat!(
            $("#define ", stringify!($constant), " ", stringify!($value), "u\n",)*
            $("#define SET_", stringify!($set), " ", stringify!($index), "\n",
              $("#define ", stringify!($binding), " ", stringify!($slot), "\n",)*)*
            $("struct ", stringify!($struct), " {\n",
              $("  ", stringify!($type), " ", stringify!($field) $(, "[", stringify!($count), "]")?, ";\n",)*
              "};\n",)*
        );
    };
}
