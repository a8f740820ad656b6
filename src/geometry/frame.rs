//! Axes in a surface, from its normal, and coordinates along axes.

use glam::Vec3;

use crate::math::{Lanes, Vec3 as Lane3, map3};

/// Two unit axes T and B = T × n in the surface with unit normal `n`, for patterns.
///
/// T is the projection of the x axis, or of the z axis where n.x is the greatest component (y before x before z
/// on ties). A floor, n = y, gets T = x and B = z.
pub fn frame(n: Vec3) -> [Vec3; 2] {
    let a = n.abs();
    let axis = if (a.y >= a.x && a.y >= a.z) || a.x < a.z { Vec3::X } else { Vec3::Z };
    let t = (axis - n * n.dot(axis)).normalize();
    [t, t.cross(n)]
}

/// A vector's coordinates along three axes.
#[inline(always)]
pub(super) fn along<L: Lanes>(axes: &[Lane3<L>; 3], v: Lane3<L>) -> Lane3<L> {
    let [x, y, z] = map3(*axes, |axis| axis.dot(v));
    Lane3::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floors_and_walls_get_the_world_axes() {
        assert_eq!(frame(Vec3::Y), [Vec3::X, Vec3::Z]);
        assert_eq!(frame(Vec3::X), [Vec3::Z, Vec3::Y]);
        assert_eq!(frame(Vec3::Z), [Vec3::X, Vec3::NEG_Y]);
    }

    #[test]
    fn axes_are_unit_and_perpendicular() {
        for n in [Vec3::new(1.0, 1.0, 1.0), Vec3::new(-3.0, 0.1, 2.9), Vec3::new(1e-3, -1.0, 0.7)] {
            let n = n.normalize();
            let [t, b] = frame(n);
            assert!(t.dot(n).abs() < 1e-6 && b.dot(n).abs() < 1e-6 && t.dot(b).abs() < 1e-6);
            assert!((t.length() - 1.0).abs() < 1e-6 && (b.length() - 1.0).abs() < 1e-6);
        }
    }
}
