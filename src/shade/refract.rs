//! A dielectric's surface: how much of a ray it reflects, and where the rest goes.

use super::spawn;
use crate::math::{Lanes, Vec3};

/// Reflection and refraction of unpolarised light at a dielectric.
#[derive(Clone, Copy, Debug)]
pub struct Fresnel<L: Lanes> {
    /// Reflectance F, 0 to 1; 1 where the ray is reflected totally.
    pub reflectance: L,
    /// Cosine of the refracted ray's angle; 0 where the ray is reflected totally.
    pub cosine: L,
    /// Where there is no refracted ray.
    pub total: L::Mask,
}

/// Fresnel's equations for a ray that meets a surface at a cosine from 0 to 1; `eta` is the index of refraction before it,
/// divided by the one behind it.
///
/// With Snell's law, sin θ' = η sin θ: F = ½ (r₁² + r₂²), r₁ = (η c − c') / (η c + c'), r₂ = (c − η c') / (c + η c').
/// Born and Wolf, *Principles of Optics*, §1.5.2. Absolute error of F at most 8 ε, but for the neighbourhood of
/// the critical angle, where c' is off by √(4 ε) at the most. Where η is 1, F is 0.
#[inline(always)]
pub fn fresnel<L: Lanes>(cosine: L, eta: L) -> Fresnel<L> {
    let one = L::splat(1.0);
    // c'² = 1 − η² (1 − c²), written so that nothing cancels where η is 1.
    let along = eta * cosine;
    let through2 = along.mul_add(along, (one - eta) * (one + eta));
    let total = through2.le(L::zero());
    let through = through2.max(L::zero()).sqrt();
    let r1 = (along - through) / (along + through);
    let r2 = eta.neg_mul_add(through, cosine) / eta.mul_add(through, cosine);
    let f = r1.mul_add(r1, r2 * r2) * L::splat(0.5);
    Fresnel { reflectance: one.select(total, f), cosine: through, total }
}

/// Unit direction behind the surface of a ray that came along `direction`, with the normal turned against it, the ray's
/// cosine and that of the refracted ray: η d + (η c − c') n, kept at unit length by one Newton step.
#[inline(always)]
pub fn bend<L: Lanes>(direction: Vec3<L>, normal: Vec3<L>, eta: L, cosine: L, through: L) -> Vec3<L> {
    let t = normal.mul_add(eta.mul_add(cosine, -through), direction * eta);
    t * t.dot(t).mul_add(L::splat(-0.5), L::splat(1.5))
}

/// The rays that a ray splits into at a surface, besides the surface's own shading.
#[derive(Clone, Copy, Debug)]
pub struct Split<L: Lanes> {
    /// The weight of the reflected ray.
    pub mirror: L,
    /// Its unit direction.
    pub reflected: Vec3<L>,
    /// The weight of the refracted ray; 0 where there is none.
    pub transmitted: L,
    /// Its unit direction.
    pub refracted: Vec3<L>,
}

/// Splits rays. `normal` is that for shading and `geometric` the surface's own where that is another, both turned against
/// the ray; `additive` where the fractions `reflectance` and `transmission` are constant; see [`crate::scene::Material`].
#[inline(always)]
pub fn split<L: Lanes>(
    direction: Vec3<L>,
    normal: Vec3<L>,
    geometric: Option<Vec3<L>>,
    eta: L,
    [reflectance, transmission]: [L; 2],
    additive: L::Mask,
) -> Split<L> {
    // An interpolated normal that faces away from a ray counts as one across it.
    let facing = |n: Vec3<L>| (-n.dot(direction)).max(L::zero()).min(L::splat(1.0));
    let cosine = facing(normal);
    let Fresnel { reflectance: f, cosine: through, mut total } = fresnel(cosine, eta);
    let refracted = bend(direction, normal, eta, cosine, through);
    let mut reflected = spawn::mirror(direction, normal);
    if let Some(geometric) = geometric {
        reflected = spawn::mirror_above(direction, normal, geometric);
        // One that bends a ray back to where it came from gives way to the surface's own, which reflects all of it there:
        // with g·t ≥ 0, −g·d ≤ √(1 − η⁻²) g·n, as η c − c' is greatest at the critical angle; so −g·d is below that angle's
        // cosine.
        total = total | !refracted.dot(geometric).lt(L::zero());
    }
    let f = L::splat(1.0).select(total, L::zero().select(additive, f));
    Split {
        mirror: transmission.mul_add(f, reflectance),
        reflected,
        transmitted: transmission * (L::splat(1.0) - f),
        refracted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textbook_values() {
        // Glass from air, head-on: ((n − 1) / (n + 1))² = 0.04.
        let f = fresnel(1.0f32, 1.0 / 1.5);
        assert!((f.reflectance - 0.04).abs() < 1e-6 && (f.cosine - 1.0).abs() < 1e-6 && !f.total);
        // Grazing: all is reflected.
        assert!(fresnel(0.0f32, 1.0 / 1.5).reflectance == 1.0);
        // The same both ways along one path.
        let c = 0.6f32;
        let inward = fresnel(c, 1.0 / 1.5);
        let outward = fresnel(inward.cosine, 1.5);
        assert!((inward.reflectance - outward.reflectance).abs() < 1e-6 && (outward.cosine - c).abs() < 1e-6);
        // Brewster's angle, tan θ = n: the parallel part vanishes.
        let theta = 1.5f32.atan();
        let perpendicular = ((theta.cos() - 1.5 * (theta.sin() / 1.5).asin().cos())
            / (theta.cos() + 1.5 * (theta.sin() / 1.5).asin().cos()))
        .powi(2);
        assert!((fresnel(theta.cos(), 1.0 / 1.5).reflectance - perpendicular / 2.0).abs() < 1e-6);
    }

    #[test]
    fn total_reflection_starts_at_the_critical_angle() {
        for eta in [1.05f32, 1.33, 1.5, 2.4, 10.0] {
            let critical = (1.0 - 1.0 / (f64::from(eta) * f64::from(eta))).sqrt() as f32;
            let [below, above] = [critical * (1.0 - 1e-5), critical * (1.0 + 1e-5)];
            assert!(fresnel(below, eta).total && fresnel(below, eta).reflectance == 1.0, "{eta}");
            assert!(!fresnel(above, eta).total && fresnel(above, eta).reflectance < 1.0, "{eta}");
        }
    }

    #[test]
    fn no_step_in_the_index_changes_nothing() {
        for cosine in [1e-15f32, 1e-4, 0.3, 0.999, 1.0] {
            let f = fresnel(cosine, 1.0);
            assert!((f.cosine / cosine - 1.0).abs() < 1e-6 && f.reflectance < 1e-12, "{cosine}: {f:?}");
        }
        assert!(fresnel(0.0f32, 1.0).reflectance == 1.0);
        let (d, n) = (glam::vec3(0.6, -0.8, 0.0), glam::Vec3::Y);
        let t = glam::Vec3::from(bend::<f32>(d.into(), n.into(), 1.0, 0.8, 0.8));
        assert!((t - d).length() < 1e-6);
    }

    /// The cosine behind the surface from sin θ' = η sin θ as it stands; `None` where all is reflected.
    fn by_sines(cosine: f32, eta: f32) -> Option<f32> {
        let sine2 = eta * eta * (1.0 - cosine * cosine);
        (sine2 <= 1.0).then(|| (1.0 - sine2).sqrt())
    }

    /// Between nearly equal indices the critical angle is next to grazing, where 1 − η² (1 − c²) cancels.
    #[test]
    fn at_the_critical_angle_of_a_small_step_the_sines_fail_and_ours_holds() {
        let (mut wrong, mut count) = (0, 0);
        for step in [0.0f32, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4] {
            let eta = 1.0 + step;
            let (e, critical) = (f64::from(eta), (2.0 * step.max(0.0)).sqrt());
            for i in 1..=200 {
                let cosine = critical + 1e-5 * 1.03f32.powi(i);
                let c = f64::from(cosine);
                let exact = ((e * c).powi(2) + (1.0 - e) * (1.0 + e)).max(0.0).sqrt();
                let off = |through: f32| (f64::from(through) - exact).abs() / exact;
                let f = fresnel(cosine, eta);
                // What rounding can do to a difference of c² and the step.
                let bound = 4.0 * 2f64.powi(-24) * (c * c / (exact * exact)).max(1.0);
                assert!(!f.total && off(f.cosine) <= bound, "{eta} {cosine}: {f:?} for {exact}");
                wrong += usize::from(by_sines(cosine, eta).is_none_or(|through| off(through) > 0.01));
                count += 1;
            }
        }
        assert!(wrong > count / 4, "{wrong} of {count}");
    }

    /// A product with the reciprocal is not always 1 between equal indices, and then a grazing ray is bent that should
    /// go straight on.
    #[test]
    fn between_equal_indices_a_rounded_ratio_fails_and_ours_holds() {
        // 2⁻¹¹, whose square rounding leaves alone.
        let (mut wrong, cosine) = (0, 1.0f32 / 2048.0);
        for i in 0..1000 {
            let ior = 1.0 + i as f32 * 1e-3;
            let off = |through: f32| (through / cosine - 1.0).abs();
            wrong += usize::from(by_sines(cosine, ior * (1.0 / ior)).is_none_or(|through| off(through) > 0.1));
            let f = fresnel(cosine, ior / ior);
            assert!(!f.total && off(f.cosine) < 1e-6, "{ior}: {f:?}");
        }
        assert!(wrong > 100, "{wrong}");
    }

    #[test]
    fn directions_obey_snells_law() {
        for eta in [0.2f32, 0.66, 1.1, 1.5] {
            for sine in [0.0f32, 0.1, 0.3, 0.6] {
                let cosine = (1.0 - sine * sine).sqrt();
                let f = fresnel(cosine, eta);
                if f.total {
                    continue;
                }
                let d = glam::vec3(sine, -cosine, 0.0);
                let t = glam::Vec3::from(bend::<f32>(d.into(), glam::Vec3::Y.into(), eta, cosine, f.cosine));
                assert!(
                    (t.x - eta * sine).abs() < 1e-6 && t.y < 0.0 && (t.length() - 1.0).abs() < 1e-6,
                    "{eta} {sine}"
                );
            }
        }
    }
}
