//! Numbers, roots and polynomials by themselves.
use super::super::exact::Exact;
use super::super::polynomial::Sturm;
use super::super::root::Root;
use super::super::turn;
use super::*;

fn exact(x: f64) -> Exact {
    Exact::from_f64(x).expect("a finite number")
}

#[test]
fn floats_are_taken_and_given_back_as_they_are() {
    let mut random = Random(1);
    let chosen = [0.0, 1.0, -1.5, f64::MIN_POSITIVE, 5e-324, f64::MAX, f64::from(f32::MIN_POSITIVE), 1.0 / 3.0];
    let drawn = (0..1000).map(|_| f64::from(random.next()) * 10f64.powf(300.0 * f64::from(random.next())));
    for x in chosen.into_iter().chain(drawn) {
        assert_eq!(exact(x).to_f64(), x);
    }
    assert!([f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().all(|x| Exact::from_f64(x).is_none()));
}

#[test]
fn rounding_is_to_the_nearest_and_to_even() {
    let (one, ulp) = (exact(1.0), exact(f64::EPSILON));
    let tiny = exact(1e-200);
    let half = ulp.scaled(-1);
    assert_eq!((&one + &half).to_f64(), 1.0);
    assert_eq!((&one + &half + &tiny).to_f64(), 1.0 + f64::EPSILON);
    assert_eq!((&one + &ulp + &half).to_f64(), 1.0 + 2.0 * f64::EPSILON);
    assert_eq!((&one + &ulp + &half - &tiny).to_f64(), 1.0 + f64::EPSILON);
    assert_eq!((-(one + half + tiny)).to_f64(), -1.0 - f64::EPSILON);
}

/// Division and square root of f64 are correctly rounded: so must these be.
#[test]
fn quotients_and_roots_round_like_the_processor() {
    let mut random = Random(2);
    for _ in 0..2000 {
        let (a, b) = (f64::from(random.next()) * f64::from(random.next()), f64::from(random.next()) * 1e10 + 0.1);
        assert_eq!(exact(a).quotient(&exact(b)).to_f64(), a / b, "{a} / {b}");
        assert_eq!(exact(a.abs()).sqrt().to_f64(), a.abs().sqrt(), "√{a}");
    }
    assert_eq!(exact(-7.0).floor_quotient(&exact(2.0)), -4);
    assert_eq!(exact(1e300).floor_quotient(&exact(1e-300)), i64::MAX);
}

#[test]
fn sums_of_distant_numbers_lose_nothing() {
    let (great, small) = (exact(1e200), exact(1e-200));
    assert!(&great + &small > great && &great + &small - &great == small);
    assert_eq!((&great + &small) * (&great - &small), great.squared() - small.squared());
}

/// t² − 2 t − 1 has the roots 1 ± √2; their convergents come closer and closer to them, from both sides.
#[test]
fn roots_compare_exactly() {
    let roots = Root::quadratic(exact(1.0), exact(-1.0), &exact(-1.0));
    let [(less, falling), (greater, rising)] = &roots[..] else { panic!("two roots") };
    assert!(falling.is_lt() && rising.is_gt());
    // p / q to 1 + √2 by Pell's numbers, which are f64 up to the 40th.
    let (mut p, mut q) = (1.0, 0.0);
    for k in 0..40 {
        (p, q) = (2.0 * p + q, p);
        let expected = if k % 2 == 0 { Ordering::Greater } else { Ordering::Less };
        assert_eq!(greater.sign_of(&exact(-p), &exact(q)), expected, "1 + √2 to {p} / {q}");
        // The other is −1 / (1 + √2).
        assert_eq!(less.sign_of(&exact(q), &exact(p)), expected, "1 − √2 to −{q} / {p}");
    }
    assert_eq!(greater.value().to_f64(), 1.0 + 2f64.sqrt());
    assert_eq!(less.value().to_f64(), -0.414_213_562_373_095_05);
    let double = Root::quadratic(exact(-4.0), exact(6.0), &exact(-9.0));
    assert!(double.len() == 1 && double[0].0.cmp_number(&exact(1.5)).is_eq() && double[0].1.is_eq());
    assert!(Root::quadratic(exact(0.0), exact(0.0), &exact(1.0)).is_empty());
}

/// The lesser root of t² − 2⁴⁰⁰ t + 1 is 2⁻⁴⁰⁰ and a little: the textbook's formula would leave nothing of it.
#[test]
fn a_root_that_would_cancel_does_not() {
    let b = exact(-1.0).scaled(399);
    let (small, _) = Root::quadratic(exact(1.0), b, &exact(1.0)).swap_remove(0);
    assert_eq!(small.value().scaled(400).to_f64(), 1.0);
}

fn polynomial(roots: &[f64]) -> Vec<Exact> {
    roots.iter().fold(vec![exact(3.0)], |p, root| {
        let shifted = std::iter::once(Exact::ZERO).chain(p.iter().cloned());
        let scaled = p.iter().map(|c| c * exact(-root)).chain([Exact::ZERO]);
        shifted.zip(scaled).map(|(a, b)| a + b).collect()
    })
}

#[test]
fn polynomials_are_counted_and_their_roots_found_in_order() {
    let close = 1.0 + f64::EPSILON;
    for roots in [vec![-1.0, 0.5, 2.0, 3.0], vec![1.0, 1.0, 2.0, 2.0], vec![0.0; 4], vec![1.0, close, 7.0, 7.0]] {
        let sturm = Sturm::new(&polynomial(&roots)).expect("not constant");
        let mut distinct = roots.clone();
        distinct.dedup();
        let bound = sturm.bound();
        assert_eq!(sturm.count(&-&bound, &bound), distinct.len(), "{roots:?}");
        let mut low = -&bound;
        for root in distinct {
            let fine = |low: &Exact, high: &Exact| (high - low).magnitude() < -80;
            let found = sturm.first_root(low.clone(), bound.clone(), fine).expect("one more root");
            assert_eq!(found.to_f64(), root, "of {roots:?}");
            low = exact(root);
        }
        assert!(sturm.first_root(low, bound, |_, _| true).is_none(), "none after the last of {roots:?}");
    }
    // x⁴ + 1 and (x² + 1)² have none, a constant is nothing to ask.
    for p in [[1.0, 0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 2.0, 0.0, 1.0]] {
        let sturm = Sturm::new(&p.map(exact)).expect("not constant");
        assert_eq!(sturm.count(&exact(-1e9), &exact(1e9)), 0);
    }
    assert!(Sturm::new(&[exact(2.0), Exact::ZERO]).is_none() && Sturm::new(&[Exact::ZERO]).is_none());
}

/// To 2⁻³⁷⁰: by the algebraic values, by sin² + cos² = 1, and by the double angle.
#[test]
fn sines_and_cosines() {
    let small = |x: Exact| x.is_zero() || x.magnitude() < -370;
    let at = |degrees: f32| turn::sin_cos(degrees).expect("finite");
    for (degrees, sin, cos) in [(0.0, 0.0, 1.0), (90.0, 1.0, 0.0), (-90.0, -1.0, 0.0), (900.0, 0.0, -1.0)] {
        assert!(at(degrees) == (exact(sin), exact(cos)), "{degrees}");
    }
    assert!(small(at(30.0).0 - exact(0.5)) && small(at(-240.0).1 + exact(0.5)));
    assert!(small(at(45.0).0.squared() - exact(0.5)) && small(at(60.0).0.squared() - exact(0.75)));
    // cos 36° is half the golden ratio g, and g² = g + 1.
    let golden = at(36.0).1.scaled(1);
    assert!(small(golden.squared() - &golden - exact(1.0)));
    for degrees in [1e-3, 0.1, 17.25, 89.99999, 123.4, -77.7, 1234.5, -1e6, 1e-30] {
        let ((sin, cos), double) = (at(degrees), at(2.0 * degrees));
        assert!(small(sin.squared() + cos.squared() - exact(1.0)), "{degrees}");
        assert!(small((&sin * &cos).scaled(1) - &double.0) && small(cos.squared() - sin.squared() - double.1));
        let reduced = (f64::from(degrees) % 360.0).to_radians();
        assert!((sin.to_f64() - reduced.sin()).abs() < 1e-15 && (cos.to_f64() - reduced.cos()).abs() < 1e-15);
    }
    assert!(turn::sin_cos(f32::NAN).is_none());
}

/// x is turned first, then y, then z: y turned by 90° about x is z, which z leaves alone and y turns to x.
#[test]
fn the_order_of_turns() {
    let axes = turn::axes(vec3(90.0, 90.0, 0.0)).expect("finite");
    let y = axes[1].each_ref().map(Exact::to_f64);
    assert_eq!(y, [1.0, 0.0, 0.0]);
    let axes = turn::axes(vec3(0.0, 90.0, 90.0)).expect("finite");
    assert_eq!(axes[2].each_ref().map(Exact::to_f64), [0.0, 1.0, 0.0], "z is turned to x, and that to y");
}
