/// The page on scene files has a row for each key, and for no other.
#[test]
fn the_page_on_scenes_has_every_key() {
    let page = include_str!("../../../docs/scenes.md");
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` |"));
    let listed: Vec<&str> = rows.map(|(key, _)| key).collect();
    let tables = super::TABLES.map(|(name, _)| name);
    let mut known = Vec::new();
    for (table, keys) in super::TABLES {
        let path = |key: &&str| if table.is_empty() { key.to_string() } else { format!("{table}.{key}") };
        known.extend(keys.iter().filter(|key| !tables.contains(key)).map(path));
    }
    known.sort();
    let mut sorted = listed.clone();
    sorted.sort();
    assert_eq!(sorted, known);
}
