//! The lobes that have a table, and how each table is laid out.

/// In which basis a table's matrices stand; see the module's head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// Around the mirror direction, with twice alpha divided out of the second and fourth number.
    Mirror,
    /// Around the normal, as they are.
    Normal,
}

/// A lobe with a table of its own.
///
/// The first coordinate of a table is linear in r over [`Layer::axis`], the second in √(1 − n·wo) over [0, 1]; texel
/// centres lie at the ends of both axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// GGX, height-correlated, F = 1. r = √alpha.
    Metal,
    /// GGX, height-correlated, exact dielectric Fresnel of index 1.5. r = √alpha.
    Plastic,
    /// GGX with separable masking, F = 1. r = √alpha.
    PrincipledSpecular,
    /// GGX with separable masking, Schlick's Fresnel of 0.04. r = √alpha.
    PrincipledDielectric,
    /// Ashikhmin–Shirley's coat with the GGX distribution, F = 1. r = √alpha.
    SubstrateSpecular,
    /// Ashikhmin–Shirley's coat with the GGX distribution, Schlick's Fresnel of 0.05. r = √alpha.
    SubstrateDielectric,
    /// Disney's clear coat: GTR1, masking of alpha 0.25, Schlick's Fresnel of 0.04, its quarter. r = √alpha.
    Clearcoat,
    /// Oren–Nayar. r = sigma / 90°.
    Matte,
    /// Disney's diffuse and retro-reflection. r = roughness.
    PrincipledDiffuse,
    /// Disney's subsurface approximation. r = roughness.
    Subsurface,
    /// Disney's sheen. No r.
    Sheen,
    /// Ashikhmin–Shirley's base. No r.
    SubstrateDiffuse,
}

impl Layer {
    /// All of them, in the order of the file.
    pub const ALL: [Self; 12] = [
        Self::Metal,
        Self::Plastic,
        Self::PrincipledSpecular,
        Self::PrincipledDielectric,
        Self::SubstrateSpecular,
        Self::SubstrateDielectric,
        Self::Clearcoat,
        Self::Matte,
        Self::PrincipledDiffuse,
        Self::Subsurface,
        Self::Sheen,
        Self::SubstrateDiffuse,
    ];

    /// Name in reports and file names.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Metal => "metal",
            Self::Plastic => "plastic",
            Self::PrincipledSpecular => "principled_specular",
            Self::PrincipledDielectric => "principled_dielectric",
            Self::SubstrateSpecular => "substrate_specular",
            Self::SubstrateDielectric => "substrate_dielectric",
            Self::Clearcoat => "clearcoat",
            Self::Matte => "matte",
            Self::PrincipledDiffuse => "principled_diffuse",
            Self::Subsurface => "subsurface",
            Self::Sheen => "sheen",
            Self::SubstrateDiffuse => "substrate_diffuse",
        }
    }

    /// The basis of its matrices.
    #[must_use]
    pub const fn frame(self) -> Frame {
        match self {
            Self::Metal
            | Self::Plastic
            | Self::PrincipledSpecular
            | Self::PrincipledDielectric
            | Self::SubstrateSpecular
            | Self::SubstrateDielectric
            | Self::Clearcoat => Frame::Mirror,
            _ => Frame::Normal,
        }
    }

    /// The lobe's albedo as a weighted sum of the three integrals of its table.
    #[must_use]
    pub const fn mixture(self) -> [f64; 3] {
        match self {
            Self::PrincipledDielectric => [0.04, 0.96, 0.0],
            Self::SubstrateDielectric => [0.05, 0.95, 0.0],
            _ => [1.0, 0.0, 0.0],
        }
    }

    /// The t of the module's head: about how wide the lobe is, for a lobe of `alpha`.
    #[must_use]
    pub fn stretch(self, alpha: f64) -> f64 {
        match (self.frame(), self) {
            (Frame::Normal, _) => 1.0,
            // GTR1's tails make its best cosine this much wider than its peak.
            (Frame::Mirror, Self::Clearcoat) => alpha.sqrt(),
            (Frame::Mirror, _) => 2.0 * alpha,
        }
    }

    /// Texels along r and along √(1 − n·wo).
    #[must_use]
    pub const fn size(self) -> [usize; 2] {
        match self {
            Self::Clearcoat | Self::PrincipledDiffuse | Self::Subsurface => [16, 32],
            Self::Sheen | Self::SubstrateDiffuse => [1, 32],
            _ => [32, 32],
        }
    }

    /// The r of the first and of the last column.
    #[must_use]
    pub fn axis(self) -> [f64; 2] {
        match self {
            Self::Clearcoat => [0.001_f64.sqrt(), 0.1_f64.sqrt()],
            _ => [0.0, 1.0],
        }
    }

    /// The parameters in the middle of texel (`column`, `row`); fractions lie between texels.
    #[must_use]
    pub fn parameters(self, column: f64, row: f64) -> Parameters {
        let [columns, rows] = self.size();
        let [first, last] = self.axis();
        let u = if columns > 1 { column / (columns - 1) as f64 } else { 0.0 };
        let v = row / (rows - 1) as f64;
        Parameters { r: first + (last - first) * u, cos: 1.0 - v * v }
    }

    /// Column and row of `parameters`, clamped to the table.
    #[must_use]
    pub fn texel(self, parameters: Parameters) -> [f64; 2] {
        let [columns, rows] = self.size();
        let [first, last] = self.axis();
        let u = ((parameters.r - first) / (last - first)).clamp(0.0, 1.0);
        let v = (1.0 - parameters.cos).clamp(0.0, 1.0).sqrt();
        [u * (columns - 1) as f64, v * (rows - 1) as f64]
    }
}

/// What a table is looked up with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Roughness as the [`Layer`] says.
    pub r: f64,
    /// n·wo.
    pub cos: f64,
}
