//! Suggestions for words that no scene has.

use crate::names::nearest;
use crate::problem::Parameter;

/// Words for the keys that are no parameters, in lower case.
const SYNONYMS: &[(&str, &[&str])] = &[
    ("title", &["name", "description"]),
    ("rod", &["bar", "beam", "material", "geometry"]),
    ("impact", &["drop", "collision"]),
    ("start", &["initial", "initial_conditions"]),
    ("run", &["simulation", "solver"]),
    ("body", &["bodies", "bars", "rods"]),
    ("run.accuracy", &["tolerance", "tol", "precision"]),
];

/// Keys for damping of the material, which is not solved.
const MATERIAL_DAMPING: &[&str] =
    &["viscosity", "rayleigh_beta", "kelvin_voigt", "beta", "material_damping", "loss_factor", "eta"];

/// Returns what a message expects in place of a key that is refused by name.
pub(super) fn refused(key: &str) -> Option<&'static str> {
    if key == "impedance" {
        return Some(
            "modulus, density and area; a rod with a bottom or a [ground], and [[body]], may have an impedance",
        );
    }
    MATERIAL_DAMPING.contains(&&*key.to_lowercase().replace('-', "_")).then_some(
        "damping, the drag 2r v_t on the whole rod (Rayleigh α = 2r); damping of the material (Kelvin–Voigt, Rayleigh \
         β) has no characteristics and is not solved",
    )
}

const FIXED: &[&str] = &["clamped", "held", "built-in", "built in", "rigid", "pinned", "dirichlet"];
const FREE: &[&str] = &["open", "loose", "unclamped", "neumann"];

/// The key meant by `key` in the table of this name, in words: `modulus`, or `drop_height in [impact]`.
pub(super) fn key(key: &str, table: &str, known: &[&'static str]) -> Option<String> {
    if let Some(near) = nearest(key, known.iter().copied()) {
        return Some(near.into());
    }
    let word = key.to_lowercase().replace('-', "_").replace('\'', "");
    let meant = |(path, synonyms): &&(&str, &[&str])| {
        let name = path.rsplit('.').next();
        name == Some(&word) || synonyms.contains(&word.as_str())
    };
    // The table itself comes before others.
    let is_here = |path: &str| path.rsplit_once('.').map_or("", |(table, _)| table) == table;
    let parameters = Parameter::ALL.iter().map(|parameter| (parameter.path(), parameter.synonyms()));
    let known: Vec<(&str, &[&str])> = SYNONYMS.iter().copied().chain(parameters).collect();
    let found = known.iter().filter(meant).map(|(path, _)| *path);
    let path = found.clone().find(|path| is_here(path)).or_else(|| found.clone().next())?;
    Some(match path.split_once('.') {
        Some((other, key)) if other != table => format!("{key} in [{other}]"),
        Some((_, key)) => key.into(),
        None if path == "body" => "[[body]]".into(),
        None => format!("[{path}]"),
    })
}

pub(super) fn top(text: &str) -> Option<&'static str> {
    let word = text.trim().to_lowercase();
    let word = word.strip_suffix("end").unwrap_or(&word).trim();
    match word {
        _ if FIXED.contains(&word) => Some("fixed"),
        _ if FREE.contains(&word) => Some("free"),
        _ => nearest(word, ["fixed", "free"]),
    }
}
