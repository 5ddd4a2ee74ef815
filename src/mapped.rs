//! Lists made item by item. `Iterator::collect` is compiled as five functions or more for each chain of adapters; these
//! are one loop.

/// As [`Iterator::collect`] into a `Vec`.
pub(crate) trait CollectVec: Iterator + Sized {
    /// The items as a list.
    fn collect_vec(self) -> Vec<Self::Item> {
        let mut found = Vec::new();
        for item in self {
            found.push(item);
        }
        found
    }
}

impl<I: Iterator> CollectVec for I {}

/// `f` of each item, in a loop that all closures share.
pub(crate) fn mapped<I: IntoIterator, U>(items: I, mut f: impl FnMut(I::Item) -> U) -> Vec<U> {
    list(items.into_iter(), &mut f)
}

/// `f` of each item, up to the first error.
pub(crate) fn try_mapped<I: IntoIterator, U, E>(
    items: I,
    mut f: impl FnMut(I::Item) -> Result<U, E>,
) -> Result<Vec<U>, E> {
    try_list(items.into_iter(), &mut f)
}

fn list<I: Iterator, U>(items: I, f: &mut dyn FnMut(I::Item) -> U) -> Vec<U> {
    let mut found = Vec::new();
    for item in items {
        found.push(f(item));
    }
    found
}

fn try_list<I: Iterator, U, E>(items: I, f: &mut dyn FnMut(I::Item) -> Result<U, E>) -> Result<Vec<U>, E> {
    let mut found = Vec::new();
    for item in items {
        found.push(f(item)?);
    }
    Ok(found)
}

/// As `map` of an array, which is compiled as seven functions for each closure.
pub(crate) trait MapEach<T, const N: usize> {
    /// `f` of each item.
    fn map_each<U>(self, f: impl FnMut(T) -> U) -> [U; N];
}

macro_rules! map_each {
    ($($n:literal: $($item:ident)*;)*) => {$(
        impl<T> MapEach<T, $n> for [T; $n] {
            fn map_each<U>(self, mut f: impl FnMut(T) -> U) -> [U; $n] {
                let [$($item),*] = self;
                [$(f($item)),*]
            }
        }
    )*};
}
map_each! {
    2: a b;
    3: a b c;
    4: a b c d;
    5: a b c d e;
    7: a b c d e f g;
}
