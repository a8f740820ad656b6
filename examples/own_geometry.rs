//! Geometry that the library does not know, in a tree over its boxes: capsules, which are lines of a thickness.
//!
//! `cargo run --release --example own_geometry` traces a million rays through 20,000 of them, on all threads, then
//! moves them and traces again.

use std::time::Instant;

use raypacket::glam::Vec3;
use raypacket::rayon::prelude::*;
use raypacket::{Aabb, BoxTree, Ray};

/// All points within `radius` of the line from `a` to `b`.
#[derive(Clone, Copy)]
struct Capsule {
    a: Vec3,
    b: Vec3,
    radius: f32,
}

impl Capsule {
    fn bounds(&self) -> Aabb {
        Aabb { min: self.a.min(self.b) - self.radius, max: self.a.max(self.b) + self.radius }
    }

    /// Where a ray from outside enters it. (After Quilez, *Capsule intersection*: the side first, then the nearer
    /// ball.)
    fn enter(&self, ray: &Ray) -> Option<f32> {
        let (ba, oa) = (self.b - self.a, ray.origin - self.a);
        let [baba, bard, baoa] = [ba.dot(ba), ba.dot(ray.direction), ba.dot(oa)];
        let [rdoa, oaoa] = [ray.direction.dot(oa), oa.dot(oa)];
        let a = baba - bard * bard;
        let b = baba * rdoa - baoa * bard;
        let c = baba * oaoa - baoa * baoa - self.radius * self.radius * baba;
        let h = b * b - a * c;
        if h < 0.0 {
            return None;
        }
        let t = (-b - h.sqrt()) / a;
        let along = baoa + t * bard;
        if along > 0.0 && along < baba {
            return Some(t);
        }
        let oc = if along <= 0.0 { oa } else { ray.origin - self.b };
        let b = ray.direction.dot(oc);
        let h = b * b - oc.dot(oc) + self.radius * self.radius;
        (h > 0.0).then(|| -b - h.sqrt())
    }
}

/// Numbers from −1 to 1 that look random.
fn noise(i: usize) -> f32 {
    let bits = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    ((bits ^ bits >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 40) as f32 / (1 << 23) as f32 - 1.0
}

fn point(i: usize) -> Vec3 {
    Vec3::new(noise(3 * i), noise(3 * i + 1), noise(3 * i + 2))
}

fn main() {
    let capsule = |i: usize| {
        let a = 10.0 * point(2 * i);
        Capsule { a, b: a + 0.5 * point(2 * i + 1), radius: 0.02 }
    };
    let mut capsules: Vec<Capsule> = (0..20_000).map(capsule).collect();
    let bounds = |capsules: &[Capsule]| capsules.iter().map(Capsule::bounds).collect::<Vec<_>>();
    let started = Instant::now();
    let mut tree = BoxTree::build(&bounds(&capsules));
    println!("built in {:.1?}", started.elapsed());

    let ray = |i: usize| {
        let aim = Vec3::new((i % 1000) as f32 / 50.0 - 10.0, (i / 1000) as f32 / 50.0 - 10.0, 0.0);
        Ray::new([0.0, 0.0, 30.0], (aim - Vec3::new(0.0, 0.0, 30.0)).normalize())
    };
    for round in ["at first", "when moved"] {
        let started = Instant::now();
        let trace = |i| tree.intersect(&ray(i), |place, ray| capsules[place].enter(ray));
        let hits = (0..1_000_000_usize).into_par_iter().filter_map(trace).count();
        println!("{round}, {hits} of 1000000 rays hit, found in {:.1?}", started.elapsed());
        capsules.iter_mut().enumerate().for_each(|(i, c)| (c.a, c.b) = (c.a + 0.2 * point(i), c.b + 0.2 * point(i)));
        let started = Instant::now();
        tree.refit(&bounds(&capsules));
        println!("moved, and made to fit in {:.1?}", started.elapsed());
    }
}
