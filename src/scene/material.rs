//! Materials: one of five models and a table of parameters, each a constant or a texture.

/// The BSDF models, in the manner of pbrt-v3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u32)]
pub enum Model {
    /// Oren–Nayar.
    Matte = 0,
    /// Lambert under a dielectric GGX lobe.
    Plastic = 1,
    /// GGX with conductor Fresnel.
    Metal = 2,
    /// Ashikhmin–Shirley.
    Substrate = 3,
    /// Disney 2012.
    Principled = 4,
}

/// Rows of a material's parameter table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(usize)]
pub enum Parameter {
    /// matte `color`, plastic and substrate `diffuse`, principled `base_color`, metal `eta` (rgb).
    Color = 0,
    /// plastic and substrate `specular`, metal `k` (rgb).
    Specular,
    /// `roughness` or `alpha`, see [`Material::squared_roughness`].
    Roughness,
    /// Constant: aspect √(1 − 0.9 anisotropic), so alpha_x = alpha/aspect, alpha_y = alpha·aspect. Texture: `anisotropic`.
    Aspect,
    /// matte `sigma`, degrees.
    Sigma,
    /// plastic and principled `eta`.
    Eta,
    /// principled `metallic`.
    Metallic,
    /// principled `specular_tint`.
    SpecularTint,
    /// principled `sheen`.
    Sheen,
    /// principled `sheen_tint`.
    SheenTint,
    /// principled `clearcoat`.
    Clearcoat,
    /// principled `clearcoat_gloss`.
    ClearcoatGloss,
    /// principled `subsurface`.
    Subsurface,
    /// `normal_map`, texture only: tangent space, +y up.
    Normal,
    /// `alpha_mask`, texture only: the red channel below 0.5 cuts the surface away.
    Mask,
}

/// Number of rows of a parameter table.
pub const PARAMETER_COUNT: usize = 15;

/// One row: the texture if there is one, else the constant. Scalars use the first channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Value {
    /// Constant.
    pub constant: [f32; 3],
    /// Index into `Scene::textures`.
    pub texture: Option<u32>,
}

/// A surface material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Unique name.
    pub name: String,
    /// BSDF model.
    pub model: Model,
    /// Rows by [`Parameter`]; rows that the model lacks are zero.
    pub parameters: [Value; PARAMETER_COUNT],
    /// True where the roughness row is a perceptual roughness, alpha = roughness²; false where it is alpha.
    pub squared_roughness: bool,
    /// False: back faces are not drawn. True: the normal turns to the viewer.
    pub two_sided: bool,
}

impl Material {
    /// A row of the table.
    #[must_use]
    pub fn value(&self, parameter: Parameter) -> Value {
        self.parameters[parameter as usize]
    }
}
