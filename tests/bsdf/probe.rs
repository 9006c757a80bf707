//! Calls `glsl/probe/bsdf.comp`, which includes `lib/bsdf.glsl` unchanged.

use std::collections::BTreeMap;
use std::fmt;

use amas::gpu::{Specialization, shaders};
use amas::reference::bsdf::{Bsdf, Ggx, Matte, Metal, Plastic, Principled, Substrate};
use amas::shared::{self, BsdfProbeRow};
use glam::{DVec3, Vec3};

use crate::common::gpu::CheckedGpu;

/// One evaluation, of numbers that float32 holds: the device and the oracle see the same ones.
#[derive(Clone, Copy)]
pub(crate) struct Case {
    pub bsdf: Bsdf,
    pub wo: DVec3,
    pub wi: DVec3,
}

impl Case {
    /// Rounds every number to float32.
    pub(crate) fn new(bsdf: &Bsdf, wo: DVec3, wi: DVec3) -> Self {
        Self { bsdf: rounded(bsdf), wo: round3(wo), wi: round3(wi) }
    }

    /// f of the oracle, which needs directions of unit length.
    pub(crate) fn oracle(&self) -> DVec3 {
        self.bsdf.eval(self.wo.normalize(), self.wi.normalize())
    }

    pub(crate) fn swapped(self) -> Self {
        Self { wo: self.wi, wi: self.wo, ..self }
    }

    pub(crate) fn row(&self) -> BsdfProbeRow {
        let rest = [0.0, 0.0, Variant::trimmed(&self.bsdf).model as f32, 0.0];
        let row =
            BsdfProbeRow { wo: pack(self.wo, 0.0), wi: pack(self.wi, 0.0), rest, ..BsdfProbeRow::default() };
        match &self.bsdf {
            Bsdf::Matte(m) => BsdfProbeRow {
                color_alpha_x: pack(m.color, 0.0),
                surface: [m.sigma as f32, 0.0, 0.0, 0.0],
                ..row
            },
            Bsdf::Plastic(m) => BsdfProbeRow {
                color_alpha_x: pack(m.diffuse, m.alpha),
                specular_alpha_y: pack(m.specular, m.alpha),
                surface: [0.0, m.eta as f32, 0.0, 0.0],
                ..row
            },
            Bsdf::Metal(m) => BsdfProbeRow {
                color_alpha_x: pack(m.eta, m.ggx.alpha_x),
                specular_alpha_y: pack(m.k, m.ggx.alpha_y),
                ..row
            },
            Bsdf::Substrate(m) => BsdfProbeRow {
                color_alpha_x: pack(m.diffuse, m.ggx.alpha_x),
                specular_alpha_y: pack(m.specular, m.ggx.alpha_y),
                ..row
            },
            Bsdf::Principled(m) => principled_row(m, row),
        }
    }
}

/// A failed case as it can be run again.
impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (wo, wi) = (self.wo.to_array(), self.wi.to_array());
        write!(f, "{:?}, wo {wo:?}, wi {wi:?}", self.bsdf)
    }
}

fn principled_row(m: &Principled, row: BsdfProbeRow) -> BsdfProbeRow {
    let tints = [m.specular_tint, m.sheen, m.sheen_tint, m.clearcoat];
    BsdfProbeRow {
        color_alpha_x: pack(m.base_color, m.ggx.alpha_x),
        specular_alpha_y: pack(DVec3::ZERO, m.ggx.alpha_y),
        surface: [0.0, m.eta, m.metallic, m.roughness].map(|x| x as f32),
        tints: tints.map(|x| x as f32),
        rest: [m.clearcoat_gloss as f32, m.subsurface as f32, row.rest[2], 0.0],
        ..row
    }
}

fn pack(xyz: DVec3, w: f64) -> [f32; 4] {
    xyz.as_vec3().extend(w as f32).to_array()
}

fn round(x: f64) -> f64 {
    f64::from(x as f32)
}

fn round3(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

fn round_ggx(ggx: Ggx) -> Ggx {
    Ggx { alpha_x: round(ggx.alpha_x), alpha_y: round(ggx.alpha_y) }
}

fn rounded(bsdf: &Bsdf) -> Bsdf {
    match *bsdf {
        Bsdf::Matte(m) => Bsdf::Matte(Matte { color: round3(m.color), sigma: round(m.sigma) }),
        Bsdf::Plastic(m) => Bsdf::Plastic(Plastic {
            diffuse: round3(m.diffuse),
            specular: round3(m.specular),
            eta: round(m.eta),
            alpha: round(m.alpha),
        }),
        Bsdf::Metal(m) => Bsdf::Metal(Metal { eta: round3(m.eta), k: round3(m.k), ggx: round_ggx(m.ggx) }),
        Bsdf::Substrate(m) => Bsdf::Substrate(Substrate {
            diffuse: round3(m.diffuse),
            specular: round3(m.specular),
            ggx: round_ggx(m.ggx),
        }),
        Bsdf::Principled(m) => Bsdf::Principled(Principled {
            base_color: round3(m.base_color),
            metallic: round(m.metallic),
            eta: round(m.eta),
            roughness: round(m.roughness),
            ggx: round_ggx(m.ggx),
            specular_tint: round(m.specular_tint),
            sheen: round(m.sheen),
            sheen_tint: round(m.sheen_tint),
            clearcoat: round(m.clearcoat),
            clearcoat_gloss: round(m.clearcoat_gloss),
            subsurface: round(m.subsurface),
        }),
    }
}

/// How to specialise for a BSDF.
pub(crate) type Choice = fn(&Bsdf) -> Variant;

/// A specialisation: the model, and which of its parts are compiled in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Variant {
    model: u32,
    /// By the SPEC constant that switches it.
    parts: [(u32, bool); 6],
}

impl Variant {
    /// Both ways to specialise, by name.
    pub(crate) const CHOICES: [(&str, Choice); 2] = [("general", Self::general), ("trimmed", Self::trimmed)];

    /// Everything compiled in.
    pub(crate) fn general(bsdf: &Bsdf) -> Self {
        let trimmed = Self::trimmed(bsdf);
        Self { parts: trimmed.parts.map(|(id, _)| (id, true)), ..trimmed }
    }

    /// Only what this BSDF needs, as the renderer would specialise it.
    pub(crate) fn trimmed(bsdf: &Bsdf) -> Self {
        let differs = |ggx: Ggx| ggx.alpha_x as f32 != ggx.alpha_y as f32;
        let (mut anisotropic, mut rough, mut lobes) = (false, false, [false; 4]);
        let model = match bsdf {
            Bsdf::Matte(m) => {
                rough = m.sigma > 0.0;
                shared::MODEL_MATTE
            }
            Bsdf::Plastic(_) => shared::MODEL_PLASTIC,
            Bsdf::Metal(m) => {
                anisotropic = differs(m.ggx);
                shared::MODEL_METAL
            }
            Bsdf::Substrate(m) => {
                anisotropic = differs(m.ggx);
                shared::MODEL_SUBSTRATE
            }
            Bsdf::Principled(m) => {
                anisotropic = differs(m.ggx);
                lobes = [m.sheen, m.clearcoat, m.subsurface, m.metallic].map(|weight| weight > 0.0);
                shared::MODEL_PRINCIPLED
            }
        };
        let parts = [
            (shared::SPEC_ANISOTROPIC, anisotropic),
            (shared::SPEC_ROUGH_MATTE, rough),
            (shared::SPEC_LOBE_SHEEN, lobes[0]),
            (shared::SPEC_LOBE_CLEARCOAT, lobes[1]),
            (shared::SPEC_LOBE_SUBSURFACE, lobes[2]),
            (shared::SPEC_LOBE_METALLIC, lobes[3]),
        ];
        Self { model, parts }
    }

    fn specialization(&self) -> Specialization {
        let model = Specialization::default().with(shared::SPEC_MODEL, self.model);
        self.parts.iter().fold(model, |all, &(id, on)| all.with(id, u32::from(on)))
    }
}

/// f of every case, each under the variant that `choose` gives it.
pub(crate) fn eval(gpu: &CheckedGpu, cases: &[Case], choose: Choice) -> Vec<DVec3> {
    let mut groups: BTreeMap<Variant, Vec<usize>> = BTreeMap::new();
    for (i, case) in cases.iter().enumerate() {
        groups.entry(choose(&case.bsdf)).or_default().push(i);
    }
    let mut values = vec![DVec3::NAN; cases.len()];
    for (variant, members) in groups {
        let rows: Vec<_> = members.iter().map(|&i| cases[i].row()).collect();
        let constants = variant.specialization();
        let got: Vec<[f32; 4]> = amas::probe::run(gpu, shaders::PROBE_BSDF_COMP, &constants, &rows).unwrap();
        for (i, value) in members.into_iter().zip(got) {
            values[i] = Vec3::from_slice(&value).as_dvec3();
        }
    }
    values
}
