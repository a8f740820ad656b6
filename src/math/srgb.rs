//! The sRGB curve, from bytes to light.

use std::sync::LazyLock;

/// By byte.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| std::array::from_fn(|byte| linear(byte as f64 / 255.0) as f32));

/// The linear light of every byte on the sRGB curve (IEC 61966-2-1), each rounded from `f64`.
pub fn linear_of_bytes() -> &'static [f32; 256] {
    &LINEAR
}

fn linear(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_rises_from_black_to_white() {
        let table = linear_of_bytes();
        assert_eq!((table[0], table[255]), (0.0, 1.0));
        assert!(table.is_sorted_by(|a, b| a < b));
        // Where the straight part ends, and a middle grey, as the standard's formula gives them.
        let near = |byte: usize, light: f32| assert!((table[byte] - light).abs() < 1e-7, "{byte}: {}", table[byte]);
        near(10, 0.003_035_27);
        near(11, 0.003_346_536);
        near(128, 0.215_860_5);
        near(188, 0.502_886_5);
    }
}
