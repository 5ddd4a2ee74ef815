use super::*;

fn values(text: &str) -> Vec<String> {
    text.parse::<Axis>().unwrap().values.iter().map(Number::to_string).collect()
}

#[test]
fn values_are_spelt_as_a_person_would() {
    assert_eq!(values("rod.damping=0, 0.1,1/3"), ["0", "0.1", "1/3"]);
    assert_eq!(values("impact.speed=0.1..0.5:5"), ["0.1", "0.2", "0.3", "0.4", "0.5"]);
    assert_eq!(values("impact.speed=1e-2..100:5:log"), ["1e-2", "0.1", "1", "10", "100"]);
    assert_eq!(values("rod.length=2..1/3:2"), ["2", "1/3"]);
}

#[test]
fn what_is_no_axis_is_said() {
    let said = |text: &str| text.parse::<Axis>().unwrap_err().to_string();
    let unknown = said("rod.dampin=1");
    assert!(unknown.starts_with("found the parameter `rod.dampin`, expected one of"), "{unknown}");
    assert!(unknown.ends_with("(did you mean rod.damping?)"), "{unknown}");
    assert!(said("rod.damping").contains("expected PATH=V1,V2"));
    assert!(said("rod.damping=0..1:1").contains("a count of 2"));
    assert!(said("rod.damping=0..1:5:log").contains("above zero"));
    assert!(said("rod.damping=1 m").contains("found `1 m`, expected a number such as"));
}

#[test]
fn the_last_axis_varies_fastest() {
    let axes = ["rod.damping=1,2", "impact.speed=3,4,5"].map(|text| text.parse().unwrap());
    let rod = Problem::uniform(1.into(), 1.into(), 1.into(), 1.into());
    let grid = Grid::new(axes.into()).unwrap();
    assert_eq!(grid.len(), 6);
    let values = |k| grid.values(k).iter().map(|(_, x)| x.to_f64()).collect();
    assert_eq!((values(0), values(2), values(3)), (vec![1.0, 3.0], vec![1.0, 5.0], vec![2.0, 3.0]));
    assert_eq!(grid.problem(&rod, 5).unwrap().damping().unwrap().to_f64(), 2.0);
}
