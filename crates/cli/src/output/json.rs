//! Numbers as JSON values.

use dalembert::number::{DOUBLE_DIGITS, Scalar, bound_of_log2, double_bound, show, shown_bound};

/// A number that carries its bound as a JSON value: a number for a double (null if not finite),
/// `{"value": …, "lo": …, "hi": …}` with `lo ≤ truth ≤ hi` for an enclosure, a string otherwise.
pub(crate) fn number_json<S: Scalar>(x: &S, digits: u32) -> serde_json::Value {
    let text = show(x, if digits == 0 { DOUBLE_DIGITS } else { digits });
    match (x.as_double(), x.ends(digits)) {
        (Some(value), _) if !value.is_finite() => serde_json::Value::Null,
        (Some(_), _) if text == "0" => 0.0.into(),
        (Some(value), _) => value.into(),
        (None, Some([lo, hi])) => serde_json::json!({"value": text, "lo": lo, "hi": hi}),
        (None, None) => text.into(),
    }
}

/// The bound of the error of a number as it is printed, as a JSON value: a number where a double holds it, a string
/// otherwise; `null` for an enclosure, which has it in itself.
pub(crate) fn bound_json<S: Scalar>(x: &S, digits: u32) -> serde_json::Value {
    if x.ends(1).is_some() {
        return serde_json::Value::Null;
    }
    let log2 = match x.as_double() {
        Some(_) if show(x, DOUBLE_DIGITS) != "0" => double_bound(x),
        _ => shown_bound(x, if digits == 0 { DOUBLE_DIGITS } else { digits }),
    };
    let text = bound_of_log2(log2);
    match text.parse::<f64>() {
        Ok(bound) if bound > 0.0 || text == "0" => bound.into(),
        _ => text.into(),
    }
}
