//! The geometry that bodies of revolution share in the slice: cylinders, cones, discs, tori.
//!
//! The vertical plane through a body's axis is a plane of symmetry, and meets the slice in a line. t runs along it, and
//! w is the distance from it in the slice. In that vertical plane, a point of the line is at s along the axis
//! and at c across it, which is t and the slice's height turned by the axis' slope: s and c are linear in t. A point of
//! the slice is √(c² + w²) from the axis, so where the body has radius r, its outline is at
//!
//! w = ± √(r² − c²) = ± √((r − |c|) (r + |c|))
//!
//! wherever |c| ≤ r. The ends of these intervals of t are known exactly. There the outline runs across the line, as
//! an ellipse does at its ends, and samples are placed as if it were one: evenly by its angle.

use super::Extent;
use crate::viewer::section::{Cut, Section, flat};
use glam::{DVec2, DVec3, Vec3, Vec3Swizzles};
use std::f64::consts::FRAC_PI_2;

/// The slice as seen from an axis.
pub struct Tilt {
    /// Where t = w = 0, in (x, z): below or above the axis' origin.
    pub origin: DVec2,
    /// The direction of t.
    along: DVec2,
    /// The horizontal part of the unit axis: s by t.
    pub level: f64,
    /// Its vertical part: s by height.
    pub steep: f64,
    /// The slice's height above the origin.
    pub rise: f64,
}

impl Tilt {
    /// `axis` is of any length but zero, `y` the slice's height.
    pub fn new(origin: Vec3, axis: DVec3, y: f64) -> Self {
        let (axis, origin) = (axis.normalize(), origin.as_dvec3());
        let (level, steep) = (axis.xz().length(), axis.y);
        let along = axis.xz().try_normalize().unwrap_or(DVec2::X);
        Self { origin: origin.xz(), along, level, steep, rise: y - origin.y }
    }

    /// s at t.
    pub fn axial(&self, t: f64) -> f64 {
        self.level * t + self.steep * self.rise
    }

    /// c at t.
    pub fn across(&self, t: f64) -> f64 {
        self.level * self.rise - self.steep * t
    }

    /// t where s is `axial`; infinite or NaN for an upright axis.
    pub fn reaches(&self, axial: f64) -> f64 {
        (axial - self.steep * self.rise) / self.level
    }

    /// In (x, z).
    pub fn point(&self, t: f64, w: f64) -> DVec2 {
        self.origin + self.along * t + self.along.perp() * w
    }

    /// The t that is seen.
    pub fn seen(&self, section: &Section) -> [f64; 2] {
        let middle = (section.center - self.origin).dot(self.along);
        [middle - section.radius, middle + section.radius]
    }

    /// w for a body's radius at t.
    pub fn aside(&self, t: f64, radius: f64) -> f64 {
        let across = self.across(t).abs();
        // At the ends of an interval rounding may leave less than 0.
        ((radius - across) * (radius + across)).max(0.0).sqrt()
    }

    /// Both halves of an outline, symmetric about the line, for t in an interval. `radius` is the body's at t.
    pub fn outline(&self, [low, high]: [f64; 2], pieces: u32, radius: impl Fn(f64) -> f64, emit: &mut dyn FnMut(Cut)) {
        let sample = |i: u32| {
            // sin² runs from 0 to 1 as half of 1 − cos, right to the last bits at both ends.
            let part = (FRAC_PI_2 * f64::from(i) / f64::from(pieces)).sin().powi(2);
            let t = low + (high - low) * part;
            (t, self.aside(t, radius(t)))
        };
        let mut last = sample(0);
        for i in 1..=pieces {
            let next = sample(i);
            for side in [1.0, -1.0] {
                emit(Cut::Segment(self.point(last.0, side * last.1), self.point(next.0, side * next.1)));
            }
            last = next;
        }
    }
}

/// The outlines of a cylinder or cone between its `ends`: conic sections, and the caps' chords.
pub fn side_cuts(ends: [Vec3; 2], radii: [f32; 2], caps: bool, section: &Section, emit: &mut dyn FnMut(Cut)) {
    let [base, apex] = ends.map(|end| end.as_dvec3());
    let (radii, axis) = (radii.map(f64::from), apex - base);
    let (length, widest) = (axis.length(), radii[0].max(radii[1]));
    if !section.meets((base + apex) / 2.0, length / 2.0 + widest) {
        return;
    }
    let tilt = Tilt::new(ends[0], axis, section.y);
    let growth = (radii[1] - radii[0]) / length;
    let radius = |t: f64| radii[0] + growth * tilt.axial(t);
    if tilt.level == 0.0 {
        if (0.0..=length).contains(&tilt.axial(0.0)) {
            emit(Cut::Circle { center: tilt.origin, radius: radius(0.0).max(0.0) });
        }
        return;
    }
    let [mut low, mut high] = tilt.seen(section);
    // Within the ends, and |c| ≤ r: each as a t + b ≥ 0.
    let (shift, slope) = (tilt.steep * tilt.rise, growth * tilt.level);
    let start = radii[0] + growth * shift;
    let middle = tilt.level * tilt.rise;
    for (a, b) in [
        (tilt.level, shift),
        (-tilt.level, length - shift),
        (slope + tilt.steep, start - middle),
        (slope - tilt.steep, start + middle),
    ] {
        match a {
            a if a > 0.0 => low = low.max(-b / a),
            a if a < 0.0 => high = high.min(-b / a),
            _ if b >= 0.0 => {}
            _ => return,
        }
    }
    if low <= high {
        tilt.outline([low, high], section.pieces(widest.max((high - low) / 2.0)), radius, emit);
    }
    for (axial, radius) in [(0.0, radii[0]), (length, radii[1])] {
        let t = tilt.reaches(axial);
        if caps && tilt.across(t).abs() < radius {
            let w = tilt.aside(t, radius);
            emit(Cut::Segment(tilt.point(t, -w), tilt.point(t, w)));
        }
    }
}

/// How far a cylinder or cone spreads.
pub fn side_extent([base, apex]: [Vec3; 2], [start, end]: [f32; 2]) -> Extent {
    let spread = disc(apex.as_dvec3() - base.as_dvec3());
    let around = |middle: Vec3, radius: f32| Extent::around(flat(middle), spread * f64::from(radius));
    around(base, start).with(around(apex, end))
}

/// How far a circle of radius 1 about an axis spreads along x and z.
pub fn disc(axis: DVec3) -> DVec2 {
    let axis = axis.normalize();
    DVec2::new(axis.yz().length(), axis.xy().length())
}
