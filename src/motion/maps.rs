//! Conversion of structs of numbers to other numbers.

/// Gives a struct its method `map`, which converts the numbers in braces. Fields after `maps` hold numbers inside, such
/// as options and arrays, and have a method `map` of their own; those after `lists` are lists of such structs, and
/// those after `keeps` hold no numbers.
macro_rules! maps {
    (
        $visibility:vis $type:ident { $($number:ident),* }
        $(maps $($inner:ident),+)? $(lists $($list:ident),+)? $(keeps $($other:ident),+)?
    ) => {
        impl<S> $type<S> {
            #[doc = concat!("Converts the [`", stringify!($type), "`] to other numbers.")]
            $visibility fn map<T>(self, f: impl Fn(S) -> T) -> $type<T> {
                $type {
                    $($number: f(self.$number),)*
                    $($($inner: self.$inner.map(&f),)+)?
                    $($($list: self.$list.into_iter().map(|item| item.map(&f)).collect(),)+)?
                    $($($other: self.$other,)+)?
                }
            }
        }
    };
}

pub(crate) use maps;
