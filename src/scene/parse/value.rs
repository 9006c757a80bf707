//! One value of the document, and its conversions with their checks.

use std::ops::RangeInclusive;

use glam::DVec3;
use toml::de::DeValue;

use super::{LARGEST, Source, Table, suggestion};
use crate::error::{Error, Result};

/// A value, and where it stands.
#[derive(Clone)]
pub(in crate::scene) struct Value<'a> {
    pub(super) source: &'a Source<'a>,
    /// As errors name it, e.g. `size` or `vertices[2]`.
    pub(super) key: String,
    pub(super) start: usize,
    pub(super) inner: &'a DeValue<'a>,
}

impl<'a> Value<'a> {
    /// The key that errors name.
    pub(in crate::scene) fn key(&self) -> &str {
        &self.key
    }

    /// File and line, for warnings.
    pub(in crate::scene) fn place(&self) -> String {
        self.source.place(self.start)
    }

    /// An error about this value; `cause` goes on after the key's name.
    pub(in crate::scene) fn error(&self, cause: impl AsRef<str>, remedy: impl Into<String>) -> Error {
        self.source.error(self.start, format!("`{}` {}", self.key, cause.as_ref()), remedy)
    }

    /// The error that the value has another type than `wanted`.
    pub(in crate::scene) fn wrong_type(&self, wanted: &str, example: &str) -> Error {
        let found = match self.inner {
            DeValue::Array(items) => format!("an array of {}", items.len()),
            other => format!("{} {}", article(other.type_str()), other.type_str()),
        };
        let cause = format!("must be {wanted}, but is {found}");
        // A part of an array is written in its place.
        let remedy = match self.key.contains('[') {
            true => format!("write e.g. `{example}` there"),
            false => format!("write e.g. `{} = {example}`", self.key),
        };
        self.error(cause, remedy)
    }

    /// A finite number of sane size.
    pub(in crate::scene) fn number(&self) -> Result<f64> {
        let number = match self.inner {
            DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
            DeValue::Integer(_) => self.any_integer().map(|integer| integer as f64),
            _ => return Err(self.wrong_type("a number", "1.0")),
        };
        match number {
            Some(x) if x.abs() <= LARGEST => Ok(x),
            Some(x) if x.is_nan() => Err(self.error("is not a number (nan)", "give a finite number")),
            _ => Err(self.error(
                format!("is infinite or beyond ±{LARGEST:e}"),
                format!("give a finite number within ±{LARGEST:e}"),
            )),
        }
    }

    fn any_integer(&self) -> Option<i128> {
        let DeValue::Integer(integer) = self.inner else {
            return None;
        };
        i128::from_str_radix(integer.as_str(), integer.radix()).ok()
    }

    /// A number that passes `test`; `rule` completes «must be …».
    pub(in crate::scene) fn number_where(&self, test: impl Fn(f64) -> bool, rule: &str) -> Result<f64> {
        let x = self.number()?;
        if test(x) {
            return Ok(x);
        }
        Err(self.error(format!("must be {rule}, but is {x}"), format!("give a number that is {rule}")))
    }

    /// A number > 0, also as float32.
    pub(in crate::scene) fn positive(&self) -> Result<f64> {
        self.number_where(|x| x as f32 > 0.0, "greater than 0")
    }

    /// A number within `range`.
    pub(in crate::scene) fn within(&self, range: RangeInclusive<f64>) -> Result<f64> {
        let rule = format!("from {} to {}", range.start(), range.end());
        self.number_where(|x| range.contains(&x), &rule)
    }

    /// A whole number within `range`.
    pub(in crate::scene) fn integer(&self, range: RangeInclusive<u32>) -> Result<u32> {
        let DeValue::Integer(integer) = self.inner else {
            return Err(self.wrong_type("a whole number", &range.start().to_string()));
        };
        let number = self.any_integer().and_then(|x| u32::try_from(x).ok());
        number.filter(|x| range.contains(x)).ok_or_else(|| {
            let rule = format!("from {} to {}", range.start(), range.end());
            self.error(format!("must be {rule}, but is {integer}"), format!("give a whole number {rule}"))
        })
    }

    /// `true` or `false`.
    pub(in crate::scene) fn boolean(&self) -> Result<bool> {
        self.inner.as_bool().ok_or_else(|| self.wrong_type("true or false", "true"))
    }

    /// A string that is not empty.
    pub(in crate::scene) fn string(&self) -> Result<&'a str> {
        let string = self.inner.as_str().ok_or_else(|| self.wrong_type("a string", "\"text\""))?;
        if string.trim().is_empty() {
            return Err(self.error("is empty", format!("give `{}` a text or leave the key out", self.key)));
        }
        Ok(string)
    }

    /// One of a few words.
    pub(in crate::scene) fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T> {
        let word = self.string()?;
        let found = choices.iter().find(|(name, _)| *name == word);
        found
            .map(|(_, value)| *value)
            .ok_or_else(|| self.unknown(word, choices.iter().map(|(name, _)| *name)))
    }

    /// The error that `word` is none of `known`.
    pub(in crate::scene) fn unknown<'k>(&self, word: &str, known: impl Iterator<Item = &'k str>) -> Error {
        self.error(format!("is \"{word}\", which is unknown"), suggestion(word, known))
    }

    /// The items of an array.
    pub(in crate::scene) fn items(&self, example: &str) -> Result<Vec<Value<'a>>> {
        let items = self.inner.as_array().ok_or_else(|| self.wrong_type("an array", example))?;
        let item = |(index, item)| self.source.value(&format!("{}[{index}]", self.key), item);
        Ok(items.iter().enumerate().map(item).collect())
    }

    /// Exactly `N` items.
    pub(in crate::scene) fn array<const N: usize>(&self, example: &str) -> Result<[Value<'a>; N]> {
        let wrong = || self.wrong_type(&format!("an array of {N} numbers"), example);
        self.items(example).ok().and_then(|items| items.try_into().ok()).ok_or_else(wrong)
    }

    /// A table, e.g. `{ vpls = 0 }`.
    pub(in crate::scene) fn table(&self) -> Result<Table<'a>> {
        self.named_table(&self.key)
    }

    /// A table that errors call `name`.
    pub(super) fn named_table(&self, name: &str) -> Result<Table<'a>> {
        let entries = self.inner.as_table().ok_or_else(|| self.wrong_type("a table", "{ … }"))?;
        Ok(Table { source: self.source, entries, start: self.start, name: name.to_owned() })
    }

    /// Whether the value is an array.
    pub(in crate::scene) fn is_array(&self) -> bool {
        self.inner.is_array()
    }

    /// Whether the value is a table.
    pub(in crate::scene) fn is_table(&self) -> bool {
        self.inner.is_table()
    }

    /// A point or a direction.
    pub(in crate::scene) fn vec3(&self) -> Result<DVec3> {
        let [x, y, z] = self.array("[0.0, 1.0, 0.0]")?;
        Ok(DVec3::new(x.number()?, y.number()?, z.number()?))
    }

    /// A direction of sane length, normalised.
    pub(in crate::scene) fn direction(&self) -> Result<DVec3> {
        let vector = self.vec3()?;
        vector
            .try_normalize()
            .ok_or_else(|| self.error("has length zero", "give a direction, e.g. [0.0, 1.0, 0.0]"))
    }

    /// A colour, radiance or intensity: three numbers ≥ 0.
    pub(in crate::scene) fn color(&self) -> Result<[f32; 3]> {
        let channels = self.array::<3>("[0.5, 0.5, 0.5]")?;
        let mut color = [0.0; 3];
        for (channel, value) in color.iter_mut().zip(channels) {
            *channel = value.number_where(|x| x >= 0.0, "0 or more")? as f32;
        }
        Ok(color)
    }
}

fn article(noun: &str) -> &'static str {
    if noun.starts_with(['a', 'i']) { "an" } else { "a" }
}
