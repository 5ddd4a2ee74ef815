use super::*;
use crate::draw::{Shape, Size};
use dalembert::problem::Problem;
use dalembert::quantity::Units;

/// Bars are as high as the coefficients, and no text is on the line at 1.
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
        let drawn = panel.layers.iter().filter_map(|(_, shape)| match shape {
            Shape::Areas(bars, _) => Some(bars),
            _ => None,
        });
        for (drawn, scene) in drawn.zip(&scenes) {
            for (bar, coefficient) in drawn.iter().zip(scene.restitution[0]) {
                assert_eq!(bar.iter().map(|corner| corner.y).fold(0.0, f64::max), coefficient.unwrap());
                bars += 1;
            }
        }
        // A text is above the line at 1 or well below it.
        for (_, shape) in &panel.layers {
            if let Shape::Note { at, .. } = shape {
                assert!(at.y > 1.0 || at.y + 0.07 * (panel.y.to - panel.y.from) < 1.0, "{}", at.y);
                texts += 1;
            }
        }
        assert!(sheet.svg(Size::Slide).contains("(energy)"));
    }
    assert_eq!((bars, texts), (14, 4));
}

/// Dashed rays have a key, and a title says if bounces are left out.
#[test]
fn dashes_and_omissions_are_explained() {
    let request = Request { pictures: vec![Picture::SpaceTime, Picture::Restitution], ..Request::default() };
    let rod = Problem::builder().length("1/2").wave_speed(1).impact_speed(1).damping("13/5").build().unwrap();
    let mut scene = request.gather("rod".into(), Units::default(), &rod.doubles().unwrap()).unwrap();
    assert_eq!(scene.field.as_ref().unwrap().rays.iter().filter(|ray| !ray.jump).count(), 1);
    scene.restitution.push([Some(0.5), None]);
    scene.all_contacts = 500;
    let sheet = request.sheet(&[scene], Vec::new()).unwrap();
    let svg = sheet.svg(Size::Page);
    assert!(svg.contains(">kink<"), "{svg}");
    assert_eq!(sheet.panels[1].title, "restitution of the first 2 of 500 bounces");
}
