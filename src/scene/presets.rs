//! Metals by name.

/// Complex index of refraction of a metal per colour channel.
pub(super) struct Conductor {
    /// Name in the scene file.
    pub(super) name: &'static str,
    /// Real part.
    pub(super) eta: [f32; 3],
    /// Absorption coefficient.
    pub(super) k: [f32; 3],
}

/// Measured indices at 650, 550 and 450 nm, which stand for red, green and blue. They are those that
/// refractiveindex.info lists (Johnson and Christy 1972 and 1974, Rakić 1995 and 1998), as rounded in the
/// hard-coded metals of the LabPBR material standard.
pub(super) const CONDUCTORS: [Conductor; 6] = [
    Conductor { name: "gold", eta: [0.18299, 0.42108, 1.3734], k: [3.4242, 2.3459, 1.7704] },
    Conductor { name: "silver", eta: [0.15943, 0.14512, 0.13547], k: [3.9291, 3.1900, 2.3808] },
    Conductor { name: "copper", eta: [0.27105, 0.67693, 1.3164], k: [3.6092, 2.6248, 2.2921] },
    Conductor { name: "aluminium", eta: [1.3456, 0.96521, 0.61722], k: [7.4746, 6.3995, 5.3031] },
    Conductor { name: "iron", eta: [2.9114, 2.9497, 2.5845], k: [3.0893, 2.9318, 2.7670] },
    Conductor { name: "chromium", eta: [3.1071, 3.1812, 2.3230], k: [3.3314, 3.3291, 3.1350] },
];
