//! The chapter on choices as text.

use super::tables::Stored;
use super::{Extent, Figures};
use std::fmt::Write as _;
use std::io::{self, Write};

pub(super) fn csv(file: &mut impl Write, figures: &Figures) -> io::Result<()> {
    writeln!(file, "layer,side,format,bytes,error_mean,error_worst")?;
    figures.tables.iter().try_for_each(|stored| {
        let bytes = stored.bytes.map_or_else(String::new, |bytes| bytes.to_string());
        let (format, side) = (stored.format.name().replace(',', ""), side(stored));
        writeln!(file, "{},{side},{format},{bytes},{:.6},{:.6}", stored.layer, stored.mean, stored.worst)
    })
}

fn side(stored: &Stored) -> String {
    stored.side.map_or_else(|| "own fits".into(), |side| side.to_string())
}

/// What is printed.
pub(super) fn summary(figures: &Figures) -> String {
    let mut text = format!("{:<10}{:>9}  {:<16}mean error     worst\n", "tables", "side", "format");
    for stored in &figures.tables {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<10}{:>9}  {:<16}{:>10.5}  {:>8.5}",
            stored.layer,
            side(stored),
            stored.format.name(),
            stored.mean,
            stored.worst
        );
    }
    let worst = figures.halves.iter().map(|rounding| rounding.worst).fold(0.0, f64::max);
    let _ = writeln!(text, "textures in halves are off by {worst:.1e} at most");
    for behind in &figures.cones {
        let share = 100.0 * behind.behind;
        let _ =
            writeln!(text, "{}: {share:.1} % of the lights in reach are behind the surface", behind.scene);
    }
    text.trim_end().to_owned()
}

pub(super) fn page(figures: &Figures, quick: bool, extent: Extent) -> String {
    let commit = option_env!("AMAS_COMMIT").unwrap_or("an unknown commit");
    let quick = if quick { " --quick" } else { "" };
    let mut text = format!(
        "# Choices without a knob\n\n\
         Written by `amas report --chapter choices{quick} --out DIR` at {commit}, in double precision on the processor. \
         `choices.csv` has the tables, `choices.json` every figure. Nothing here is timed.\n"
    );
    tables(&mut text, figures, extent);
    halves(&mut text, figures);
    cones(&mut text, figures, extent);
    text
}

fn tables(text: &mut String, figures: &Figures, extent: Extent) {
    let _ = write!(
        text,
        "\n## Texels and bits of the tables of transformed cosines\n\n\
         Error: the most by which the lobe's integral over any directions may be off, over its albedo, at {} random places \
         of the table up to 88°. *Own fits* are made for each place. A lookup takes as long whatever the number of texels, \
         so that bytes stand for cost: those of matrices and moments of one layer.\n\n\
         ![Mean error over bytes](choices.png)\n\n\
         | layer | texels a side | stored as | bytes | mean error | worst | |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        extent.places
    );
    for stored in &figures.tables {
        let bytes = stored.bytes.map_or_else(|| "–".into(), |bytes| bytes.to_string());
        let default = if stored.default { "default" } else { "" };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {} | {bytes} | {:.3} % | {:.2} % | {default} |",
            stored.layer,
            side(stored),
            stored.format.name(),
            100.0 * stored.mean,
            100.0 * stored.worst
        );
    }
    text.push_str(
        "\nThe default is 32 × 32 texels, because with as many the mean error is within some percent of that of own fits: more \
         have next to nothing to gain. Matrices have 16 bits in the file, which cost nothing, and moments floats, as those of \
         dielectrics are small for fixed point; devices have floats. What is left is the form of the lobe, one cosine: \
         [docs/ltc](../ltc/README.md) has it by roughness and angle, and shipped pictures take quadrature where it is too much.\n",
    );
}

fn halves(text: &mut String, figures: &Figures) {
    text.push_str(
        "\n## Halves for textures\n\n\
         Textures are halves on devices that are CPUs, and where their files have floats. Errors of all texels of all levels \
         of the embedded scene's textures, in linear light, relative:\n\n\
         | texture | texels | mean | worst |\n| --- | --- | --- | --- |\n",
    );
    for rounding in &figures.halves {
        let _ = writeln!(
            text,
            "| {} | {} | {:.1e} | {:.1e} |",
            rounding.texture, rounding.texels, rounding.mean, rounding.worst
        );
    }
    text.push_str(
        "\nThe default is halves there, because lavapipe 22.3.6 filters 8-bit texels in 8 bits: the mean error of a textured wall \
         was 3.5e-3 with them and is 1.3e-4 with halves. Floats would take twice the memory for the last 1.3e-4; nobody has \
         timed them, for there is no switch.\n",
    );
}

fn cones(text: &mut String, figures: &Figures, extent: Extent) {
    let [width, height] = extent.size;
    let _ = write!(
        text,
        "\n## Clusters split by normals\n\n\
         Not built. They could leave out lights that are behind all surfaces of a cluster; at most, those behind the pixel's \
         own surface, {width} × {height} pixels:\n\n\
         | scene | lights in reach of a pixel | of which behind its surface |\n| --- | --- | --- |\n"
    );
    for behind in &figures.cones {
        let share = 100.0 * behind.behind;
        let _ = writeln!(text, "| `{}` | {:.1} | {share:.1} % |", behind.scene, behind.per_pixel);
    }
    text.push_str(
        "\nThat share of the pairs is the bound of the gain, to be set against more clusters, shorter runs of pixels with one list \
         and a cone for each.\n",
    );
}
