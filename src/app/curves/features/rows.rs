//! The table of features: each with the scene that it is measured in. A further one is a row here.

/// A scene: the common one with these keys of [render], materials, lights and whatever else.
pub(super) struct Variant {
    /// What it has, in words.
    pub(super) what: &'static str,
    keys: &'static str,
    /// The floor's material.
    floor: &'static str,
    more: &'static str,
    /// An output variable is drawn before the frames that are measured.
    pub(super) aov: bool,
}

/// A feature: without it; there but not used; used.
pub(super) struct Feature {
    pub(super) name: &'static str,
    pub(super) base: Variant,
    pub(super) unused: Option<Variant>,
    pub(super) used: Option<Variant>,
}

const PLASTIC: &str = "type = \"plastic\"\ndiffuse = [0.4, 0.4, 0.4]\nroughness = 0.5\n";
const BASE: Variant = Variant { what: "", keys: "", floor: PLASTIC, more: "", aov: false };

/// Materials in the file that nothing has.
macro_rules! idle {
    ($material:literal) => {
        concat!("[[material]]\nname = \"idle\"\n", $material)
    };
}

/// A light over the balls.
macro_rules! panel {
    ($more:literal) => {
        concat!(
            "[[light]]\ntype = \"rect\"\ncenter = [0, 2, -1]\nu = [0.6, 0, 0]\nv = [0, 0.4, 0.3]\nradiance = [5, 5, 5]\n",
            $more
        )
    };
}

const fn feature(name: &'static str, unused: Variant, used: Variant) -> Feature {
    Feature { name, base: BASE, unused: Some(unused), used: Some(used) }
}

const fn keys(what: &'static str, keys: &'static str) -> Variant {
    Variant { what, keys, ..BASE }
}

const fn more(what: &'static str, more: &'static str) -> Variant {
    Variant { what, more, ..BASE }
}

const fn floor(what: &'static str, floor: &'static str) -> Variant {
    Variant { what, floor, ..BASE }
}

pub(super) const FEATURES: &[Feature] = &[
    Feature {
        name: "nothing",
        base: BASE,
        unused: Some(Variant { what: "the same scene again", ..BASE }),
        used: None,
    },
    feature(
        "textures",
        more(
            "a material that no mesh has",
            idle!("type = \"plastic\"\ndiffuse = { texture = \"default_tiles.png\" }\nroughness = 0.5\n"),
        ),
        floor(
            "on the floor",
            "type = \"plastic\"\ndiffuse = { texture = \"default_tiles.png\" }\nroughness = 0.5\n",
        ),
    ),
    feature(
        "normal maps",
        more(
            "a material that no mesh has",
            idle!("type = \"plastic\"\nroughness = 0.5\nnormal_map = \"default_tiles_normal.png\"\n"),
        ),
        floor(
            "on the floor",
            "type = \"plastic\"\ndiffuse = [0.4, 0.4, 0.4]\nroughness = 0.5\nnormal_map = \"default_tiles_normal.png\"\n",
        ),
    ),
    feature(
        "alpha masks",
        more(
            "a material that no mesh has",
            idle!("type = \"plastic\"\nroughness = 0.5\nalpha_mask = \"default_lattice.png\"\n"),
        ),
        floor(
            "on the floor",
            "type = \"plastic\"\ndiffuse = [0.4, 0.4, 0.4]\nroughness = 0.5\nalpha_mask = \"default_lattice.png\"\n",
        ),
    ),
    feature(
        "indirect light",
        keys("asked for, not yet gathered", "indirect = { vpls = 16384, bounces = 3 }"),
        keys(
            "the same with shadows of points: left to gathering",
            "indirect = { vpls = 16384, bounces = 3 }\nshadows = true",
        ),
    ),
    feature(
        "the principled BSDF with all lobes",
        more(
            "a material that no mesh has",
            idle!("type = \"principled\"\nroughness = 0.4\nsheen = 0.5\nclearcoat = 1\nsubsurface = 0.3\n"),
        ),
        floor(
            "on the floor",
            "type = \"principled\"\nroughness = 0.4\nsheen = 0.5\nclearcoat = 1\nsubsurface = 0.3\n",
        ),
    ),
    feature(
        "anisotropy",
        more(
            "a material that no mesh has",
            idle!("type = \"metal\"\npreset = \"gold\"\nroughness = 0.4\nanisotropic = 0.5\n"),
        ),
        floor("on the floor", "type = \"metal\"\npreset = \"gold\"\nroughness = 0.4\nanisotropic = 0.5\n"),
    ),
    feature(
        "area lights",
        more(
            "one that faces away",
            "[[light]]\ntype = \"rect\"\ncenter = [0, 9, 0]\nu = [0.6, 0, 0]\nv = [0, 0, -0.4]\nradiance = [5, 5, 5]\n",
        ),
        more("one over the balls", panel!("")),
    ),
    Feature {
        name: "output variables",
        base: BASE,
        unused: Some(Variant { what: "one was drawn before", aov: true, ..BASE }),
        used: None,
    },
    Feature {
        name: "shadows of area lights",
        base: more("", panel!("visible = false\n")),
        unused: None,
        used: Some(Variant {
            what: "asked for",
            keys: "shadows = true",
            more: panel!("visible = false\n"),
            ..BASE
        }),
    },
    feature(
        "lights without a range",
        keys("light_error, which only they ask for", "light_error = 0.1"),
        more(
            "64 of them",
            "[[light]]\ntype = \"points\"\ngenerate = { count = 64, seed = 2, min = [-3, 1, -3], max = [3, 2, 3], \
             intensity = [0.1, 0.3] }\n",
        ),
    ),
    feature(
        "folded lists",
        keys("a cap that no list reaches", "max_lights_per_cluster = 512"),
        Variant {
            what: "a cap that many reach",
            keys: "max_lights_per_cluster = 128",
            more: "[[light]]\ntype = \"points\"\ngenerate = { count = 256, seed = 2, min = [-3, 0.2, -3], max = [3, 2, 3], \
                   intensity = [0.01, 0.03], range = 9 }\n",
            ..BASE
        },
    ),
];

impl Variant {
    /// The scene's file.
    pub(super) fn toml(&self) -> String {
        let Self { keys, floor, more, .. } = self;
        let ball = |x: f64, material: &str| {
            format!(
                "[[mesh]]\nshape = \"sphere\"\nradius = 0.5\nsegments = 48\nmaterial = \"{material}\"\n\
                 translate = [{x}, 0.5, 0]\n"
            )
        };
        format!(
            "[render]\nsize = [160, 90]\n{keys}\n\
             [[camera]]\nname = \"main\"\nposition = [0, 1.4, 5]\ntarget = [0, 0.6, 0]\nvertical_fov = 40\n\
             [[material]]\nname = \"floor\"\n{floor}\n\
             [[material]]\nname = \"metal\"\ntype = \"metal\"\npreset = \"gold\"\nroughness = 0.4\n\
             [[mesh]]\nshape = \"plane\"\nsize = 8\nmaterial = \"floor\"\n{}{}\
             [[light]]\ntype = \"points\"\ngenerate = {{ count = 256, seed = 1, min = [-3, 0.2, -3], max = [3, 2, 3], \
             intensity = [0.1, 0.3], range = 2 }}\n{more}",
            ball(-0.7, "floor"),
            ball(0.7, "metal")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::default_scene;
    use crate::scene::load_embedded;

    /// Every scene is sound.
    #[test]
    fn scenes() {
        for feature in FEATURES {
            for variant in
                [Some(&feature.base), feature.unused.as_ref(), feature.used.as_ref()].into_iter().flatten()
            {
                let scene = load_embedded("feature", &variant.toml(), default_scene::FILES, &[]).unwrap();
                assert!(scene.warnings.is_empty(), "{}: {:?}", feature.name, scene.warnings);
            }
        }
    }
}
