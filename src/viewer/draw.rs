//! Pictures and the few shapes the slice needs: clipped lines, circles, dots.
//!
//! Coordinates are `f64` pixels from the top left corner; pixel (i, j) covers [i, i + 1) × [j, j + 1). Shapes may lie
//! anywhere, however far or large: everything is cut to the picture before a loop runs over it, so that the cost of a
//! shape is bounded by the picture's size. A shape with a coordinate that is not finite is left out.

use glam::DVec2;

/// A picture of 0RGB pixels, row by row from the top. Either side may be 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// `width × height` pixels.
    pub pixels: Vec<u32>,
}

impl Picture {
    /// A black picture.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![0; width * height] }
    }

    /// Gives the picture another size, keeping its memory; what it shows afterwards is not defined.
    pub fn resize(&mut self, width: usize, height: usize) {
        self.pixels.resize(width * height, 0);
        (self.width, self.height) = (width, height);
    }

    /// One colour everywhere.
    pub fn fill(&mut self, color: u32) {
        self.pixels.fill(color);
    }

    /// The pixel at column `x` and row `y`, None outside.
    pub fn get_mut(&mut self, x: i64, y: i64) -> Option<&mut u32> {
        let inside = (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y);
        if inside { self.pixels.get_mut(y as usize * self.width + x as usize) } else { None }
    }

    /// Sets the pixel that covers a point.
    pub fn plot(&mut self, x: f64, y: f64, color: u32) {
        // A conversion to an integer saturates and takes NaN to 0, so NaN has to be left out here.
        if x.is_nan() || y.is_nan() {
            return;
        }
        if let Some(pixel) = self.get_mut(x.floor() as i64, y.floor() as i64) {
            *pixel = color;
        }
    }

    /// The points `origin + t · direction` with t in `span`, whose ends may be infinite: a segment, a ray or a line.
    pub fn line(&mut self, origin: DVec2, direction: DVec2, span: (f64, f64), color: u32) {
        let size = DVec2::new(self.width as f64, self.height as f64);
        let Some((from, to)) = clip(origin, direction, span, size) else { return };
        // One pixel for each step along the longer axis leaves no gap.
        let steps = (to - from).abs().max_element().ceil().max(1.0);
        let step = (to - from) / steps;
        for i in 0..=steps as u64 {
            let point = from + step * i as f64;
            self.plot(point.x, point.y, color);
        }
    }

    /// The segment between two points.
    pub fn segment(&mut self, from: DVec2, to: DVec2, color: u32) {
        self.line(from, to - from, (0.0, 1.0), color);
    }

    /// A circle's outline; one that is smaller than a pixel is a single pixel.
    pub fn circle(&mut self, center: DVec2, radius: f64, color: u32) {
        if !center.is_finite() || !radius.is_finite() || radius < 0.0 {
            return;
        }
        self.plot_arcs(center.x, radius, self.width, |picture, x, offset| {
            picture.plot(x, center.y - offset, color);
            picture.plot(x, center.y + offset, color);
        });
        self.plot_arcs(center.y, radius, self.height, |picture, y, offset| {
            picture.plot(center.x - offset, y, color);
            picture.plot(center.x + offset, y, color);
        });
        if radius < 1.0 {
            self.plot(center.x, center.y, color);
        }
    }

    /// The arcs of a circle that run mostly along one axis: where they cross each pixel's middle on that axis, as
    /// (middle, distance from the centre along the other axis). Beyond radius / √2 the other axis' turn is denser.
    fn plot_arcs(&mut self, center: f64, radius: f64, size: usize, mut plot: impl FnMut(&mut Self, f64, f64)) {
        let reach = radius * std::f64::consts::FRAC_1_SQRT_2 + 1.0;
        let first = (center - reach).floor().max(0.0);
        let last = (center + reach).ceil().min(size as f64);
        let mut middle = first + 0.5;
        while middle < last {
            let along = (middle - center).abs();
            if along <= radius {
                // As a product, since r² − a² loses everything for a huge circle whose edge passes through.
                plot(self, middle, ((radius - along) * (radius + along)).sqrt());
            }
            middle += 1.0;
        }
    }

    /// A filled square of `2 · reach + 1` pixels around a point.
    pub fn dot(&mut self, center: DVec2, reach: i64, color: u32) {
        if !center.is_finite() {
            return;
        }
        for y in -reach..=reach {
            for x in -reach..=reach {
                self.plot(center.x + x as f64, center.y + y as f64, color);
            }
        }
    }

    /// Fills the `width` columns from `left` on with `source`, stretched to them; the nearest pixel is taken.
    pub fn paste(&mut self, source: &Picture, left: usize, width: usize) {
        let width = width.min(self.width.saturating_sub(left));
        if source.width == 0 || source.height == 0 || width == 0 {
            return;
        }
        for y in 0..self.height {
            let row = &source.pixels[y * source.height / self.height * source.width..][..source.width];
            let target = &mut self.pixels[y * self.width + left..][..width];
            if source.width == width {
                target.copy_from_slice(row);
            } else {
                for (x, pixel) in target.iter_mut().enumerate() {
                    *pixel = row[x * source.width / width];
                }
            }
        }
    }
}

/// The part of `origin + t · direction`, t in `span`, that lies in the rectangle from 0 to `size`, ends included.
///
/// Liang and Barsky 1984: each axis narrows the span of t. None when nothing is left, or for input that is not finite
/// (the span may be infinite).
pub fn clip(origin: DVec2, direction: DVec2, span: (f64, f64), size: DVec2) -> Option<(DVec2, DVec2)> {
    if !origin.is_finite() || !direction.is_finite() {
        return None;
    }
    let (mut start, mut end) = span;
    for axis in 0..2 {
        if direction[axis] == 0.0 {
            if !(0.0..=size[axis]).contains(&origin[axis]) {
                return None;
            }
            continue;
        }
        let low = -origin[axis] / direction[axis];
        let high = (size[axis] - origin[axis]) / direction[axis];
        start = start.max(low.min(high));
        end = end.min(low.max(high));
    }
    let (from, to) = (origin + direction * start, origin + direction * end);
    if start <= end && from.is_finite() && to.is_finite() {
        // Rounding may leave an end a little outside, or far outside when the origin is far away.
        Some((from.clamp(DVec2::ZERO, size), to.clamp(DVec2::ZERO, size)))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const SIZE: DVec2 = DVec2::new(100.0, 50.0);
    const EVERYWHERE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

    fn lit(picture: &Picture) -> usize {
        picture.pixels.iter().filter(|&&pixel| pixel != 0).count()
    }

    #[test]
    fn clip_keeps_what_is_inside() {
        let clipped = clip(DVec2::new(10.0, 10.0), DVec2::new(20.0, 5.0), (0.0, 1.0), SIZE);
        assert_eq!(clipped, Some((DVec2::new(10.0, 10.0), DVec2::new(30.0, 15.0))));
    }

    #[test]
    fn clip_cuts_segments_rays_and_lines() {
        let (middle, right) = (DVec2::new(50.0, 25.0), DVec2::X);
        assert_eq!(clip(middle, right * 1e9, (0.0, 1.0), SIZE), Some((middle, DVec2::new(100.0, 25.0))));
        assert_eq!(clip(middle, right, (0.0, f64::INFINITY), SIZE), Some((middle, DVec2::new(100.0, 25.0))));
        assert_eq!(clip(middle, right, EVERYWHERE, SIZE), Some((DVec2::new(0.0, 25.0), DVec2::new(100.0, 25.0))));
        assert_eq!(clip(DVec2::new(-5.0, 25.0), -right, (0.0, f64::INFINITY), SIZE), None);
        assert_eq!(clip(DVec2::new(50.0, 51.0), right, EVERYWHERE, SIZE), None);
        assert_eq!(clip(DVec2::new(-10.0, 45.0), DVec2::new(20.0, 20.0), (0.0, 1.0), SIZE), None);
    }

    #[test]
    fn clip_survives_extremes() {
        let extremes = [0.0, -0.0, 1e-320, 1.0, -1.0, 1e300, -1e300, f64::MAX, f64::INFINITY, f64::NAN];
        for x in extremes {
            for y in extremes {
                for span in [(0.0, 1.0), (0.0, f64::INFINITY), EVERYWHERE] {
                    for point in [DVec2::new(3.0, 4.0), DVec2::new(y, x)] {
                        if let Some((from, to)) = clip(point, DVec2::new(x, y), span, SIZE) {
                            for end in [from, to] {
                                assert!(end.cmpge(DVec2::ZERO).all() && end.cmple(SIZE).all(), "{point} {x} {y}");
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_line_has_no_gaps() {
        let mut picture = Picture::new(100, 50);
        picture.line(DVec2::new(-1e6, -0.5e6), DVec2::new(2.0, 1.0), (0.0, f64::INFINITY), 1);
        for x in 0..100 {
            assert!((0..50).any(|y| picture.pixels[y * 100 + x] == 1), "column {x}");
        }
    }

    #[test]
    fn a_circle_passes_through_its_points() {
        let mut picture = Picture::new(60, 60);
        let center = DVec2::new(30.2, 29.7);
        picture.circle(center, 20.0, 1);
        for i in 0..200 {
            let point = center + DVec2::from_angle(TAU * i as f64 / 200.0) * 20.0;
            let near = (-1..=1).any(|dy| {
                (-1..=1).any(|dx| picture.get_mut(point.x as i64 + dx, point.y as i64 + dy).copied() == Some(1))
            });
            assert!(near, "{point}");
        }
        for y in 0..60 {
            for x in 0..60 {
                let distance = DVec2::new(x as f64 + 0.5, y as f64 + 0.5).distance(center);
                assert!(picture.pixels[y * 60 + x] == 0 || (distance - 20.0).abs() < 1.5);
            }
        }
    }

    #[test]
    fn a_huge_circle_is_its_tangent() {
        let mut picture = Picture::new(40, 40);
        picture.circle(DVec2::new(20.0, 1e9 + 10.5), 1e9, 1);
        assert_eq!(lit(&picture), 40);
        assert!(picture.pixels[10 * 40..11 * 40].iter().all(|&pixel| pixel == 1));
    }

    #[test]
    fn a_tiny_circle_is_a_pixel() {
        let mut picture = Picture::new(40, 40);
        picture.circle(DVec2::new(20.5, 10.5), 1e-9, 1);
        assert_eq!(lit(&picture), 1);
    }

    #[test]
    fn nothing_panics_on_an_empty_picture_or_wild_input() {
        for (width, height) in [(0, 0), (0, 5), (5, 0), (1, 1), (7, 3)] {
            let mut picture = Picture::new(width, height);
            for value in [0.0, 0.5, -1e30, 1e300, f64::INFINITY, f64::NAN] {
                let point = DVec2::new(value, 1.0);
                picture.plot(value, value, 1);
                picture.dot(point, 2, 1);
                picture.circle(point, value.abs(), 1);
                picture.circle(DVec2::ZERO, value, 1);
                picture.line(point, DVec2::new(1.0, value), EVERYWHERE, 1);
                picture.segment(DVec2::ZERO, point, 1);
            }
            picture.paste(&Picture::new(3, 3), 0, width);
            picture.paste(&Picture::default(), 0, width);
            Picture::new(4, 4).paste(&picture, 1, 9);
        }
    }

    #[test]
    fn paste_stretches() {
        let source = Picture { width: 2, height: 1, pixels: vec![1, 2] };
        let mut picture = Picture::new(5, 2);
        picture.paste(&source, 1, 4);
        assert_eq!(picture.pixels, [0, 1, 1, 2, 2, 0, 1, 1, 2, 2]);
    }
}
