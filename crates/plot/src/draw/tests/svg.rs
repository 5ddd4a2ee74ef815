use super::*;

#[test]
fn texts_and_lengths() {
    assert_eq!([1.0, -0.001, 12.345, 0.1].map(length), ["1", "0", "12.35", "0.1"]);
    let low = |text: &str| parts(text).into_iter().map(|(part, low)| format!("{part}{low}")).collect::<String>();
    assert_eq!(low("v_x(0,t)"), "vfalsextrue(0,t)false");
    assert_eq!(low("t_{12}"), "tfalse12true");
    assert_eq!(low(&plain("my_rod")), "my_rodfalse");
    let mut svg = Svg::new(10.0, 10.0, 3.0);
    svg.text(DVec2::ZERO, Anchor::Start, "E_h < 1");
    assert!(svg.finish().contains(">E<tspan dy=\"0.54\" font-size=\"2.16\">h</tspan><tspan dy=\"-0.54\"> &lt; 1<"));
}
