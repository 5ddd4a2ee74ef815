//! Where a map changes: closed lines about what is up to a level.

use std::collections::BTreeMap;

/// Two neighbours on a grid, from the one that is nearer to its origin: columns and rows.
pub type Edge = [[usize; 2]; 2];

/// The edges across which `inside` changes.
pub fn crossed(size: [usize; 2], inside: &dyn Fn([usize; 2]) -> bool) -> Vec<Edge> {
    let nodes = (0..size[0]).flat_map(|column| (0..size[1]).map(move |row| [column, row]));
    let edges = nodes.flat_map(|[column, row]| [[column + 1, row], [column, row + 1]].map(|b| [[column, row], b]));
    edges.filter(|[_, b]| b[0] < size[0] && b[1] < size[1]).filter(|[a, b]| inside(*a) != inside(*b)).collect()
}

/// Closed lines through the crossed edges of a grid whose border lies outside, as lists of edges: what is inside lies
/// to their left. Marching squares; where two opposite corners of a square are inside, each is cut off by itself.
pub fn loops(edges: &[Edge], inside: &dyn Fn([usize; 2]) -> bool) -> Vec<Vec<Edge>> {
    // Of each edge through which a line comes into a square: that through which it leaves it.
    let mut next: BTreeMap<Edge, Edge> = BTreeMap::new();
    for [a, b] in edges {
        let across = [usize::from(a[0] == b[0]), usize::from(a[1] == b[1])];
        let below = (a[0] >= across[0] && a[1] >= across[1]).then(|| [a[0] - across[0], a[1] - across[1]]);
        // The squares on both sides. A line comes in where, about the square, what is inside ends.
        for square in below.into_iter().chain([*a]) {
            let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[x, y]| [square[0] + x, square[1] + y]);
            let at = (0..4).find(|k| {
                let side = [corners[*k], corners[(k + 1) % 4]];
                (side == [*a, *b] || side == [*b, *a]) && inside(side[0]) && !inside(side[1])
            });
            if let Some(at) = at {
                // Back along the border to where what is inside began.
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
