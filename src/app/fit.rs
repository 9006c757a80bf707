//! `amas fit`: fits the tables of linearly transformed cosines.

use super::args::{FitOptions, ObjectiveName};
use super::fit_maps;
use super::outputs::{check_distinct, check_folder, make_folder};
use super::terminal::print;
use crate::error::{Error, Result};
use crate::image::write_atomically;
use crate::ltc::{Cell, Fitted, Layer, Objective, fit_layer, fit_work, join};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::Instant;

const HEADER: &str = "layer                 size    TV mean / max     leak max   between texels mean / max   bound max   seconds";

pub(super) fn run(options: &FitOptions) -> Result<()> {
    let layers = chosen(options)?;
    options.out.iter().try_for_each(|path| check_folder(path))?;
    options.maps.iter().try_for_each(|folder| make_folder(folder))?;
    let maps: Vec<_> = options.maps.iter().map(|folder| folder.join(fit_maps::SUMMARY)).collect();
    maps.iter().try_for_each(|path| check_folder(path))?;
    check_distinct(options.out.iter().chain(&maps), None)?;
    let objective = match options.objective {
        ObjectiveName::L1 => Objective::L1,
        ObjectiveName::L2 => Objective::L2,
    };
    let bar = progress(layers.iter().map(|layer| fit_work(*layer)).sum());
    let mut rows = Vec::new();
    let mut tables = Vec::new();
    print(HEADER)?;
    for layer in layers {
        bar.set_message(layer.name());
        let begin = Instant::now();
        let fitted = fit_layer(layer, objective, &|| bar.inc(1));
        let seconds = begin.elapsed().as_secs_f64();
        bar.suspend(|| print(row(&fitted, seconds)))?;
        if let Some(folder) = &options.maps {
            fit_maps::write(folder, &fitted)?;
            rows.push(summary(&fitted));
        }
        tables.push(fitted.table);
    }
    bar.finish_and_clear();
    if let Some(folder) = &options.maps {
        fit_maps::write_summary(folder, &rows)?;
    }
    match &options.out {
        Some(path) => {
            let tables = join(tables);
            write_atomically(path, |file| tables.write(file))
        }
        None => Ok(()),
    }
}

/// The layers that the options name, or all.
fn chosen(options: &FitOptions) -> Result<Vec<Layer>> {
    if options.layer.is_empty() {
        return Ok(Layer::ALL.to_vec());
    }
    if let Some(path) = &options.out {
        return Err(Error::usage(
            format!("{}: a file of tables has all layers", path.display()),
            "leave out --layer or --out",
        ));
    }
    let named = |name: &String| {
        Layer::ALL.into_iter().find(|layer| layer.name() == name).ok_or_else(|| {
            let names: Vec<_> = Layer::ALL.iter().map(|layer| layer.name()).collect();
            Error::usage(
                format!("there is no layer {name:?}"),
                format!("choose one of: {}", names.join(", ")),
            )
        })
    };
    options.layer.iter().map(named).collect()
}

fn progress(work: u64) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("fit {bar:40} {percent} % {msg}, {eta} left");
    match style {
        Ok(style) => ProgressBar::new(work).with_style(style),
        Err(_) => ProgressBar::new(work),
    }
}

/// The figures of a layer: name, then numbers.
pub(super) struct Summary {
    pub(super) layer: Layer,
    pub(super) variation: [f64; 2],
    pub(super) leak: f64,
    pub(super) excess: [f64; 2],
    pub(super) bound: f64,
}

/// Mean and maximum at the texels and between them, up to the last row but one: beyond lie the last degrees.
fn summary(fitted: &Fitted) -> Summary {
    let rows = fitted.table.size[1];
    let seen: Vec<&Cell> = fitted.cells.iter().filter(|cell| cell.row < f64::from(rows - 1)).collect();
    let at = |texels: bool, value: &dyn Fn(&Cell) -> f64| {
        let whole = |cell: &Cell| cell.column.fract() == 0.0 && cell.row.fract() == 0.0;
        let values = seen.iter().filter(|cell| whole(cell) == texels).map(|cell| value(cell));
        let (sum, most, count) =
            values.fold((0.0, 0.0_f64, 0), |(sum, most, count), v| (sum + v, most.max(v), count + 1));
        [sum / f64::from(count), most]
    };
    Summary {
        layer: fitted.table.layer,
        variation: at(true, &|cell| cell.table.variation),
        leak: at(true, &|cell| cell.table.leak)[1],
        excess: at(false, &|cell| cell.table.variation - cell.fitted),
        bound: at(false, &|cell| cell.table.bound)[1],
    }
}

fn row(fitted: &Fitted, seconds: f64) -> String {
    let Summary { layer, variation, leak, excess, bound } = summary(fitted);
    let [columns, rows] = fitted.table.size;
    format!(
        "{:<22}{:<8}{:.4} / {:.4}   {leak:.4}     {:.5} / {:.5}             {bound:.4}      {seconds:.1}",
        layer.name(),
        format!("{columns}×{rows}"),
        variation[0],
        variation[1],
        excess[0],
        excess[1],
    )
}
