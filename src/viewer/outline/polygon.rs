//! Outlines of flat convex shapes: a segment.

use crate::viewer::section::Cut;
use glam::{DVec3, Vec3Swizzles};

/// The segment that the slice's plane cuts out of a convex polygon.
///
/// A corner on the slice counts as above it, so that neighbours agree on a shared edge and corner, and a polygon that
/// lies in the slice is not cut.
pub fn polygon_cut(corners: &[DVec3], y: f64) -> Option<Cut> {
    let next = corners.iter().cycle().skip(1);
    let mut crossings = corners.iter().zip(next).filter(|(a, b)| (a.y >= y) != (b.y >= y)).map(|(&a, &b)| {
        // Always from below, so that neighbours agree on the point as well.
        let (from, to) = if a.y >= y { (b, a) } else { (a, b) };
        from.lerp(to, (y - from.y) / (to.y - from.y)).xz()
    });
    Some(Cut::Segment(crossings.next()?, crossings.next()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    #[test]
    fn triangles_give_segments() {
        let corners = [DVec3::new(0.0, 0.0, 0.0), DVec3::new(4.0, 2.0, 0.0), DVec3::new(0.0, 2.0, 8.0)];
        let expected = [DVec2::new(2.0, 0.0), DVec2::new(0.0, 4.0)];
        for turn in 0..3 {
            let mut corners = corners;
            corners.rotate_left(turn);
            let Some(Cut::Segment(a, b)) = polygon_cut(&corners, 1.0) else { panic!() };
            assert!([a, b] == expected || [b, a] == expected);
        }
        assert_eq!(polygon_cut(&corners, 2.5), None);
        assert_eq!(polygon_cut(&corners.map(|p| DVec3::new(p.x, 1.0, p.z)), 1.0), None, "parallel");
    }
}
