//! Boxes: the ray is in the closed box where it is between both faces of all three pairs. All six quotients are brought
//! over one denominator, so that comparing them is exact and cheap.

use super::exact::{Exact, Exact3, dot, minus};
use super::root::Root;
use super::{Crossing, Line, exact3, turn};
use crate::scene::Cuboid;

/// In a face's plane the ray is between that pair. At an edge or corner the normal is that of the first of the axes. A
/// turned box is the one that [`turn::axes`] makes.
pub fn cuboid(it: &Cuboid, line: &Line) -> Option<Crossing> {
    let (min, max, axes) = (exact3(it.min)?, exact3(it.max)?, turn::axes(it.rotation)?);
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
