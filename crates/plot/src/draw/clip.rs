//! What of lines and polygons lies in a rectangle. Cut here, a picture needs no clip path, for which a renderer draws
//! each group apart.

use glam::DVec2;

/// What of a convex polygon lies between two corners; of another one that may be joined along the border.
pub fn polygon(mut points: Vec<DVec2>, [low, high]: [DVec2; 2]) -> Vec<DVec2> {
    for (inwards, least) in sides([low, high]) {
        let depth = |point: &DVec2| inwards.dot(*point) - least;
        let mut kept = Vec::with_capacity(points.len() + 1);
        for (k, b) in points.iter().enumerate() {
            let a = &points[(k + points.len() - 1) % points.len()];
            let (before, after) = (depth(a), depth(b));
            if (before < 0.0) != (after < 0.0) {
                kept.push(a.lerp(*b, before / (before - after)));
            }
            if after >= 0.0 {
                kept.push(*b);
            }
        }
        points = kept;
    }
    points
}

/// The area of a convex polygon, negative where it turns to the right.
pub fn area(points: &[DVec2]) -> f64 {
    (2..points.len()).map(|k| (points[k - 1] - points[0]).perp_dot(points[k] - points[0])).sum::<f64>() / 2.0
}

/// What of a line through points lies between two corners, in stretches.
pub fn line(points: &[DVec2], corners: [DVec2; 2]) -> Vec<Vec<DVec2>> {
    let mut stretches: Vec<Vec<DVec2>> = Vec::new();
    for ends in points.windows(2) {
        let Some([from, to]) = segment([ends[0], ends[1]], corners) else { continue };
        match stretches.last_mut() {
            Some(last) if last.last() == Some(&from) => last.push(to),
            _ => stretches.push(vec![from, to]),
        }
    }
    stretches
}

/// Between the points where it comes in and goes out (Liang and Barsky); none where that is at most a point.
fn segment([a, b]: [DVec2; 2], corners: [DVec2; 2]) -> Option<[DVec2; 2]> {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (inwards, least) in sides(corners) {
        let [before, after] = [a, b].map(|point| inwards.dot(point) - least);
        let at = before / (before - after);
        match (before < 0.0, after < 0.0) {
            (true, true) => return None,
            (true, false) => from = from.max(at),
            (false, true) => to = to.min(at),
            (false, false) => (),
        }
    }
    // Ends that lie inside stay as they are, so that stretches meet.
    let place = |share: f64| match share {
        0.0 => a,
        1.0 => b,
        share => a.lerp(b, share),
    };
    (from < to && a != b).then(|| [place(from), place(to)])
}

/// Each side of a rectangle: the direction inwards, and how far along it the side lies.
fn sides([low, high]: [DVec2; 2]) -> [(DVec2, f64); 4] {
    [(DVec2::X, low.x), (-DVec2::X, -high.x), (DVec2::Y, low.y), (-DVec2::Y, -high.y)]
}

/// A convex polygon whose sides are so far out; sharp corners go out by at most three times as much.
pub fn grown(points: &[DVec2], by: f64) -> Vec<DVec2> {
    let count = points.len();
    let area: f64 = (0..count).map(|k| points[k].perp_dot(points[(k + 1) % count])).sum();
    let outwards = |a: DVec2, b: DVec2| -area.signum() * (b - a).perp().normalize_or_zero();
    let corner = |k: usize| {
        let (before, at, after) = (points[(k + count - 1) % count], points[k], points[(k + 1) % count]);
        let [a, b] = [outwards(before, at), outwards(at, after)];
        at + ((a + b) / (1.0 + a.dot(b)).max(1e-9)).clamp_length_max(3.0) * by
    };
    (0..count).map(corner).collect()
}

#[cfg(test)]
#[path = "tests/clip.rs"]
mod tests;
