//! Boxes, aligned to the axes or turned.
use super::{Edges, FACE, Primitive, Primitives};
use crate::scene;
use glam::{DMat3, DVec2, DVec3};

#[derive(Clone, Debug)]
pub(super) struct Cuboid {
    min: DVec3,
    max: DVec3,
    /// From the world's axes to the box's own, where they differ.
    to_own: Option<DMat3>,
    material: usize,
}

impl Cuboid {
    pub fn new(cuboid: &scene::Cuboid) -> Self {
        let [x, y, z] = cuboid.rotation.to_array().map(sin_cos);
        let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, x.1, x.0), DVec3::new(0.0, -x.0, x.1));
        let about_y = DMat3::from_cols(DVec3::new(y.1, 0.0, -y.0), DVec3::Y, DVec3::new(y.0, 0.0, y.1));
        let about_z = DMat3::from_cols(DVec3::new(z.1, z.0, 0.0), DVec3::new(-z.0, z.1, 0.0), DVec3::Z);
        let turn = about_z * (about_y * about_x);
        Self {
            min: cuboid.min.as_dvec3(),
            max: cuboid.max.as_dvec3(),
            to_own: (turn != DMat3::IDENTITY).then(|| turn.transpose()),
            material: cuboid.material,
        }
    }

    fn center(&self) -> DVec3 {
        (self.min + self.max) / 2.0
    }

    fn half(&self) -> DVec3 {
        (self.max - self.min) / 2.0
    }

    /// A world vector in the box's own axes.
    fn own(&self, v: DVec3) -> DVec3 {
        self.to_own.map_or(v, |to_own| to_own * v)
    }

    /// A vector in the box's own axes in the world's.
    fn world(&self, v: DVec3) -> DVec3 {
        self.to_own.map_or(v, |to_own| to_own.transpose() * v)
    }

    /// A point near the surface in the box's own axes, from its centre; the axis across its face, x before y before z
    /// where several are as near, and the side.
    fn face(&self, point: DVec3) -> (DVec3, usize, f64) {
        let q = self.own(point - self.center());
        let out = (q / self.half()).abs();
        let axis = out.max_position();
        (q, axis, if q[axis] < 0.0 { -1.0 } else { 1.0 })
    }
}

/// Sine and cosine of degrees; exact at quarter turns.
fn sin_cos(degrees: f32) -> (f64, f64) {
    let turn = f64::from(degrees).rem_euclid(360.0);
    match turn {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => turn.to_radians().sin_cos(),
    }
}

impl Primitives for scene::Cuboid {
    fn add(&self, to: &mut Vec<Box<dyn Primitive>>) {
        to.push(Box::new(Cuboid::new(self)));
    }
}

impl Primitive for Cuboid {
    /// The ray is in the closed box where it is between both faces of each pair.
    ///
    /// Along an axis in which it does not move it is so always or never; in a face's plane, always.
    fn distance(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let (low, high) = if self.to_own.is_none() {
            (self.min - origin, self.max - origin)
        } else {
            let from_center = self.own(origin - self.center());
            (-self.half() - from_center, self.half() - from_center)
        };
        let along = self.own(direction);
        let (mut enter, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (low, high, d) = (low[axis], high[axis], along[axis]);
            if d == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (first, last) = if d > 0.0 { (low / d, high / d) } else { (high / d, low / d) };
            enter = enter.max(first);
            exit = exit.min(last);
        }
        if enter > exit {
            return None;
        }
        [enter, exit].into_iter().find(|&t| t > 0.0)
    }

    fn project(&self, point: DVec3) -> DVec3 {
        let (mut q, axis, side) = self.face(point);
        q = q.clamp(-self.half(), self.half());
        q[axis] = side * self.half()[axis];
        self.center() + self.world(q)
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        let (_, axis, side) = self.face(point);
        self.world(side * DVec3::AXES[axis])
    }

    /// Half the diagonal.
    fn extent(&self) -> f64 {
        self.half().length()
    }

    fn material(&self) -> usize {
        self.material
    }

    fn uv(&self, point: DVec3) -> DVec2 {
        let (q, axis, side) = self.face(point);
        face_uv(q / self.half(), axis, side)
    }

    fn edges(&self, _point: DVec3) -> Edges {
        FACE
    }

    fn checker(&self, point: DVec3) -> DVec3 {
        let (mut q, axis, _) = self.face(point);
        q[axis] = 0.0;
        q
    }
}

/// Where a point at `share` of the half size from the centre is on the face across `axis` on one side.
pub(super) fn face_uv(share: DVec3, axis: usize, side: f64) -> DVec2 {
    let along = match axis {
        0 => DVec2::new(-side * share.z, share.y),
        1 => DVec2::new(share.x, -side * share.z),
        _ => DVec2::new(side * share.x, share.y),
    };
    (along + 1.0) / 2.0
}
