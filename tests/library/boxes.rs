//! A tree over boxes of one's own finds what testing all of them finds.

use std::ops::ControlFlow;

use glam::Vec3;
use raypacket::{Aabb, BoxTree, Hit, Ray};

use crate::common::{Pcg, ROUNDOFF};

/// A ball, tested in f64.
#[derive(Clone, Copy)]
struct Ball {
    center: Vec3,
    radius: f32,
}

impl Ball {
    fn bounds(&self) -> Aabb {
        Aabb { min: self.center - self.radius, max: self.center + self.radius }
    }

    fn hit(&self, ray: &Ray) -> Option<f32> {
        let (f, d) = ((ray.origin - self.center).as_dvec3(), ray.direction.as_dvec3());
        let (b, c) = (f.dot(d), f.length_squared() - f64::from(self.radius).powi(2));
        let root = (b * b - d.length_squared() * c).sqrt();
        let inside = |t: &f32| *t > ray.t_min && *t < ray.t_max;
        [-b - root, -b + root].map(|t| (t / d.length_squared()) as f32).into_iter().find(inside)
    }
}

fn balls(count: usize, rng: &mut Pcg) -> Vec<Ball> {
    let ball = |_| Ball { center: 10.0 * rng.cube(), radius: rng.range(0.01, 0.5) };
    (0..count).map(ball).collect()
}

fn bounds(balls: &[Ball]) -> Vec<Aabb> {
    balls.iter().map(Ball::bounds).collect()
}

fn rays(rng: &mut Pcg) -> Vec<Ray> {
    let axes = [Vec3::X, Vec3::NEG_Y, Vec3::Z, Vec3::new(0.0, 0.6, -0.8)];
    let ray = |i| {
        let direction = if i % 5 == 0 { rng.pick(&axes) } else { rng.cube().normalize() };
        let t_max = rng.pick(&[f32::INFINITY, 5.0, 0.0]);
        Ray { t_min: rng.pick(&[0.0, 1.0]), t_max, ..Ray::new(12.0 * rng.cube(), direction) }
    };
    (0..500).map(ray).collect()
}

/// By testing all, from the last on; of hits at equal distance the lowest place.
fn nearest(balls: &[Ball], ray: &Ray) -> Option<Hit> {
    let hits = balls.iter().enumerate().filter_map(|(i, ball)| Some(Hit { t: ball.hit(ray)?, primitive: i as u32 }));
    hits.min_by(|a, b| a.t.total_cmp(&b.t).then(a.primitive.cmp(&b.primitive)))
}

fn same(tree: &BoxTree, balls: &[Ball], rng: &mut Pcg) -> usize {
    let rays = rays(rng);
    for ray in &rays {
        let wanted = nearest(balls, ray);
        assert_eq!(tree.intersect(ray, |i, ray| balls[i].hit(ray)), wanted, "{ray:?}");
        assert_eq!(tree.occluded(ray, |i, ray| balls[i].hit(ray)), wanted.is_some(), "{ray:?}");
    }
    rays.iter().filter(|ray| nearest(balls, ray).is_some()).count()
}

#[test]
fn it_finds_what_testing_all_finds() {
    let mut rng = Pcg::new(7);
    for count in [0, 1, 2, 3, 8, 9, 100, 3000] {
        let balls = balls(count, &mut rng);
        let tree = BoxTree::build(&bounds(&balls));
        assert_eq!((tree.len(), tree.is_empty()), (count, count == 0));
        assert_eq!(tree.bounds(), bounds(&balls).into_iter().fold(Aabb::EMPTY, Aabb::union));
        let hits = same(&tree, &balls, &mut rng);
        assert!(count < 3000 || (50..450).contains(&hits), "{hits}");
    }
}

#[test]
fn it_finds_all_of_what_coincides() {
    let mut rng = Pcg::new(8);
    let ball = Ball { center: Vec3::ZERO, radius: 1.0 };
    let balls: Vec<_> = balls(50, &mut rng).into_iter().chain([ball; 40]).collect();
    let tree = BoxTree::build(&bounds(&balls));
    same(&tree, &balls, &mut rng);
    let mut met = Vec::new();
    let ray = Ray::new([0.0, 0.0, 20.0], Vec3::NEG_Z);
    let end = tree.traverse(&ray, |i, _| {
        met.push(i);
        ControlFlow::<()>::Continue(())
    });
    assert!(end.is_continue());
    met.sort_unstable();
    assert!((50..90).all(|i| met.binary_search(&i).is_ok()), "{met:?}");
    assert!(met.windows(2).all(|pair| pair[0] != pair[1]), "each once: {met:?}");
}

#[test]
fn moved_boxes_are_found_where_they_are() {
    let mut rng = Pcg::new(9);
    for count in [0, 1, 5, 1000] {
        let mut balls = balls(count, &mut rng);
        let mut tree = BoxTree::build(&bounds(&balls));
        for _ in 0..3 {
            balls.iter_mut().for_each(|ball| ball.center += rng.cube());
            tree.refit(&bounds(&balls));
            assert_eq!(tree.bounds(), bounds(&balls).into_iter().fold(Aabb::EMPTY, Aabb::union));
            same(&tree, &balls, &mut rng);
        }
    }
}

#[test]
fn few_are_asked_and_a_lower_end_leaves_out_more() {
    let mut rng = Pcg::new(10);
    let balls = balls(5000, &mut rng);
    let tree = BoxTree::build(&bounds(&balls));
    let (mut all, mut before, mut hits) = (0, 0, 0);
    for ray in rays(&mut rng) {
        let _ = tree.traverse(&ray, |_, _| {
            all += 1;
            ControlFlow::<()>::Continue(())
        });
        let hit = tree.intersect(&ray, |i, ray| {
            before += 1;
            balls[i].hit(ray)
        });
        hits += usize::from(hit.is_some());
    }
    assert!(hits > 100 && before < all && all < 500 * 100, "{hits} {before} {all}");
    let first = tree.traverse(&Ray::new([20.0, 0.0, 0.0], Vec3::NEG_X), |i, _| ControlFlow::Break(i));
    assert!(matches!(first, ControlFlow::Break(i) if i < 5000));
}

#[test]
fn a_ray_without_finite_numbers_meets_nothing() {
    let tree = BoxTree::build(&[Aabb { min: Vec3::splat(-1.0), max: Vec3::ONE }]);
    let met = |ray: Ray| tree.traverse(&ray, |i, _| ControlFlow::Break(i)).is_break();
    let ray = Ray::new([0.0, 0.0, 5.0], Vec3::NEG_Z);
    assert!(met(ray));
    for t_max in [-1.0, f32::NAN, 3.9] {
        assert!(!met(Ray { t_max, ..ray }));
    }
    for bad in [f32::NAN, f32::INFINITY, 1e30] {
        assert!(!met(Ray { origin: Vec3::new(0.0, bad, 5.0), ..ray }));
        assert!(!met(Ray { direction: Vec3::new(0.0, bad, -1.0), ..ray }));
    }
}

/// Trees within the boxes of a tree, as instances are.
#[test]
fn a_closure_may_go_through_another_tree() {
    let mut rng = Pcg::new(11);
    let groups: Vec<Vec<Ball>> = (0..40).map(|_| balls(30, &mut rng)).collect();
    let trees: Vec<BoxTree> = groups.iter().map(|group| BoxTree::build(&bounds(group))).collect();
    let whole = BoxTree::build(&trees.iter().map(BoxTree::bounds).collect::<Vec<_>>());
    let all = groups.concat();
    for ray in rays(&mut rng) {
        let below = |i: usize, ray: &Ray| Some(trees[i].intersect(ray, |k, ray| groups[i][k].hit(ray))?.t);
        let found = whole.intersect(&ray, below).map(|hit| hit.t);
        assert_eq!(found, nearest(&all, &ray).map(|hit| hit.t), "{ray:?}");
    }
}

/// Things that all lie in one plane, in boxes of which those of higher places begin earlier.
#[test]
fn at_equal_distance_the_lowest_place_wins() {
    let around = |i: usize| Aabb { min: Vec3::splat(-1.0), max: Vec3::new(1.0, 1.0, 1.0 + i as f32) };
    for count in [2, 9, 100] {
        let tree = BoxTree::build(&(0..count).map(around).collect::<Vec<_>>());
        let ray = Ray::new([0.25, 0.5, 200.0], Vec3::NEG_Z);
        let hit = tree.intersect(&ray, |i, ray| (i > 0).then_some(-ray.origin.z / ray.direction.z));
        assert_eq!(hit, Some(Hit { t: 200.0, primitive: 1 }), "{count}");
    }
}

/// What lies within 56 ε R of a box along every axis is not lost, by the documentation.
#[test]
fn what_a_ray_passes_close_by_is_asked_about() {
    let (mut rng, mut tested) = (Pcg::new(12), 0);
    for _ in 0..20_000 {
        let center = rng.cube() * rng.pick(&[0.0, 1.0, 100.0]);
        let mut boxes: Vec<Aabb> = (0..3)
            .map(|_| {
                let (p, q) = (center + rng.cube(), center + rng.cube());
                Aabb { min: p.min(q), max: p.max(q) }
            })
            .collect();
        let axis = rng.below(3);
        boxes[0].max[axis] = boxes[0].min[axis];
        let tree = BoxTree::build(&boxes);
        let origin = center + rng.cube() * rng.pick(&[3.0, 1e3]);
        let around = tree.bounds();
        let away = (around.max - origin).abs().max((origin - around.min).abs()).max_element();
        let near = 56.0 * ROUNDOFF * f64::from(away + origin.abs().max_element());
        let Aabb { min, max } = boxes[0];
        let mut to = min.as_dvec3();
        for axis in 0..3 {
            match rng.below(3) {
                0 => to[axis] -= 0.98 * near,
                1 => to[axis] = f64::from(max[axis]) + 0.98 * near,
                _ => (),
            }
        }
        let direction = (to - origin.as_dvec3()).normalize().as_vec3();
        let t = (to - origin.as_dvec3()).length() as f32;
        let at = origin.as_dvec3() + direction.as_dvec3() * f64::from(t);
        if at.cmplt(min.as_dvec3() - near).any() || at.cmpgt(max.as_dvec3() + near).any() {
            continue;
        }
        tested += 1;
        let hit = tree.intersect(&Ray::new(origin, direction), |i, _| (i == 0).then_some(t));
        assert_eq!(hit, Some(Hit { t, primitive: 0 }), "{boxes:?} {origin} {direction}");
    }
    assert!(tested > 10_000, "{tested}");
}
