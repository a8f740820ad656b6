//! One ray through a tree over boxes of the caller's own: the boxes' test, padding and order are those of a single ray
//! through the scene's tree ([`super::single`]).

use std::cell::Cell;
use std::ops::ControlFlow;

use glam::Vec3;
use wide::f32x8;

use super::beam::{PAD, TINY};
use super::line::Line;
use super::stack::Stack;
use super::state::TOO_FAR;
use crate::bvh::{Aabb, BoxTree, Kind};
use crate::trace::{Hit, Ray};

thread_local! {
    /// What a traversal puts aside goes here, kept by every thread from one to the next. One that begins within
    /// another, in its closure, finds nothing here and makes its own.
    static STACK: Cell<Option<Box<Stack>>> = const { Cell::new(None) };
}

impl BoxTree {
    /// The nearest hit of one ray. For every box that the ray meets before what is known by then, `test` is told its
    /// place and the ray as far as it still counts, and gives the distance where the ray hits what is in the box, or
    /// the nearest of such distances.
    ///
    /// Distances outside of the open interval of the ray it is told do not count. At equal distance the lowest place
    /// wins, and so the answer does not depend on the order. [`Hit::primitive`] is the place.
    ///
    /// `test` may be asked about boxes that the ray passes close by. With R the largest distance along an axis from the
    /// ray's start to a corner of the tree's box, plus the start's largest coordinate, and ε = 2⁻²⁴, no hit is lost
    /// that lies within 56 ε R of its box along every axis. A ray with NaN or infinite components, or which starts
    /// beyond 2⁶⁸, hits nothing.
    pub fn intersect(&self, ray: &Ray, mut test: impl FnMut(usize, &Ray) -> Option<f32>) -> Option<Hit> {
        let (mut ray, mut nearest) = (*ray, None::<Hit>);
        let _ = self.traverse(&{ ray }, |i, t_max| {
            let t = test(i, &ray).filter(|t| *t > ray.t_min && *t < ray.t_max);
            let found = t.map(|t| Hit { t, primitive: i as u32 });
            if let Some(hit) = found.filter(|hit| nearest.is_none_or(|old| (hit.t, i as u32) < (old.t, old.primitive)))
            {
                nearest = Some(hit);
                *t_max = hit.t;
                // Something as near may have a lower place.
                ray.t_max = hit.t.next_up();
            }
            ControlFlow::<()>::Continue(())
        });
        nearest
    }

    /// Whether one ray hits anything, by a `test` as that of [`BoxTree::intersect`], which is asked no more after its
    /// first hit.
    pub fn occluded(&self, ray: &Ray, mut test: impl FnMut(usize, &Ray) -> Option<f32>) -> bool {
        let traversal = self.traverse(ray, |i, _| match test(i, ray).filter(|t| *t > ray.t_min && *t < ray.t_max) {
            Some(_) => ControlFlow::Break(()),
            None => ControlFlow::Continue(()),
        });
        traversal.is_break()
    }

    /// Visits the boxes that one ray meets between its start and `ray.t_max`, roughly from the nearest on, by their
    /// places.
    ///
    /// `visit` may lower the end of the interval, which passes over boxes that begin beyond it, and may end the way by
    /// [`ControlFlow::Break`], whose value is then the answer. `ray.t_min` is the caller's matter. Which boxes are met
    /// is as in [`BoxTree::intersect`].
    pub fn traverse<B>(&self, ray: &Ray, mut visit: impl FnMut(usize, &mut f32) -> ControlFlow<B>) -> ControlFlow<B> {
        let limit = ray.t_max;
        let counts = limit >= 0.0 && ((ray.origin * TOO_FAR).is_finite() && (ray.direction * TOO_FAR).is_finite());
        if self.is_empty() || !counts {
            return ControlFlow::Continue(());
        }
        let mut stack = STACK.take().unwrap_or_default();
        let end = self.through(&Line::of(ray, self.bounds()), limit, &mut stack, &mut visit);
        STACK.set(Some(stack));
        end
    }

    fn through<B>(
        &self,
        line: &Line,
        mut limit: f32,
        stack: &mut Stack,
        visit: &mut impl FnMut(usize, &mut f32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        stack.clear();
        let mut at = 0;
        loop {
            let node = &self.nodes()[at];
            let (enter, met) = line.meets(node, f32x8::splat(limit));
            let mut next = (met != 0).then(|| stack.nearest(node, &enter.to_array(), met));
            at = loop {
                let Some(entry) = next.take().or_else(|| stack.pop(limit)) else { return ControlFlow::Continue(()) };
                let child = entry.child();
                match child.kind() {
                    Kind::Node => break child.index(),
                    Kind::Nothing => (),
                    _ => visit(child.index(), &mut limit)?,
                }
            };
        }
    }
}

impl Line {
    /// One ray alone, by the arithmetic of [`super::line::Lines`].
    fn of(ray: &Ray, bounds: Aabb) -> Self {
        let (o, d) = (ray.origin, ray.direction);
        let reach = (bounds.max - o).abs().max((o - bounds.min).abs()).max_element() + o.abs().max_element();
        let pad = reach * PAD;
        let least = Vec3::select(d.cmplt(Vec3::ZERO), Vec3::splat(-TINY), Vec3::splat(TINY));
        let inverse = 1.0 / Vec3::select(d.abs().cmplt(Vec3::splat(TINY)), least, d);
        let (wider, at_origin) = (inverse.abs() * pad, o * inverse);
        let splat = |v: Vec3| v.to_array().map(f32x8::splat);
        Self {
            inverse: splat(inverse),
            near: splat(at_origin + wider),
            far: splat(at_origin - wider),
            side: d.to_array().map(|d| usize::from(d < 0.0)),
        }
    }
}
