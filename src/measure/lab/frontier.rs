//! Pareto's frontier.

/// Which points no other beats: none is at most as large in both coordinates and smaller in one. By x, then y; of equal
/// points the first. Points that are not finite are left out.
pub fn frontier(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).filter(|&i| points[i].iter().all(|x| x.is_finite())).collect();
    order.sort_by(|&a, &b| points[a][0].total_cmp(&points[b][0]).then(points[a][1].total_cmp(&points[b][1])));
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let better = points[i][1] < least;
        least = least.min(points[i][1]);
        better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_known_points() {
        let points = [[1.0, 9.0], [2.0, 3.0], [2.0, 4.0], [3.0, 3.0], [4.0, 0.0], [0.5, f64::NAN], [5.0, 0.0]];
        assert_eq!(frontier(&points), [0, 1, 4]);
        assert_eq!(frontier(&[[1.0, 1.0], [1.0, 1.0]]), [0]);
        assert!(frontier(&[]).is_empty() && frontier(&[[f64::INFINITY, 0.0]]).is_empty());
    }

    /// None of those left out beats one, each is beaten; by the definition, on a grid with many ties.
    #[test]
    fn by_the_definition() {
        let mut rng = crate::measure::random::Pcg::new(7);
        for _ in 0..50 {
            let points: Vec<[f64; 2]> = (0..20).map(|_| [rng.below(6) as f64, rng.below(6) as f64]).collect();
            let beats = |a: [f64; 2], b: [f64; 2]| a != b && a[0] <= b[0] && a[1] <= b[1];
            let found = frontier(&points);
            for (i, &p) in points.iter().enumerate() {
                let beaten = points.iter().any(|&q| beats(q, p));
                let same = found.iter().any(|&k| points[k] == p);
                assert_eq!(same, !beaten, "{i} {p:?} {points:?}");
            }
        }
    }
}
