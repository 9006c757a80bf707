//! What the device is given of area lights: outlines, convex pieces, points of cubature, textures.
#![allow(clippy::unwrap_used, reason = "a test that panics fails")]

use amas::Scene;
use amas::area_lights::{AreaLights, AreaPoint, MOST_VERTICES};
use amas::scene::{AreaLight, AreaShape, Texels, Texture};
use amas::shared::{AREA_RECORD_LOG2, AreaRecord};
use glam::{DVec2, DVec3, Vec3, vec3};

fn light(shape: AreaShape) -> AreaLight {
    AreaLight { shape, radiance: vec3(1.0, 2.0, 3.0), two_sided: false, visible: false, texture: None }
}

fn prepared(light: AreaLight, textures: Vec<Texture>) -> AreaLights {
    AreaLights::new(&Scene { area_lights: vec![light], textures, ..Scene::default() }, Vec3::ZERO).unwrap()
}

/// The coarse and the fine points of the first light.
fn points(lights: &AreaLights) -> [&[AreaPoint]; 2] {
    let record = lights.records[0];
    let (coarse, fine) = ((record.points & 0xffff) as usize, (record.points >> 16) as usize);
    let first = record.point_first as usize + 1;
    assert_eq!(lights.points.len(), first + coarse + fine);
    [&lights.points[first..first + coarse], &lights.points[first + coarse..]]
}

/// Loops of a run of vertices.
fn loops(lights: &AreaLights, first: u32, count: u32) -> Vec<Vec<DVec3>> {
    let run = &lights.vertices[first as usize..(first + count) as usize];
    let loops = run.split_inclusive(|vertex| vertex[3] == 1.0);
    loops.map(|l| l.iter().map(|&[x, y, z, _]| vec3(x, y, z).as_dvec3()).collect()).collect()
}

fn rings(lights: &AreaLights) -> Vec<Vec<DVec3>> {
    loops(lights, lights.records[0].ring_first, lights.records[0].ring_count)
}

fn pieces(lights: &AreaLights) -> Vec<Vec<DVec3>> {
    loops(lights, lights.records[0].piece_first, lights.records[0].piece_count)
}

/// A polygon in the plane z = 2, from loops in it.
fn polygon(loops: &[&[[f32; 2]]]) -> AreaLight {
    let points = |l: &&[[f32; 2]]| l.iter().map(|&[x, y]| vec3(x, y, 2.0)).collect::<Vec<_>>();
    let mut all = loops.iter().map(points);
    light(AreaShape::Polygon { vertices: all.next().unwrap(), holes: all.collect(), uvs: None })
}

fn circle(count: u32, radius: f32) -> Vec<[f32; 2]> {
    let angle = |i| std::f32::consts::TAU * i as f32 / count as f32;
    (0..count).map(|i| [radius * angle(i).cos(), radius * angle(i).sin()]).collect()
}

fn star(points: u32) -> Vec<[f32; 2]> {
    let tips = circle(2 * points, 2.0);
    (0..).zip(tips).map(|(i, [x, y])| if i % 2 == 0 { [x, y] } else { [0.4 * x, 0.4 * y] }).collect()
}

/// Outlines with and without holes, each named.
fn outlines() -> Vec<(&'static str, AreaLight)> {
    let l: &[[f32; 2]] = &[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let square: &[[f32; 2]] = &[[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let window = |x: f32, y: f32| [[x, y], [x + 0.5, y], [x + 0.5, y + 0.6], [x, y + 0.5]];
    let [a, b, mut c] = [window(-1.0, -1.0), window(0.3, -0.8), window(0.1, 0.7)];
    c.reverse();
    vec![
        ("triangle", polygon(&[&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]])),
        ("square", polygon(&[square])),
        ("rhomboid", polygon(&[&[[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [1.0, 1.0]]])),
        ("octagon", polygon(&[&circle(8, 1.0)])),
        ("64 corners", polygon(&[&circle(64, 1.0)])),
        ("L", polygon(&[l])),
        ("star", polygon(&[&star(7)])),
        ("ring", polygon(&[&circle(20, 2.0), &circle(14, 1.5)])),
        ("windows", polygon(&[square, &a, &b, &c])),
        ("collinear", polygon(&[&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [0.0, 0.5]]])),
    ]
}

/// Twice the vector area of a loop.
fn doubled(points: &[DVec3]) -> DVec3 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| a.cross(*b)).sum()
}

/// ∫ xⁱ yʲ over what loops in a plane z = const enclose, by Green's theorem with Gauss points on each edge.
fn moment(loops: &[Vec<DVec3>], i: i32, j: i32) -> f64 {
    const GAUSS: [[f64; 2]; 4] = [
        [-0.861_136_311_594_052_6, 0.347_854_845_137_453_9],
        [-0.339_981_043_584_856_3, 0.652_145_154_862_546_1],
        [0.339_981_043_584_856_3, 0.652_145_154_862_546_1],
        [0.861_136_311_594_052_6, 0.347_854_845_137_453_9],
    ];
    let edge = |(a, b): (&DVec3, &DVec3)| -> f64 {
        let at = |[x, w]: [f64; 2]| {
            let p = a.lerp(*b, 0.5 + 0.5 * x);
            0.5 * w * (b.y - a.y) * p.x.powi(i + 1) * p.y.powi(j) / f64::from(i + 1)
        };
        GAUSS.map(at).iter().sum()
    };
    loops.iter().map(|l| l.iter().zip(l.iter().cycle().skip(1)).map(edge).sum::<f64>()).sum()
}

fn summed(points: &[AreaPoint], i: i32, j: i32) -> f64 {
    let term = |p: &AreaPoint| {
        let [x, y, _] = p.position.map(f64::from);
        f64::from(p.weight) * x.powi(i) * y.powi(j)
    };
    points.iter().map(term).sum()
}

#[test]
fn pieces_are_convex_and_tile_the_outline() {
    for (name, light) in outlines() {
        let lights = prepared(light, vec![]);
        let area: f64 = rings(&lights).iter().map(|ring| doubled(ring).z).sum();
        let pieces = pieces(&lights);
        let tiled: f64 = pieces.iter().map(|piece| doubled(piece).z).sum();
        assert!((tiled / area - 1.0).abs() < 1e-6, "{name}: {tiled} of {area}");
        for piece in &pieces {
            assert!((3..=8).contains(&piece.len()), "{name}: {} vertices", piece.len());
            for k in 0..piece.len() {
                let [a, b, c] = [k, k + 1, k + 2].map(|k| piece[k % piece.len()]);
                let turn = (b - a).cross(c - b).z;
                assert!(turn >= -1e-6 * (b - a).length() * (c - b).length(), "{name}: {piece:?}");
            }
        }
        println!("{name}: {} pieces", pieces.len());
        let own = lights.records[0].piece_first == lights.records[0].ring_first;
        assert_eq!(own, ["triangle", "square", "rhomboid", "octagon", "collinear"].contains(&name), "{name}");
    }
}

/// The outline counter-clockwise seen from the front, holes clockwise, however they were given.
#[test]
fn rings_wind_as_the_front_sees_them() {
    for (name, light) in outlines() {
        let lights = prepared(light, vec![]);
        let normal = Vec3::from(lights.records[0].normal).as_dvec3();
        for (index, ring) in rings(&lights).iter().enumerate() {
            let facing = doubled(ring).dot(normal);
            assert!(if index == 0 { facing > 0.0 } else { facing < 0.0 }, "{name}: ring {index}");
        }
    }
    let (center, u, v) = (vec3(1.0, 2.0, 3.0), vec3(1.0, 0.0, 0.5), vec3(0.0, 2.0, 0.1));
    let lights = prepared(light(AreaShape::Rect { center, u, v }), vec![]);
    let facing = doubled(&rings(&lights)[0]) / 8.0;
    assert!((facing - u.as_dvec3().cross(v.as_dvec3())).length() < 1e-5);
}

/// A plate with 64 hexagonal holes is more than one record may hold: its parts tile it.
#[test]
fn outlines_of_many_corners_are_several_records() {
    let hexagon =
        |x: f32, y: f32| circle(6, 0.3).into_iter().map(|[a, b]| [a + x, b + y]).collect::<Vec<_>>();
    let holes: Vec<_> = (0..64_u32).map(|i| hexagon((i % 8) as f32 - 3.5, (i / 8) as f32 - 3.5)).collect();
    let plate: &[[f32; 2]] = &[[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]];
    let outline: Vec<_> = std::iter::once(plate).chain(holes.iter().map(Vec::as_slice)).collect();
    let lights = prepared(polygon(&outline), vec![]);
    assert!((5..40).contains(&lights.records.len()), "{}", lights.records.len());
    let mut area = 0.0;
    for record in &lights.records {
        assert!(record.piece_count as usize <= MOST_VERTICES);
        assert_eq!((record.ring_first, record.ring_count), (record.piece_first, record.piece_count));
        let own = loops(&lights, record.piece_first, record.piece_count);
        let own: f64 = own.iter().map(|piece| doubled(piece).z / 2.0).sum();
        let whole = f64::from(lights.points[record.point_first as usize].weight);
        assert!((whole / own - 1.0).abs() < 1e-6, "{whole} {own}");
        area += own;
    }
    let hole = 1.5 * 3.0_f64.sqrt() * 0.3 * 0.3;
    assert!((area / (64.0 - 64.0 * hole) - 1.0).abs() < 1e-6, "{area}");
}

/// Weights are positive and sum to the area; polynomials are integrated exactly up to the promised degree.
#[test]
fn rules_of_polygons_are_exact() {
    for (name, light) in outlines() {
        let lights = prepared(light, vec![]);
        let rings = rings(&lights);
        for (points, degree, most) in
            points(&lights).into_iter().zip([3, 5]).zip([10, 21]).map(|((a, b), c)| (a, b, c))
        {
            assert!(points.len() <= most, "{name}: {} points", points.len());
            assert!(points.iter().all(|point| point.weight > 0.0), "{name}");
            for (i, j) in (0..=degree).flat_map(|i| (0..=degree - i).map(move |j| (i, j))) {
                let (want, got) = (moment(&rings, i, j), summed(points, i, j));
                let scale = moment(&rings, 0, 0) * 2.0_f64.powi(i + j).max(1.0);
                assert!((want - got).abs() < 1e-6 * scale, "{name}, x^{i} y^{j}: {got} for {want}");
            }
        }
    }
}

/// ∫ sⁱ tʲ over [−1, 1]² or the unit disk, over its area.
fn mean_of_powers(disk: bool, i: i32, j: i32) -> f64 {
    if i % 2 == 1 || j % 2 == 1 {
        return 0.0;
    }
    if !disk {
        return 1.0 / f64::from((i + 1) * (j + 1));
    }
    let odd = |n: i32| (1..n).step_by(2).map(f64::from).product::<f64>();
    let even = |n: i32| (2..=n).step_by(2).map(f64::from).product::<f64>();
    2.0 / f64::from(i + j + 2) * odd(i) * odd(j) / even(i + j)
}

#[test]
fn rules_of_rectangles_and_ellipses_are_exact() {
    let (center, u, v) = (vec3(1.0, -2.0, 3.0), vec3(1.0, 0.0, 0.5), vec3(0.25, 2.0, 0.5));
    let spanned = u.as_dvec3().cross(v.as_dvec3()).length();
    for disk in [false, true] {
        let shape = if disk { AreaShape::Disk { center, u, v } } else { AreaShape::Rect { center, u, v } };
        let area = spanned * if disk { std::f64::consts::PI } else { 4.0 };
        let lights = prepared(light(shape), vec![]);
        assert_eq!(points(&lights).map(<[_]>::len), [4, 16]);
        let dual = [v.cross(u.cross(v)), u.cross(v.cross(u))].map(|d| d.as_dvec3());
        let st = |p: &AreaPoint| {
            let p = (Vec3::from(p.position) - center).as_dvec3();
            DVec2::new(p.dot(dual[0]) / u.as_dvec3().dot(dual[0]), p.dot(dual[1]) / v.as_dvec3().dot(dual[1]))
        };
        for (points, degree) in points(&lights).into_iter().zip([3, 7]) {
            for (i, j) in (0..=degree).flat_map(|i| (0..=degree - i).map(move |j| (i, j))) {
                let term = |p: &AreaPoint| f64::from(p.weight) * st(p).x.powi(i) * st(p).y.powi(j);
                let got: f64 = points.iter().map(term).sum::<f64>() / area;
                let want = mean_of_powers(disk, i, j);
                assert!((got - want).abs() < 1e-6, "disk {disk}, s^{i} t^{j}: {got} for {want}");
            }
        }
        let whole = lights.points[0];
        assert!((f64::from(whole.weight) / area - 1.0).abs() < 1e-6);
        assert!((Vec3::from(whole.position) - center).length() < 1e-6);
    }
}

#[test]
fn lines_weigh_their_length() {
    let (a, b) = (vec3(1.0, 0.0, 2.0), vec3(1.0, 3.0, 6.0));
    let lights = prepared(light(AreaShape::Line { a, b, radius: 0.1 }), vec![]);
    for (points, degree) in points(&lights).into_iter().zip([3, 11]) {
        for power in 0..=degree {
            let along = |p: &AreaPoint| f64::from((Vec3::from(p.position) - a).length()) / 5.0;
            let got: f64 = points.iter().map(|p| f64::from(p.weight) * along(p).powi(power)).sum();
            assert!((got - 5.0 / f64::from(power + 1)).abs() < 2e-6, "{power}: {got}");
        }
    }
    let record = lights.records[0];
    assert_eq!((record.radius, record.ring_count, record.u), (0.1, 0, [0.0, 3.0, 4.0]));
    assert!((f64::from(record.extent) - 2.5_f64.hypot(0.1)).abs() < 1e-6);
}

/// Each point has the mean of the texture over its part: a picture that is constant over every part is found again, and
/// whatever the picture, all points together send out its light.
#[test]
fn textures_are_filtered_over_each_point_s_part() {
    let quarters = |x: u32, y: u32| if (x < 32) == (y < 32) { 1.0 } else { 0.25 };
    let texels = |width: u32, height: u32, value: &dyn Fn(u32, u32) -> f32| {
        let at = |i: u32| [value(i % width, i / width), 0.5, 2.0, 1.0];
        Texture {
            name: "t".into(),
            width,
            height,
            texels: Texels::Float((0..width * height).map(at).collect()),
        }
    };
    let textured = |shape: AreaShape, texture: Texture| {
        prepared(AreaLight { texture: Some(0), ..light(shape) }, vec![texture])
    };
    let (center, u, v) = (Vec3::ZERO, vec3(2.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));
    for shape in [AreaShape::Rect { center, u, v }, AreaShape::Disk { center, u, v }] {
        let lights = textured(shape, texels(64, 64, &quarters));
        for point in points(&lights)[0] {
            // Row 0 is on top: the left upper quarter is bright, and so is the right lower one.
            let bright = (point.position[0] < 0.0) == (point.position[1] > 0.0);
            let want = if bright { 1.0 } else { 0.25 };
            // Texels at the middle lines are interpolated across them.
            assert!((point.radiance[0] - want).abs() < 0.02, "{point:?}");
            assert_eq!(point.radiance[1..], [1.0, 6.0]);
        }
    }
    let ramp = |x: u32, _| (x as f32 + 0.5) / 300.0;
    let (_, ring) = outlines().into_iter().find(|(name, _)| *name == "ring").unwrap();
    let shapes = [ring.shape, AreaShape::Rect { center, u, v }, AreaShape::Disk { center, u, v }];
    for (index, shape) in shapes.into_iter().enumerate() {
        let lights = textured(shape, texels(300, 200, &ramp));
        for points in points(&lights) {
            let (power, area) = points.iter().fold((0.0, 0.0), |(power, area), p| {
                (power + f64::from(p.weight * p.radiance[0]), area + f64::from(p.weight))
            });
            assert!((power / area - 0.5).abs() < 1e-3, "shape {index}: mean {}", power / area);
            assert!(points.iter().all(|p| p.radiance[2] == 6.0 || (p.radiance[2] - 6.0).abs() < 1e-5));
        }
    }
}

/// Numbers in records become texels: vertices, points and levels lie where the records say.
#[test]
fn texels_hold_everything() {
    let texels = (0..15).map(|i| [i as f32, 0.0, 0.0, 1.0]).collect();
    let texture = Texture { name: "t".into(), width: 5, height: 3, texels: Texels::Float(texels) };
    let (_, ring) = outlines().into_iter().find(|(name, _)| *name == "ring").unwrap();
    let ring = AreaLight { texture: Some(0), ..ring };
    let area_lights = vec![light(AreaShape::Line { a: Vec3::ZERO, b: Vec3::X, radius: 0.1 }), ring];
    let scene = Scene { area_lights, textures: vec![texture], ..Scene::default() };
    let lights = AreaLights::new(&scene, Vec3::ZERO).unwrap();
    let texels = lights.texels();
    let record: AreaRecord = bytemuck::cast_slice(&texels[1 << AREA_RECORD_LOG2..2 << AREA_RECORD_LOG2])[0];
    let float = |texel: [u32; 4]| texel.map(f32::from_bits);
    assert_eq!(float(texels[record.ring_first as usize]), lights.vertices[0]);
    let first = lights.points[lights.records[1].point_first as usize];
    let [x, y, z, weight] = float(texels[2 * record.point_first as usize]);
    assert_eq!(([x, y, z], weight), (first.position, first.weight));
    let heap = record.heap as usize;
    let levels: Vec<_> = texels[heap..heap + 3].iter().map(|level| [level[1], level[2]]).collect();
    assert_eq!(levels, [[5, 3], [2, 1], [1, 1]]);
    assert_eq!(record.size, 5 | 3 << 16);
    let mean = float(texels[heap + texels[heap + 2][0] as usize]);
    assert!((mean[0] - 7.0).abs() < 1e-5, "{mean:?}");
    assert_eq!(heap + texels[heap + 2][0] as usize + 1, texels.len());
}

#[test]
fn too_many_lights_are_refused() {
    let one = light(AreaShape::Line { a: Vec3::ZERO, b: Vec3::X, radius: 0.1 });
    let scene = Scene { area_lights: vec![one; 4097], ..Scene::default() };
    let error = AreaLights::new(&scene, Vec3::ZERO).unwrap_err().to_string();
    assert!(error.contains("4097") && error.contains("4096"), "{error}");
}
