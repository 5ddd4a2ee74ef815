use super::*;

/// Each line is closed, its steps are within squares, and by the crossing numbers of random pictures it parts what is
/// inside from what is not.
#[test]
fn loops_part_what_is_inside_from_what_is_not() {
    let (size, mut state, mut compared) = ([14, 11], 1u64, 0);
    for _ in 0..60 {
        let mut picture = vec![false; size[0] * size[1]];
        for (k, cell) in picture.iter_mut().enumerate() {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let (column, row) = (k / size[1], k % size[1]);
            let border = column == 0 || row == 0 || column + 1 == size[0] || row + 1 == size[1];
            *cell = !border && state >> 62 != 0;
        }
        let inside = |[column, row]: [usize; 2]| picture[column * size[1] + row];
        let edges = crossed(size, &inside);
        let lines = loops(&edges, &inside);
        assert_eq!(lines.iter().map(Vec::len).sum::<usize>(), edges.len());
        let middle = |[a, b]: &Edge| [a[0] + b[0], a[1] + b[1]].map(|twice| twice as f64 / 2.0);
        for line in &lines {
            for k in 0..line.len() {
                let [from, to] = [k, (k + 1) % line.len()].map(|k| middle(&line[k]));
                assert!((from[0] - to[0]).abs() <= 1.0 && (from[1] - to[1]).abs() <= 1.0, "{from:?} {to:?}");
            }
        }
        for column in 0..size[0] {
            for row in 0..size[1] {
                // Lines to the right of a node, at a height at which no point of a line lies.
                let height = row as f64 + 1e-3;
                let mut winding = 0;
                for line in &lines {
                    for k in 0..line.len() {
                        let [from, to] = [k, (k + 1) % line.len()].map(|k| middle(&line[k]));
                        let share = (height - from[1]) / (to[1] - from[1]);
                        let right = from[0] + share * (to[0] - from[0]) > column as f64;
                        let upwards = [from[1] < height && to[1] > height, to[1] < height && from[1] > height];
                        winding += if right { i32::from(upwards[0]) - i32::from(upwards[1]) } else { 0 };
                    }
                }
                assert_eq!(winding, i32::from(inside([column, row])), "at {column}, {row}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 60 * 14 * 11);
}
