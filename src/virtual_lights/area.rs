//! Points of area lights.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::steps::Steps;
use crate::reference::sampler::concentric_disk;
use crate::reference::texture::{Wrap, sample};
use crate::scene::{AreaLight, AreaShape, Luminaire, Texture, Vertex};

/// A point of an area light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    pub(super) position: DVec3,
    /// Unit, towards the front.
    pub(super) normal: DVec3,
    uv: DVec2,
}

/// The surface of an area light, with its points in proportion to area.
#[derive(Clone, Debug)]
enum Shape {
    Parallelogram {
        center: DVec3,
        u: DVec3,
        v: DVec3,
    },
    Ellipse {
        center: DVec3,
        u: DVec3,
        v: DVec3,
    },
    Triangles {
        corners: Vec<[Vertex; 3]>,
        areas: Steps,
    },
    /// Its side alone; `x` and `y` are radii across the axis.
    Cylinder {
        a: DVec3,
        axis: DVec3,
        x: DVec3,
        y: DVec3,
    },
}

impl Shape {
    fn new(shape: &AreaShape, triangles: impl Fn() -> Luminaire) -> Self {
        match shape {
            AreaShape::Rect { center, u, v } => {
                Self::Parallelogram { center: center.as_dvec3(), u: u.as_dvec3(), v: v.as_dvec3() }
            }
            AreaShape::Disk { center, u, v } => {
                Self::Ellipse { center: center.as_dvec3(), u: u.as_dvec3(), v: v.as_dvec3() }
            }
            AreaShape::Polygon { .. } => {
                let surface = triangles();
                let corners: Vec<_> =
                    surface.triangles.iter().map(|t| t.map(|i| surface.vertices[i as usize])).collect();
                let areas = Steps::new(corners.iter().map(|corners| 0.5 * cross(corners).length()));
                Self::Triangles { corners, areas }
            }
            AreaShape::Line { a, b, radius } => {
                let axis = b.as_dvec3() - a.as_dvec3();
                let along = axis.normalize_or(DVec3::Y);
                let x = along.any_orthonormal_vector();
                let radius = f64::from(*radius);
                Self::Cylinder { a: a.as_dvec3(), axis, x: radius * x, y: radius * along.cross(x) }
            }
        }
    }

    fn area(&self) -> f64 {
        match self {
            Self::Parallelogram { u, v, .. } => 4.0 * u.cross(*v).length(),
            Self::Ellipse { u, v, .. } => PI * u.cross(*v).length(),
            Self::Triangles { areas, .. } => areas.total(),
            Self::Cylinder { axis, x, .. } => 2.0 * PI * x.length() * axis.length(),
        }
    }

    /// The point of two numbers in [0, 1); `None` only where there is no area.
    fn point(&self, xi: DVec2) -> Option<Point> {
        match self {
            Self::Parallelogram { center, u, v } => flat(*center, *u, *v, 2.0 * xi - DVec2::ONE),
            Self::Ellipse { center, u, v } => flat(*center, *u, *v, concentric_disk(xi)),
            Self::Triangles { corners, areas } => {
                let pick = areas.pick(xi.x)?;
                let corners = &corners[pick.index];
                let root = pick.within.sqrt();
                let weights = [1.0 - root, root * (1.0 - xi.y), root * xi.y];
                let uv = |corner: &Vertex| DVec2::from_array(corner.uv.map(f64::from));
                let blend = |i: usize| weights[i] * place(&corners[i]);
                let blend_uv = |i: usize| weights[i] * uv(&corners[i]);
                Some(Point {
                    position: (0..3).map(blend).sum(),
                    normal: cross(corners).try_normalize()?,
                    uv: (0..3).map(blend_uv).sum(),
                })
            }
            Self::Cylinder { a, axis, x, y } => {
                let (sin, cos) = (2.0 * PI * xi.x).sin_cos();
                let out = cos * *x + sin * *y;
                let position = *a + xi.y * *axis + out;
                Some(Point { position, normal: out.try_normalize()?, uv: DVec2::ZERO })
            }
        }
    }

    /// Largest coordinate about `origin`.
    fn reach(&self, origin: DVec3) -> f64 {
        let around = |center: DVec3, half: DVec3| ((center - origin).abs() + half).max_element();
        match self {
            Self::Parallelogram { center, u, v } | Self::Ellipse { center, u, v } => {
                around(*center, u.abs() + v.abs())
            }
            Self::Triangles { corners, .. } => {
                corners.iter().flatten().map(|c| around(place(c), DVec3::ZERO)).fold(0.0, f64::max)
            }
            Self::Cylinder { a, axis, x, .. } => {
                around(*a + 0.5 * *axis, 0.5 * axis.abs() + DVec3::splat(x.length()))
            }
        }
    }
}

fn flat(center: DVec3, u: DVec3, v: DVec3, st: DVec2) -> Option<Point> {
    let position = center + st.x * u + st.y * v;
    Some(Point { position, normal: u.cross(v).try_normalize()?, uv: 0.5 * st + 0.5 })
}

fn place(vertex: &Vertex) -> DVec3 {
    DVec3::from_array(vertex.position.map(f64::from))
}

/// Twice the area, along the normal.
fn cross(corners: &[Vertex; 3]) -> DVec3 {
    let [a, b, c] = [0, 1, 2].map(|i| place(&corners[i]));
    (b - a).cross(c - a)
}

/// A picture, and how its points are chosen.
#[derive(Clone, Debug)]
struct Picture<'a> {
    texture: &'a Texture,
    rows: Steps,
    columns: Vec<Steps>,
}

/// Cells along a side of the square that a picture's points are chosen from.
const CELLS: u32 = 32;
/// Looks at the picture along a cell's side.
const LOOKS: u32 = 4;
/// Least share of a cell in the mean one's weight: a bright spot that no look met costs noise, and light is never lost.
const LEAST: f64 = 0.1;

impl<'a> Picture<'a> {
    fn new(shape: &Shape, texture: &'a Texture) -> Self {
        let look = |x: u32, y: u32| {
            let across = f64::from(CELLS * LOOKS);
            let xi = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / across;
            shape.point(xi).map_or(0.0, |point| sample(texture, point.uv, Wrap::Clamp).element_sum())
        };
        let cell = |x: u32, y: u32| {
            let looks = (0..LOOKS * LOOKS).map(|i| look(LOOKS * x + i % LOOKS, LOOKS * y + i / LOOKS));
            looks.sum::<f64>() / f64::from(3 * LOOKS * LOOKS)
        };
        let cells: Vec<Vec<f64>> = (0..CELLS).map(|y| (0..CELLS).map(|x| cell(x, y)).collect()).collect();
        let mean = cells.iter().flatten().sum::<f64>() / f64::from(CELLS * CELLS);
        // Where all looks met black, the picture may shine still.
        let least = LEAST * mean.max(1e-3);
        let columns: Vec<_> =
            cells.iter().map(|row| Steps::new(row.iter().map(|weight| weight + least))).collect();
        Self { texture, rows: Steps::new(columns.iter().map(Steps::total)), columns }
    }

    /// Mean of the texels, about.
    fn mean(&self) -> f64 {
        self.rows.total() / f64::from(CELLS * CELLS)
    }

    /// Numbers in [0, 1) that favour what is bright, and their density.
    fn warp(&self, xi: DVec2) -> Option<(DVec2, f64)> {
        let row = self.rows.pick(xi.y)?;
        let column = self.columns[row.index].pick(xi.x)?;
        let at = DVec2::new(column.index as f64 + column.within, row.index as f64 + row.within);
        let cells = f64::from(CELLS);
        Some((at / cells, column.probability * row.probability * cells * cells))
    }
}

/// An area light that emits.
#[derive(Clone, Debug)]
pub(super) struct Area<'a> {
    shape: Shape,
    radiance: DVec3,
    pub(super) two_sided: bool,
    picture: Option<Picture<'a>>,
}

impl<'a> Area<'a> {
    pub(super) fn new(light: &AreaLight, textures: &'a [Texture]) -> Self {
        let shape = Shape::new(&light.shape, || Luminaire::new(light));
        let line = matches!(light.shape, AreaShape::Line { .. });
        let texture = light.texture.and_then(|index| textures.get(index as usize)).filter(|_| !line);
        let picture = texture.map(|texture| Picture::new(&shape, texture));
        // The inside of a line does not shine.
        Self { shape, radiance: light.radiance.as_dvec3(), two_sided: light.two_sided && !line, picture }
    }

    /// Flux of the mean channel, about.
    pub(super) fn power(&self) -> f64 {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        let texel = self.picture.as_ref().map_or(1.0, Picture::mean);
        self.radiance.element_sum() / 3.0 * texel * PI * self.shape.area() * sides
    }

    /// A point of two numbers in [0, 1), and its radiance over the density per area, W·sr⁻¹.
    pub(super) fn point(&self, xi: DVec2) -> Option<(Point, DVec3)> {
        let area = self.shape.area();
        let Some(picture) = &self.picture else {
            return Some((self.shape.point(xi)?, self.radiance * area));
        };
        let (xi, density) = picture.warp(xi)?;
        let point = self.shape.point(xi)?;
        let texel = sample(picture.texture, point.uv, Wrap::Clamp);
        Some((point, self.radiance * texel * (area / density)))
    }

    /// Largest coordinate about `origin`, metres.
    pub(super) fn reach(&self, origin: DVec3) -> f64 {
        self.shape.reach(origin)
    }
}
