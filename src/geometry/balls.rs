//! Balls around primitives, to leave out what no ray of a batch can meet.

use crate::math::MAX_LANES;

/// Balls, column by column, padded with zeros to a multiple of [`MAX_LANES`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Balls {
    /// Centres.
    pub center: [Vec<f32>; 3],
    /// Radii.
    pub radius: Vec<f32>,
    len: usize,
}

impl Balls {
    /// The number of balls.
    #[inline]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is none.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Adds a ball.
    pub fn push(&mut self, center: glam::Vec3, radius: f32) {
        let i = self.len;
        self.len += 1;
        let padded = self.len.next_multiple_of(MAX_LANES);
        for (column, value) in
            self.center.iter_mut().chain([&mut self.radius]).zip([center.x, center.y, center.z, radius])
        {
            column.resize(padded, 0.0);
            column[i] = value;
        }
    }

    /// Adds the ball around a box from `min` to `max`, rounded up.
    pub fn push_around(&mut self, [min, max]: [glam::Vec3; 2]) {
        let (low, high) = (min.as_dvec3(), max.as_dvec3());
        let center = ((low + high) * 0.5).as_vec3();
        // The centre was rounded, so the radius is taken from where it is.
        let furthest = (high - center.as_dvec3()).max(center.as_dvec3() - low);
        self.push(center, (furthest.length() * (1.0 + 1e-6)) as f32);
    }

    /// Ball `i`'s centre.
    #[inline]
    pub fn center(&self, i: usize) -> glam::Vec3 {
        glam::Vec3::new(self.center[0][i], self.center[1][i], self.center[2][i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn a_ball_holds_its_box() {
        let mut balls = Balls::default();
        for (i, [low, high]) in [
            [vec3(-1.0, 2.0, 3.0), vec3(4.0, 5.0, 6.0)],
            [vec3(1e6, 1e6, 1e6), vec3(1e6 + 0.0625, 1e6, 1e6)],
            [vec3(0.1, 0.1, 0.1), vec3(0.1, 0.1, 0.1)],
        ]
        .into_iter()
        .enumerate()
        {
            balls.push_around([low, high]);
            let center = balls.center(i).as_dvec3();
            for corner in [low, high].map(|c| c.as_dvec3()) {
                assert!(corner.distance(center) <= f64::from(balls.radius[i]), "{i}");
            }
        }
        assert!(balls.len() == 3 && balls.radius.len() == MAX_LANES);
    }
}
