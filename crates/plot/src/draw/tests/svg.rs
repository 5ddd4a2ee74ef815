use super::*;

#[test]
fn texts_and_lengths() {
    assert_eq!([1.0, -0.001, 12.345, 0.1].map(length), ["1", "0", "12.35", "0.1"]);
    let parts_of =
        |text: &str| parts(text).into_iter().map(|(part, subscript)| format!("{part}{subscript}")).collect::<String>();
    assert_eq!(parts_of("v_x(0,t)"), "vfalsextrue(0,t)false");
    assert_eq!(parts_of("t_{12}"), "tfalse12true");
    assert_eq!(parts_of(&without_subscripts("my_rod")), "my_rodfalse");
    let mut svg = Svg::new(10.0, 10.0, 3.0);
    svg.text(DVec2::ZERO, Anchor::Start, "E_h < 1");
    assert!(svg.finish().contains(">E<tspan dy=\"0.54\" font-size=\"2.16\">h</tspan><tspan dy=\"-0.54\"> &lt; 1<"));
}
