use super::ascending;

#[test]
fn items_of_equal_keys_stay_in_order() {
    let words = vec!["bb", "a", "cc", "", "d", "aa"];
    assert_eq!(ascending(words, |word| word.len() as f64), ["", "a", "d", "bb", "cc", "aa"]);
}
