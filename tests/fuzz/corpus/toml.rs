//! Scene files.

use raypacket::scene::builtins;

use super::Format;

pub const TOML: Format =
    Format { name: "toml", scene: "scene.toml", mutated: "scene.toml", seeds, tokens: TOKENS, memory };

/// By the file's length, and by its tables in braces and before dots.
fn memory(bytes: &[u8]) -> [usize; 2] {
    let tables = bytes.iter().filter(|b| b"{.".contains(b)).count();
    [250, 300].map(|multiple| multiple * bytes.len() + 1500 * tables)
}

/// The built-in scenes, but for most primitives of large ones, the examples of the documentation, and all keys.
fn seeds() -> Vec<Vec<u8>> {
    let short = |text: &str| {
        let short: String = text.split_inclusive('\n').take(140).collect();
        // The end of an array of primitives.
        if short.len() < text.len() { short + "]\n" } else { short }
    };
    let mut texts: Vec<String> = builtins().iter().map(|b| short(b.source)).collect();
    let pages = [include_str!("../../../README.md"), include_str!("../../../docs/scene-format.md")];
    let examples = pages.into_iter().flat_map(|page| page.split("```toml\n").skip(1));
    texts.extend(examples.map(|rest| rest.split("```").next().unwrap_or_default().to_owned()));
    texts.extend([KEYS.to_owned(), KINDS.to_owned()]);
    texts.into_iter().map(String::into_bytes).collect()
}

const KEYS: &str = r#"camera = { eye = [0, 1, 6], look_at = [0, 0.5, 0], up = [0, 1, 0.1], fov = 60 }
settings = { max_depth = 7, attenuation = false, ambient = [0.1, 0.1, 0.2] }
sky = { image = "textures/dusk.hdr", rotation = 30 }
light = [{ position = [3, 5, 4], power = [1, 2, 3] }, { position = [-4, 2, 1], power = [1, 1, 0] }]
[materials]
glass = { transmission = 0.9, reflectance = 0.1, ior = 1.5, absorption = [0.1, 0.2, 0] }
brick = { texture = "textures/brick.png", texture_size = 0.5, texture_wrap = "clamp", specular = 0.5, shininess = 20 }
"tiles \u00e9" = { checker = { colors = [[1, 1, 1], [0, 0, 0]], size = 0.25 }, reflectance = 0.5 }
[[mesh]]
file = "mesh.obj"
scale = 0.5
rotation = [10, 20, 30]
translation = [0, 1, 0]
material = "glass"
[[mesh]]
file = "clothed.obj"
[[triangle]]
vertices = [[-2, 0, 0], [2, 0, -1], [0, 2, 0]]
normals = [[0, 0, 1], [0, 1, 1], [1, 0, 1]]
uvs = [[0, 0], [1, 0], [0.5, 1]]
material = "brick"
[[box]]
min = [-1, 0, -1]
max = [1, 0.25, 1]
rotation = [0, 30, 5]
material = 'tiles é'
"#;

const KINDS: &str = r#"plane = [{ normal = [0, 2, 0], distance = 1 }]
sphere = [{ center = [-1, 1, 0], radius = 0.5 }, { center = [1.5e0, 0x1, -0.0], radius = +1_0.5e-1 }]
quad = [{ corner = [-1, 0, -3], u = [2, 0, 0], v = [0, 2, 0] }]
cylinder = [{ base = [0, 0, 0], apex = [0, 1, 0], radius = 0.25, caps = true }]
cone = [{ base = [1, 0, 1], base_radius = 0.5, apex = [1, 1, 1], apex_radius = 0, caps = true }]
torus = [{ center = [0, 1, 1], axis = [0, 1, 1], major_radius = 0.5, minor_radius = 0.125 }]
fractal = [{ center = [-2, 1, 1], radius = 0.5, iterations = 3 }]
disc = [{ center = [2, 1, 1], normal = [0, 1, 2], radius = 0.5, inner_radius = 0.25 }]
sky.gradient = [[1, 1, 1], [0, 0, 1]]
"#;

const TOKENS: &str = "\
    camera|settings|sky|light|materials|plane|sphere|triangle|quad|box|cylinder|cone|torus|fractal|disc|mesh|eye|\
    look_at|up|fov|max_depth|color|attenuation|ambient|gradient|image|rotation|position|power|checker|texture|\
    texture_size|texture_wrap|reflectance|transmission|ior|absorption|specular|shininess|normal|distance|center|radius|\
    vertices|normals|uvs|corner|u|v|min|max|base|apex|caps|base_radius|apex_radius|axis|major_radius|\
    minor_radius|inner_radius|\
    iterations|file|scale|translation|material|colors|size|true|false|nan|inf|1979-05-27T07:32:00Z|\
    '''|\"\"\"| = |[[sphere]]\n|[materials.a]\n|[|]|{|}|,|.|#|'.'|'/dev/zero'|'mesh.obj'|'clothed.obj'|\
    'scene.toml'|'textures/brick.png'|\"\\u0000\"";
