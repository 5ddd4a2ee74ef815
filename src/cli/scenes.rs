//! `dalembert scenes`.

use clap::Args;

use super::{Failure, source};
use crate::output::{table, write_whole};
use crate::scene::builtin;

/// List the built-in scenes, or print one
#[derive(Args, Debug)]
pub(super) struct Scenes {
    /// The scene to print
    name: Option<String>,
}

impl Scenes {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let text = match &self.name {
            None => {
                let rows = builtin::ALL.iter().map(|scene| vec![scene.name.to_string(), scene.summary.to_string()]);
                table(&["scene", "what it shows"], rows.collect(), 2) + "\n"
            }
            Some(name) => match builtin::get(name) {
                Some(scene) => scene.source.to_string(),
                None => {
                    return Err(miette::miette!(
                        help = "expected one of the names that `dalembert scenes` lists",
                        "found no built-in scene called `{name}`"
                    ));
                }
            },
        };
        Ok(write_whole(None, text.as_bytes()).map_err(source::cannot("write to standard output"))?)
    }
}
