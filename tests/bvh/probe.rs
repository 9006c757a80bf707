//! Scenes of loose triangles, random numbers, and the way to the device.

use amas::bvh::Bvh;
use amas::gpu::{Specialization, shaders};
use amas::gpu_scene::occluders::Occluders;
use amas::scene::{Mesh, Scene, Vertex};
use amas::shared::RayProbeRow;
use glam::{DVec3, Vec3, vec3};

use crate::common::gpu::CheckedGpu;
use crate::common::square;

/// What the device says of each ray.
pub(crate) fn occluded(gpu: &CheckedGpu, scene: &Scene, rows: &[RayProbeRow]) -> Vec<bool> {
    let occluders = Occluders::new(gpu, &Bvh::new(scene, Vec3::ZERO)).unwrap();
    let masks = Specialization::default().with_all(&occluders.specialization);
    let values: Vec<u32> =
        amas::probe::run_among(gpu, shaders::PROBE_BVH_COMP, &masks, &|scene| occluders.bind(scene), rows)
            .unwrap();
    assert!(values.iter().all(|&value| value <= 1));
    values.into_iter().map(|value| value == 1).collect()
}

/// A ray of which everything between its ends counts.
pub(crate) fn ray(origin: Vec3, direction: Vec3, t_min: f32, t_max: f32) -> RayProbeRow {
    let (origin, direction) = (origin.to_array(), direction.to_array());
    RayProbeRow { origin, t_min, direction, t_max, ..RayProbeRow::default() }
}

/// One mesh of loose triangles.
pub(crate) fn soup(triangles: &[[Vec3; 3]]) -> Scene {
    let vertex = |position: &Vec3| Vertex { position: position.to_array(), ..Vertex::default() };
    let mesh = Mesh {
        vertices: triangles.iter().flatten().map(vertex).collect(),
        triangles: (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        material: 0,
    };
    Scene { meshes: vec![mesh], ..square::scene() }
}

/// `count` triangles of about `size` in a cube of half edge `half`.
pub(crate) fn random_soup(
    random: &mut Random,
    count: usize,
    center: Vec3,
    half: f32,
    size: f32,
) -> Vec<[Vec3; 3]> {
    (0..count)
        .map(|_| {
            let place = center + random.place() * half;
            // Sliver or compact.
            let stretch = random.number().powi(3);
            let [a, b] = [random.direction() * size, random.direction() * (size * stretch)];
            [place, place + a, place + b]
        })
        .collect()
}

/// A closed surface of 1152 triangles, of radius 1.7.
pub(crate) fn sphere(center: Vec3) -> Vec<[Vec3; 3]> {
    let n = 24;
    let at = |i: u32, j: u32| {
        let (phi, theta) =
            ((i % n) as f32 / n as f32 * std::f32::consts::TAU, j as f32 / n as f32 * std::f32::consts::PI);
        let ring = if j == 0 || j == n { 0.0 } else { theta.sin() };
        vec3(ring * phi.cos(), theta.cos(), ring * phi.sin()) * 1.7 + center
    };
    let quads = (0..n).flat_map(|i| (0..n).map(move |j| [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]));
    quads
        .flat_map(|quad| {
            let [a, b, c, d] = quad.map(|(i, j)| at(i, j));
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// All triangles of a scene's meshes.
pub(crate) fn triangles(scene: &Scene) -> Vec<[DVec3; 3]> {
    let of_mesh = |mesh: &Mesh| {
        let corner = |index: u32| Vec3::from(mesh.vertices[index as usize].position).as_dvec3();
        mesh.triangles.iter().map(|triangle| triangle.map(corner)).collect::<Vec<_>>()
    };
    scene.meshes.iter().flat_map(of_mesh).collect()
}

/// PCG, the same numbers everywhere.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// In [0, 1).
    pub(crate) fn number(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = ((self.0 >> 18) ^ self.0) >> 27;
        let word = (mixed as u32).rotate_right((self.0 >> 59) as u32);
        (word >> 8) as f32 / 16_777_216.0
    }

    /// In the cube of half edge 1.
    pub(crate) fn place(&mut self) -> Vec3 {
        vec3(self.number(), self.number(), self.number()) * 2.0 - 1.0
    }

    /// Uniform over directions.
    pub(crate) fn direction(&mut self) -> Vec3 {
        loop {
            let p = self.place();
            if (0.01..=1.0).contains(&p.length_squared()) {
                return p.normalize();
            }
        }
    }
}
