//! Colours that readers with any kind of colour vision can tell apart.

/// Colours of lines, after Okabe and Ito, the darker ones first.
pub const LINES: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

/// Light colours of stacked areas, under black lines.
pub(crate) const AREAS: [&str; 3] = ["#a5d9c8", "#7fb8d8", "#f0a860"];

/// ColorBrewer's palette from blue over white to red, for values from −1 to 1 in equal steps.
const DIVERGING: [u32; 11] =
    [0x053061, 0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7, 0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b, 0x67001f];

/// Returns the colour of a value from −1 to 1; values beyond have the colour of the nearer end.
pub(crate) fn diverging(value: f64) -> String {
    let last = DIVERGING.len() - 1;
    let place = (value.clamp(-1.0, 1.0) + 1.0) / 2.0 * last as f64;
    let below = (place.floor() as usize).min(last - 1);
    let share = place - below as f64;
    let mix = |bits: u32| {
        let [a, b] = [below, below + 1].map(|color| f64::from((DIVERGING[color] >> bits) & 0xff));
        (a + (b - a) * share).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", mix(16), mix(8), mix(0))
}

/// Returns the stops of a gradient from one value to another: shares of the way, in order, and their colours. Between
/// two stops the palette is linear.
pub(super) fn diverging_stops(from: f64, to: f64) -> Vec<(f64, String)> {
    let last = DIVERGING.len() as i32 - 1;
    let inner = (0..=last).map(|k| 2.0 * f64::from(k) / f64::from(last) - 1.0);
    let mut shares: Vec<f64> = inner.map(|value| (value - from) / (to - from)).collect();
    shares.retain(|share| *share > 1e-4 && *share < 1.0 - 1e-4);
    shares.extend([0.0, 1.0]);
    shares.sort_by(f64::total_cmp);
    shares.into_iter().map(|share| (share, diverging(from + (to - from) * share))).collect()
}

#[cfg(test)]
#[path = "tests/color.rs"]
mod tests;
