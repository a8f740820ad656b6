//! Boxes: the ray is in the closed box where it is between both faces of all three pairs. All six quotients are brought
//! over one denominator, so that comparing them is exact and cheap.

use super::body::{Body, Crossing, Line, ball_around, exact3};
use super::exact::{Exact, Exact3, dot, minus};
use super::root::Root;
use super::turn;
use crate::scene::Cuboid;
use glam::DVec3;

impl Body for Cuboid {
    /// In a face's plane the ray is between that pair. At an edge or corner the normal is that of the first of the axes. A
    /// turned box is the one that [`turn::axes`] makes.
    fn first(&self, line: &Line) -> Option<Crossing> {
        let (min, max, axes) = (exact3(self.min)?, exact3(self.max)?, turn::axes(self.rotation)?);
        // From the centre, all doubled.
        let from_center: Exact3 = std::array::from_fn(|i| line.origin[i].scaled(1) - &min[i] - &max[i]);
        let size = minus(&max, &min);
        let origin = axes.each_ref().map(|axis| dot(axis, &from_center));
        let direction = axes.each_ref().map(|axis| dot(axis, &line.direction).scaled(1));
        let slabs = Slabs::new(&origin, &direction, &size)?;
        let hits = [(&slabs.enter, true), (&slabs.exit, false)].into_iter().filter_map(|(event, enters)| {
            let (numerator, axis) = event.as_ref()?;
            Some((Root::ratio(numerator.clone(), slabs.denominator.clone())?, *axis, enters))
        });
        let (t, axis, enters) = hits.into_iter().find(|(t, ..)| line.span.contains(t))?;
        // Entering, the ray runs against the outward normal.
        let against = direction[axis].sign().is_gt() == enters;
        let normal = axes[axis].each_ref().map(|c| if against { -c } else { c.clone() });
        Some(Crossing { t: t.value(), normal })
    }

    fn tips(&self, _width: f64) -> Vec<DVec3> {
        let [min, max, degrees] = [self.min, self.max, self.rotation].map(|p| p.as_dvec3());
        let [x, y, z] = (degrees % 360.0).to_array().map(f64::to_radians);
        let turn = glam::DQuat::from_euler(glam::EulerRot::ZYX, z, y, x);
        let (center, half) = ((min + max) / 2.0, (max - min) / 2.0);
        let signs = (0..8).map(|i| DVec3::from_array([1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 1.0 })));
        signs.map(|sign| center + turn * (sign * half)).collect()
    }

    fn ball(&self) -> Option<(DVec3, f64)> {
        Some(ball_around(&self.tips(0.0), 0.0))
    }

    fn thickness(&self) -> f64 {
        (self.max.as_dvec3() - self.min.as_dvec3()).min_element()
    }
}

/// Where the ray passes a face, and the axis across it.
type Face = (Exact, usize);

/// Where a ray is between −`size` and `size` in all coordinates: from `enter` to `exit`, both over `denominator`, with the
/// axes whose faces these are; `None` without beginning or end.
struct Slabs {
    enter: Option<Face>,
    exit: Option<Face>,
    denominator: Exact,
}

impl Slabs {
    /// `None` where the ray misses the box.
    fn new(origin: &Exact3, direction: &Exact3, size: &Exact3) -> Option<Self> {
        let moves = |axis: &usize| !direction[*axis].is_zero();
        let product = |axes: &mut dyn Iterator<Item = usize>| {
            axes.filter(moves).fold(Exact::integer(1), |product, axis| product * direction[axis].abs())
        };
        let (mut enter, mut exit): (Option<Face>, Option<Face>) = (None, None);
        for axis in 0..3 {
            if !moves(&axis) {
                if origin[axis].abs() > size[axis] {
                    return None;
                }
                continue;
            }
            let others = product(&mut (0..3).filter(|other| *other != axis));
            let ahead = if direction[axis].sign().is_gt() { -&origin[axis] } else { origin[axis].clone() };
            let (first, last) = ((&ahead - &size[axis]) * &others, (ahead + &size[axis]) * others);
            if enter.as_ref().is_none_or(|(most, _)| first > *most) {
                enter = Some((first, axis));
            }
            if exit.as_ref().is_none_or(|(least, _)| last < *least) {
                exit = Some((last, axis));
            }
        }
        let meets = enter.as_ref().zip(exit.as_ref()).is_none_or(|(enter, exit)| enter.0 <= exit.0);
        meets.then(|| Self { enter, exit, denominator: product(&mut (0..3)) })
    }
}
