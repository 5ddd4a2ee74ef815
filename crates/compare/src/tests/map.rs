use super::*;

fn names(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_string).collect()
}

#[test]
fn names_and_numbers() {
    let u = Quantity::EndDisplacement;
    let map = ColumnMap::new(Some("t=0, u=2,force=lam"), &names("time lam disp"), 3, false).unwrap();
    assert_eq!(map.columns, [(Quantity::Time, 0), (u, 2), (Quantity::Force, 1)]);
    // The names of a header, and what is none of ours left alone.
    let map = ColumnMap::new(None, &names("step t u"), 3, false).unwrap();
    assert_eq!(map.columns, [(Quantity::Time, 1), (u, 2)]);
    // With points, u is that there.
    let map = ColumnMap::new(None, &names("t x u"), 3, false).unwrap();
    assert_eq!(map.columns, [(Quantity::Time, 0), (Quantity::Point, 1), (Quantity::PointDisplacement, 2)]);
}

#[test]
fn what_is_refused() {
    let of = |text: Option<&str>, header: &str, counted| ColumnMap::new(text, &names(header), 3, counted).unwrap_err();
    assert_eq!(of(None, "", false), MapError::NoNames);
    assert_eq!(of(Some("u=1"), "", false), MapError::NoTime { found: String::new() });
    assert_eq!(of(Some("t=0,u=1"), "", true), MapError::TwoTimes);
    assert_eq!(of(Some("t=0,u"), "", false), MapError::Form { found: "u".into() });
    assert_eq!(of(Some("t=0,w=1"), "", false), MapError::Name { found: "w".into(), field: false });
    assert_eq!(of(Some("t=0,u=1,u_end=2"), "", false), MapError::Twice { found: "u_end".into() });
    assert_eq!(of(Some("t=0,u=3"), "", false), MapError::Column { found: "3".into(), expected: "0 to 2".into() });
    assert_eq!(of(None, "t a b", false), MapError::Nothing { found: "t, a, b".into(), field: false });
    assert_eq!(of(None, "t x force", false), MapError::Nothing { found: "t, x, force".into(), field: true });
    assert_eq!(of(None, "t time u", false), MapError::Twice { found: "time".into() });
    // One name twice; of two names of one quantity, the first is taken.
    assert_eq!(of(None, "t u_end U_end", false), MapError::Twice { found: "U_end".into() });
    assert_eq!(ColumnMap::new(None, &names("t u_end u"), 3, false).unwrap().unused, ["u"]);
}
