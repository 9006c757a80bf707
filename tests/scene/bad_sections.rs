//! Sections of scene files that are wrong: materials, meshes, lights. See `bad` for what is asserted.

use crate::bad::fails;

#[test]
fn materials() {
    fails("[[material]]\ntype = \"matte\"\n", 5, "lacks the key `name`");
    fails("[[material]]\nname = \"\"\ntype = \"matte\"\n", 6, "is empty");
    fails("[[material]]\nname = \"m\"\n", 5, "lacks the key `type`");
    let twice = "[[material]]\nname = \"m\"\ntype = \"matte\"\n";
    fails(&format!("{twice}{twice}"), 9, "two materials");
    let cases = [
        ("matt", "", 7, "did you mean `matte`?"),
        ("matte", "diffuse = [1, 1, 1]", 8, "unknown key `diffuse`"),
        ("matte", "color = [-1, 0, 0]", 8, "0 or more"),
        ("matte", "color = 0.5", 8, "array of 3 numbers"),
        ("matte", "color = { file = \"a.png\" }", 8, "unknown key `file`"),
        ("matte", "color = { texture = \"no.png\" }", 8, "does not exist"),
        ("matte", "sigma = 91", 8, "from 0 to 90"),
        ("matte", "normal_map = \"no.png\"", 8, "does not exist"),
        ("matte", "alpha_mask = 3", 8, "must be a string"),
        ("matte", "two_sided = \"yes\"", 8, "true or false"),
        ("plastic", "eta = 0", 8, "greater than 0"),
        ("plastic", "eta = -1.5", 8, "greater than 0"),
        ("plastic", "roughness = -0.1", 8, "from 0 to 1"),
        ("plastic", "alpha = 1.5", 8, "from 0 to 1"),
        ("plastic", "alpha = [0.1, 0.2]", 8, "plastic is isotropic"),
        ("plastic", "roughness = 0.1\nalpha = 0.1", 9, "beside `roughness`"),
        ("metal", "", 5, "lacks `eta`"),
        ("metal", "eta = [1, 1, 1]", 5, "lacks `k`"),
        ("metal", "eta = [1, 0, 1]\nk = [1, 1, 1]", 8, "greater than 0"),
        ("metal", "preset = \"goldd\"", 8, "did you mean `gold`?"),
        ("metal", "preset = \"gold\"\nk = [1, 1, 1]", 9, "beside `preset`"),
        ("metal", "preset = \"gold\"\nanisotropic = 2", 9, "from 0 to 1"),
        ("metal", "preset = \"gold\"\nalpha = [0.1, 0.2]\nanisotropic = 0.2", 10, "beside `alpha = [x, y]`"),
        ("metal", "preset = \"gold\"\nalpha = [0.1]", 9, "array of 2"),
        ("principled", "metallic = 1.1", 8, "from 0 to 1"),
        ("principled", "sheeen = 1", 8, "did you mean `sheen`?"),
    ];
    for (model, keys, line, part) in cases {
        fails(&format!("[[material]]\nname = \"m\"\ntype = \"{model}\"\n{keys}\n"), line, part);
    }
}

#[test]
fn meshes() {
    let cases = [
        ("material = \"x\"", 5, "neither `obj` nor `shape`"),
        ("obj = \"m.obj\"\nshape = \"box\"", 7, "beside `obj`"),
        ("obj = \"n.obj\"", 6, "does not exist"),
        ("obj = \"m.obj\"\nsize = 3", 7, "unknown key `size`"),
        ("obj = \"m.obj\"\nmaterial = \"x\"", 7, "which is unknown"),
        ("obj = \"m.obj\"\nmaterials = { a = \"x\" }", 7, "which is unknown"),
        ("obj = \"m.obj\"\nnormals = \"hard\"", 7, "use one of: smooth, flat"),
        ("obj = \"m.obj\"\nscale = 0", 7, "axis that is 0"),
        ("obj = \"m.obj\"\nscale = [1, 1]", 7, "array of 3"),
        ("obj = \"m.obj\"\nscale = 1e18\ntranslate = [1e18, 0, 0]", 5, "reaches beyond"),
        ("obj = \"m.obj\"\nrotate = [0, nan, 0]", 7, "not a number"),
        ("shape = \"spere\"", 6, "did you mean `sphere`?"),
        ("shape = \"sphere\"\nradius = -1", 7, "greater than 0"),
        ("shape = \"sphere\"\nsegments = 2", 7, "from 3 to 2048"),
        ("shape = \"sphere\"\nsegments = [32, 1]", 7, "from 2 to 1024"),
        ("shape = \"box\"\nsize = [1, 0, 1]", 7, "greater than 0"),
        ("shape = \"plane\"\nradius = 1", 7, "unknown key `radius`"),
    ];
    for (keys, line, part) in cases {
        fails(&format!("[[mesh]]\n{keys}\n"), line, part);
    }
}

#[test]
fn lights() {
    let cases = [
        ("position = [0, 0, 0]", 5, "lacks the key `type`"),
        ("type = \"spot\"", 6, "unknown"),
        ("type = \"point\"\nintensity = [1, 1, 1]", 5, "lacks the key `position`"),
        ("type = \"point\"\nposition = [0, 0, 0]\nintensity = [1, -1, 1]", 8, "0 or more"),
        ("type = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]\nrange = 0", 9, "greater than 0"),
        ("type = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]\nrange = inf", 9, "infinite"),
        ("type = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]\nvisible = true", 9, "no surface"),
        ("type = \"point\"\nradiance = [1, 1, 1]", 7, "unknown key `radiance`"),
        ("type = \"points\"", 5, "neither `file` nor `generate`"),
        ("type = \"points\"\nfile = \"l.csv\"", 7, "does not exist"),
        ("type = \"rect\"\ncenter = [0, 0, 0]\nu = [1, 0, 0]\nv = [2, 0, 0]", 9, "parallel"),
        ("type = \"rect\"\ncenter = [0, 0, 0]\nu = [0, 0, 0]\nv = [2, 0, 0]", 9, "one of them is zero"),
        ("type = \"disk\"\ncenter = [0, 0, 0]\nnormal = [0, 0, 0]\nradius = 1", 8, "length zero"),
        ("type = \"disk\"\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nradius = -1", 9, "greater than 0"),
        ("type = \"disk\"\ncenter = [0, 0, 0]\nradius = 1", 8, "without `normal`"),
        ("type = \"line\"\na = [1, 1, 1]\nb = [1, 1, 1]\nradius = 1", 8, "same point"),
        ("type = \"line\"\na = [1, 1, 1]\nb = [1, 2, 1]\nradius = 0", 9, "greater than 0"),
        ("type = \"polygon\"\nvertices = [[0,0,0],[1,0,0]]", 7, "has 2 vertices"),
        ("type = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[2,0,0]]", 7, "encloses no area"),
        ("type = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[1,1,0.01],[0,1,0]]", 7, "not planar"),
        ("type = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[1,0,0],[0,1,0]]", 7, "twice in a row"),
        ("type = \"polygon\"\nvertices = [[0,0,0],[4,0,0],[4,1,0],[1,-1,0],[0,2,0]]", 7, "crosses itself"),
    ];
    for (keys, line, part) in cases {
        fails(&format!("[[light]]\n{keys}\n"), line, part);
    }
    let square = "[[light]]\ntype = \"polygon\"\nvertices = [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]\n";
    fails(&format!("{square}holes = [[[2,0,0],[3,0,0],[2,1,0]]]\n"), 8, "leaves the outer loop");
    fails(&format!("{square}holes = [[[0.2,0.2,1],[0.3,0.2,1],[0.2,0.3,1]]]\n"), 8, "not planar");
    fails(&format!("{square}holes = [[0.2,0.2,0],[0.3,0.2,0],[0.2,0.3,0]]\n"), 8, "holes = [[[0, 2, 0]");
    fails(&format!("{square}uvs = [[0, 0]]\nradiance = [1, 1, 1]\n"), 8, "1 entries for 4 vertices");
    for hole in ["[[0.2,0.2,0],[1.2,0.5,0],[0.2,0.8,0]]", "[[0.4,0.4,0],[0.6,0.4,0],[0.4,0.6,0]]"] {
        let holes = format!("holes = [[[0.5,0.1,0],[0.6,0.9,0],[0.5,0.9,0]], {hole}]\n");
        fails(&format!("{square}{holes}"), 8, "crosses");
    }
    fails(square, 5, "lacks the key `radiance`");
    fails(&format!("{square}radiance = [1, 1, -1]\n"), 8, "0 or more");
    let many = vec!["[0,0,0]"; 65].join(",");
    fails(&format!("[[light]]\ntype = \"polygon\"\nvertices = [{many}]\n"), 7, "has 65 vertices");
}

#[test]
fn generators() {
    let whole = "count = 5, seed = 1, min = [0, 0, 0], max = [1, 1, 1], intensity = [0, 1], range = 1";
    let cases = [
        ("count = 5", "count = 0", "from 1 to 1048576"),
        ("count = 5", "count = 1048577", "from 1 to 1048576"),
        ("count = 5", "number = 5", "unknown key `number`"),
        ("seed = 1", "seed = -1", "from 0 to 4294967295"),
        ("max = [1, 1, 1]", "max = [1, -1, 1]", "below `min`"),
        ("intensity = [0, 1]", "intensity = [2, 1]", "lo > hi"),
        ("intensity = [0, 1]", "intensity = [-1, 1]", "0 or more"),
        ("intensity = [0, 1]", "intensity = 1", "array of 2"),
        ("range = 1", "range = -1", "greater than 0"),
    ];
    for (old, new, part) in cases {
        let generate = whole.replace(old, new);
        fails(&format!("[[light]]\ntype = \"points\"\ngenerate = {{ {generate} }}\n"), 7, part);
    }
    let million = whole.replace("count = 5", "count = 1048576");
    let light = format!("[[light]]\ntype = \"points\"\ngenerate = {{ {million} }}\n");
    fails(
        &format!("{light}[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]\n"),
        8,
        "1048577 lights",
    );
}
