//! `[[material]]`: names, models and their parameters.
//!
//! Any colour or scalar is a constant or `{ texture = "file" }`; `normal_map` and `alpha_mask` also take the
//! bare file name. Defaults where the contract is silent:
//!
//! | model | colours | scalars |
//! | --- | --- | --- |
//! | matte | `color` 0.5 | |
//! | plastic | `diffuse` 0.5 | `roughness` 0.5 |
//! | metal | none: `eta` and `k`, or `preset`, are required | `roughness` 0.5, `anisotropic` 0 |
//! | substrate | `diffuse` 0.5, `specular` 0.05 | `roughness` 0.5, `anisotropic` 0 |
//! | principled | `base_color` 0.5 | `roughness` 0.5, `sheen_tint` 0.5, `clearcoat_gloss` 1, all others 0 |
//!
//! Ranges: colours ≥ 0, `sigma` 0…90 degrees, a dielectric's `eta` in (0, 100], a metal's `eta` > 0 and `k` ≥ 0,
//! everything else 0…1. `alpha = [x, y]` (metal and substrate) stores alpha = √(xy) and aspect = √(y/x), each of
//! x and y being raised to at least 1e-3, the smallest alpha that is drawn.

use super::{Table, Value};
use crate::error::Result;
use crate::scene::decode::Use;
use crate::scene::load::Loader;
use crate::scene::material::{Material, Model, PARAMETER_COUNT, Parameter};
use crate::scene::presets::CONDUCTORS;

/// Smallest alpha of either axis in `alpha = [x, y]`.
const SMALLEST_ALPHA: f64 = 1e-3;

const MODELS: [(&str, Model); 5] = [
    ("matte", Model::Matte),
    ("plastic", Model::Plastic),
    ("metal", Model::Metal),
    ("substrate", Model::Substrate),
    ("principled", Model::Principled),
];

/// Reads every `[[material]]` into the loader's scene.
pub(in crate::scene) fn materials(loader: &mut Loader, root: &Table) -> Result<()> {
    for table in root.tables("material")? {
        loader.advance()?;
        let value = table.require("name", "\"floor\"")?;
        let name = value.string()?;
        if loader.material_named(name).is_some() {
            return Err(
                value.error(format!("\"{name}\" is the name of two materials"), "give each its own name")
            );
        }
        let material = material(loader, &table, name)?;
        loader.add_material(material, &table.place());
    }
    Ok(())
}

fn material(loader: &mut Loader, table: &Table, name: &str) -> Result<Material> {
    let model = table.require("type", "\"matte\"")?.choice(&MODELS)?;
    table.allow(&[keys(model), &["name", "type", "normal_map", "alpha_mask", "two_sided"]].concat())?;
    let material = Material {
        name: name.to_owned(),
        model,
        parameters: Default::default(),
        squared_roughness: false,
        two_sided: table.get_or("two_sided", true, Value::boolean)?,
    };
    let mut reader = Reader { loader, table, material };
    match model {
        Model::Matte => reader.matte()?,
        Model::Plastic => reader.plastic()?,
        Model::Metal => reader.metal()?,
        Model::Substrate => reader.substrate()?,
        Model::Principled => reader.principled()?,
    }
    reader.map("normal_map", Parameter::Normal, Use::Normal(1000))?;
    reader.map("alpha_mask", Parameter::Mask, Use::Mask)?;
    Ok(reader.material)
}

fn keys(model: Model) -> &'static [&'static str] {
    match model {
        Model::Matte => &["color", "sigma"],
        Model::Plastic => &["diffuse", "specular", "eta", "roughness", "alpha"],
        Model::Metal => &["eta", "k", "preset", "roughness", "alpha", "anisotropic"],
        Model::Substrate => &["diffuse", "specular", "roughness", "alpha", "anisotropic"],
        Model::Principled => &[
            "base_color",
            "metallic",
            "roughness",
            "eta",
            "specular_tint",
            "anisotropic",
            "sheen",
            "sheen_tint",
            "clearcoat",
            "clearcoat_gloss",
            "subsurface",
        ],
    }
}

/// The material under construction.
struct Reader<'l, 's, 't> {
    loader: &'l mut Loader<'s>,
    table: &'t Table<'t>,
    material: Material,
}

impl Reader<'_, '_, '_> {
    fn matte(&mut self) -> Result<()> {
        self.color("color", Parameter::Color, 0.5)?;
        self.scalar("sigma", Parameter::Sigma, 0.0, |value| value.within(0.0..=90.0))
    }

    fn plastic(&mut self) -> Result<()> {
        self.color("diffuse", Parameter::Color, 0.5)?;
        self.color("specular", Parameter::Specular, 1.0)?;
        self.eta()?;
        self.roughness()?;
        self.set(Parameter::Aspect, [1.0, 0.0, 0.0]);
        match self.table.get("alpha") {
            Some(alpha) if alpha.is_array() => Err(alpha
                .error("is a pair, but plastic is isotropic", "give one number, or use metal or substrate")),
            _ => Ok(()),
        }
    }

    fn metal(&mut self) -> Result<()> {
        self.conductor()?;
        self.roughness()?;
        self.aspect()
    }

    fn substrate(&mut self) -> Result<()> {
        self.color("diffuse", Parameter::Color, 0.5)?;
        self.color("specular", Parameter::Specular, 0.05)?;
        self.roughness()?;
        self.aspect()
    }

    fn principled(&mut self) -> Result<()> {
        self.color("base_color", Parameter::Color, 0.5)?;
        self.eta()?;
        self.roughness()?;
        self.aspect()?;
        let unit = |value: &Value| value.within(0.0..=1.0);
        self.scalar("metallic", Parameter::Metallic, 0.0, unit)?;
        self.scalar("specular_tint", Parameter::SpecularTint, 0.0, unit)?;
        self.scalar("sheen", Parameter::Sheen, 0.0, unit)?;
        self.scalar("sheen_tint", Parameter::SheenTint, 0.5, unit)?;
        self.scalar("clearcoat", Parameter::Clearcoat, 0.0, unit)?;
        self.scalar("clearcoat_gloss", Parameter::ClearcoatGloss, 1.0, unit)?;
        self.scalar("subsurface", Parameter::Subsurface, 0.0, unit)
    }

    /// `eta` and `k`, or `preset`.
    fn conductor(&mut self) -> Result<()> {
        let (eta, k) = (self.table.get("eta"), self.table.get("k"));
        let Some(preset) = self.table.get("preset") else {
            let missing = if eta.is_none() { "eta" } else { "k" };
            if eta.is_none() || k.is_none() {
                let cause = format!("the metal \"{}\" lacks `{missing}`", self.material.name);
                return Err(self.table.error(cause, "add `eta` and `k`, or `preset = \"gold\"`"));
            }
            self.color("eta", Parameter::Color, 1.0)?;
            if let Some(value) = eta.filter(|value| !value.is_table())
                && value.color()?.contains(&0.0)
            {
                return Err(value.error("has a channel that is 0", "give three numbers greater than 0"));
            }
            return self.color("k", Parameter::Specular, 1.0);
        };
        if let Some(extra) = eta.or(k) {
            return Err(extra.error("stands beside `preset`", "keep the preset, or `eta` and `k`"));
        }
        let presets: Vec<_> = CONDUCTORS.iter().map(|metal| (metal.name, metal)).collect();
        let metal = preset.choice(&presets)?;
        self.set(Parameter::Color, metal.eta);
        self.set(Parameter::Specular, metal.k);
        Ok(())
    }

    fn eta(&mut self) -> Result<()> {
        let rule = "greater than 0 and at most 100";
        self.scalar("eta", Parameter::Eta, 1.5, |value| {
            value.number_where(|x| x as f32 > 0.0 && x <= 100.0, rule)
        })
    }

    /// `roughness` or `alpha`; a pair of alphas also sets the aspect.
    fn roughness(&mut self) -> Result<()> {
        let unit = |value: &Value| value.within(0.0..=1.0);
        let Some(alpha) = self.table.get("alpha") else {
            self.material.squared_roughness = true;
            return self.scalar("roughness", Parameter::Roughness, 0.5, unit);
        };
        if self.table.get("roughness").is_some() {
            return Err(alpha.error("stands beside `roughness`", "keep one of the two: alpha = roughness²"));
        }
        if !alpha.is_array() {
            return self.scalar("alpha", Parameter::Roughness, 0.5, unit);
        }
        if let Some(extra) = self.table.get("anisotropic") {
            return Err(extra.error("stands beside `alpha = [x, y]`", "keep one of the two"));
        }
        let [x, y] = alpha.array("[0.1, 0.3]")?;
        let (x, y) = (unit(&x)?.max(SMALLEST_ALPHA), unit(&y)?.max(SMALLEST_ALPHA));
        self.set(Parameter::Roughness, [(x * y).sqrt() as f32, 0.0, 0.0]);
        self.set(Parameter::Aspect, [(y / x).sqrt() as f32, 0.0, 0.0]);
        Ok(())
    }

    /// The aspect from `anisotropic`, unless `alpha = [x, y]` has set it.
    fn aspect(&mut self) -> Result<()> {
        if self.table.get("alpha").is_some_and(|alpha| alpha.is_array()) {
            return Ok(());
        }
        self.scalar("anisotropic", Parameter::Aspect, 1.0, |value| {
            Ok((1.0 - 0.9 * value.within(0.0..=1.0)?).sqrt())
        })
    }

    fn set(&mut self, parameter: Parameter, constant: [f32; 3]) {
        self.material.parameters[parameter as usize].constant = constant;
    }

    fn color(&mut self, key: &str, parameter: Parameter, default: f32) -> Result<()> {
        match self.table.get(key) {
            Some(value) if value.is_table() => self.texture(&value, parameter, Use::Color),
            Some(value) => {
                self.set(parameter, value.color()?);
                Ok(())
            }
            None => {
                self.set(parameter, [default; 3]);
                Ok(())
            }
        }
    }

    fn scalar(
        &mut self,
        key: &str,
        parameter: Parameter,
        default: f64,
        read: impl Fn(&Value) -> Result<f64>,
    ) -> Result<()> {
        let constant = match self.table.get(key) {
            Some(value) if value.is_table() => return self.texture(&value, parameter, Use::Scalar),
            Some(value) => read(&value)?,
            None => default,
        };
        self.set(parameter, [constant as f32, 0.0, 0.0]);
        Ok(())
    }

    /// `{ texture = "file" }`.
    fn texture(&mut self, value: &Value, parameter: Parameter, usage: Use) -> Result<()> {
        let table = value.table()?;
        table.allow(&["texture"])?;
        let file = table.require("texture", "\"wood.png\"")?;
        self.material.parameters[parameter as usize].texture = Some(self.loader.texture(&file, usage)?);
        Ok(())
    }

    /// A parameter that only a texture can give: a file name, or a table with one.
    fn map(&mut self, key: &str, parameter: Parameter, usage: Use) -> Result<()> {
        match self.table.get(key) {
            None => Ok(()),
            Some(value) if value.is_table() => self.texture(&value, parameter, usage),
            Some(value) => {
                let index = self.loader.texture(&value, usage)?;
                self.material.parameters[parameter as usize].texture = Some(index);
                Ok(())
            }
        }
    }
}

const _: () = assert!(PARAMETER_COUNT == Parameter::Mask as usize + 1);
