//! Rational numbers of another crate, and a count of roots that is not Sturm's.
use super::*;
use dashu_ratio::RBig;

pub type Rational3 = [RBig; 3];

pub fn rational(x: impl Into<f64>) -> RBig {
    RBig::try_from(x.into()).expect("a finite number")
}

pub fn rational3(v: Vec3) -> Rational3 {
    v.to_array().map(rational)
}

pub fn dot(a: &Rational3, b: &Rational3) -> RBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub fn cross(a: &Rational3, b: &Rational3) -> Rational3 {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &a[j] * &b[k] - &a[k] * &b[j]
    })
}

pub fn sub(a: &Rational3, b: &Rational3) -> Rational3 {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

/// origin + t direction.
pub fn at(ray: &Ray, t: &RBig) -> Rational3 {
    let (o, d) = (rational3(ray.origin), rational3(ray.direction));
    [0, 1, 2].map(|i| &o[i] + t * &d[i])
}

/// Half-way from a number to the next less and the next greater one: what rounds to it lies between.
pub fn rounds_to(t: f64) -> [RBig; 2] {
    [t.next_down(), t.next_up()].map(|other| (rational(t) + rational(other)) / RBig::from(2))
}

#[track_caller]
pub fn assert_rounded(t: f64, exact: &RBig) {
    let [low, high] = rounds_to(t);
    assert!(low <= *exact && *exact <= high, "{t} is not the nearest to {}", exact.to_f64().value());
}

/// The coefficients of the polynomial of a degree that a function is, by Newton's divided differences at 0, 1, 2 …
pub fn interpolated(f: impl Fn(&RBig) -> RBig, degree: usize) -> Vec<RBig> {
    let places = (0..=degree).map(RBig::from).collect::<Vec<_>>();
    let mut differences = places.iter().map(f).collect::<Vec<_>>();
    for order in 1..=degree {
        for i in (order..=degree).rev() {
            differences[i] = (&differences[i] - &differences[i - 1]) / (&places[i] - &places[i - order]);
        }
    }
    let mut polynomial = vec![RBig::ZERO; degree + 1];
    for i in (0..=degree).rev() {
        // polynomial · (x − i) + difference
        for power in (0..=degree).rev() {
            let below = if power > 0 { polynomial[power - 1].clone() } else { differences[i].clone() };
            polynomial[power] = below - &polynomial[power] * &places[i];
        }
    }
    polynomial
}

/// p(scale x + shift).
fn composed(p: &[RBig], scale: &RBig, shift: &RBig) -> Vec<RBig> {
    let mut result: Vec<RBig> = vec![RBig::ZERO; p.len()];
    for c in p.iter().rev() {
        for power in (0..p.len()).rev() {
            let below = if power > 0 { &result[power - 1] * scale } else { c.clone() };
            result[power] = below + &result[power] * shift;
        }
    }
    result
}

/// Whether a polynomial has no root in the open interval: Descartes' rule of signs for (1 + x)ⁿ p((low + high x) / (1 + x)),
/// which has as many above 0; where it is undecided, for the halves (Collins and Akritas 1976).
pub fn rootless(p: &[RBig], low: &RBig, high: &RBig) -> bool {
    fn halves(p: &[RBig], depth: u32) -> bool {
        let reversed = p.iter().rev().cloned().collect::<Vec<_>>();
        let signs = composed(&reversed, &RBig::ONE, &RBig::ONE);
        let signs = signs.iter().filter(|c| **c != RBig::ZERO).map(|c| *c > RBig::ZERO).collect::<Vec<_>>();
        let half = RBig::ONE / RBig::from(2);
        match signs.windows(2).filter(|pair| pair[0] != pair[1]).count() {
            0 => !signs.is_empty(),
            1 => false,
            _ if depth == 0 => false,
            _ => {
                let (left, right) = (composed(p, &half, &RBig::ZERO), composed(p, &half, &half));
                right[0] != RBig::ZERO && halves(&left, depth - 1) && halves(&right, depth - 1)
            }
        }
    }
    low >= high || halves(&composed(p, &(high - low), low), 80)
}

#[test]
fn roots_are_seen_where_they_are() {
    // (x − 1) (x − 2)² (x − 5)
    let f = |x: &RBig| {
        let from = |root: u32| x - RBig::from(root);
        from(1) * from(2) * from(2) * from(5)
    };
    let p = interpolated(f, 4);
    assert_eq!(p, [20, -44, 33, -10, 1].map(RBig::from));
    let free = |low: f64, high: f64| rootless(&p, &rational(low), &rational(high));
    assert!(free(-9.0, 1.0) && free(1.0, 2.0) && free(2.0, 5.0) && free(5.0, 1e9) && free(1.0, 1.99999));
    assert!(!free(0.9, 1.1) && !free(1.9, 2.1) && !free(1.5, 9.0) && !free(0.0, 9.0) && !free(4.0, 5.1));
}
