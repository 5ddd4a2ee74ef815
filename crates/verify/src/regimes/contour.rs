//! Contours of a map: closed lines about the nodes inside of a level.

use std::collections::BTreeMap;

/// Two neighbouring nodes of a grid, columns and rows; the one nearer to the origin comes first.
pub(super) type Edge = [[usize; 2]; 2];

/// Returns the edges across which `inside` changes.
pub(super) fn crossed(size: [usize; 2], inside: &dyn Fn([usize; 2]) -> bool) -> Vec<Edge> {
    let nodes = (0..size[0]).flat_map(|column| (0..size[1]).map(move |row| [column, row]));
    let edges = nodes.flat_map(|[column, row]| [[column + 1, row], [column, row + 1]].map(|b| [[column, row], b]));
    edges.filter(|[_, b]| b[0] < size[0] && b[1] < size[1]).filter(|[a, b]| inside(*a) != inside(*b)).collect()
}

/// Joins the crossed edges of a grid whose border lies outside to closed lines, with the inside to their left.
///
/// The method is marching squares; of two opposite corners inside of a square, each is cut off by itself.
pub(super) fn loops(edges: &[Edge], inside: &dyn Fn([usize; 2]) -> bool) -> Vec<Vec<Edge>> {
    // Maps the edge through which a line enters a square to the edge through which it leaves.
    let mut next: BTreeMap<Edge, Edge> = BTreeMap::new();
    for [a, b] in edges {
        let across = [usize::from(a[0] == b[0]), usize::from(a[1] == b[1])];
        let below = (a[0] >= across[0] && a[1] >= across[1]).then(|| [a[0] - across[0], a[1] - across[1]]);
        // The squares on both sides. A line enters at the edge where, around the square, the inside ends.
        for square in below.into_iter().chain([*a]) {
            let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[x, y]| [square[0] + x, square[1] + y]);
            let at = (0..4).find(|k| {
                let side = [corners[*k], corners[(k + 1) % 4]];
                (side == [*a, *b] || side == [*b, *a]) && inside(side[0]) && !inside(side[1])
            });
            if let Some(at) = at {
                // It leaves at the edge where, back around the square, the inside began.
                let start = (1..4).map(|back| (at + 4 - back) % 4).find(|k| !inside(corners[*k]));
                let start = start.map_or([*a, *b], |k| [corners[k], corners[(k + 1) % 4]]);
                next.insert([*a, *b], if start[0] <= start[1] { start } else { [start[1], start[0]] });
            }
        }
    }
    let mut found = Vec::new();
    while let Some((first, mut edge)) = next.pop_first() {
        let mut line = vec![first];
        while edge != first {
            line.push(edge);
            match next.remove(&edge) {
                Some(after) => edge = after,
                None => break,
            }
        }
        found.push(line);
    }
    found
}

#[cfg(test)]
#[path = "tests/contour.rs"]
mod tests;
