//! Fewer points for a line that looks the same, after Douglas and Peucker: of a run of points, the
//! one farthest from the straight line between its ends stays if that is visible, and both halves
//! are looked at again.

/// Distance that the eye does not see, in pixels.
const TOLERANCE: f64 = 0.12;

/// The points that are needed; the first and the last are.
pub fn simplify(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let mut keep = vec![false; points.len()];
    let mut runs = vec![(0, points.len().saturating_sub(1))];
    while let Some((first, last)) = runs.pop() {
        let distance = |index: &usize| distance(points[*index], points[first], points[last]);
        if let Some(kept) = keep.get_mut(first..=last) {
            kept[0] = true;
            kept[last - first] = true;
        }
        let farthest = (first + 1..last).max_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(middle) = farthest.filter(|middle| distance(middle) > TOLERANCE) {
            runs.extend([(first, middle), (middle, last)]);
        }
    }
    points.into_iter().zip(keep).filter(|&(_, keep)| keep).map(|(point, _)| point).collect()
}

/// From `point` to the segment between `a` and `b`.
fn distance(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [point[0] - a[0], point[1] - a[1]]);
    let square = along[0] * along[0] + along[1] * along[1];
    let projection = (to[0] * along[0] + to[1] * along[1]) / square;
    let part = if square > 0.0 { projection.clamp(0.0, 1.0) } else { 0.0 };
    (to[0] - part * along[0]).hypot(to[1] - part * along[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_stay_and_points_on_the_way_go() {
        let on_the_way = (0..=100).map(|i| [f64::from(i), 0.0]);
        let up = (1..=100).map(|i| [100.0, f64::from(i)]);
        let kept = simplify(on_the_way.chain(up).collect());
        assert_eq!(kept, [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0]]);
    }

    #[test]
    fn a_circle_stays_round() {
        let point = |i: i32| f64::from(i).to_radians().sin_cos();
        let circle = (0..360).map(point).map(|(y, x)| [100.0 * x, 100.0 * y]).collect();
        let kept = simplify(circle);
        assert!((40..120).contains(&kept.len()), "{}", kept.len());
        let middle = |p: &[[f64; 2]]| (0.5 * (p[0][0] + p[1][0])).hypot(0.5 * (p[0][1] + p[1][1]));
        assert!(kept.windows(2).all(|pair| middle(pair) > 100.0 - 2.0 * TOLERANCE));
    }

    #[test]
    fn few_points_stay() {
        assert!(simplify(Vec::new()).is_empty());
        assert_eq!(simplify(vec![[1.0, 2.0]]), [[1.0, 2.0]]);
    }
}
