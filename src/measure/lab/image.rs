//! How much two pictures differ, as they are displayed.

use crate::render::{Film, tone_map};

/// The difference between two pictures on the sRGB curve, cut off at black and white.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// The share of pixels of which a channel differs by more than 1/255, 0 to 1.
    pub off: f64,
    /// The root of the mean square difference over all channels, in 1/255.
    pub rms: f64,
}

/// The difference between pictures of one size, 8 bits a channel as displayed.
pub fn difference(a: &Film, b: &Film) -> Difference {
    let (mut off, mut squares, mut pixels) = (0usize, 0u64, 0usize);
    for (a, b) in a.pixels.iter().zip(&b.pixels) {
        let [a, b] = [a, b].map(|rgb| tone_map(*rgb).to_le_bytes());
        let apart = [0, 1, 2].map(|i| u64::from(a[i].abs_diff(b[i])));
        off += usize::from(apart.iter().any(|&d| d > 1));
        squares += apart.iter().map(|d| d * d).sum::<u64>();
        pixels += 1;
    }
    let pixels = pixels.max(1) as f64;
    Difference { off: off as f64 / pixels, rms: (squares as f64 / (3.0 * pixels)).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_known_pictures() {
        let mut a = Film::new(2, 2);
        let mut b = a.clone();
        assert_eq!(difference(&a, &b), Difference::default());
        // Black and white differ by 255 in all channels; what is brighter than white is white.
        (a.pixels[0], b.pixels[0]) = ([0.0; 3], [1.0; 3]);
        (a.pixels[1], b.pixels[1]) = ([1.0; 3], [7.0; 3]);
        assert_eq!(difference(&a, &b), Difference { off: 0.25, rms: 127.5 });
        // One step of one channel is not off.
        b.pixels[0] = [0.0, 0.0, 1.0 / 3294.6];
        assert_eq!(difference(&a, &b).off, 0.0);
        assert!((difference(&a, &b).rms - (1.0f64 / 12.0).sqrt()).abs() < 1e-12);
    }
}
