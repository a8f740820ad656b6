//! Tori: with R and m its radii, one lies between R ± √(m² − s²) from its axis, at s along it.

use super::revolution::{Tilt, disc};
use super::{Extent, Outline};
use crate::scene::Torus;
use crate::viewer::section::{Cut, Section, flat};

impl Outline for Torus {
    fn cuts(&self, section: &Section, emit: &mut dyn FnMut(Cut)) {
        let (major, minor) = (f64::from(self.major_radius), f64::from(self.minor_radius));
        if !section.meets(self.center.as_dvec3(), major + minor) {
            return;
        }
        let tilt = Tilt::new(self.center, self.axis.as_dvec3(), section.y);
        let tube = |t: f64| {
            let axial = tilt.axial(t).abs();
            ((minor - axial) * (minor + axial)).max(0.0).sqrt()
        };
        let (outer, inner) = (|t: f64| major + tube(t), |t: f64| major - tube(t));
        if tilt.level == 0.0 {
            if tilt.axial(0.0).abs() <= minor {
                emit(Cut::Circle { center: tilt.origin, radius: outer(0.0) });
                emit(Cut::Circle { center: tilt.origin, radius: inner(0.0) });
            }
            return;
        }
        let [low, high] = tilt.seen(section);
        let mut ends = vec![low, high];
        ends.extend([-minor, minor].map(|axial| tilt.reaches(axial)));
        for side in [-major, major] {
            // The tube's two circles in the vertical plane: where the line enters and leaves each. When it passes by, where
            // it is nearest, since an outline that has just parted or is about to join bends sharply there.
            let (nearest, off) = (-tilt.steep * side, (tilt.rise - tilt.level * side).abs());
            let reach = ((minor - off) * (minor + off)).max(0.0).sqrt();
            ends.extend([nearest - reach, nearest + reach]);
        }
        ends.retain(|t| (low..=high).contains(t));
        ends.sort_by(f64::total_cmp);
        for pair in ends.windows(2) {
            let (span, middle) = ([pair[0], pair[1]], (pair[0] + pair[1]) / 2.0);
            if pair[0] == pair[1] || tilt.axial(middle).abs() > minor {
                continue;
            }
            let (across, pieces) = (tilt.across(middle).abs(), section.pieces(major + minor));
            if outer(middle) >= across {
                tilt.outline(span, pieces, outer, emit);
            }
            if inner(middle) >= across {
                tilt.outline(span, pieces, inner, emit);
            }
        }
    }

    fn extent(&self) -> Option<Extent> {
        let spread = disc(self.axis.as_dvec3()) * f64::from(self.major_radius);
        Some(Extent::around(flat(self.center), spread + f64::from(self.minor_radius)))
    }
}
