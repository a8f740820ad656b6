//! Where the corners of what has some are, in `f64` from the description's numbers.

use super::{Cuboid, Quad};
use glam::{DMat3, DVec3};

impl Quad {
    /// Its corners in order around it: corner, corner + u, corner + u + v, corner + v.
    pub fn corners(&self) -> [DVec3; 4] {
        let [corner, u, v] = [self.corner, self.u, self.v].map(|v| v.as_dvec3());
        [corner, corner + u, corner + u + v, corner + v]
    }
}

impl Cuboid {
    /// Its corners, turned. The one of index i has the greater x, y, z, before it is turned, where bit 0, 1, 2 of i is
    /// set.
    pub fn corners(&self) -> [DVec3; 8] {
        let (min, max) = (self.min.as_dvec3(), self.max.as_dvec3());
        let (center, half) = ((min + max) / 2.0, (max - min) / 2.0);
        let [x, y, z] = self.rotation.as_dvec3().to_array().map(f64::to_radians);
        let turn = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
        let axes = [turn.x_axis * half.x, turn.y_axis * half.y, turn.z_axis * half.z];
        std::array::from_fn(|i| {
            let side = |bit: usize| if i >> bit & 1 == 1 { axes[bit] } else { -axes[bit] };
            center + side(0) + side(1) + side(2)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn corners_are_where_they_are_said_to_be() {
        let quad = Quad { corner: Vec3::X, u: Vec3::Y, v: Vec3::Z * 2.0, material: 0 };
        let [a, b, c, d] = quad.corners();
        assert_eq!([a, b - a, c - b, d - c], [DVec3::X, DVec3::Y, DVec3::Z * 2.0, -DVec3::Y]);

        let (min, max) = (Vec3::new(-1.0, -2.0, -3.0), Vec3::new(1.0, 2.0, 3.0));
        let cuboid = Cuboid { min, max, rotation: Vec3::ZERO, material: 0 };
        let [low, x, .., high] = cuboid.corners();
        assert_eq!([low, x, high], [min, Vec3::new(1.0, -2.0, -3.0), max].map(|p| p.as_dvec3()));
        let turned = Cuboid { rotation: Vec3::Z * 90.0, ..cuboid }.corners();
        assert!(turned[1].distance(DVec3::new(2.0, 1.0, -3.0)) < 1e-12, "{}", turned[1]);
    }
}
