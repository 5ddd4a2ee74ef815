use super::*;
use crate::sweep::PointNumber;

#[test]
fn a_journal_cut_anywhere_gives_back_what_was_whole_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("sweep.csv");
    let sweep = serde_json::json!({"scene": "μ", "points": [0, 3]});
    let cell = |x: f64| PointNumber { value: x.into(), uncertainty: 1e-17.into(), note: None };
    let point = |index| Point {
        index,
        numbers: vec![cell(0.1 + index as f64), PointNumber { note: Some("none".into()), ..PointNumber::default() }],
    };
    let all: Vec<Point> = [2, 0, 1].map(point).into();
    let (journal, known) = Journal::open(&output, &sweep, false).unwrap();
    assert!(known.is_empty());
    all.iter().for_each(|point| journal.add(point).unwrap());
    let whole = std::fs::read(journal_path(&output)).unwrap();
    for end in 0..=whole.len() {
        std::fs::write(journal_path(&output), &whole[..end]).unwrap();
        let (journal, known) = Journal::open(&output, &sweep, true).unwrap();
        let lines = whole[..end].iter().filter(|byte| **byte == b'\n').count();
        assert_eq!(known, all[..lines.saturating_sub(1)]);
        all[known.len()..].iter().for_each(|point| journal.add(point).unwrap());
        assert_eq!(std::fs::read(journal_path(&output)).unwrap(), whole);
    }
    let refused = |sweep: &Value, resume| Journal::open(&output, sweep, resume).unwrap_err().kind();
    assert_eq!(refused(&sweep, false), ErrorKind::AlreadyExists);
    assert_eq!(refused(&serde_json::json!({}), true), ErrorKind::InvalidData);
    let (journal, known) = Journal::open(&output, &sweep, true).unwrap();
    assert_eq!(known, all);
    journal.remove().unwrap();
    assert!(!journal_path(&output).exists());
}
