//! The camera's controls: a pose that moves with time, independent of how often it is asked to.
//!
//! The pose is held in `f64`: at hundreds of steps a second, steps of thousandths of a unit would get lost beside an
//! eye that is thousands of units from the origin.

use crate::{render::Camera, scene::CameraDescription};
use glam::DVec3;

/// The field of view's limits, degrees.
const FOV: (f64, f64) = (5.0, 150.0);
/// Steepest view up or down, radians: short of the poles, where turning left and right has no meaning.
const STEEPEST: f64 = 89.0 * std::f64::consts::PI / 180.0;
/// How much faster everything moves with shift.
const FAST: f64 = 4.0;

/// Which ways to go; every part from −1 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moves {
    /// Along the view direction.
    pub forward: f64,
    /// Sideways.
    pub right: f64,
    /// Along the scene's up.
    pub up: f64,
    /// Turn to the right.
    pub turn: f64,
    /// Turn upward.
    pub tilt: f64,
    /// Widen the field of view.
    pub widen: f64,
    /// Move faster.
    pub fast: bool,
}

/// The camera's pose and field of view, which moving changes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pose {
    eye: DVec3,
    /// Radians to the right of [`Controls::ahead`].
    yaw: f64,
    /// Radians above the horizon, whose normal is [`Controls::up`].
    pitch: f64,
    /// Degrees.
    fov: f64,
}

/// A camera that can be flown.
#[derive(Clone, Debug)]
pub struct Controls {
    home: CameraDescription,
    start: Pose,
    pose: Pose,
    /// Unit vectors, perpendicular to each other.
    up: DVec3,
    ahead: DVec3,
    right: DVec3,
    /// World units a second; the distance from eye to look_at, as the scene's own measure of what is near.
    speed: f64,
}

impl Controls {
    /// Starts where the scene says.
    pub fn new(home: &CameraDescription) -> Self {
        let eye = home.eye.as_dvec3();
        let view = home.look_at.as_dvec3() - eye;
        let forward = view.try_normalize().unwrap_or(DVec3::NEG_Z);
        let mut up = home.up.as_dvec3().try_normalize().unwrap_or(DVec3::Y);
        if forward.cross(up).length() < 1e-4 {
            // Looking along up: left and right are the camera's choice, so its screen says what up is.
            let camera = Camera::new(home, 1.0);
            up = (-camera.down).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
        }
        let pitch = forward.dot(up).clamp(-1.0, 1.0).asin();
        let ahead = forward.reject_from_normalized(up).normalize();
        let speed = if view.length() > 0.0 && view.is_finite() { view.length() } else { 1.0 };
        let start = Pose { eye, yaw: 0.0, pitch, fov: f64::from(home.fov) };
        Self { home: *home, start, pose: start, up, ahead, right: ahead.cross(up), speed }
    }

    /// Back to where the scene says.
    pub fn reset(&mut self) {
        self.pose = self.start;
    }

    /// Moves for `seconds`. Steps add up: many short ones go as far as one long one.
    pub fn step(&mut self, moves: &Moves, seconds: f64) {
        let speed = self.speed * seconds * if moves.fast { FAST } else { 1.0 };
        let (sin, cos) = self.pose.yaw.sin_cos();
        let right = self.right * cos - self.ahead * sin;
        let eye = self.pose.eye + (self.forward() * moves.forward + right * moves.right + self.up * moves.up) * speed;
        // A flight beyond what f32 holds would end in a camera that is nowhere.
        if eye.abs().max_element() < 1e30 {
            self.pose.eye = eye;
        }
        // By the field of view a second, so that the picture passes at the same pace when zoomed in.
        let turn = self.pose.fov.min(90.0).to_radians() * seconds;
        self.turn(moves.turn * turn, moves.tilt * turn);
        if moves.widen != 0.0 {
            self.pose.fov = (self.pose.fov * (moves.widen * seconds).exp2()).clamp(FOV.0, FOV.1);
        }
    }

    /// Turns as a mouse drag does, by parts of the picture's height: to the right and down.
    pub fn drag(&mut self, right: f64, down: f64) {
        let fov = self.pose.fov.to_radians();
        self.turn(right * fov, -down * fov);
    }

    fn turn(&mut self, right: f64, up: f64) {
        self.pose.yaw = (self.pose.yaw + right) % std::f64::consts::TAU;
        if up != 0.0 {
            // The scene itself may start steeper; then it may stay, but go no further.
            let steepest = STEEPEST.max(self.pose.pitch.abs());
            self.pose.pitch = (self.pose.pitch + up).clamp(-steepest, steepest);
        }
    }

    /// The unit view direction.
    fn forward(&self) -> DVec3 {
        let (yaw_sin, yaw_cos) = self.pose.yaw.sin_cos();
        let (pitch_sin, pitch_cos) = self.pose.pitch.sin_cos();
        (self.ahead * yaw_cos + self.right * yaw_sin) * pitch_cos + self.up * pitch_sin
    }

    /// The camera as it is now; to the bit the scene's own before the first move and after a reset.
    pub fn camera(&self) -> CameraDescription {
        if self.pose == self.start {
            return self.home;
        }
        // Far enough ahead that the direction survives the rounding of eye + direction.
        let reach = self.speed.max(self.pose.eye.length()).min(1e30);
        CameraDescription {
            eye: self.pose.eye.as_vec3(),
            look_at: (self.pose.eye + self.forward() * reach).as_vec3(),
            up: self.up.as_vec3(),
            fov: self.pose.fov as f32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn controls() -> Controls {
        let home = CameraDescription { look_at: Vec3::new(0.0, 0.5, 1.0), ..CameraDescription::default() };
        Controls::new(&home)
    }

    fn all_moves() -> [Moves; 7] {
        let none = Moves::default();
        [
            Moves { forward: 1.0, ..none },
            Moves { right: -1.0, fast: true, ..none },
            Moves { up: 1.0, ..none },
            Moves { turn: 1.0, ..none },
            Moves { tilt: -1.0, ..none },
            Moves { widen: 1.0, ..none },
            Moves { widen: -1.0, forward: 1.0, ..none },
        ]
    }

    #[test]
    fn ten_short_steps_are_one_long_one() {
        for moves in all_moves() {
            let (mut short, mut long) = (controls(), controls());
            (0..10).for_each(|_| short.step(&moves, 0.01));
            long.step(&moves, 0.1);
            let (short, long, start) = (short.camera(), long.camera(), controls().camera());
            assert_ne!(long, start, "{moves:?}");
            assert!(short.eye.distance(long.eye) < 1e-5 && short.look_at.distance(long.look_at) < 1e-5, "{moves:?}");
            assert!((short.fov - long.fov).abs() < 1e-4, "{moves:?}");
        }
    }

    #[test]
    fn directions_are_what_they_say() {
        let home = CameraDescription::default(); // towards −z
        let after = |moves: Moves| {
            let mut controls = Controls::new(&home);
            controls.step(&moves, 0.1);
            controls.camera()
        };
        let none = Moves::default();
        let near = |a: Vec3, b: Vec3| assert!(a.distance(b) < 1e-5, "{a} {b}");
        near(after(Moves { forward: 1.0, ..none }).eye, home.eye + Vec3::new(0.0, 0.0, -0.5));
        near(after(Moves { right: 1.0, ..none }).eye, home.eye + Vec3::new(0.5, 0.0, 0.0));
        near(after(Moves { up: -1.0, ..none }).eye, home.eye + Vec3::new(0.0, -0.5, 0.0));
        near(after(Moves { up: 1.0, fast: true, ..none }).eye, home.eye + Vec3::new(0.0, 2.0, 0.0));
        assert!(after(Moves { turn: 1.0, ..none }).look_at.x > 0.1);
        assert!(after(Moves { tilt: 1.0, ..none }).look_at.y > home.look_at.y + 0.1);
        assert!(after(Moves { widen: 1.0, ..none }).fov > home.fov);
    }

    #[test]
    fn a_reset_restores_the_bits() {
        let mut controls = controls();
        let home = controls.camera();
        all_moves().iter().for_each(|moves| controls.step(moves, 0.3));
        controls.drag(0.2, 0.3);
        assert_ne!(controls.camera(), home);
        controls.reset();
        assert_eq!(controls.camera(), home);
    }

    #[test]
    fn tilt_and_field_of_view_stay_within_limits() {
        for sign in [-1.0, 1.0] {
            let mut controls = controls();
            controls.step(&Moves { tilt: sign, widen: sign, ..Moves::default() }, 1000.0);
            let camera = controls.camera();
            let view = (camera.look_at - camera.eye).normalize();
            assert!(view.cross(camera.up).length() > 0.01 && view.y * sign as f32 > 0.99);
            assert_eq!(f64::from(camera.fov), if sign < 0.0 { FOV.0 } else { FOV.1 });
        }
    }

    #[test]
    fn a_field_of_view_beyond_the_limits_stays_until_changed() {
        let mut controls = Controls::new(&CameraDescription { fov: 2.0, ..CameraDescription::default() });
        controls.step(&Moves { forward: 1.0, ..Moves::default() }, 0.1);
        assert_eq!(controls.camera().fov, 2.0);
    }

    #[test]
    fn small_steps_count_far_from_the_origin() {
        let eye = Vec3::new(1e6, 0.0, 0.0);
        let home = CameraDescription { eye, look_at: eye + Vec3::X, ..CameraDescription::default() };
        let mut controls = Controls::new(&home);
        (0..10_000).for_each(|_| controls.step(&Moves { up: 1.0, forward: 1.0, ..Moves::default() }, 1e-3));
        let moved = controls.camera().eye - eye;
        assert!((moved - Vec3::new(10.0, 10.0, 0.0)).length() < 0.1, "{moved}");
    }

    #[test]
    fn odd_cameras_do_not_break_it() {
        for (look_at, up) in [(Vec3::new(0.0, 1.0, 5.0), Vec3::Y), (Vec3::NEG_Z, Vec3::ZERO), (Vec3::MAX, Vec3::X)] {
            let mut controls = Controls::new(&CameraDescription { look_at, up, ..CameraDescription::default() });
            all_moves().iter().for_each(|moves| controls.step(moves, 0.1));
            let camera = controls.camera();
            assert!(camera.eye.is_finite() && camera.look_at.is_finite() && camera.up.is_finite());
        }
    }
}
