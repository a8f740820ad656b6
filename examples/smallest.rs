//! The smallest ray tracer: the lecture's minimum in one file, on nothing but vectors and a window.
//!
//! `cargo run --release --example smallest [N]` shows Whitted's spheres on the left and, on the right, a slice at the
//! eye's height seen from above: what it cuts, the eye and its screen, every 10th eye ray of the middle row (yellow)
//! with its shadow rays (green, or red where blocked) and reflections (blue). W A S D Q E move, arrows turn, + and −
//! change the field of view, Esc quits. With N it closes after N frames.

use glam::{Vec2, Vec3, vec2, vec3};
use minifb::{Key, Window, WindowOptions};
use std::{env, error::Error, f32::consts::PI, process::ExitCode, sync::Mutex, thread, time::Instant};

/// Pixels of a view's side; the window shows two views, side by side.
const SIDE: usize = 512;
/// Rays of a path: the eye ray and its reflections.
const MAX_DEPTH: u32 = 6;
/// How far secondary rays start off a surface, in parts of the largest coordinate or distance that its point was
/// computed from. This relies on the point's error being some roundings of 2⁻²⁴ of that, as it is in a scene without
/// huge spheres, and is less than a pixel.
const LIFT: f32 = 1e-4;

const SKY: Vec3 = vec3(0.16, 0.24, 0.42);
const AMBIENT: Vec3 = vec3(0.03, 0.035, 0.05);
/// Positions, and powers in watts.
const LIGHTS: [(Vec3, Vec3); 2] =
    [(vec3(4.0, 6.0, 5.0), vec3(600.0, 500.0, 360.0)), (vec3(-5.0, 5.0, 2.0), vec3(130.0, 190.0, 280.0))];
/// N and d of the points P with N·P + d = 0, and the squares that they are divided into.
const PLANE: (Vec3, f32) = (Vec3::Y, 0.0);
const CHECKER: [Material; 2] =
    [Material { color: vec3(0.9, 0.9, 0.88), mirror: 0.15 }, Material { color: vec3(0.12, 0.13, 0.16), mirror: 0.15 }];
/// Centres, radii and what they are made of.
const SPHERES: [(Vec3, f32, Material); 5] = [
    (vec3(0.0, 1.2, -0.8), 1.2, Material { color: vec3(0.9, 0.9, 0.95), mirror: 0.9 }),
    (vec3(-1.4, 0.65, 0.6), 0.65, Material { color: vec3(0.75, 0.3, 0.45), mirror: 0.4 }),
    (vec3(1.45, 0.6, 0.5), 0.6, Material { color: vec3(0.85, 0.12, 0.08), mirror: 0.0 }),
    (vec3(0.5, 0.3, 1.5), 0.3, Material { color: vec3(0.08, 0.55, 0.5), mirror: 0.0 }),
    (vec3(-3.0, 1.9, -2.8), 1.9, Material { color: vec3(0.95, 0.62, 0.12), mirror: 0.0 }),
];
/// What the slice draws, as 0RGB.
const EYE_RAY: u32 = 0xB0_A0_58;
const REFLECTION: u32 = 0x38_A8_D8;
const LIT: u32 = 0x34_68_2C;
const BLOCKED: u32 = 0x68_2C_34;
const CUT: u32 = 0xD8_DC_E4;
const SCREEN: u32 = 0xFF_60_60;

#[derive(Clone, Copy)]
struct Material {
    color: Vec3,
    /// The part of the light that it reflects as a mirror.
    mirror: f32,
}

/// What a ray hits first: its distance, the normal there, and the material. Directions have length 1.
fn nearest(origin: Vec3, direction: Vec3) -> Option<(f32, Vec3, Material)> {
    let spheres = SPHERES.iter().filter_map(|&(center, radius, material)| {
        let to_center = center - origin;
        let middle = to_center.dot(direction);
        // Pythagoras with the ray's distance from the centre; a ray that misses gets NaN, which is not above 0.
        let half = (radius * radius - (to_center - middle * direction).length_squared()).sqrt();
        let t = [middle - half, middle + half].into_iter().find(|t| *t > 0.0)?;
        Some((t, (t * direction - to_center) / radius, material))
    });
    let (normal, d) = PLANE;
    let t = -(normal.dot(origin) + d) / normal.dot(direction);
    let square = (origin + t * direction).floor();
    let dark = (square.x + square.z) % 2.0 != 0.0;
    let plane = (t > 0.0 && t.is_finite()).then_some((t, normal, CHECKER[usize::from(dark)]));
    spheres.chain(plane).min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The light that comes along a ray, after Whitted. Tells `seen` the kind and both ends of every ray on the way.
fn trace(origin: Vec3, direction: Vec3, depth: u32, seen: &mut impl FnMut(u32, Vec3, Vec3)) -> Vec3 {
    let hit = nearest(origin, direction);
    let point = origin + hit.map_or(1e3, |hit| hit.0) * direction;
    seen(if depth == 1 { EYE_RAY } else { REFLECTION }, origin, point);
    let Some((t, normal, material)) = hit else { return SKY };
    let normal = if normal.dot(direction) < 0.0 { normal } else { -normal };
    let start = point + LIFT * point.abs().max_element().max(t) * normal;

    let mut irradiance = AMBIENT;
    for (position, power) in LIGHTS {
        let (to_light, distance) = (position - start).normalize_and_length();
        let cosine = normal.dot(to_light);
        if cosine <= 0.0 {
            continue;
        }
        let free = nearest(start, to_light).map_or(distance, |blocker| blocker.0.min(distance));
        let blocked = free < distance;
        seen(if blocked { BLOCKED } else { LIT }, start, start + free * to_light);
        if !blocked {
            irradiance += power * cosine / (4.0 * PI * distance * distance);
        }
    }
    let diffuse = (1.0 - material.mirror) * material.color * irradiance;
    if material.mirror == 0.0 || depth == MAX_DEPTH {
        return diffuse;
    }
    diffuse + material.mirror * trace(start, direction.reflect(normal).normalize(), depth + 1, seen)
}

/// Angles in radians: to the right of −z, above the horizon, and from the screen's top to its bottom.
struct Camera {
    eye: Vec3,
    yaw: f32,
    pitch: f32,
    fov: f32,
}

impl Camera {
    /// Right, up, and V, the view direction.
    fn axes(&self) -> [Vec3; 3] {
        let ((sin, cos), (rise, run)) = (self.yaw.sin_cos(), self.pitch.sin_cos());
        let (right, view) = (vec3(cos, 0.0, sin), vec3(run * sin, rise, -run * cos));
        [right, right.cross(view), view]
    }

    /// The screen's corners p0, p1 and p2: top left, top right and bottom left, around E + d V.
    fn screen(&self) -> [Vec3; 3] {
        let [right, up, view] = self.axes();
        let center = self.eye + view / (self.fov / 2.0).tan();
        [center - right + up, center + right + up, center - right - up]
    }

    /// From a pixel's column and row to the direction of the ray through its centre.
    fn directions(&self) -> impl Fn(usize, usize) -> Vec3 {
        let ([p0, p1, p2], eye) = (self.screen(), self.eye);
        move |x, y| {
            let [u, v] = [x, y].map(|i| (i as f32 + 0.5) / SIDE as f32);
            (p0 + u * (p1 - p0) + v * (p2 - p0) - eye).normalize()
        }
    }

    fn control(&mut self, window: &Window, seconds: f32) {
        let down = |key| f32::from(window.is_key_down(key)) * seconds;
        let axis = |more, less| down(more) - down(less);
        let [right, _, view] = self.axes();
        let sideways = right * axis(Key::D, Key::A) + Vec3::Y * axis(Key::E, Key::Q);
        self.eye += 4.0 * (view * axis(Key::W, Key::S) + sideways);
        self.yaw += axis(Key::Right, Key::Left);
        self.pitch = (self.pitch + axis(Key::Up, Key::Down)).clamp(-1.5, 1.5);
        let wider = axis(Key::Equal, Key::Minus) + axis(Key::NumPadPlus, Key::NumPadMinus);
        self.fov = (self.fov + wider).clamp(0.1, 2.6);
    }
}

/// The 3D view. Each thread takes the next row when it has finished one, since some rows take longer than others.
fn draw_view(pixels: &mut [u32], camera: &Camera) {
    let direction = camera.directions();
    let rows = Mutex::new(pixels.chunks_exact_mut(2 * SIDE).enumerate());
    let next = || rows.lock().unwrap().next();
    let work = || {
        while let Some((y, row)) = next() {
            for (x, pixel) in row[..SIDE].iter_mut().enumerate() {
                let light = trace(camera.eye, direction(x, y), 1, &mut |_, _, _| ());
                let [r, g, b] = (255.0 * light.min(Vec3::ONE).powf(1.0 / 2.2)).to_array().map(|c| c as u32);
                *pixel = r << 16 | g << 8 | b;
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
}

/// The slice, of 16 × 16 units around the origin: x to the right, z down. A level plane is not cut.
fn draw_slice(pixels: &mut [u32], camera: &Camera) {
    pixels.chunks_exact_mut(2 * SIDE).for_each(|row| row[SIDE..].fill(0));
    let mut line = |color, from: Vec3, to: Vec3| {
        let [from, to] = [from, to].map(|point| (vec2(point.x, point.z) / 16.0 + 0.5) * SIDE as f32);
        draw_line(pixels, from, to, color);
    };
    let direction = camera.directions();
    for x in (0..SIDE).step_by(10) {
        trace(camera.eye, direction(x, SIDE / 2), 1, &mut line);
    }
    for (center, radius, _) in SPHERES {
        // NaN, and not drawn, when the slice passes above or below.
        let cut = (radius * radius - (center.y - camera.eye.y).powi(2)).sqrt();
        let corner = |i: u8| center + cut * Vec3::X.rotate_y(f32::from(i) * PI / 32.0);
        (0..64).for_each(|i| line(CUT, corner(i), corner(i + 1)));
    }
    let [p0, p1, p2] = camera.screen();
    line(SCREEN, (p0 + p2) / 2.0, p1 + (p2 - p0) / 2.0);
    for arm in [0.1 * Vec3::X, 0.1 * Vec3::Z] {
        line(SCREEN, camera.eye - arm, camera.eye + arm);
    }
}

/// Draws what of a line lies on the slice, which it enters and leaves as a ray does a box.
fn draw_line(pixels: &mut [u32], from: Vec2, to: Vec2, color: u32) {
    let (way, side) = (to - from, Vec2::splat(SIDE as f32));
    let (a, b) = (-from / way, (side - from) / way);
    let (enter, leave) = (a.min(b).max_element().max(0.0), a.max(b).min_element().min(1.0));
    let steps = ((leave - enter) * way.abs().max_element()).ceil();
    for i in 0..=steps as usize {
        let point = from + way * (enter + (leave - enter) * i as f32 / steps.max(1.0));
        if point.cmpge(Vec2::ZERO).all() && point.cmplt(side).all() {
            pixels[point.y as usize * 2 * SIDE + SIDE + point.x as usize] = color;
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let frames = env::args().nth(1).map_or(Ok(u64::MAX), |n| n.parse().map_err(|error| format!("{n}: {error}")))?;
    let mut window = Window::new("smallest", 2 * SIDE, SIDE, WindowOptions::default())
        .map_err(|error| format!("no display to open a window on: {error}"))?;
    let mut camera = Camera { eye: vec3(0.35, 1.6, 6.0), yaw: -0.06, pitch: -0.11, fov: 0.8 };
    let mut pixels = vec![0; 2 * SIDE * SIDE];
    let mut last = Instant::now();
    for _ in 0..frames {
        draw_view(&mut pixels, &camera);
        draw_slice(&mut pixels, &camera);
        window.update_with_buffer(&pixels, 2 * SIDE, SIDE)?;
        if !window.is_open() || window.is_key_down(Key::Escape) {
            break;
        }
        // A pause, as when the computer slept, does not throw the eye across the scene.
        camera.control(&window, last.elapsed().as_secs_f32().min(0.2));
        last = Instant::now();
    }
    Ok(())
}

fn main() -> ExitCode {
    let Err(error) = run() else { return ExitCode::SUCCESS };
    eprintln!("smallest: {error}");
    ExitCode::FAILURE
}
