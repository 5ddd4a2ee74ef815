//! Clipping to a rectangle. Shapes are cut before they are written: a clip path in the SVG would make renderers draw
//! each group on a layer of its own.

use glam::DVec2;

/// Returns the part of a polygon inside a rectangle, given by two corners (Sutherland and Hodgman). Parts of a polygon
/// that is not convex may be joined along the border.
pub(crate) fn polygon(mut points: Vec<DVec2>, [low, high]: [DVec2; 2]) -> Vec<DVec2> {
    for (normal, offset) in sides([low, high]) {
        let depth = |point: &DVec2| normal.dot(*point) - offset;
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

/// Returns the area of a convex polygon, negative if it runs clockwise.
pub(crate) fn area(points: &[DVec2]) -> f64 {
    (2..points.len()).map(|k| (points[k - 1] - points[0]).perp_dot(points[k] - points[0])).sum::<f64>() / 2.0
}

/// Returns the parts of a line through points inside a rectangle, given by two corners.
pub(super) fn line(points: &[DVec2], corners: [DVec2; 2]) -> Vec<Vec<DVec2>> {
    let mut parts: Vec<Vec<DVec2>> = Vec::new();
    for ends in points.windows(2) {
        let Some([from, to]) = segment([ends[0], ends[1]], corners) else { continue };
        match parts.last_mut() {
            Some(last) if last.last() == Some(&from) => last.push(to),
            _ => parts.push(vec![from, to]),
        }
    }
    parts
}

/// Returns the ends of the part of a segment inside a rectangle (Liang and Barsky); `None` if it is at most a point.
fn segment([a, b]: [DVec2; 2], corners: [DVec2; 2]) -> Option<[DVec2; 2]> {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for (normal, offset) in sides(corners) {
        let [before, after] = [a, b].map(|point| normal.dot(point) - offset);
        let crossing = before / (before - after);
        match (before < 0.0, after < 0.0) {
            (true, true) => return None,
            (true, false) => from = from.max(crossing),
            (false, true) => to = to.min(crossing),
            (false, false) => (),
        }
    }
    // Ends inside the rectangle stay exactly as they are, so that neighbouring segments join.
    let place = |share: f64| match share {
        0.0 => a,
        1.0 => b,
        share => a.lerp(b, share),
    };
    (from < to && a != b).then(|| [place(from), place(to)])
}

/// Returns the inward normal of each side of a rectangle, and the side's offset along it.
fn sides([low, high]: [DVec2; 2]) -> [(DVec2, f64); 4] {
    [(DVec2::X, low.x), (-DVec2::X, -high.x), (DVec2::Y, low.y), (-DVec2::Y, -high.y)]
}

/// Moves the sides of a convex polygon outwards by a distance. A sharp corner moves by at most three times as much.
pub(super) fn grown(points: &[DVec2], distance: f64) -> Vec<DVec2> {
    let count = points.len();
    let area: f64 = (0..count).map(|k| points[k].perp_dot(points[(k + 1) % count])).sum();
    let outwards = |a: DVec2, b: DVec2| -area.signum() * (b - a).perp().normalize_or_zero();
    let corner = |k: usize| {
        let (before, at, after) = (points[(k + count - 1) % count], points[k], points[(k + 1) % count]);
        let [a, b] = [outwards(before, at), outwards(at, after)];
        at + ((a + b) / (1.0 + a.dot(b)).max(1e-9)).clamp_length_max(3.0) * distance
    };
    (0..count).map(corner).collect()
}

#[cfg(test)]
#[path = "tests/clip.rs"]
mod tests;
