//! Bisection with a test that may fail.

/// Returns the number of leading items of `list` that have `passed`, by bisection.
///
/// **Errors**: the first one of `passed`.
pub(crate) fn partition<T, E>(list: &[T], passed: impl Fn(&T) -> Result<bool, E>) -> Result<usize, E> {
    let (mut from, mut to) = (0, list.len());
    while from < to {
        let middle = (from + to) / 2;
        if passed(&list[middle])? { from = middle + 1 } else { to = middle }
    }
    Ok(from)
}
