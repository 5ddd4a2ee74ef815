//! Lists in order.

/// The items in ascending order of `key`; those of equal keys stay as they are.
pub(crate) fn ascending<T>(items: Vec<T>, key: impl Fn(&T) -> f64) -> Vec<T> {
    let mut order: Vec<(f64, usize)> = Vec::with_capacity(items.len());
    for (place, item) in items.iter().enumerate() {
        order.push((key(item), place));
    }
    sort(&mut order);
    let mut items: Vec<Option<T>> = items.into_iter().map(Some).collect();
    let mut sorted = Vec::with_capacity(items.len());
    for (_, place) in order {
        sorted.extend(items[place].take());
    }
    sorted
}

/// How many items of a list have `passed`, which are the first of it: by bisection, up to the first error.
pub(crate) fn partition<T, E>(list: &[T], passed: impl Fn(&T) -> Result<bool, E>) -> Result<usize, E> {
    let (mut from, mut to) = (0, list.len());
    while from < to {
        let middle = (from + to) / 2;
        if passed(&list[middle])? { from = middle + 1 } else { to = middle }
    }
    Ok(from)
}

fn sort(order: &mut [(f64, usize)]) {
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
}

#[cfg(test)]
#[path = "tests/order.rs"]
mod tests;
