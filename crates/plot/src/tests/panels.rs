use super::*;
use crate::draw::{Shape, Size};
use dalembert::problem::Problem;
use dalembert::quantity::Units;

/// Bars are as high as the coefficients are, and no text lies on the line at 1.
#[test]
fn a_single_bounce_is_bars_of_its_coefficients() {
    let pictures = vec![Picture::Restitution];
    let request = Request { pictures, ..Request::default() };
    let gathered = |speed: i64| {
        let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(speed).build().unwrap();
        request.gather(format!("{speed}"), Units::default(), &rod.doubles().unwrap()).unwrap()
    };
    let (mut bars, mut texts) = (0, 0);
    for speeds in [&[2][..], &[2, 7], &[2, 3, 40, 5]] {
        let scenes = speeds.iter().map(|speed| gathered(*speed)).collect::<Vec<_>>();
        let sheet = request.sheet(&scenes, Vec::new()).unwrap();
        let panel = &sheet.panels[0];
        let drawn = panel.layers.iter().filter_map(|layer| match &layer.shape {
            Shape::Areas(bars, _) => Some(bars),
            _ => None,
        });
        for (drawn, scene) in drawn.zip(&scenes) {
            for (bar, coefficient) in drawn.iter().zip(scene.restitution[0]) {
                assert_eq!(bar.iter().map(|corner| corner.y).fold(0.0, f64::max), coefficient.unwrap());
                bars += 1;
            }
        }
        // A text stands above the line at 1 or well below it.
        for layer in &panel.layers {
            if let Shape::Note { at, .. } = &layer.shape {
                assert!(at.y > 1.0 || at.y + 0.07 * (panel.y.to - panel.y.from) < 1.0, "{}", at.y);
                texts += 1;
            }
        }
        assert!(sheet.svg(Size::Slide).contains("(energy)"));
    }
    assert_eq!((bars, texts), (14, 4));
}
