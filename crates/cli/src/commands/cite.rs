//! `dalembert cite`.

use clap::Args;

use crate::args::{NumberArgs, OutputArgs, known_formats};
use crate::failure::Failure;
use crate::file::{Format, write_all};
use crate::output::Reference;
use crate::source::{self, AnyScene};
use dalembert::solve::{Engine, Numbers, Plan, Question};
use dalembert::{Publication, Published, builtin};

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
#[command(
    after_help = "Examples:\n  dalembert cite code-aster-sdnv100\n  dalembert cite rod.toml --digits 30 -o run.bib\n\n\
    The references are the program, the paper whose system it solves, libraries that the numbers need, and the sources \
    of the scene, its [publication], and of its [[target]]s."
)]
pub(crate) struct Cite {
    /// A scene file, `-`, or a built-in scene
    scene: String,
    #[command(flatten)]
    numbers: NumberArgs,
    #[command(flatten)]
    output: OutputArgs,
}

const FORMATS: &[Format] = &[Format::Table, Format::Bibtex];

fn some(text: &str) -> Option<String> {
    Some(text.to_string())
}

impl Cite {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let destinations = self.output.destinations(FORMATS)?;
        let references = self.references()?;
        write_all(&destinations, |format| {
            let entries = || references.iter().map(Reference::bibtex).collect::<Vec<_>>().join("\n");
            Ok(match format {
                Format::Bibtex => entries().into_bytes(),
                _ => {
                    let texts: Vec<String> = references.iter().map(Reference::text).collect();
                    format!("{}\n\n{}", texts.join("\n"), entries()).into_bytes()
                }
            })
        })
    }

    fn references(&self) -> Result<Vec<Reference>, Failure> {
        let scene = source::read(&self.scene)?;
        let (method, is_paper, numbers, publication, targets) = match &scene {
            AnyScene::Rod(scene) => {
                let plan = Plan::of(&scene.problem, &Question::run(self.numbers.numbers_to(scene.accuracy)))?;
                let method = format!("engine: {}", plan.engine);
                let targets: Vec<&Published> = scene.targets.iter().map(|target| &target.published).collect();
                (method, plan.engine != Engine::Chain, plan.numbers, &scene.publication, targets)
            }
            AnyScene::Chain(scene) => {
                let of_bodies = scene.targets.iter().map(|(_, target)| &target.published);
                let targets = of_bodies.chain(scene.chain_targets.iter().map(|target| &target.published)).collect();
                let method = "engine: a chain, from node to node".to_string();
                (method, false, self.numbers.numbers_to(scene.accuracy), &scene.publication, targets)
            }
        };
        let name = self.scene.as_str();
        let kind = if builtin::names().chain(builtin::CHAINS.iter().map(|scene| scene.name)).any(|known| known == name)
        {
            "built-in scene"
        } else {
            "scene"
        };
        let mut references = vec![Reference {
            key: "dalembert".into(),
            kind: "misc",
            publication: Publication {
                author: some("The dalembert developers"),
                title: some("dalembert: exact reference solutions for the bouncing elastic rod"),
                publisher: some(concat!("version ", env!("CARGO_PKG_VERSION"))),
                ..Publication::default()
            },
            note: format!("{kind} {name}, {numbers}, {method}"),
        }];
        if is_paper {
            references.push(paper());
        }
        references.extend(libraries(numbers));
        let key: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        if let Some(publication) = publication {
            references.push(Reference {
                key: key.clone(),
                kind: if publication.journal.is_some() { "article" } else { "misc" },
                publication: publication.clone(),
                note: "source of the scene".into(),
            });
        }
        let mut sources: Vec<&str> = targets.into_iter().map(|target| target.source.as_str()).collect();
        let mut seen = std::collections::HashSet::new();
        sources.retain(|source| seen.insert(*source));
        references.extend(sources.into_iter().zip(1..).map(|(source, number)| Reference {
            key: format!("{key}-value-{number}"),
            kind: "misc",
            publication: Publication { title: some(source), ..Publication::default() },
            note: "source of a published value".into(),
        }));
        Ok(references)
    }
}

/// Returns the paper whose system is solved.
fn paper() -> Reference {
    Reference {
        key: "wang-hansen-2016".into(),
        kind: "techreport",
        publication: Publication {
            author: some("F. Wang and S. W. Hansen"),
            title: some("Explicit solutions and coefficient of restitution for an elastic rod with viscous damping"),
            publisher: some(
                "Institute for Mathematics and its Applications, University of Minnesota, IMA Preprint 2473",
            ),
            year: some("2016"),
            ..Publication::default()
        },
        note: "the system that is solved".into(),
    }
}

/// Returns the libraries of long numbers, where the build has them and the answer calls for them.
fn libraries(numbers: Numbers) -> Vec<Reference> {
    let is_long = !matches!(numbers, Numbers::Double(_));
    if !cfg!(feature = "mp") || !is_long {
        return Vec::new();
    }
    vec![Reference {
        key: "mpfr".into(),
        kind: "article",
        publication: Publication {
            author: some("L. Fousse and G. Hanrot and V. Lefèvre and P. Pélissier and P. Zimmermann"),
            title: some("MPFR: A multiple-precision binary floating-point library with correct rounding"),
            journal: some("ACM Transactions on Mathematical Software"),
            volume: some("33"),
            pages: some("13"),
            year: some("2007"),
            doi: some("10.1145/1236463.1236468"),
            ..Publication::default()
        },
        note: "long numbers".into(),
    }]
}
