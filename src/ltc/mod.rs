//! Area lights by linearly transformed cosines (Heitz et al. 2016): the tables, and the fitter that makes them.
//!
//! A lobe f(wo, wi) n·wi is replaced by mass × D, where D is a cosine lobe under a linear map M:
//!
//! ```text
//! D(ω) = max(0, z(q))/π · det M⁻¹/|q|⁴,   q = M⁻¹ω
//! ```
//!
//! so that its integral over a polygon is the form factor of the polygon mapped by M⁻¹. A matrix has four numbers
//! (a, b, c, d), in one of two bases; for p relative to the shaded point, n the normal, v towards the viewer:
//!
//! ```text
//! Frame::Mirror   z = 2(n·v)n − v, y = normalize(n × v), x = y × z    q = (a p.x + t b p.z, p.y, t (c p.x + d p.z))
//! Frame::Normal   z = n, y = normalize(n × v), x = y × z              q = (a p.x + b p.z, p.y, c p.x + d p.z)
//! ```
//!
//! t is twice the lobe's alpha, alpha being r² (√alpha for the clear coat: [`Layer::stretch`]). About the mirror direction
//! the numbers have a limit as alpha goes to 0 (a = d = n·v), so bilinear interpolation and 16 bits are exact enough down
//! to any roughness. Of each texel the table also has three integrals of the lobe, of which its mass is a weighted sum
//! ([`Layer::mixture`]), and TV, a bound over the cells around it: under any one-sided light of uniform radiance L,
//! |mass × L × ∫ D − L × ∫ f cos| ≤ L × mass × TV, with mass and TV interpolated as they are.
//!
//! [`fit_layer`] makes a table: [`Layer`] and [`Lobe`] say of what, `grid` goes over the texels, `fit` is one texel's
//! search (over fixed directions, `samples`, by BFGS, `minimize`), `moments` integrates, [`assess`] judges.

mod assess;
mod build;
mod fit;
mod fresnel;
mod grid;
mod layer;
mod lobe;
mod matrix;
mod minimize;
mod moments;
mod quadrature;
mod samples;
mod table;

pub use assess::{Assessment, assess};
pub use build::{Cell, Fitted, fit_layer, fit_texel, fit_work, join};
pub use fit::Objective;
pub use fresnel::{project_conductor, project_dielectric};
pub use layer::{Frame, Layer, Parameters};
pub use lobe::{Lobe, PLASTIC_ETAS};
pub use matrix::{Basis, Shape, density, leak};
pub use table::{LayerTable, Lookup, Tables, schlick_share, tables};
