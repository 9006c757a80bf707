//! Outlines of rows, as glsl/probe/hard_area/shapes.glsl has them.

/// Functions of `Slot` and `Vector`, in the precision of their place.
macro_rules! shapes {
    () => {
        pub(in super::super) fn corners(slots: &[Slot; 4]) -> [Vector; 4] {
            slots.map(|slot| slot.truncate())
        }

        /// From each corner to the middles of its edges and of all.
        pub(in super::super) fn quarters(slots: &[Slot; 4]) -> [[Vector; 4]; 4] {
            let corners = corners(slots);
            let middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
            std::array::from_fn(|i| {
                let halfway = |k: usize| 0.5 * (corners[i] + corners[k & 3]);
                [corners[i], halfway(i + 1), middle, halfway(i + 3)]
            })
        }

        /// A parallelogram that lacks a quarter.
        pub(in super::super) fn notched(&[center, u, v, _]: &[Slot; 4]) -> [Vector; 6] {
            let [p, u, v] = [center, u, v].map(|slot| slot.truncate());
            [p - u - v, p + u - v, p + u, p, p + v, p - u + v]
        }

        pub(in super::super) fn parallelogram(&[center, u, v, _]: &[Slot; 4], size: Real) -> [Vector; 4] {
            let [p, u, v] = [center.truncate(), size * u.truncate(), size * v.truncate()];
            [p - u - v, p + u - v, p + u + v, p - u + v]
        }

        /// Lid and walls of the cube from −1 to 1 over the surface.
        fn cube() -> [[Vector; 4]; 5] {
            let lid = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
            let wall = |x: Real, y: Real| {
                let [a, b] = [Vector::new(x + y, y - x, 0.0), Vector::new(x - y, y + x, 0.0)];
                [a, a + Vector::Z, b + Vector::Z, b]
            };
            let lid = lid.map(|[x, y]| Vector::new(x, y, 1.0));
            [wall(1.0, 0.0), wall(0.0, 1.0), wall(-1.0, 0.0), wall(0.0, -1.0), lid]
        }
    };
}

pub(super) use shapes;
