//! Discs: a chord, in two pieces where it passes through the hole.

use super::revolution::{self, Tilt};
use super::{Extent, Outline};
use crate::scene::Disc;
use crate::viewer::section::{Cut, Section, flat};

impl Outline for Disc {
    /// Nothing when the disc is parallel to the slice.
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        let [radius, inner] = [self.radius, self.inner_radius].map(f64::from);
        if !section.meets(self.center.as_dvec3(), radius) {
            return;
        }
        let tilt = Tilt::new(self.center, self.normal.as_dvec3(), section.y);
        // Of an upright axis infinite or NaN.
        let t = tilt.reaches(0.0);
        let off = tilt.across(t).abs();
        let chord = |from: f64, to: f64| Cut::Segment(tilt.point(t, from), tilt.point(t, to));
        let end = tilt.aside(t, radius);
        if off < inner {
            let start = tilt.aside(t, inner);
            emit(chord(-end, -start));
            emit(chord(start, end));
        } else if off < radius {
            emit(chord(-end, end));
        }
    }

    fn extent(&self) -> Option<Extent> {
        let spread = revolution::disc(self.normal.as_dvec3()) * f64::from(self.radius);
        Some(Extent::around(flat(self.center), spread))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::random::Pcg;
    use glam::{DVec2, DVec3, Vec3, vec3};

    fn pieces(center: Vec3, normal: Vec3, radius: f32, inner_radius: f32) -> Vec<[DVec2; 2]> {
        let section = Section { y: 0.0, center: DVec2::ZERO, radius: 15.0, pixel: 0.01 };
        let (disc, mut pieces) = (Disc { center, normal, radius, inner_radius, material: 0 }, Vec::new());
        disc.cuts(&section, &mut |cut| match cut {
            Cut::Segment(from, to) => pieces.push([from, to]),
            _ => panic!("{cut:?}"),
        });
        pieces
    }

    #[test]
    fn chords_and_their_pieces() {
        // About x: a circle in the plane x = 2, whose middle is 3 above the slice.
        let w = (3.5f64 * 3.5 - 9.0).sqrt();
        for normal in [Vec3::X, Vec3::X * -7.0] {
            for (radius, inner, expected) in [
                (5.0, 0.0, vec![-3.0, 5.0]),
                (5.0, 3.0, vec![-3.0, 5.0]),
                (5.0, 3.5, vec![-3.0, 1.0 - w, 1.0 + w, 5.0]),
                (2.9, 0.0, vec![]),
            ] {
                let found = pieces(vec3(2.0, 3.0, 1.0), normal, radius, inner);
                let mut z: Vec<f64> = found.iter().flatten().map(|p| p.y).collect();
                assert!(found.iter().flatten().all(|p| (p.x - 2.0).abs() < 1e-12), "{found:?}");
                z.sort_by(f64::total_cmp);
                let near = z.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12);
                assert!(z.len() == expected.len() && near, "{radius} {inner}: {found:?}");
            }
        }
        for (y, normal) in [(0.0, Vec3::Y), (0.0, Vec3::NEG_Y), (0.5, Vec3::Y)] {
            assert!(pieces(Vec3::Y * y, normal, 2.0, 1.0).is_empty(), "in the slice, or parallel");
        }
    }

    /// The ends are on a rim, and between them is the disc, between two pieces the hole.
    #[test]
    fn they_are_cut_where_they_are() {
        let (mut rng, mut counts) = (Pcg::new(8), [0; 3]);
        for i in 0..300 {
            let (center, normal, radius) = (rng.cube() * 4.0, rng.unit(), rng.range(0.5, 5.0));
            let inner = if i % 3 == 0 { 0.0 } else { radius * rng.range(0.1, 0.99) };
            let pieces = pieces(center, normal, radius, inner);
            counts[pieces.len()] += 1;
            let (n, c) = (normal.as_dvec3().normalize(), center.as_dvec3());
            let out = |p: DVec2| {
                let q = DVec3::new(p.x, 0.0, p.y) - c;
                assert!(q.dot(n).abs() < 1e-9, "{p} is not in the plane");
                q.length()
            };
            let [inner, radius] = [inner, radius].map(f64::from);
            for p in pieces.iter().flatten() {
                let off = (out(*p) - radius).abs().min((out(*p) - inner).abs());
                assert!(off < 1e-6, "{p} is {off} off");
            }
            if let [one, two] = pieces[..] {
                assert!(out((one[0] + two[1]) / 2.0) < inner && out((one[1] + two[0]) / 2.0) < inner);
            }
            for [from, to] in pieces {
                let middle = out((from + to) / 2.0);
                assert!(middle > inner - 1e-9 && middle < radius, "{from} {to}");
            }
        }
        assert!(counts.iter().all(|&n| n > 20), "{counts:?}");
    }
}
