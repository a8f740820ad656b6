//! NFF files.

use super::{Format, texts};

pub const NFF: Format = Format {
    name: "nff",
    scene: "scene.nff",
    mutated: "scene.nff",
    seeds: || texts(&SEEDS),
    tokens: TOKENS,
    memory: |bytes| [20 * bytes.len(), 200 * bytes.len()],
};

const SEEDS: [&str; 2] = [
    "# all entities\nv\nfrom 0 1 6\nat 0 0.5 0\nup 0 1 0\nangle 45\nhither 0.1\nresolution 64 64\nb 0.1 0.2 0.3\n\
     l 4 3 2\nl 1 4 4 1 0.5 0\nf 1 0.5 0.25 0.8 0.5 30 0 0\ns 1 0 0 0.5\ns -1 1 0 -0.5\nc 0 0 0 1 0 1 0 0.5\n\
     c 0 0 1 -0.5 0 2 1 -0.5\nf 1 1 1 0.1 0.4 1e5 0.9 1.5\np 4\n-3 -1 -3\n-3 -1 3\n3 -1 3\n3 -1 -3\ns 0 1 2 0.25\n\
     f 0 1 0 1 0 0 0 1\npp 3\n-2 0 -1 0 0 1\n2 0 -1 0 1 2\n0 2 -1 0 1 1\nc 1 0 1 0 1 1 1 0.25\n",
    "s 0 0 0 1 f 1 1 1 1 1 9 1 10 s 0.5 0 0 1 f 1 1 1 1 1 9 1 0.1 c 0 -2 0 1 0 2 0 1\n\
     v from 0 0 5 at 0 0 0 up 0 1 0 angle 90 resolution 1 1 hither 1\n\
     p 8\n0 0 0\n3 0 0\n3 3 0\n2 3 0\n2 1 0\n1 1 0\n1 3 0\n0 3 0\n\
     pp 5\n0 0 1 0 0 1\n1 0 1 0 0 1\n0.2 0.2 1 0 0 1\n0 1 1 0 0 -1\n0 0.5 1 1 0 1\nl 0 0 9\n",
];

const TOKENS: &str = "\
    v|b|l|f|s|c|p|pp|from|at|up|angle|hither|resolution|#|\np 3\n|\npp 3\n|\np 65536\n|\np 65537\n|\
    \ns 0 0 0 1\n|\nf 1 1 1 1 1 1 1 1\n| |\n";
