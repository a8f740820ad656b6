//! The lecture's camera: an eye and a screen of three corners before it.
use crate::scene::CameraDescription;
use glam::DVec3;

/// An eye and the screen it looks through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// E.
    pub eye: DVec3,
    /// From the eye to the top left corner of the screen, p0 − E: relative, so that a far eye costs no digits.
    top_left: DVec3,
    /// p1 − p0: along the top edge.
    across: DVec3,
    /// p2 − p0: down the left edge.
    down: DVec3,
}

impl Camera {
    /// From a description and the picture's width / height.
    ///
    /// The screen's centre lies d = 1 / tan(fov / 2) ahead; the screen is 2 high and 2 · `aspect` wide.
    pub fn new(description: &CameraDescription, aspect: f64) -> Self {
        let eye = description.eye.as_dvec3();
        let view = (description.look_at.as_dvec3() - eye).normalize();
        let right = view.cross(usable_up(view, description.up.as_dvec3())).normalize();
        let up = right.cross(view);
        let d = 1.0 / (f64::from(description.fov).to_radians() / 2.0).tan();
        Self { eye, top_left: d * view - aspect * right + up, across: 2.0 * aspect * right, down: -2.0 * up }
    }

    /// The eye and the unit direction through p0 + `u` (p1 − p0) + `v` (p2 − p0).
    pub fn ray(&self, u: f64, v: f64) -> (DVec3, DVec3) {
        (self.eye, (self.top_left + u * self.across + v * self.down).normalize())
    }
}

/// `up`, or where that is as good as parallel to the view (or zero): the world axis most across the view.
fn usable_up(view: DVec3, up: DVec3) -> DVec3 {
    if view.cross(up).length() > 1e-6 * up.length() {
        return up;
    }
    let [x, y, z] = view.abs().to_array();
    if x <= y && x <= z {
        DVec3::X
    } else if y <= z {
        DVec3::Y
    } else {
        DVec3::Z
    }
}
