//! Real roots of polynomials: counted by Sturm's theorem, told apart and bisected, all in whole numbers.
//!
//! Sturm (1829): with p₀ = p, p₁ = p′, pₖ₊₁ = −(pₖ₋₁ mod pₖ), a polynomial without double roots has as many roots in
//! (a, b] as the chain has fewer changes of sign at b than at a. A double root is made a single one beforehand by
//! dividing by the greatest common divisor of p and p′, which is the last of the chain. The remainders are
//! pseudo-remainders (Knuth, *The Art of Computer Programming* vol. 2, §4.6.1), freed of their content.

use std::cmp::Ordering;

use dashu_int::ops::{Abs, BitTest, Gcd};
use dashu_int::{IBig, UBig};

use super::exact::Exact;

/// Coefficients, the constant term first, the last not 0; no coefficients for the zero polynomial.
type Polynomial = Vec<IBig>;

/// A polynomial without double roots, with its Sturm chain.
#[derive(Clone, Debug)]
pub struct Sturm {
    chain: Vec<Polynomial>,
}

impl Sturm {
    /// For the distinct roots of a polynomial, the constant term first; `None` when it is constant.
    pub fn new(coefficients: &[Exact]) -> Option<Self> {
        let terms = coefficients.iter().filter(|c| !c.is_zero());
        let exponent = terms.map(Exact::exponent).min()?;
        let p = trimmed(coefficients.iter().map(|c| c.floor_at(exponent)).collect());
        if p.len() < 2 {
            return None;
        }
        let chain = chain(primitive(p));
        let common = chain.last()?;
        let chain = if common.len() > 1 { self::chain(quotient(&chain[0], common)) } else { chain };
        Some(Self { chain })
    }

    /// The number of distinct roots in (`low`, `high`].
    pub fn count(&self, low: &Exact, high: &Exact) -> usize {
        self.changes(low).saturating_sub(self.changes(high))
    }

    /// The sign of the polynomial, up to a common factor ±1.
    pub fn sign(&self, x: &Exact) -> Ordering {
        sign_at(&self.chain[0], x)
    }

    /// A power of two that all roots are less than, by magnitude: Cauchy's bound.
    pub fn bound(&self) -> Exact {
        let p = &self.chain[0];
        let (last, rest) = p.split_last().expect("a polynomial with a root has coefficients");
        let greatest = rest.iter().map(bits).max().unwrap_or(0);
        // 1 + max |cᵢ / cₙ| < 1 + 2^(greatest − bits(cₙ) + 1)
        Exact::integer(1).scaled((greatest - bits(last) + 1).max(0) + 1)
    }

    /// The least root in the open interval from `low` to `high`, once `fine` says that the bracket of it that it is
    /// shown is narrow enough; exact where bisection meets it.
    pub fn first_root(&self, low: Exact, high: Exact, fine: impl Fn(&Exact, &Exact) -> bool) -> Option<Exact> {
        let (mut low, mut high) = (low, high);
        if low >= high {
            return None;
        }
        let mut count = self.count(&low, &high);
        if count == usize::from(self.sign(&high).is_eq()) {
            return None;
        }
        while count > 1 {
            let middle = middle(&low, &high);
            match self.count(&low, &middle) {
                0 => low = middle,
                n => (count, high) = (n, middle),
            }
        }
        let beyond = self.sign(&high);
        while beyond.is_ne() && !fine(&low, &high) {
            let middle = middle(&low, &high);
            match self.sign(&middle) {
                Ordering::Equal => return Some(middle),
                sign if sign == beyond => high = middle,
                _ => low = middle,
            }
        }
        Some(if beyond.is_eq() { high } else { middle(&low, &high) })
    }

    fn changes(&self, x: &Exact) -> usize {
        let signs = self.chain.iter().map(|p| sign_at(p, x)).filter(|s| s.is_ne()).collect::<Vec<_>>();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }
}

/// Half-way; 0 where the signs differ, so that a root there is met, and small roots are approached by ever shorter
/// steps.
fn middle(low: &Exact, high: &Exact) -> Exact {
    if low.sign().is_lt() && high.sign().is_gt() { Exact::ZERO } else { (low + high).scaled(-1) }
}

fn bits(x: &IBig) -> isize {
    x.bit_len() as isize
}

/// Horner's rule over a common denominator.
fn sign_at(p: &[IBig], x: &Exact) -> Ordering {
    let shift = (-x.exponent()).max(0) as usize;
    let x = x.floor_at(-(shift as isize));
    let (mut sum, mut scale) = (IBig::ZERO, 0);
    for c in p.iter().rev() {
        sum = sum * &x + (c << scale);
        scale += shift;
    }
    sum.cmp(&IBig::ZERO)
}

fn chain(p: Polynomial) -> Vec<Polynomial> {
    let slope = p.iter().enumerate().skip(1).map(|(power, c)| c * IBig::from(power)).collect();
    let mut chain = vec![p, primitive(slope)];
    while let [.., a, b] = &chain[..] {
        let rest = primitive(remainder(a, b).into_iter().map(|c| -c).collect());
        if rest.is_empty() {
            break;
        }
        chain.push(rest);
    }
    chain
}

/// a mod b, times a number above 0.
fn remainder(a: &[IBig], b: &[IBig]) -> Polynomial {
    divide(a, b).1
}

/// a / b, times a number, where b divides a.
fn quotient(a: &[IBig], b: &[IBig]) -> Polynomial {
    primitive(divide(a, b).0)
}

/// Quotient and remainder of k a by b, with one k > 0 for both.
fn divide(a: &[IBig], b: &[IBig]) -> (Polynomial, Polynomial) {
    let (mut quotient, mut rest) = (vec![IBig::ZERO; (a.len() + 1).saturating_sub(b.len())], a.to_vec());
    let Some(last) = b.last() else { return (quotient, rest) };
    let (size, negative) = (last.clone().abs(), *last < IBig::ZERO);
    while rest.len() >= b.len() {
        let (shift, lead) = (rest.len() - b.len(), rest[rest.len() - 1].clone());
        let lead = if negative { -lead } else { lead };
        quotient.iter_mut().chain(&mut rest).for_each(|c| *c *= &size);
        quotient[shift] += &lead;
        b.iter().zip(&mut rest[shift..]).for_each(|(b, c)| *c -= b * &lead);
        rest = trimmed(rest);
    }
    (quotient, rest)
}

/// Without leading zeros.
fn trimmed(mut p: Polynomial) -> Polynomial {
    while p.last().is_some_and(|c| *c == IBig::ZERO) {
        p.pop();
    }
    p
}

/// Divided by the greatest common divisor of the coefficients.
fn primitive(p: Polynomial) -> Polynomial {
    let content = p.iter().fold(UBig::ZERO, |common, c| {
        if common == UBig::ZERO && *c == IBig::ZERO { common } else { common.gcd(c.clone().into_parts().1) }
    });
    if content == UBig::ZERO { p } else { p.into_iter().map(|c| c / &content).collect() }
}
