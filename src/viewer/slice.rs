//! The lecture's 2D view: a horizontal slice of the scene at the eye's height, seen from above, and the light paths of
//! the screen's middle row, projected onto it.

use super::{
    cut::cuts,
    draw::Picture,
    map::Layout,
    section::{Cut, flat},
    text,
};
use crate::{
    render::Camera,
    scene::Description,
    shade::{Segment, SegmentKind},
};
use glam::{DVec2, Vec3};

const BACKGROUND: u32 = 0x12_14_18;
const OUTLINE: u32 = 0xD8_DC_E4;
const EYE: u32 = 0xFF_60_60;
const PRIMARY: u32 = 0xB0_A0_58;
const HIT: u32 = 0xFF_FF_FF;
const REFLECTION: u32 = 0x38_A8_D8;
const REFRACTION: u32 = 0xC0_60_D0;
const SHADOW: u32 = 0x34_68_2C;
const BLOCKED: u32 = 0x68_2C_34;
const LIGHT: u32 = 0xFF_E8_80;
/// The least value of a word's brightest channel.
const LEGIBLE: u32 = 0xE0;
const LEGEND: [(u32, &str); 5] = [
    (PRIMARY, "primary"),
    (REFLECTION, "reflection"),
    (REFRACTION, "refraction"),
    (SHADOW, "shadow"),
    (BLOCKED, "blocked"),
];

/// Draws the whole slice: light paths, outlines, lights, the eye and its screen, a scale bar and a legend.
pub fn draw(picture: &mut Picture, layout: &Layout, description: &Description, camera: &Camera, paths: &[Segment]) {
    picture.fill(BACKGROUND);
    draw_paths(picture, layout, paths);
    cuts(description, &layout.section(camera.eye.y), |cut| match cut {
        Cut::Circle { center, radius } => picture.circle(layout.place(center), radius * layout.scale, OUTLINE),
        Cut::Segment(from, to) => picture.segment(layout.place(from), layout.place(to), OUTLINE),
        Cut::Line { point, direction } => {
            let direction = direction.normalize_or_zero();
            picture.line(layout.place(point), direction, (f64::NEG_INFINITY, f64::INFINITY), OUTLINE);
        }
    });
    for light in &description.lights {
        picture.dot(layout.place(flat(light.position)), 2, LIGHT);
    }
    draw_eye(picture, layout, camera);
    draw_scale(picture, layout);
    draw_legend(picture);
}

/// The least important first, since later lines cover earlier ones.
fn draw_paths(picture: &mut Picture, layout: &Layout, paths: &[Segment]) {
    let order = [
        (SegmentKind::Shadow { blocked: true }, BLOCKED),
        (SegmentKind::Shadow { blocked: false }, SHADOW),
        (SegmentKind::Primary, PRIMARY),
        (SegmentKind::Refraction, REFRACTION),
        (SegmentKind::Reflection, REFLECTION),
    ];
    for (kind, color) in order {
        for segment in paths.iter().filter(|segment| segment.kind == kind) {
            let from = layout.place(flat(segment.from));
            match segment.to {
                Some(to) => picture.segment(from, layout.place(flat(to)), color),
                None => picture.line(from, flat(segment.direction), (0.0, f64::INFINITY), color),
            }
        }
    }
    for segment in paths.iter().filter(|segment| segment.kind == SegmentKind::Primary) {
        if let Some(to) = segment.to {
            picture.dot(layout.place(flat(to)), 1, HIT);
        }
    }
}

fn draw_eye(picture: &mut Picture, layout: &Layout, camera: &Camera) {
    let eye = layout.place(flat(camera.eye));
    let down = (camera.down * 0.5).as_vec3();
    let place = |point: Vec3| layout.place(flat(point));
    let (left, right) = (place(camera.p0() + down), place(camera.p1() + down));
    // Any screen that is the same seen from the eye gives the same rays: one too small or too large to see on the
    // pane is drawn moved along them.
    let length = (right - left).length();
    let limit = (picture.width.min(picture.height) as f64 * 0.25).max(1.0);
    let scale = length.clamp(limit * 0.25, limit) / length;
    if scale.is_finite() {
        picture.segment(eye + (left - eye) * scale, eye + (right - eye) * scale, EYE);
    }
    picture.dot(eye, 2, EYE);
}

fn draw_scale(picture: &mut Picture, layout: &Layout) {
    let (left, bottom) = (8.0, picture.height as f64 - 8.0);
    let length = layout.round_length(picture.width as f64 * 0.25);
    let right = left + length * layout.scale;
    if length.is_finite() && bottom > 40.0 {
        for (from, to) in [
            (DVec2::new(left, bottom), DVec2::new(right, bottom)),
            (DVec2::new(left, bottom - 3.0), DVec2::new(left, bottom + 3.0)),
            (DVec2::new(right, bottom - 3.0), DVec2::new(right, bottom + 3.0)),
        ] {
            picture.segment(from, to, OUTLINE);
        }
        text::write(picture, left as usize, bottom as usize - 21, &length_text(length), OUTLINE);
    }
}

fn draw_legend(picture: &mut Picture) {
    let names: Vec<&str> = LEGEND.iter().map(|(_, name)| *name).collect();
    text::panel(picture, 0, 0, &[" ".repeat(names.join(" ").len())], 0);
    let mut x = text::PADDING;
    for (color, name) in LEGEND {
        text::write(picture, x, text::PADDING, name, legible(color));
        x += (name.len() + 1) * text::char_width();
    }
}

/// The colour of a line, made bright enough for letters: many lines may be dark, thin letters may not.
fn legible(color: u32) -> u32 {
    let channels = [16, 8, 0].map(|shift| (color >> shift) & 255);
    let most = channels.into_iter().max().unwrap_or(0).max(1);
    channels.into_iter().fold(0, |legible, channel| (legible << 8) | (channel * LEGIBLE.max(most) / most))
}

fn length_text(length: f64) -> String {
    if (1e-3..1e5).contains(&length) { format!("{length}") } else { format!("{length:.0e}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        scene::{Plane, Sides, Sphere},
        viewer::map::Map,
    };

    fn sphere(y: f32, radius: f32) -> Sphere {
        Sphere { center: Vec3::new(2.0, y, 3.0), radius, sides: Sides::Both, material: 0 }
    }

    fn drawn(paths: &[Segment], width: usize, height: usize) -> Picture {
        let description = Description {
            spheres: vec![sphere(1.0, 1.0), sphere(0.0, 1e6)],
            planes: vec![Plane { normal: Vec3::X, distance: 3.0, material: 0 }],
            ..Description::default()
        };
        let eye = Vec3::new(0.0, 1.0, 5.0);
        let camera = Camera {
            eye,
            corner: glam::DVec3::new(-1.0, 1.0, -1.5),
            across: glam::DVec3::X * 2.0,
            down: glam::DVec3::Y * -2.0,
        };
        let mut picture = Picture::new(width, height);
        draw(&mut picture, &Map::new(&description).layout(width, height), &description, &camera, paths);
        picture
    }

    #[test]
    fn everything_is_drawn_in_its_colour() {
        let (from, direction) = (Vec3::new(0.0, 1.0, 5.0), Vec3::new(0.0, 0.0, -1.0));
        let segment = |kind, to: Option<Vec3>, turn: f32| Segment {
            kind,
            from,
            to,
            direction: (direction + Vec3::X * turn).normalize(),
        };
        let paths = [
            segment(SegmentKind::Primary, Some(Vec3::new(0.5, 0.0, 0.0)), 0.0),
            segment(SegmentKind::Shadow { blocked: true }, Some(Vec3::new(1.0, 1.0, 0.5)), 0.0),
            segment(SegmentKind::Shadow { blocked: false }, Some(Vec3::new(-1.0, 1.0, 0.5)), 0.0),
            segment(SegmentKind::Reflection, None, 0.9),
        ];
        let picture = drawn(&paths, 512, 512);
        for color in [BACKGROUND, OUTLINE, EYE, PRIMARY, HIT, REFLECTION, SHADOW, BLOCKED] {
            assert!(picture.pixels.contains(&color), "{color:06x}");
        }
        // The ray that leaves the scene reaches the pane's edge.
        assert!((0..512).any(|y| picture.pixels[y * 512 + 511] == REFLECTION));
    }

    #[test]
    fn wild_segments_and_odd_sizes_are_no_panic() {
        let wild = [0.0, 1e30, f32::MAX, f32::INFINITY, f32::NAN];
        let mut paths = Vec::new();
        for a in wild {
            for b in wild {
                let (from, direction) = (Vec3::new(a, b, a), Vec3::new(b, a, b));
                for to in [None, Some(Vec3::splat(b))] {
                    paths.push(Segment { kind: SegmentKind::Primary, from, to, direction });
                }
            }
        }
        for (width, height) in [(0, 0), (1, 1), (0, 9), (9, 0), (3, 700), (701, 50)] {
            drawn(&paths, width, height);
        }
    }

    #[test]
    fn the_legend_is_in_the_lines_hues_and_legible() {
        assert_eq!([0x00_00_00, 0x70_38_00, 0xFF_10_20].map(legible), [0x00_00_00, 0xE0_70_00, 0xFF_10_20]);
        let picture = drawn(&[], 512, 512);
        for (color, name) in LEGEND {
            assert!(picture.pixels[..512 * 28].contains(&legible(color)), "{name}");
            let most = [16, 8, 0].map(|shift| (legible(color) >> shift) & 255).into_iter().max();
            assert!(most >= Some(LEGIBLE), "{name}: {color:06x}");
        }
    }

    #[test]
    fn lengths_are_short() {
        assert_eq!([0.005, 20.0, 2e6].map(length_text), ["0.005", "20", "2e6"]);
    }
}
