//! Reading scenes: standard input, files and built-in scenes.

use std::io::Read;
use std::path::Path;

use crate::failure::{Failure, cannot};
use dalembert::{ChainScene, Scene, builtin};

/// Most bytes that are read of a scene: one more than a scene may have.
const MAX_BYTES: u64 = (16 << 20) + 1;
/// Least similarity, by Jaro and Winkler, of a name that is suggested.
const MIN_SIMILARITY: f64 = 0.8;

/// A scene of either kind.
pub(crate) enum AnyScene {
    /// A single rod.
    Rod(Box<Scene>),
    /// Several bodies.
    Chain(Box<ChainScene>),
}

impl AnyScene {
    /// Returns the single rod, or the body of the chain counted from 1 at the bottom; `name` is that of the scene.
    ///
    /// **Errors**: also for a chain of several bodies of which none is chosen, and for a body that is not there.
    pub(crate) fn into_rod(self, name: &str, body: Option<usize>) -> Result<Scene, Failure> {
        match (self, body) {
            (Self::Rod(scene), None | Some(1)) => Ok(*scene),
            (Self::Rod(_), Some(body)) => Err(failure!("found --body {body} of `{name}`, expected 1: it has one rod")),
            (Self::Chain(scene), body) => match (body, scene.chain.bodies().len()) {
                (Some(body), count) if body == 0 || body > count => {
                    Err(failure!("found --body {body} of `{name}`, expected a body from 1, the lowest, to {count}"))
                }
                (Some(_), _) | (None, 1) => Ok(scene.body(body.unwrap_or(1) - 1)?),
                (None, count) => {
                    let failure = failure!("found {count} bodies in `{name}`, expected one of them to be chosen");
                    Err(failure.help(format!("--body N, from 1, the lowest, to {count}, takes a body as a rod")))
                }
            },
        }
    }
}

/// Returns the scene called `name`: `-` for standard input, a file, or a built-in scene.
pub(crate) fn read(name: &str) -> Result<AnyScene, Failure> {
    let path = Path::new(name);
    let builtin = builtin::get(name).filter(|_| !path.is_file());
    let (shown, text) = if name == "-" {
        ("standard input", read_text(std::io::stdin(), "standard input")?)
    } else if let Some(builtin) = builtin {
        (name, builtin.source.to_string())
    } else if path.is_dir() {
        let failure = failure!("found the folder `{name}` as a scene");
        return Err(failure
            .help("expected a scene file in it, such as `FOLDER/rod.toml`, or a name that `dalembert scenes` lists"));
    } else if path.exists() {
        let file = std::fs::File::open(name).map_err(cannot(&format!("open {name}")))?;
        (name, read_text(file, name)?)
    } else {
        let suggestion = nearest_scene(name).map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        let expected = "a scene file, `-` for standard input, or a name that `dalembert scenes` lists";
        let failure = failure!("found no file and no built-in scene called `{name}`");
        return Err(failure.help(format!("expected {expected}{suggestion}")));
    };
    let scene = match ChainScene::is_chain(&text) {
        true => ChainScene::parse(&text).map(|scene| AnyScene::Chain(Box::new(scene))),
        false => Scene::parse(&text).map(|scene| AnyScene::Rod(Box::new(scene))),
    };
    scene.map_err(|error| Failure::in_file(error, shown))
}

fn read_text(from: impl Read, name: &str) -> Result<String, Failure> {
    let mut text = String::new();
    from.take(MAX_BYTES).read_to_string(&mut text).map_err(cannot(&format!("read {name}")))?;
    Ok(text)
}

/// Returns the scene file or built-in scene whose name is closest to `name`, if one is close.
pub(crate) fn nearest_scene(name: &str) -> Option<String> {
    let with_ending = format!("{name}.toml");
    if Path::new(&with_ending).is_file() {
        return Some(with_ending);
    }
    let folder = Path::new(name).parent().unwrap_or(Path::new(""));
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let files = std::fs::read_dir(here).into_iter().flatten().filter_map(|entry| {
        let path = folder.join(entry.ok()?.file_name());
        let is_scene = path.extension().is_some_and(|extension| extension == "toml");
        Some(path.display().to_string()).filter(|_| is_scene)
    });
    let builtin = builtin::ALL.iter().chain(builtin::CHAINS).map(|scene| scene.name.to_string());
    let mut known: Vec<String> = builtin.chain(files).collect();
    known.sort();
    nearest(name, known.iter().map(String::as_str)).map(str::to_string)
}

/// Returns the known name that is spelled most like `name`, if one is close.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = name.to_lowercase();
    let scored = known.into_iter().map(|known| (strsim::jaro_winkler(&name, &known.to_lowercase()), known));
    let near = scored.filter(|(score, _)| *score >= MIN_SIMILARITY);
    near.max_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, known)| known)
}
