use super::*;

#[test]
fn units_have_prefixes_and_ticks_are_round() {
    let texts = |axis: &Axis| axis.ticks(5.0).into_iter().map(|tick| tick.1).collect();
    let axis = Axis::new("t", "s", [0.0, 1.2e-3]);
    assert_eq!((axis.label.as_str(), texts(&axis)), ("t [ms]", ["0.0", "0.5", "1.0"].map(String::from).to_vec()));
    let axis = Axis::new("E v_x", "Pa", [-4.1e7, 0.0]);
    assert_eq!(axis.label, "E v_x [MPa]");
    assert_eq!(texts(&axis), ["−40", "−30", "−20", "−10", "0"]);
    assert_eq!(Axis::new("u", "in", [0.0, 2e-3]).label, "u [10⁻³ in]");
    assert_eq!(Axis::new("u", "", [0.0, 2e-3]).label, "u [10⁻³]");
    assert_eq!(Axis::new("u", "", [0.0, 3.0]).label, "u");
    assert_eq!(texts(&Axis::log("M", [0.1, 20.0])), ["0.1", "0.2", "0.5", "1", "2", "5", "10", "20"]);
    assert_eq!(texts(&Axis::log("M", [0.5, 2e4])), ["10⁰", "10¹", "10²", "10³", "10⁴"]);
    assert_eq!(power_of_ten(-15), "10⁻¹⁵");
    // A constant value is in the middle of its axis.
    let axis = Axis::new("E", "J", Axis::range([2.0, 2.0].into_iter(), false));
    assert!((axis.share(2.0) - 0.5).abs() < 1e-12);
}
