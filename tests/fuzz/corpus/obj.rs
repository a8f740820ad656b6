//! OBJ files and the materials that belong to them.

use super::{Format, texts};

pub const OBJ: Format = Format {
    name: "obj",
    scene: "scene.obj",
    mutated: "scene.obj",
    seeds: || texts(&SEEDS),
    tokens: TOKENS,
    memory: |bytes| [100 * bytes.len(), 200 * bytes.len()],
};

pub const MTL: Format = Format {
    name: "mtl",
    scene: "clothed.obj",
    mutated: "scene.mtl",
    seeds: || texts(&[MATERIALS]),
    tokens: MTL_TOKENS,
    memory: |bytes| [50 * bytes.len(), 50 * bytes.len()],
};

/// One without materials, one with those below.
pub const SEEDS: [&str; 2] = [
    "# cube\no cube\nv -1 0 -1\nv 1 0 -1\nv 1 2 -1 1\nv -1 2 -1\nv 0 0 1 0.5 0.5 0.5\nvt 0 0\nvt 1 0 0\nvt 0.5\n\
     vn 0 0 1\nvn 0 0 0\nf 1/1/1 2/2/1 3/3/1\nf 1//1 3//2 4//1\ng top\ns 1\nf -1 -2 -3\nf 1/1 2/2 5/3\n\
     f 1 2 \\\n3 6\nv 0 -1 0\nl 1 2\nf 1 1 2\n",
    "\u{feff}mtllib scene.mtl\nv -2 0 -1\nv 2 0 -1\nv 2 3 -1\nv 0 1 -1\nv -2 3 -1\nv 0 0 2\nvt 0 0\nvt 1 0\nvt 1 1\n\
     usemtl matt\nf 1 2 3 4 5\nusemtl glass\nf 1/1 2/2 6/3\nusemtl picture\nf 2/1 3/2 6/3\nusemtl mirror\n\
     f 5 1 6\nusemtl matt\nf 4 3 6 5\n",
];

const TOKENS: &str = "\
    v|vt|vn|vp|f|l|p|o|g|s|usemtl|mtllib|usemtl matt\n|/|//|mtllib scene.mtl\n|mtllib /dev/zero\n|mtllib .\n|\
    mtllib scene.obj\n|mtllib ./scene.mtl\n|\\\n|f 1 2 3\n|f -1 -2 -3\n|f 1 2 3 4 5\n|f 1/1/1 2/2/1 3/3/1\n|\
    v 1 2 3\n|vn 0 1 0\n|vt 0 1\n|#|\n| |usemtl\n|mtllib\n";

pub const MATERIALS: &str = "# four\nnewmtl matt\nKd 0.5 0.5 0.25\nKs 0.5\nNs 20\nillum 2\nKa 1 1 1\nnewmtl glass\nd 0.25\nNi 1.5\n\
    Tr 0.5\nillum 7\nnewmtl picture\nKd 1 1 1\nmap_Kd -s 1 1 1 -clamp on a b.png\nnewmtl mirror\nKs 0.7 0.8 0.9\nillum 3\n\
    d -halo 0.9\nmap_Kd textures\\brick.png\n";

const MTL_TOKENS: &str = "\
    newmtl|Kd|Ks|Ns|Ni|d|Tr|illum|map_Kd|-halo|-s|-o|-mm|-clamp|newmtl matt\n|map_Kd /dev/zero\n|map_Kd .\n|\
    map_Kd a b.png\n|map_Kd scene.mtl\n|#|\n|illum 5\n|Kd spectral x\n|Kd xyz 1 1 1\n";
