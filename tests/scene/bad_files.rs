//! Files of a scene that are wrong: OBJ, MTL, CSV and pictures.

use crate::{png, try_load};

fn fails(toml: &str, files: &[(&str, &[u8])], place: &str, part: &str) {
    let Err(error) = try_load(toml, files, &[]) else { panic!("loads, but should not: {files:?}") };
    let text = error.to_string();
    assert!(text.starts_with(&format!("{place}: ")), "not at {place}: {text}");
    assert!(text.contains(part), "`{part}` is not in: {text}");
    assert!(text.split_once("\n  remedy: ").is_some_and(|(_, remedy)| remedy.len() > 5), "{text}");
}

#[test]
fn obj_files() {
    let cases = [
        ("", "m.obj", "no faces"),
        ("v 0 0 0\nv 1 0 0\n", "m.obj", "no faces"),
        ("v 0 0\n", "m.obj:1", "2 numbers instead of 3"),
        ("\nv 0 0 x\n", "m.obj:2", "\"x\", which is not a number"),
        ("v 0 0 nan\n", "m.obj:1", "not finite"),
        ("v 0 0 1e39\n", "m.obj:1", "not finite"),
        ("vt inf 0\n", "m.obj:1", "not finite"),
        ("vn 1\n", "m.obj:1", "1 numbers instead of 3"),
        ("v 0 0 0\nf 1 2 3\n", "m.obj:2", "refers to vertex 2, but 1 are defined"),
        ("v 0 0 0\nf 0 1 1\n", "m.obj:2", "refers to vertex 0"),
        ("v 0 0 0\nf -2 1 1\n", "m.obj:2", "refers to vertex -2"),
        ("v 0 0 0\nf 1/1 1/1 1/1\n", "m.obj:2", "refers to texture coordinate 1, but 0"),
        ("v 0 0 0\nf 1//2 1 1\n", "m.obj:2", "refers to normal 2"),
        ("v 0 0 0\nf 1 a 1\n", "m.obj:2", "the corner \"a\""),
        ("v 0 0 0\nf 1/1/1/1 1 1\n", "m.obj:2", "refers to texture coordinate"),
        ("v 0 0 0\nf / / /\n", "m.obj:2", "the corner \"/\""),
        ("v 0 0 0\nf 99999999999999999999 1 1\n", "m.obj:2", "the corner"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "test.toml:5", "no triangle with an area"),
    ];
    for (text, place, part) in cases {
        fails("[[mesh]]\nobj = \"m.obj\"\n", &[("m.obj", text.as_bytes())], place, part);
    }
}

#[test]
fn mtl_files() {
    let obj = b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    let cases = [
        ("newmtl a\nKd red\n", "m.mtl:2", "`kd` needs a finite number"),
        ("newmtl a\nNs\n", "m.mtl:2", "`ns` needs"),
        ("newmtl a\nNs nan\n", "m.mtl:2", "`ns` needs"),
        ("newmtl a\nmap_Kd\n", "m.mtl:2", "names no file"),
        ("newmtl a\nmap_Kd -s 1 1 1\n", "m.mtl:2", "names no file"),
        ("newmtl a\nmap_Kd bad.png\n", "m.mtl:1", "\"bad.png\": cannot decode"),
    ];
    for (text, place, part) in cases {
        let files: [(&str, &[u8]); 3] = [("m.obj", obj), ("m.mtl", text.as_bytes()), ("bad.png", b"no")];
        fails("[[mesh]]\nobj = \"m.obj\"\n", &files, place, part);
    }
}

#[test]
fn csv_files() {
    let cases: [(&[u8], &str, &str); 13] = [
        (b"", "l.csv:1", "empty"),
        (b"1,2,3,4,5,6\n", "l.csv:1", "unknown column `1`"),
        (b"x,y,z,r,g\n", "l.csv:1", "lacks the column `b`"),
        (b"x,y,z,r,g,b,b\n", "l.csv:1", "twice"),
        (b"x;y;z;r;g;b\n", "l.csv:1", "unknown column"),
        (b"x,y,z,r,g,b\n", "l.csv", "no lights"),
        (b"x,y,z,r,g,b\n1,2,3,4,5,6\n1,2,3,4,5\n", "l.csv:3", "5 fields, the header 6"),
        (b"x,y,z,r,g,b\n\n1,2,3,4,5,6,7\n", "l.csv:3", "7 fields, the header 6"),
        (b"x,y,z,r,g,b\n1,2,three,4,5,6\n", "l.csv:2", "`z` is \"three\""),
        (b"x,y,z,r,g,b\n1,2,nan,4,5,6\n", "l.csv:2", "`z` is NaN"),
        (b"x,y,z,r,g,b\n1,2,3,4,-5,6\n", "l.csv:2", "`g` is negative"),
        (b"x,y,z,r,g,b,range\n1,2,3,4,5,6,-1\n", "l.csv:2", "`range` is negative"),
        (b"x,y,z,r,g,b\n1,2,3,4,5,\xff\n", "l.csv", "not UTF-8"),
    ];
    for (text, place, part) in cases {
        fails("[[light]]\ntype = \"points\"\nfile = \"l.csv\"\n", &[("l.csv", text)], place, part);
    }
}

#[test]
fn pictures() {
    let material = |file: &str| {
        format!("[[material]]\nname = \"m\"\ntype = \"matte\"\ncolor = {{ texture = \"{file}\" }}\n")
    };
    let whole = png(16, 16, |x, y| [x as u8 * 3, y as u8 * 7, (x * y) as u8, 255]);
    let mut wrong = whole.clone();
    wrong[20] = 0x7f;
    let cases: [(&str, &[u8]); 6] = [
        ("t.png", b""),
        ("t.png", &whole[..whole.len() / 2]),
        ("t.png", &wrong),
        ("t.txt", b"hello"),
        ("t.tga", b"\x00\x01"),
        ("t.jpg", b"\xff\xd8\xff\xe0"),
    ];
    for (name, bytes) in cases {
        let cause = format!("`texture` names \"{name}\": cannot decode");
        fails(&material(name), &[(name, bytes)], "test.toml:8", &cause);
    }
    let wide = png(16385, 1, |_, _| [0; 4]);
    fails(&material("wide.png"), &[("wide.png", &wide)], "test.toml:8", "16384 texels a side");
}
