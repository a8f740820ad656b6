//! Scenes elsewhere: scaled, then turned or mirrored, then moved.

use glam::{DMat3, DVec3, EulerRot, Vec3};
use raypacket::render::Camera;
use raypacket::scene::{Cuboid, Description};

/// What happens to points. Computed in `f64` and rounded once.
pub struct Map {
    pub scale: f64,
    /// Of axes at right angles and of length 1.
    pub turn: DMat3,
    pub by: DVec3,
}

impl Default for Map {
    fn default() -> Self {
        Self { scale: 1.0, turn: DMat3::IDENTITY, by: DVec3::ZERO }
    }
}

/// The matrix of quarter turns about x, then y, then z, of zeros and ones.
pub fn right_angles(turns: [u8; 3]) -> DMat3 {
    let quarter = [
        DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y),
        DMat3::from_cols(DVec3::NEG_Z, DVec3::Y, DVec3::X),
        DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z),
    ];
    let about = |axis: usize| (0..turns[axis]).fold(DMat3::IDENTITY, |turn, _| quarter[axis] * turn);
    about(2) * about(1) * about(0)
}

impl Map {
    fn point(&self, p: Vec3) -> Vec3 {
        (self.turn * (p.as_dvec3() * self.scale) + self.by).as_vec3()
    }

    fn edge(&self, v: Vec3) -> Vec3 {
        (self.turn * (v.as_dvec3() * self.scale)).as_vec3()
    }

    fn direction(&self, v: Vec3) -> Vec3 {
        (self.turn * v.as_dvec3()).as_vec3()
    }

    fn length(&self, x: f32) -> f32 {
        (f64::from(x) * self.scale) as f32
    }

    /// The same camera there; what is seen from the eye is not rounded.
    pub fn camera(&self, camera: &Camera) -> Camera {
        let [corner, across, down] = [camera.corner, camera.across, camera.down].map(|v| self.turn * v);
        Camera { eye: self.point(camera.eye), corner, across, down }
    }

    pub fn description(&self, description: &Description) -> Description {
        let mut scene = description.clone();
        let camera = &mut scene.camera;
        (camera.eye, camera.look_at) = (self.point(camera.eye), self.point(camera.look_at));
        camera.up = self.direction(camera.up);
        scene.lights.iter_mut().for_each(|l| l.position = self.point(l.position));
        for p in &mut scene.planes {
            // (p + b)·Rn = p·n + b·Rn
            p.normal = self.direction(p.normal);
            let moved = f64::from(p.distance) * self.scale - p.normal.as_dvec3().dot(self.by);
            p.distance = moved as f32;
        }
        scene.spheres.iter_mut().for_each(|s| (s.center, s.radius) = (self.point(s.center), self.length(s.radius)));
        scene.meshes.iter_mut().flat_map(|m| &mut m.positions).for_each(|p| *p = self.point(*p));
        scene
            .quads
            .iter_mut()
            .for_each(|q| (q.corner, q.u, q.v) = (self.point(q.corner), self.edge(q.u), self.edge(q.v)));
        scene.cuboids.iter_mut().for_each(|c| *c = self.cuboid(c));
        for c in &mut scene.cylinders {
            (c.base, c.apex, c.radius) = (self.point(c.base), self.point(c.apex), self.length(c.radius));
        }
        for c in &mut scene.cones {
            (c.base, c.apex) = (self.point(c.base), self.point(c.apex));
            (c.base_radius, c.apex_radius) = (self.length(c.base_radius), self.length(c.apex_radius));
        }
        for t in &mut scene.tori {
            (t.center, t.axis) = (self.point(t.center), self.direction(t.axis));
            (t.major_radius, t.minor_radius) = (self.length(t.major_radius), self.length(t.minor_radius));
        }
        scene.fractals.iter_mut().for_each(|f| (f.center, f.radius) = (self.point(f.center), self.length(f.radius)));
        for d in &mut scene.discs {
            (d.center, d.normal) = (self.point(d.center), self.direction(d.normal));
            (d.radius, d.inner_radius) = (self.length(d.radius), self.length(d.inner_radius));
        }
        scene
    }

    fn cuboid(&self, c: &Cuboid) -> Cuboid {
        let [x, y, z] = c.rotation.as_dvec3().to_array().map(f64::to_radians);
        // A box is its own mirror image: where the turn mirrors, an axis the other way round makes it a turn again.
        let mirror = DMat3::from_diagonal(DVec3::new(self.turn.determinant().signum(), 1.0, 1.0));
        let turn = self.turn * DMat3::from_euler(EulerRot::ZYX, z, y, x) * mirror;
        let [min, max] = [c.min, c.max].map(|p| p.as_dvec3() * self.scale);
        let (middle, half) = (self.turn * ((min + max) / 2.0) + self.by, (max - min) / 2.0);
        if turn.to_cols_array().iter().all(|x| x.fract() == 0.0) {
            // Turned by right angles, its edges lie along axes again.
            let half = DMat3::from_cols(turn.x_axis.abs(), turn.y_axis.abs(), turn.z_axis.abs()) * half;
            return Cuboid {
                min: (middle - half).as_vec3(),
                max: (middle + half).as_vec3(),
                rotation: Vec3::ZERO,
                ..*c
            };
        }
        let (z, y, x) = turn.to_euler(EulerRot::ZYX);
        let turned = DVec3::new(x, y, z).map(f64::to_degrees).as_vec3();
        let rotation = if self.turn == DMat3::IDENTITY { c.rotation } else { turned };
        Cuboid { min: (middle - half).as_vec3(), max: (middle + half).as_vec3(), rotation, ..*c }
    }
}
