/// The page on scene files has a row for each key, and for no other.
#[test]
fn the_page_on_scenes_has_every_key() {
    let page = include_str!("../../../docs/scenes.md");
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` |"));
    let listed: Vec<&str> = rows.map(|(key, _)| key).collect();
    let tables = super::TABLES;
    let mut known: Vec<String> =
        super::TOP_KEYS.iter().filter(|key| !tables.contains(key)).map(ToString::to_string).collect();
    for table in tables {
        known.extend(super::keys(table).iter().map(|key| format!("{table}.{key}")));
    }
    known.sort();
    let mut sorted = listed.clone();
    sorted.sort();
    assert_eq!(sorted, known);
}
