use super::*;

/// A height y is drawn at 154 − 125 y: the rod is 1 high, and the ground is 46 above the lower edge.
#[test]
fn the_rod_and_the_bars_are_to_scale() {
    let picture = RodPicture { width: 100.0, height: 200.0, letters: 13.0, enlarged: None, color_limit: 1.0 };
    let extremes = RunExtremes { strain: 0.6, rise: 0.0, energy: [0.0, 2.0] };
    let mut state = State { strains: vec![0.0; PARTS + 1], end: 0.2, centre: 0.2, energy: [1.0, 0.5] };
    let svg = picture.svg(&state, &extremes, 1.0, false);
    for part in [
        "<path fill=\"#f7f7f7\" d=\"M4 4H22V129H4z\"/>",
        "x=\"4\" y=\"4\" width=\"18\" height=\"125\" fill=\"none\"",
        "<polyline points=\"4,66.5 22,66.5\"",
        "M67 84H79V154H67z",
        "M85 119H97V154H85z",
    ] {
        assert!(svg.contains(part), "{part} in {svg}");
    }
    // The lower half is compressed by a half: the rod is a quarter shorter and stands on the ground.
    state.strains[..=PARTS / 2].fill(-0.5);
    state.end = 0.0;
    let svg = picture.svg(&state, &extremes, 1.0, true);
    assert!(svg.contains(&format!("<path fill=\"{}\"", diverging(-0.5))), "{svg}");
    let height = svg.split("height=\"").nth(3).and_then(|rest| rest.split('"').next()).unwrap();
    // The part in the middle has the mean of both strains.
    let expected = 125.0 * (1.0 - 0.25 - 0.25 / PARTS as f64);
    assert!((height.parse::<f64>().unwrap() - expected).abs() < 0.011, "{height} {expected}");
    assert_eq!(svg.matches("<polyline").count(), 2 * 5 + 4, "two hatched lines, three of the centre, one of the bars");
}
