//! Formulas of BSDFs.

mod cases;

use super::formulas::Formula;
use crate::gpu::shaders;

/// An expression of four slots, in the precision of its place.
macro_rules! of {
    (|$a:ident, $b:ident, $c:ident, $d:ident| $value:expr) => {
        |slots| {
            #[allow(unused_variables, reason = "formulas of fewer slots")]
            let [$a, $b, $c, $d] = *slots;
            $value
        }
    };
}

/// A row: number, name, texts, directions, cases; the usual form; the one that ships.
macro_rules! formula {
    ($number:ident, $name:literal, [$naive_text:literal, $shipped_text:literal], $directions:literal, $cases:ident,
     |$a:ident, $b:ident, $c:ident, $d:ident| $naive:expr, $shipped:expr) => {
        Formula {
            number: crate::shared::$number,
            shader: shaders::PROBE_HARD_COMP,
            name: $name,
            naive_text: $naive_text,
            shipped_text: $shipped_text,
            naive: of!(|$a, $b, $c, $d| $naive),
            exact_naive: of!(|$a, $b, $c, $d| $naive),
            shipped: Some(of!(|$a, $b, $c, $d| $shipped)),
            truth: of!(|$a, $b, $c, $d| $shipped),
            directions: $directions,
            cases: cases::$cases,
        }
    };
}

pub(super) const FORMULAS: &[Formula] = &[
    formula!(
        HARD_DISTRIBUTION,
        "GGX D",
        ["α⁴/(c²(α² − 1) + 1)²", "(H²/((Hx² + Hy²)/α² + Hz²))²"],
        0,
        DISTRIBUTION,
        |a, b, c, d| {
            let (h, alpha2) = ((a + b).truncate().normalize(), c.x * c.x);
            (alpha2 / (h.z * h.z * (alpha2 - 1.0) + 1.0)).powi(2)
        },
        {
            let h = a + b;
            let (flat, up) = (h.x * h.x + h.y * h.y, h.z * h.z);
            ((flat + up) / (flat / (c.x * c.x) + up)).powi(2)
        }
    ),
    formula!(
        HARD_SCHLICK,
        "Schlick's weight",
        ["(1 − wi·h)⁵", "(|wi − wo|²/(4(1 + |wi + wo|/2)))⁵"],
        2,
        SCHLICK,
        |a, b, c, d| (1.0 - b.truncate().dot((a + b).truncate().normalize())).powi(5),
        ((b - a).length_squared() / (4.0 * (1.0 + 0.5 * (a + b).length()))).powi(5)
    ),
    formula!(
        HARD_HALF_COSINE,
        "wi·h",
        ["wi·(wi + wo)/|wi + wo|", "|wi + wo|/2"],
        2,
        HALF_COSINE,
        |a, b, c, d| b.truncate().dot((a + b).truncate().normalize()),
        0.5 * (a + b).length()
    ),
    formula!(
        HARD_VISIBILITY,
        "Smith's visibility",
        ["G(tan²θ)/(4 cosθi cosθo)", "½/(cosθi L(wo) + cosθo L(wi))"],
        2,
        VISIBILITY,
        |a, b, c, d| {
            let lambda = [a.z, b.z].map(|z| 0.5 * ((1.0 + c.x * c.x * (1.0 - z * z) / (z * z)).sqrt() - 1.0));
            2.0 * b.z / ((1.0 + lambda[0] + lambda[1]) * 4.0 * b.z * a.z)
        },
        {
            let stretch = [a.z, b.z].map(|z| (c.x * c.x + (1.0 - c.x * c.x) * z * z).sqrt());
            b.z / (b.z * stretch[0] + a.z * stretch[1]).max(1e-30)
        }
    ),
    formula!(
        HARD_DIELECTRIC,
        "dielectric Fresnel",
        ["amplitudes by Snell's cosine", "t² = η² − 1 + c², r = (1 − η²)/(c + t)²"],
        0,
        DIELECTRIC,
        |a, b, c, d| {
            let (eta, cosine) = (c.x, c.y.sqrt());
            let t = (1.0 - (1.0 - c.y) / (eta * eta)).sqrt();
            let (s, p) = ((cosine - eta * t) / (cosine + eta * t), (eta * cosine - t) / (eta * cosine + t));
            0.5 * (s * s + p * p)
        },
        {
            let (index, cos2) = ((c.x - 1.0) * (c.x + 1.0), c.y);
            let (t2, sin2) = ((index + cos2).max(0.0), 1.0 - cos2);
            let p = (cos2 * t2).sqrt();
            let root = (cos2 + t2 + 2.0 * p) * (p + sin2);
            (index * index * (cos2 * t2 + sin2 * sin2) / (root * root).max(1e-30)).min(1.0)
        }
    ),
    formula!(
        HARD_CONDUCTOR,
        "conductor Fresnel",
        [
            "a² = (m + Re t²)/2, R = (m + c² − 2ac)/(…)",
            "a² = (ηk/b)² where Re t² < 0, sums of positive terms"
        ],
        0,
        CONDUCTOR,
        |a, b, c, d| {
            let (eta, k, cos2) = (c.x, c.y, c.z);
            let sin2 = 1.0 - cos2;
            let real = eta * eta - k * k - sin2;
            let m = (real * real + 4.0 * eta * eta * k * k).sqrt();
            let ac2 = 2.0 * (0.5 * (m + real)).sqrt() * cos2.sqrt();
            let (s, p) = ((m + cos2 - ac2) / (m + cos2 + ac2), cos2 * m + sin2 * sin2);
            0.5 * (s + s * (p - ac2 * sin2) / (p + ac2 * sin2))
        },
        {
            let (eta, cos2) = (c.x, c.z);
            let k = if eta * eta + c.y * c.y < 1e-6 { 1e-3 } else { c.y };
            let sin2 = 1.0 - cos2;
            let index = (eta - 1.0) * (eta + 1.0) - k * k;
            let imaginary2 = 4.0 * (eta * k) * (eta * k);
            let real = index + cos2;
            let m = (real * real + imaginary2).sqrt();
            let larger = 0.5 * (m + real.abs());
            let smaller = 0.25 * imaginary2 / larger.max(1e-30);
            let ac = ((if real >= 0.0 { larger } else { smaller }) * cos2).sqrt();
            let mean = m * cos2 + sin2 * sin2;
            let sum = m + cos2 + 2.0 * ac;
            (index * index + imaginary2) * mean / (sum * sum * (mean + 2.0 * sin2 * ac)).max(1e-30)
        }
    ),
    formula!(
        HARD_COMPLEMENT,
        "substrate's diffuse factor",
        ["1 − (1 − x)⁵", "x(5 − x(10 − x(10 − x(5 − x))))"],
        0,
        COMPLEMENT,
        |a, b, c, d| 1.0 - (1.0 - c.x).powi(5),
        c.x * (5.0 - c.x * (10.0 - c.x * (10.0 - c.x * (5.0 - c.x))))
    ),
    formula!(
        HARD_OREN_NAYAR,
        "Oren and Nayar's s cosθi/t",
        ["(wi·wo − cosθi cosθo) cosθi/max(cosθi, cosθo)", "(wi.xy·wo.xy) min(cosθi/cosθo, 1)"],
        2,
        OREN_NAYAR,
        |a, b, c, d| (b.dot(a) - b.z * a.z).max(0.0) / b.z.max(a.z) * b.z,
        (b.x * a.x + b.y * a.y).max(0.0) * (b.z * (1.0 / a.z.max(1e-15))).min(1.0)
    ),
    formula!(
        HARD_CLEARCOAT,
        "clearcoat's D (GTR1)",
        ["1/(1 + (α² − 1)c²)", "H²/(Hx² + Hy² + α² Hz²)"],
        0,
        CLEARCOAT,
        |a, b, c, d| {
            let h = (a + b).truncate().normalize();
            1.0 / (1.0 + (c.x * c.x - 1.0) * h.z * h.z)
        },
        {
            let h = a + b;
            (h.x * h.x + h.y * h.y + h.z * h.z) / (h.x * h.x + h.y * h.y + c.x * c.x * h.z * h.z)
        }
    ),
    formula!(
        HARD_SUBSURFACE,
        "principled subsurface",
        ["Fss (1/(ci + co) − ½) + ½, Fss by (1 − c)⁵", "Fss/(ci + co) + ½(1 − Fss), Fss by 1 − (1 − c)⁵"],
        0,
        SUBSURFACE,
        |a, b, c, d| {
            let fss = [c.x, c.y].map(|cosine| 1.0 + (c.z - 1.0) * (1.0 - cosine).powi(5));
            fss[0] * fss[1] * (1.0 / (c.x + c.y) - 0.5) + 0.5
        },
        {
            let factor = [c.x, c.y]
                .map(|x| x * (5.0 - x * (10.0 - x * (10.0 - x * (5.0 - x)))) + c.z * (1.0 - x).powi(5));
            let fss = factor[0] * factor[1];
            fss / (c.x + c.y).max(1e-30) + 0.5 * (1.0 - fss)
        }
    ),
    formula!(
        HARD_TANGENT,
        "a tangent's length",
        ["(+y) × n, normalised", "Duff et al. 2017"],
        1,
        TANGENT,
        |a, b, c, d| {
            let length = (a.z * a.z + a.x * a.x).sqrt();
            (a.z / length).powi(2) + (a.x / length).powi(2)
        },
        {
            let sign = if a.z < 0.0 { -1.0 } else { 1.0 };
            let k = -1.0 / (sign + a.z);
            (1.0 + sign * a.x * a.x * k).powi(2) + (a.x * a.y * k).powi(2) + a.x * a.x
        }
    ),
];
