//! A number as it was written, before it is checked.

pub(crate) use crate::number::short;
use crate::number::{Number, NumberError, Rational, shortest};

/// A number as it was written: an integer, a text such as `"1/3"` or `"0.1"`, a [`Number`], or a double, which stands
/// for the shortest decimal that spells it: `0.1` is 1/10. A [`Rational`] too,
/// and with the feature `mp` a `rug::Integer`.
///
/// **Accuracy**: *exact*.
#[derive(Clone, Debug)]
pub struct Written {
    /// The text that messages show.
    pub(super) shown: String,
    pub(super) number: Result<Number, NumberError>,
}

impl Written {
    /// The number that `text` spells; messages show it as `shown`.
    pub(crate) fn new(text: &str, shown: &str) -> Self {
        Written { shown: short(shown), number: text.parse() }
    }

    /// The number that it spells.
    ///
    /// **Errors**: [`NumberError`] where it spells none.
    pub fn number(&self) -> Result<&Number, &NumberError> {
        self.number.as_ref()
    }
}

impl From<&str> for Written {
    fn from(text: &str) -> Self {
        Written::new(text, &format!("\"{text}\""))
    }
}

impl From<String> for Written {
    fn from(text: String) -> Self {
        text.as_str().into()
    }
}

impl From<Number> for Written {
    fn from(number: Number) -> Self {
        Written { shown: short(&number.to_string()), number: Ok(number) }
    }
}

impl From<f64> for Written {
    fn from(x: f64) -> Self {
        let text = shortest(x);
        Written::new(&text, &text)
    }
}

/// Types whose `Display` is the number itself.
macro_rules! written {
    ($($type:ty),*) => {$(
        impl From<$type> for Written {
            fn from(n: $type) -> Self {
                let text = n.to_string();
                Written::new(&text, &text)
            }
        }
    )*};
}

impl From<&Number> for Written {
    fn from(number: &Number) -> Self {
        number.clone().into()
    }
}

written!(i32, i64, u32, u64, usize, Rational);
#[cfg(feature = "mp")]
written!(rug::Integer);

/// Whether a text is a number followed by a word: `1 m`, `5 kg/m3`.
pub(crate) fn has_unit(text: &str) -> bool {
    let is_word = |c: char| c.is_alphabetic() || c == '%';
    // A prefix such as `1e2` of `1e2 m` holds a letter: the number is the longest prefix that spells one.
    let number = text.char_indices().map(|(i, _)| i).take(60).filter(|i| text[..*i].parse::<Number>().is_ok()).last();
    number.is_some_and(|end| {
        let (number, word) = (text[..end].trim(), &text[end..]);
        let other_base = number == "0" && word.starts_with(['x', 'o', 'b']);
        let open_exponent = word.trim_end_matches(['+', '-']).eq_ignore_ascii_case("e");
        word.starts_with(is_word) && !other_base && !open_exponent
    })
}
