//! Leaves out the points of a line that cannot be seen.

/// The points of a polyline without those closer than `tolerance` to the line through their neighbours, after x has been
/// multiplied by `scale.0` and y by `scale.1` (Douglas and Peucker). The first and the last point stay.
///
/// Curves of motion are straight for most of their samples; this keeps the pictures small.
pub(crate) fn simplify(points: &[(f64, f64)], scale: (f64, f64), tolerance: f64) -> Vec<(f64, f64)> {
    let mut keep = vec![false; points.len()];
    let ends = [keep.len().checked_sub(1), Some(0)];
    ends.into_iter().flatten().for_each(|end| {
        if let Some(kept) = keep.get_mut(end) {
            *kept = true;
        }
    });
    let mut open = vec![(0, points.len().saturating_sub(1))];
    while let Some((first, last)) = open.pop() {
        let (Some(&from), Some(&to)) = (points.get(first), points.get(last)) else { continue };
        let between = points.iter().enumerate().take(last).skip(first + 1);
        let farthest = between
            .map(|(n, &point)| (n, distance(point, from, to, scale)))
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .filter(|(_, far)| *far > tolerance);
        if let Some((n, _)) = farthest {
            if let Some(kept) = keep.get_mut(n) {
                *kept = true;
            }
            open.extend([(first, n), (n, last)]);
        }
    }
    points.iter().zip(keep).filter_map(|(point, keep)| keep.then_some(*point)).collect()
}

/// Distance of `point` from the stretch `from`-`to`.
fn distance(point: (f64, f64), from: (f64, f64), to: (f64, f64), scale: (f64, f64)) -> f64 {
    let vector = |a: (f64, f64), b: (f64, f64)| ((b.0 - a.0) * scale.0, (b.1 - a.1) * scale.1);
    let (line, to_point) = (vector(from, to), vector(from, point));
    let length = line.0 * line.0 + line.1 * line.1;
    let along = if length > 0.0 {
        ((to_point.0 * line.0 + to_point.1 * line.1) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (to_point.0 - along * line.0).hypot(to_point.1 - along * line.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_stretches_keep_their_ends() {
        let ramp: Vec<(f64, f64)> =
            (0..=100).map(|n| (f64::from(n), f64::from(n.min(40)))).chain([(100.0, 0.0)]).collect();
        assert_eq!(
            simplify(&ramp, (1.0, 1.0), 0.01),
            [(0.0, 0.0), (40.0, 40.0), (100.0, 40.0), (100.0, 0.0)]
        );
        assert_eq!(simplify(&[], (1.0, 1.0), 0.01), []);
        assert_eq!(simplify(&[(1.0, 2.0)], (1.0, 1.0), 0.01), [(1.0, 2.0)]);
    }

    #[test]
    fn nothing_moves_by_more_than_the_tolerance() {
        let wave: Vec<(f64, f64)> =
            (0..=2000).map(|n| (f64::from(n) * 0.005, (f64::from(n) * 0.01).sin())).collect();
        let scale = (70.0, 100.0);
        let kept = simplify(&wave, scale, 0.05);
        assert!(kept.len() < 300, "{}", kept.len());
        for point in &wave {
            let near = kept
                .windows(2)
                .map(|pair| distance(*point, pair[0], pair[1], scale))
                .fold(f64::INFINITY, f64::min);
            assert!(near <= 0.05 + 1e-9, "{near}");
        }
    }
}
