//! Formulas of area lights. What ships is in GLSL only.

mod cases;
mod shapes;
mod truth;
mod usual;

use super::formulas::Formula;
use crate::gpu::shaders;
use usual::double;

/// A row: number, name, texts, directions, cases, usual form; the truth.
macro_rules! formula {
    ($number:ident, $name:literal, [$naive_text:literal, $shipped_text:literal], $directions:literal, $cases:ident,
     $usual:ident, $truth:expr) => {
        Formula {
            number: crate::shared::$number,
            shader: shaders::PROBE_HARD_AREA_COMP,
            name: $name,
            naive_text: $naive_text,
            shipped_text: $shipped_text,
            naive: usual::single::$usual,
            exact_naive: usual::double::$usual,
            shipped: None,
            truth: $truth,
            directions: $directions,
            cases: cases::$cases,
        }
    };
}

pub(super) const FORMULAS: &[Formula] = &[
    formula!(
        HARD_FORM_FACTOR,
        "form factor of a polygon",
        [
            "clipped, then Σ (u × v).z θ/sin θ, θ = acos(u·v), 1 up to .001",
            "angles by their sines, against an anchor; clipped on the way"
        ],
        0,
        FORM_FACTOR,
        form_factor,
        |slots| truth::polygon(&double::corners(slots))
    ),
    formula!(HARD_PARTS, "a polygon by its quarters", ["as above", "as above"], 0, PARTS, parts, |slots| {
        truth::polygon(&double::corners(slots))
    }),
    formula!(HARD_NOTCH, "form factor of an L", ["as above", "as above"], 0, NOTCH, notch, |slots| {
        truth::polygon(&double::notched(slots))
    }),
    formula!(
        HARD_HOLE,
        "form factor of a frame",
        ["outer less inner", "one outline of two rings"],
        0,
        HOLE,
        hole,
        |slots| {
            let [outer, inner] = [1.0, slots[3].x].map(|size| double::parallelogram(slots, size));
            (truth::polygon(&outer) - truth::polygon(&inner)).abs()
        }
    ),
    formula!(
        HARD_ELLIPSE,
        "form factor of a disk",
        [
            "its cone's cubic by Blinn's two roots and the third; at the horizon a sphere",
            "one root by Laguerre's method; the arc above the horizon"
        ],
        0,
        ELLIPSE,
        ellipse,
        |&[center, a, b, _]| truth::ellipse([center, a, b].map(|slot| slot.truncate()))
    ),
    formula!(
        HARD_LINE,
        "form factor of a line",
        ["l/(d(d² + l²)) + atan(l/d)/d² at its ends, no width", "the outline of its cylinder"],
        0,
        LINE,
        line,
        |&[a, b, radius, _]| truth::cylinder([a, b].map(|end| end.truncate()), radius.x)
    ),
    formula!(
        HARD_FURNACE,
        "a lobe in a white cube",
        ["frame by n × wo, form factors as usual", "a frame for every view, form factors that ship"],
        0,
        FURNACE,
        furnace,
        |&[wo, shape, stretch, _]| truth::furnace([wo, shape, stretch])
    ),
    formula!(
        HARD_INCIDENCE,
        "wo in the plane of incidence",
        ["wo · (wo − n (n·wo)), normalised", "in local coordinates, across (−wo.y, wo.x)"],
        2,
        VIEWS,
        incidence,
        |&[wo, n, ..]| wo.truncate().cross(n.truncate()).length()
    ),
];
