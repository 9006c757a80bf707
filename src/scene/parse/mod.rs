//! The scene file: TOML with a position for every value, so that every error names its line.
//!
//! [`Source`] knows where a text came from, [`Table`] and [`Value`] walk it, and one file per section turns
//! it into the plain data of [`crate::Scene`]. Numbers beyond ±[`LARGEST`] are refused everywhere: their
//! squares and products would leave float32 and end as infinities in the picture.

mod area;
pub(super) mod camera;
pub(super) mod light;
pub(super) mod material;
pub(super) mod mesh;
mod motion;
pub(super) mod render;
mod syntax;
mod value;

use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

pub(super) use value::Value;

use crate::error::{Error, Result};

/// Largest magnitude of any number in a scene.
pub(super) const LARGEST: f64 = 1e18;

/// Where a text came from; errors point into it.
pub(super) struct Source<'a> {
    path: &'a Path,
    text: &'a str,
    /// `KEY=VALUE` if the text is the value of a `--set`.
    set: Option<&'a str>,
}

impl<'a> Source<'a> {
    /// The scene file itself.
    pub(super) fn file(path: &'a Path, text: &'a str) -> Self {
        Self { path, text, set: None }
    }

    /// The value of `--set KEY=VALUE`.
    pub(super) fn set(path: &'a Path, text: &'a str, pair: &'a str) -> Self {
        Self { path, text, set: Some(pair) }
    }

    /// The text, without a byte order mark.
    pub(super) fn text(&self) -> &'a str {
        self.text
    }

    /// An error at byte `at` of the text.
    pub(super) fn error(&self, at: usize, cause: impl Into<String>, remedy: impl Into<String>) -> Error {
        match self.set {
            Some(pair) => Error::usage(format!("--set {pair}: {}", cause.into()), remedy),
            None => Error::input(self.path, self.line(at), cause, remedy),
        }
    }

    /// File and line of byte `at`, for warnings.
    fn place(&self, at: usize) -> String {
        format!("{}:{}", self.path.display(), self.line(at))
    }

    /// 1-based line of byte `at`.
    fn line(&self, at: usize) -> usize {
        let before = self.text.as_bytes().iter().take(at);
        1 + before.filter(|byte| **byte == b'\n').count()
    }

    /// The error of the TOML parser, in our form.
    pub(super) fn syntax(&self, error: &toml::de::Error) -> Error {
        let at = error.span().map_or(0, |span: Range<usize>| span.start);
        let what = error.message().lines().collect::<Vec<_>>().join("; ");
        self.error(at, format!("not valid TOML: {what}"), syntax::remedy(self.text, at))
    }

    /// The whole document as a table.
    pub(super) fn root(&'a self, document: &'a Spanned<DeTable<'a>>) -> Table<'a> {
        Table { source: self, entries: document.get_ref(), start: document.span().start, name: String::new() }
    }

    /// A value that stands alone, as in `--set`.
    pub(super) fn value(&'a self, key: &str, value: &'a Spanned<DeValue<'a>>) -> Value<'a> {
        Value { source: self, key: key.to_owned(), start: value.span().start, inner: value.get_ref() }
    }
}

/// A table of the document.
#[derive(Clone)]
pub(super) struct Table<'a> {
    source: &'a Source<'a>,
    entries: &'a DeTable<'a>,
    start: usize,
    /// As the user writes it, e.g. `[[camera]]`; empty for the document.
    name: String,
}

impl<'a> Table<'a> {
    /// Refuses keys that are not in `known`.
    pub(super) fn allow(&self, known: &[&str]) -> Result<()> {
        let Some(unknown) = self.entries.keys().find(|key| !known.contains(&key.get_ref().as_ref())) else {
            return Ok(());
        };
        let place =
            if self.name.is_empty() { "the scene file".to_owned() } else { format!("`{}`", self.name) };
        let cause = format!("unknown key `{}` in {place}", unknown.get_ref());
        Err(self.source.error(
            unknown.span().start,
            cause,
            suggestion(unknown.get_ref(), known.iter().copied()),
        ))
    }

    /// The value of `key`, if it is there.
    pub(super) fn get(&self, key: &str) -> Option<Value<'a>> {
        self.entries.get(key).map(|value| self.source.value(key, value))
    }

    /// The value of `key`, or the error that it is missing; `example` shows how to write it.
    pub(super) fn require(&self, key: &str, example: &str) -> Result<Value<'a>> {
        self.get(key).ok_or_else(|| {
            self.error(format!("`{}` lacks the key `{key}`", self.name), format!("add `{key} = {example}`"))
        })
    }

    /// `read` applied to the value of `key`, or `default` where the key is missing.
    pub(super) fn get_or<T>(
        &self,
        key: &str,
        default: T,
        read: impl FnOnce(&Value<'a>) -> Result<T>,
    ) -> Result<T> {
        self.get(key).map_or(Ok(default), |value| read(&value))
    }

    /// All values, in the order of their keys.
    pub(super) fn values(&self) -> impl Iterator<Item = Value<'a>> + use<'a> {
        let source = self.source;
        self.entries.iter().map(move |(key, value)| source.value(key.get_ref(), value))
    }

    /// The `[[key]]` tables; none where the key is missing.
    pub(super) fn tables(&self, key: &str) -> Result<Vec<Table<'a>>> {
        let Some(value) = self.get(key) else {
            return Ok(Vec::new());
        };
        let DeValue::Array(items) = value.inner else {
            return Err(
                value.error("must be an array of tables", format!("write [[{key}]] with double brackets"))
            );
        };
        let tables = items.iter().map(|item| self.source.value(key, item).named_table(&format!("[[{key}]]")));
        tables.collect()
    }

    /// File and line, for warnings.
    pub(super) fn place(&self) -> String {
        self.source.place(self.start)
    }

    /// An error about the table as a whole.
    pub(super) fn error(&self, cause: impl Into<String>, remedy: impl Into<String>) -> Error {
        self.source.error(self.start, cause, remedy)
    }
}

/// «did you mean», or the list of what is known.
pub(super) fn suggestion<'k>(unknown: &str, known: impl Iterator<Item = &'k str>) -> String {
    let known: Vec<&str> = known.collect();
    // Of `indirect.vpls` the last part may be meant.
    let last = |name: &'k str| name.rsplit('.').next().unwrap_or(name);
    let similarity =
        |name: &'k str| strsim::jaro_winkler(unknown, name).max(strsim::jaro_winkler(unknown, last(name)));
    let best = known.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    match best {
        Some(name) if similarity(name) > 0.75 => format!("did you mean `{name}`?"),
        Some(_) if known.len() <= 24 => format!("use one of: {}", known.join(", ")),
        Some(_) => "use a name that exists".to_owned(),
        None => "remove it; there is none to choose from".to_owned(),
    }
}
