use super::*;

#[test]
fn median_and_quartiles() {
    let timing = Timing::from_samples(&mut [5.0, 1.0, 3.0, 2.0, 4.0]);
    assert_eq!(timing, Timing { seconds: 3.0, spread: Some(2.0), runs: 5 });
    assert_eq!(Timing::from_samples(&mut [7.0]), Timing { seconds: 7.0, spread: None, runs: 1 });
}
