//! The horizontal plane of the slice, and the pieces that it cuts out of primitives, in (x, z).

use glam::{DVec2, DVec3, Vec3, Vec3Swizzles};

/// A piece of what a horizontal plane cuts out of a primitive, in (x, z).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cut {
    /// Out of a sphere, or of the side of a body that stands upright.
    Circle {
        /// Its middle.
        center: DVec2,
        /// Not negative.
        radius: f64,
    },
    /// Out of a plane: an endless line.
    Line {
        /// One of its points.
        point: DVec2,
        /// Of any length but zero.
        direction: DVec2,
    },
    /// Out of something flat, or a piece of a curve.
    Segment(DVec2, DVec2),
}

impl Cut {
    /// Whether it holds nothing but numbers.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Circle { center, radius } => center.is_finite() && radius.is_finite(),
            Self::Line { point, direction } => point.is_finite() && direction.is_finite(),
            Self::Segment(from, to) => from.is_finite() && to.is_finite(),
        }
    }
}

/// The part of a horizontal plane that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// The plane's height.
    pub y: f64,
    /// The middle of what is seen, in (x, z).
    pub center: DVec2,
    /// All that is seen is no further from there.
    pub radius: f64,
    /// The size of a pixel in the world: outlines are right to a quarter of it.
    pub pixel: f64,
}

impl Section {
    /// Whether a ball comes to the part that is seen.
    pub fn meets(&self, center: DVec3, radius: f64) -> bool {
        (center.y - self.y).abs() <= radius && center.xz().distance(self.center) <= radius + self.radius
    }

    /// Into how many pieces to divide half an ellipse, evenly by its angle, whose greater semi-axis is `size` or which
    /// shows no more of it: the middles of their chords are size (1 − cos(π / 2n)) ≈ size π² / 8n² off.
    pub fn pieces(&self, size: f64) -> u32 {
        let pixels = size.min(self.radius) / self.pixel;
        // Down to at least an octagon; a pane of 16384² pixels needs no more than 239. NaN becomes 0.
        ((std::f64::consts::PI * (pixels / 2.0).sqrt()).ceil() as u32).clamp(4, 256)
    }
}

/// The point of the slice below or above a point of the world: its x and z.
pub fn flat(point: Vec3) -> DVec2 {
    point.as_dvec3().xz()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_follow_the_pixels() {
        let seen = Section { y: 0.0, center: DVec2::ZERO, radius: 15.0, pixel: 0.01 };
        for pixels in [1.0, 10.0, 1000.0, 11_000.0] {
            let n = f64::from(seen.pieces(pixels * seen.pixel));
            assert!(pixels.min(1500.0) * (1.0 - (std::f64::consts::FRAC_PI_2 / n).cos()) <= 0.25);
        }
        assert_eq!(Section { pixel: f64::NAN, ..seen }.pieces(1.0), 4);
        assert_eq!(Section { radius: f64::MAX, ..seen }.pieces(f64::MAX), 256);
    }
}
