//! The rays: beams of eight neighbours, half of them aimed to hit and half to miss.

use glam::{DVec3, Vec3, vec3};
use raypacket::math::{BATCH, RayBatch};
use raypacket::reference::{Hit, Tracer};
use raypacket::scene::Description;

use crate::scenes::{Pcg, ROUNDOFF};

/// Rays of a beam: a packet of the widest kernel, or several of the others.
const BEAM: usize = 8;

/// What a beam measures at distance 1 along −z, across and up: four pixels of 1/64.
const SPREAD: f32 = 1.0 / 16.0;

/// Rays from the world's origin, and what the reference says of them.
pub struct Beams {
    pub rays: RayBatch,
    hits: Vec<Option<Hit>>,
}

impl Beams {
    /// Full of beams around −z, as many that hit as miss, in random order.
    pub fn new(description: &Description, rng: &mut Pcg) -> Self {
        let tracer = Tracer::new(description);
        let mut beams = Self { rays: RayBatch::default(), hits: Vec::new() };
        // Hits and misses that are yet to come.
        let mut wanted = [BATCH / BEAM / 2; 2];
        while wanted != [0; 2] {
            let miss = usize::from(rng.below(wanted[0] + wanted[1]) >= wanted[0]);
            wanted[miss] -= 1;
            beams.push(&tracer, miss == 1, rng);
        }
        assert_eq!(beams.rays.len, BATCH);
        beams
    }

    /// Full of beams around −z, wherever they go.
    pub fn anywhere(rng: &mut Pcg) -> Self {
        let mut beams = Self { rays: RayBatch::default(), hits: Vec::new() };
        for _ in 0..BATCH / BEAM {
            let directions = Self::directions(rng);
            directions.iter().for_each(|&d| beams.rays.push(Vec3::ZERO, d, 0.0, f32::INFINITY));
        }
        beams
    }

    /// Those of a beam.
    fn directions(rng: &mut Pcg) -> [Vec3; BEAM] {
        let corner = vec3(rng.range(-0.5, 0.5), rng.range(-0.5, 0.5), -1.0);
        std::array::from_fn(|_| (corner + vec3(rng.range(0.0, SPREAD), rng.range(0.0, SPREAD), 0.0)).normalize())
    }

    /// Adds a beam of which every ray hits, or misses.
    fn push(&mut self, tracer: &Tracer, miss: bool, rng: &mut Pcg) {
        for _ in 0..10_000 {
            let directions = Self::directions(rng);
            let hits = directions.map(|d| tracer.intersect(DVec3::ZERO, d.as_dvec3().normalize(), f64::INFINITY));
            if hits.iter().all(|hit| hit.is_none() == miss) {
                directions.iter().for_each(|&d| self.rays.push(Vec3::ZERO, d, 0.0, f32::INFINITY));
                self.hits.extend(hits);
                return;
            }
        }
        panic!("no beam {}", if miss { "misses" } else { "hits" });
    }

    /// Asserts that `found`, infinite for a miss, are the reference's distances: the same rays hit, and no farther off
    /// the surface than `off` ε (8 + t).
    pub fn confirm(&self, name: &str, off: f64, found: &[f32; BATCH]) {
        let mut hits = 0;
        for (i, (&t, exact)) in found.iter().zip(&self.hits).enumerate() {
            let same = exact.as_ref().map_or(t == f32::INFINITY, |hit| {
                let direction = DVec3::from_array([0, 1, 2].map(|axis| f64::from(self.rays.direction[axis][i])));
                let cosine = hit.normal.dot(direction).abs();
                (f64::from(t) - hit.t).abs() * cosine <= off * ROUNDOFF * (8.0 + hit.t)
            });
            assert!(same, "{name}: ray {i} has {t} for {exact:?}");
            hits += usize::from(t < f32::INFINITY);
        }
        assert_eq!(hits, BATCH / 2, "{name}: hits");
    }
}
