//! How large a tree's blocks are ([`Bvh::grain`](super::Bvh::grain)).

use super::aabb::Aabb;

/// The sums of the squares and the cubes of the blocks' sizes, but for the largest blocks.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Grain {
    squares: f64,
    cubes: f64,
}

impl Grain {
    /// Counts a block in.
    pub fn add(&mut self, block: Aabb, whole: Aabb) {
        let size = self::size(block);
        if size * 8.0 <= self::size(whole) {
            self.squares += size * size;
            self.cubes += size * size * size;
        }
    }

    /// The grain of the whole.
    pub fn of(self, whole: Aabb) -> f32 {
        if self.squares == 0.0 {
            // All are large.
            return (whole.max - whole.min).max_element() / 8.0;
        }
        (self.cubes / self.squares) as f32
    }
}

/// A box's largest extent, or the edge of a square of half its area if that is less: what is long and thin is met by as
/// few rays as a smaller square.
fn size(bounds: Aabb) -> f64 {
    bounds.area_f64().sqrt().min(f64::from((bounds.max - bounds.min).max_element()))
}
