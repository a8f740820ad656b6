//! Roots of linear and quadratic equations, compared exactly.

use std::cmp::Ordering;

use super::exact::Exact;

/// (a + s √d) / c with s = −1, 0 or 1, d ≥ 0 and c > 0.
#[derive(Clone, Debug)]
pub struct Root {
    a: Exact,
    s: Ordering,
    d: Exact,
    c: Exact,
}

impl Root {
    /// `numerator` / `denominator`; `None` when that is 0.
    pub fn ratio(numerator: Exact, denominator: Exact) -> Option<Self> {
        let (a, c) = positive_denominator(numerator, denominator)?;
        Some(Self { a, s: Ordering::Equal, d: Exact::ZERO, c })
    }

    /// The real roots of a t² + 2 b t + c = 0, ascending, with the sign of the polynomial's slope there. A double root
    /// comes once, with slope 0. All numbers being roots is none.
    pub fn quadratic(a: Exact, b: Exact, c: &Exact) -> Vec<(Self, Ordering)> {
        if a.is_zero() {
            let slope = b.sign();
            return Self::ratio(-c, b.scaled(1)).map(|root| (root, slope)).into_iter().collect();
        }
        let d = b.squared() - &a * c;
        let opens = a.sign();
        let Some((middle, a)) = positive_denominator(-&b, a) else { return Vec::new() };
        let root = |s| Self { a: middle.clone(), s, d: d.clone(), c: a.clone() };
        match d.sign() {
            Ordering::Less => Vec::new(),
            Ordering::Equal => vec![(root(Ordering::Equal), Ordering::Equal)],
            Ordering::Greater => {
                vec![(root(Ordering::Less), opens.reverse()), (root(Ordering::Greater), opens)]
            }
        }
    }

    /// The sign of u + v t.
    pub fn sign_of(&self, u: &Exact, v: &Exact) -> Ordering {
        // (u c + v a) + v s √d over c.
        let rational = u * &self.c + v * &self.a;
        let (first, second) = (rational.sign(), product(v.sign(), self.s));
        if first == second || second.is_eq() {
            return first;
        }
        if first.is_eq() {
            return second;
        }
        // Unlike signs: the greater square wins.
        match rational.squared().cmp(&(v.squared() * &self.d)) {
            Ordering::Greater => first,
            Ordering::Equal => Ordering::Equal,
            Ordering::Less => second,
        }
    }

    /// Compares with a number.
    pub fn cmp_number(&self, x: &Exact) -> Ordering {
        self.sign_of(&-x, &Exact::integer(1))
    }

    /// Compares with a root that is a ratio.
    pub fn cmp_ratio(&self, ratio: &Self) -> Ordering {
        debug_assert!(ratio.s.is_eq());
        self.sign_of(&-&ratio.a, &ratio.c)
    }

    /// The root to [`super::exact::BITS`] bits and more, exact but for the last where it is a ratio.
    pub fn value(&self) -> Exact {
        let root = self.d.sqrt();
        let same = match self.s {
            Ordering::Equal => return self.a.quotient(&self.c),
            s => s == self.a.sign() || self.a.is_zero(),
        };
        let signed = |s: Ordering| if s.is_lt() { -&root } else { root.clone() };
        if same {
            return (&self.a + signed(self.s)).quotient(&self.c);
        }
        // (a² − d) / (a − s √d): the sum would cancel.
        (self.a.squared() - &self.d).quotient(&((&self.a - signed(self.s)) * &self.c))
    }
}

/// Turns the signs of a fraction so that its denominator is above 0; `None` when that is 0.
fn positive_denominator(numerator: Exact, denominator: Exact) -> Option<(Exact, Exact)> {
    match denominator.sign() {
        Ordering::Greater => Some((numerator, denominator)),
        Ordering::Less => Some((-&numerator, -&denominator)),
        Ordering::Equal => None,
    }
}

/// The sign of a product.
fn product(a: Ordering, b: Ordering) -> Ordering {
    match a {
        Ordering::Less => b.reverse(),
        Ordering::Equal => Ordering::Equal,
        Ordering::Greater => b,
    }
}

/// The open interval in which a hit counts; `None` is no bound.
#[derive(Clone, Debug)]
pub struct Span {
    pub low: Option<Exact>,
    pub high: Option<Exact>,
}

impl Span {
    pub fn contains(&self, root: &Root) -> bool {
        let above = self.low.as_ref().is_none_or(|low| root.cmp_number(low).is_gt());
        above && self.high.as_ref().is_none_or(|high| root.cmp_number(high).is_lt())
    }
}
