//! Roots by Newton's method from the side it cannot overshoot.

use super::{LaneMask, Lanes};

/// The most steps of a search.
///
/// Every step of Newton's method on a convex function divides value · slope by 4 or more, as
/// f(x₁) / f(x₀) + f′(x₁) / f′(x₀) ≤ 1. From 1 that is 2⁻⁹⁶ after so many, whose root is 2⁻⁴⁸: the value or the slope
/// is far below ε.
const MAX_STEPS: usize = 48;

/// A function's value and derivative at one place, the latter as a quotient, so that a step divides but once.
#[derive(Clone, Copy, Debug)]
pub struct Sample<L> {
    /// f.
    pub value: L,
    /// f′ · `run`.
    pub rise: L,
    /// Above zero.
    pub run: L,
    /// How far from here f may be taken for a parabola.
    pub near: L,
}

/// A stretch in which a function is convex or concave.
#[derive(Clone, Copy, Debug)]
pub struct Stretch<L: Lanes> {
    /// Where it begins.
    pub left: L,
    /// Where it ends.
    pub right: L,
    /// Lanes in which the function is convex; it is concave in the others.
    pub convex: L::Mask,
}

/// The first root in a stretch at whose left end the function is above zero, and the lanes of `live` that have one.
///
/// Fourier's condition, f f″ ≥ 0, makes Newton's method monotone: from the left end where the function is convex, as a
/// tangent lies below it and meets zero before it does; from the right end where it is concave, if the function is not
/// above zero there, as it then falls through zero once and its tangents lie above it. So a convex function has no
/// root left as soon as it rises, or the tangent leaves the stretch, and what is found is the first root, double or
/// not.
///
/// Once a step is at most [`Sample::near`], two more are to the root of the parabola with the function's value, slope
/// and `curvature` there, or to none where that stays above zero. So one rounded value decides where or whether a
/// function that nearly touches zero has its root, as with the discriminant of a quadratic. The root is off by the
/// rounding of that value, and the parabola's error, up to |f‴| (2 near)³ / 6, over the slope. A lane's result does not
/// depend on the other lanes.
#[inline(always)]
pub fn first_root<L: Lanes>(
    f: impl Fn(L) -> Sample<L>,
    curvature: impl Fn(L) -> L,
    stretch: &Stretch<L>,
    live: L::Mask,
) -> (L, L::Mask) {
    let Stretch { left, right, convex } = *stretch;
    let zero = L::zero();
    let mut x = left.select(convex, right);
    let mut at = f(x);
    let below = live & at.value.le(zero);
    // A convex function that is not above zero at the left end is zero there, but for rounding.
    let mut found = below & convex;
    let mut active = live & ((convex & at.value.gt(zero) & at.rise.lt(zero)) | (!convex & below));
    for _ in 0..MAX_STEPS {
        let step = -(at.value * at.run) / at.rise;
        // Rising at its right end a concave function is zero there, but for rounding.
        let close = active & (step.abs().le(at.near) | at.rise.ge(zero));
        found = found | close;
        let next = (x + step).max(left);
        active = active & !close & (!convex | next.lt(right));
        if !active.any() {
            break;
        }
        x = next.select(active, x);
        at = f(x);
        let crossed = active & ((convex & at.value.le(zero)) | (!convex & at.value.ge(zero)));
        found = found | crossed;
        active = active & !crossed & (!convex | at.rise.lt(zero));
    }
    let live = found | active;
    // Twice, as the first parabola may be touched as much as 2 near away, where its vertex is off by 2 near² f‴ / f″.
    let (x, _) = to_parabola(x, &at, curvature(x), stretch);
    let (x, touched) = to_parabola(x, &f(x), curvature(x), stretch);
    (x, live & touched & x.le(right))
}

/// From `x` to the root of the parabola with the value, slope and curvature there, the first where it is convex; to its
/// vertex, and false, where it has none.
#[inline(always)]
fn to_parabola<L: Lanes>(x: L, at: &Sample<L>, curvature: L, stretch: &Stretch<L>) -> (L, L::Mask) {
    let zero = L::zero();
    let slope = at.rise / at.run;
    let discriminant = slope.mul_add(slope, at.value * curvature * L::splat(-2.0));
    let root = discriminant.max(zero).sqrt();
    let ahead = (at.value + at.value) / (root - slope);
    // Beyond the vertex of a convex one; nothing to gain where a concave one has no slope.
    let back = ((-(slope + root)) / curvature).max(-at.near).select(stretch.convex, zero);
    let step = ahead.select(slope.lt(zero), back);
    ((x + step).max(stretch.left), !stretch.convex | discriminant.ge(zero))
}

#[cfg(test)]
mod tests {
    use super::*;
    use wide::{f32x4, f32x8};

    /// The first root of the quadratic a x² + b x + c between −1 and 1.
    fn quadratic<L: Lanes>(a: L, b: L, c: L) -> (L, L::Mask) {
        let f = |x: L| Sample {
            value: a.mul_add(x, b).mul_add(x, c),
            rise: (a + a).mul_add(x, b),
            run: L::splat(1.0),
            near: L::splat(1e-3),
        };
        let one = L::splat(1.0);
        let stretch = Stretch { left: -one, right: one, convex: a.ge(L::zero()) };
        first_root(f, |_| a + a, &stretch, f(-one).value.gt(L::zero()))
    }

    fn root(a: f32, b: f32, c: f32) -> Option<f32> {
        let (x, found) = quadratic(a, b, c);
        found.then_some(x)
    }

    #[test]
    fn convex_and_concave() {
        let close = |x: Option<f32>, y: f32| assert!(x.is_some_and(|x| (x - y).abs() < 1e-6), "{x:?} {y}");
        close(root(1.0, 0.0, -0.25), -0.5);
        close(root(-1.0, -1.0, 0.75), 0.5);
        close(root(0.0, -1.0, 0.25), 0.25);
        close(root(1e-6, -1.0, 0.25), 0.25);
        assert_eq!(root(1.0, 0.0, 0.25), None, "no root");
        assert_eq!(root(1.0, -3.0, 2.25), None, "beyond the right end");
        assert_eq!(root(-1.0, 0.0, 1.5), None, "concave and above zero at both ends");
        close(root(-1.0, -1.0, 2.0), 1.0);
        assert_eq!(root(f32::NAN, 0.0, -0.25), None);
    }

    #[test]
    fn double_roots_and_their_neighbours() {
        for i in 0..1000 {
            let at = i as f32 / 1000.0 - 0.5;
            // (x − at)² with a rounded last coefficient: the root is double but for ε.
            let double = root(1.0, -2.0 * at, at * at - 1e-7);
            assert!(double.is_some_and(|x| (x - at).abs() < 1e-3), "{at}: {double:?}");
            assert_eq!(root(1.0, -2.0 * at, at * at + 1e-6), None, "{at}");
        }
    }

    #[test]
    fn lanes_do_not_depend_on_each_other() {
        let coefficient = |i: usize, k: usize| match (i * 7 + k * 3) % 11 {
            0 => f32::NAN,
            n => n as f32 * 0.3 - 1.4,
        };
        let column = |k: usize| (0..64).map(|i| coefficient(i, k)).collect::<Vec<_>>();
        let ([a, c], b) = ([column(0), column(2)], column(1).iter().map(|b| b - 1.0).collect::<Vec<_>>());
        fn bits<L: Lanes>(a: &[f32], b: &[f32], c: &[f32]) -> Vec<u32> {
            let mut out = Vec::new();
            for at in (0..a.len()).step_by(L::WIDTH) {
                let (x, found) = quadratic(L::load(&a[at..]), L::load(&b[at..]), L::load(&c[at..]));
                let mut lanes = vec![0.0; L::WIDTH];
                x.select(found, L::splat(9.0)).store(&mut lanes);
                out.extend(lanes.iter().map(|x| x.to_bits()));
            }
            out
        }
        let one = bits::<f32>(&a, &b, &c);
        assert_eq!(one, bits::<f32x4>(&a, &b, &c));
        assert_eq!(one, bits::<f32x8>(&a, &b, &c));
        assert!(one.iter().filter(|x| **x != 9.0f32.to_bits()).count() > 10);
    }
}
