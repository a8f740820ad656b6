//! The lecture's camera: an eye E, a view direction V, and a screen at distance d.

use crate::scene::CameraDescription;
use glam::{DVec3, Vec3};

/// The eye and the screen's corners as seen from it.
///
/// C = E + d V is the screen's centre, its half-height 1 and its half-width the aspect; d = 1 / tan(fov / 2).
/// The primary ray through (u, v), both from 0 to 1, goes through p0 + u (p1 − p0) + v (p2 − p0). The corners are
/// kept relative to E, where they do not lose digits to it, and in `f64`, so that a pixel does not lose any to the
/// width of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// E.
    pub eye: Vec3,
    /// p0 − E, the top left corner.
    pub corner: DVec3,
    /// p1 − p0, along the top edge.
    pub across: DVec3,
    /// p2 − p0, down the left edge.
    pub down: DVec3,
}

impl Camera {
    /// From a description and the picture's width / height.
    ///
    /// Where `up` is parallel to V (or zero), the world axis furthest from V stands in for it.
    pub fn new(description: &CameraDescription, aspect: f32) -> Self {
        let (eye, up) = (description.eye.as_dvec3(), description.up.as_dvec3());
        let view = (description.look_at.as_dvec3() - eye).normalize();
        let across = view.cross(up);
        let right = if across.length() > 1e-6 * up.length() { across } else { view.cross(furthest_axis(view)) };
        let right = right.normalize();
        let up = right.cross(view);
        let d = 1.0 / (f64::from(description.fov).to_radians() / 2.0).tan();
        let half_width = f64::from(aspect);
        Self {
            eye: description.eye,
            corner: view * d - right * half_width + up,
            across: right * (2.0 * half_width),
            down: up * -2.0,
        }
    }

    /// An eye that looks at a point, which is another one; +y is up. `fov` is the vertical field of view in degrees, above 0
    /// and below 180, and `aspect` the picture's width / height.
    pub fn look_at(eye: impl Into<Vec3>, look_at: impl Into<Vec3>, fov: f32, aspect: f32) -> Self {
        Self::new(&CameraDescription { fov, ..CameraDescription::new(eye, look_at) }, aspect)
    }

    /// p0, the top left corner of the screen.
    pub fn p0(&self) -> Vec3 {
        (self.eye.as_dvec3() + self.corner).as_vec3()
    }

    /// p1, the top right corner.
    pub fn p1(&self) -> Vec3 {
        (self.eye.as_dvec3() + self.corner + self.across).as_vec3()
    }

    /// p2, the bottom left corner.
    pub fn p2(&self) -> Vec3 {
        (self.eye.as_dvec3() + self.corner + self.down).as_vec3()
    }

    /// V, the unit direction straight ahead.
    pub fn view(&self) -> DVec3 {
        self.across.cross(self.down).normalize()
    }

    /// Unit direction of the ray through p0 + u (p1 − p0) + v (p2 − p0).
    pub fn direction(&self, u: f32, v: f32) -> Vec3 {
        (self.corner + self.across * f64::from(u) + self.down * f64::from(v)).normalize().as_vec3()
    }
}

/// The world axis along which `v` is smallest; x before y before z on ties.
fn furthest_axis(v: DVec3) -> DVec3 {
    let a = v.abs();
    if a.x <= a.y && a.x <= a.z {
        DVec3::X
    } else if a.y <= a.z {
        DVec3::Y
    } else {
        DVec3::Z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    fn looking(eye: Vec3, look_at: Vec3, up: Vec3) -> Camera {
        Camera::new(&CameraDescription { eye, look_at, up, fov: 90.0 }, 2.0)
    }

    #[test]
    fn corners_of_the_lecture() {
        let c = looking(vec3(0.0, 1.0, 5.0), vec3(0.0, 1.0, 0.0), Vec3::Y);
        let close = |a: Vec3, b: Vec3| assert!((a - b).length() < 1e-6, "{a} {b}");
        close(c.p0(), vec3(-2.0, 2.0, 4.0));
        close(c.p1(), vec3(2.0, 2.0, 4.0));
        close(c.p2(), vec3(-2.0, 0.0, 4.0));
        close(c.direction(0.5, 0.5), Vec3::NEG_Z);
    }

    #[test]
    fn any_orientation_is_finite_even_with_up_along_the_view() {
        for look_at in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::Y, vec3(1.0, 1.0, 1.0), vec3(0.0, 1.0, 1e-9)] {
            for up in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::ZERO, look_at, -look_at * 1e-3, look_at * 1e6] {
                let c = looking(Vec3::ZERO, look_at, up);
                let v = look_at.normalize();
                assert!((c.direction(0.5, 0.5) - v).length() < 1e-5, "{look_at} {up}");
                assert!((c.across.length() - 4.0).abs() < 1e-5 && (c.down.length() - 2.0).abs() < 1e-5);
                assert!(c.across.dot(c.down).abs() < 1e-5 && c.across.dot(v.as_dvec3()).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn a_far_eye_loses_no_digits() {
        let near = looking(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y);
        let far = looking(vec3(1e6, 1e6, 1e6), vec3(1e6, 1e6, 1e6 - 1.0), Vec3::Y);
        assert_eq!(near.direction(0.3, 0.7), far.direction(0.3, 0.7));
    }
}
