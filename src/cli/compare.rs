//! `dalembert compare`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::{Failure, Format, picture, source};
use crate::agreement::{
    Agreement, Axis, Clock, Compression, Conventions, Limit, Map, Order, Origin, Samples, Settings, orders,
};
use crate::data::Source;
use crate::number::Number;
use crate::output::{
    ComparedFile, Size, compare_csv, compare_json, compare_svg, compare_table, orders_table, write_whole,
};
use crate::problem::{Parameters, Problem, Run};
use crate::quantity::Units;
use crate::scene::Scene;
use crate::solve::{Numbers, Plan, Question, Solution};

/// Your data against the exact history: norms, contacts, an audit, and hints at what may be wrong
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  dalembert compare doyen-ern-piperno run.csv\n  \
    dalembert compare rod.toml run.dat --map t=0,u=1,v=2,force=3 -o run.svg\n  \
    dalembert compare rod.toml coarse.npz fine.npz --fail-above u.l2=0.01,force.l1=0.05\n\n\
    Quantities are called as in `dalembert reference`; u and v are short for u_end and v_end. With a column x, u, v,\n\
    strain and stress are those at the point x. The exit code is 1 where --fail-above fails.")]
pub(super) struct Compare {
    /// A scene file, `-`, or a built-in scene. It is followed as far as the data go
    scene: String,
    /// Data: text with columns, .npy or .npz; `-` is standard input. Several show the order of convergence
    #[arg(required = true)]
    data: Vec<PathBuf>,
    /// Which column is what, by its name or its number from 0: t=0,u=1,force=f_n; by default the names of the columns
    #[arg(long, value_name = "NAME=COLUMN,…")]
    map: Option<String>,
    /// Step between rows, where no column holds the time
    #[arg(long, value_name = "DT")]
    dt: Option<Number>,
    /// Time of the first row, with --dt
    #[arg(long, value_name = "T", requires = "dt", allow_hyphen_values = true)]
    t0: Option<Number>,
    /// Added to the times of the data
    #[arg(long, value_name = "DT", allow_hyphen_values = true)]
    shift: Option<Number>,
    /// Sign of forces, stresses and strains in compression; by default forces are +, stresses and strains −
    #[arg(long, value_enum, value_name = "SIGN", allow_hyphen_values = true)]
    compression: Option<Compression>,
    /// Where displacements are zero
    #[arg(long, value_enum, default_value_t)]
    u_origin: Origin,
    /// Which way displacements and velocities count
    #[arg(long, value_enum, default_value_t)]
    axis: Axis,
    /// Factor that brings the energies of the data to those of the rod
    #[arg(long, value_name = "FACTOR", default_value = "1")]
    energy_scale: Number,
    /// Round trips from a jump where `L∞ off jumps` begins; by default 0.02, or two steps where that is more
    #[arg(long, value_name = "TRIPS")]
    window: Option<Number>,
    /// Width of the mesh of each file, for the order of convergence; by default the step of its times
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    widths: Vec<Number>,
    /// Exit with code 1 where a relative norm is above a bound: u.l2=0.1, of l1, l2, linf, linf_off_jumps
    #[arg(long, value_name = "QUANTITY.NORM=BOUND,…", value_delimiter = ',')]
    fail_above: Vec<Limit>,
    /// What to print; by default a table
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write to this file, whole or not at all: a picture (.svg, .png), .json, .csv with every sample, or a table; `-`
    /// is standard output. Can be given several times. Beside pictures the table is printed as well
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
}

/// What a file holds, by its ending.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Rows(Format),
    Svg,
    Png,
}

/// What is printed.
struct Report<'a> {
    files: &'a [ComparedFile],
    orders: &'a [Order],
    title: Option<&'a str>,
    units: &'a Units,
}

impl Compare {
    pub(super) fn run(&self) -> Result<ExitCode, Failure> {
        self.check()?;
        let scene = source::read(&self.scene)?;
        let rod = Parameters::<f64>::of(&scene.problem, &())?;
        let all = self.data.iter().map(|path| self.read(path, rod.length)).collect::<Result<Vec<Samples>, _>>()?;
        let last = all.iter().filter_map(|samples| samples.grid.times.last()).fold(0.0, |a: f64, b| a.max(*b));
        // A round trip more shows a contact that begins in the data a little too early.
        let (problem, history) = solve(&scene, last + rod.round_trip())?;
        let until = match &scene.problem.run {
            Run::Time(time) => Some(time.to_f64()),
            Run::Impacts(_) => None,
        };
        let settings = self.settings(until);
        let mut files = Vec::new();
        for (path, samples) in self.data.iter().zip(all) {
            let file = path.display().to_string();
            files.push(ComparedFile { file, agreement: Agreement::of(&problem, &history, samples, &settings)? });
        }
        let widths: Vec<f64> = if self.widths.is_empty() {
            files.iter().map(|file| file.agreement.step).collect()
        } else {
            self.widths.iter().map(Number::to_f64).collect()
        };
        let compared: Vec<&Agreement> = files.iter().map(|file| &file.agreement).collect();
        let orders = orders(&compared, &widths);
        let units = Units::of(&scene.problem, scene.units);
        let report = Report { files: &files, orders: &orders, title: scene.title.as_deref(), units: &units };
        // Before anything is written.
        let failures = self.failures(&files)?;
        self.write(&report)?;
        for failure in &failures {
            eprintln!("failed: {failure}");
        }
        Ok(if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    fn check(&self) -> Result<(), Failure> {
        let kinds = self.output.iter().map(|path| (path, self.kind(path)));
        for (path, kind) in kinds {
            if !matches!(kind, Kind::Rows(_)) {
                picture::Kind::of(path)?;
            }
            let path = path.display();
            if self.data.len() > 1 && !matches!(kind, Kind::Rows(Format::Table | Format::Json)) {
                return Err(miette::miette!(
                    "found {path} with several files of data, expected one for a picture or CSV"
                ));
            }
        }
        if self.data.len() > 1 && self.format == Some(Format::Csv) {
            return Err(miette::miette!("found --format csv with several files of data, expected one"));
        }
        if self.data.iter().filter(|path| *path == Path::new("-")).count() + usize::from(self.scene == "-") > 1 {
            return Err(miette::miette!("found `-` twice, expected standard input to be read once"));
        }
        if !self.widths.is_empty() && self.widths.len() != self.data.len() {
            let (found, expected) = (self.widths.len(), self.data.len());
            return Err(miette::miette!("found {found} --widths, expected {expected}, one for each file"));
        }
        let positive = |name: &str, number: &Number| match number.to_f64() > 0.0 {
            true => Ok(()),
            false => Err(miette::miette!("found {name} {number}, expected more than zero")),
        };
        for (name, number) in [("--dt", &self.dt), ("--window", &self.window)] {
            number.iter().try_for_each(|number| positive(name, number))?;
        }
        self.widths.iter().try_for_each(|width| positive("--widths", width))
    }

    fn settings(&self, until: Option<f64>) -> Settings {
        Settings {
            conventions: Conventions {
                compression: self.compression,
                origin: self.u_origin,
                axis: self.axis,
                energy_scale: self.energy_scale.to_f64(),
            },
            until,
            window: self.window.as_ref().map(Number::to_f64),
        }
    }

    fn read(&self, path: &Path, length: f64) -> Result<Samples, Failure> {
        let of = |number: &Option<Number>| number.as_ref().map_or(0.0, Number::to_f64);
        let source = Source::open(path)?;
        let counted = self.dt.is_some();
        let map = Map::of(self.map.as_deref(), source.names(), source.width(), counted)
            .map_err(|error| miette::miette!("{}: {error}", source.file()))?;
        let clock = counted.then(|| Clock { start: of(&self.t0), step: of(&self.dt) });
        let columns = source.columns(&map.places())?;
        Ok(Samples::of(columns, &map, clock, of(&self.shift), length)?)
    }

    /// What --fail-above finds, a line each.
    fn failures(&self, files: &[ComparedFile]) -> Result<Vec<String>, Failure> {
        let mut failures = Vec::new();
        for ComparedFile { file, agreement } in files {
            for limit in &self.fail_above {
                let found = limit.above(agreement).map_err(|error| miette::miette!("{file}: {error}"))?;
                failures.extend(found.map(|found| format!("{file}: {limit}, found {found:.3e}")));
            }
        }
        Ok(failures)
    }

    fn kind(&self, path: &Path) -> Kind {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("svg") => Kind::Svg,
            Some("png") => Kind::Png,
            Some("json") => Kind::Rows(self.format.unwrap_or(Format::Json)),
            Some("csv") => Kind::Rows(self.format.unwrap_or(Format::Csv)),
            _ => Kind::Rows(self.format.unwrap_or(Format::Table)),
        }
    }

    fn write(&self, report: &Report<'_>) -> Result<(), Failure> {
        let mut printed = false;
        for path in &self.output {
            let kind = self.kind(path);
            printed |= matches!(kind, Kind::Rows(_));
            write(Some(path), &report.bytes(kind)?)?;
        }
        if printed {
            return Ok(());
        }
        write(None, &report.bytes(Kind::Rows(self.format.unwrap_or(Format::Table)))?)
    }
}

/// The problem followed as far as its own run and the data go, and its history.
fn solve(scene: &Scene, last: f64) -> Result<(Problem, crate::History<f64>), Failure> {
    let problem = match &scene.problem.run {
        Run::Time(time) if time.to_f64() >= last => scene.problem.clone(),
        _ => scene.problem.to_builder().time(last).build().map_err(crate::Error::from)?,
    };
    let accuracy = scene.accuracy.as_ref().map(Number::to_f64);
    let plan = Plan::of(&problem, &Question::run(Numbers::Double(accuracy)))?;
    let progress = source::Progress::of(scene, &plan);
    let solution = plan.solve(&problem, progress.observer())?;
    drop(progress);
    let Solution::Double(history) = solution else {
        return Err(miette::miette!("found no answer in doubles, expected one"));
    };
    for warning in history.warnings() {
        eprintln!("warning: {warning}");
    }
    Ok((problem, history))
}

impl Report<'_> {
    fn bytes(&self, kind: Kind) -> Result<Vec<u8>, Failure> {
        let Report { files, orders, title, units } = *self;
        Ok(match kind {
            Kind::Rows(Format::Json) => format!("{:#}\n", compare_json(files, orders, title, units)).into_bytes(),
            Kind::Rows(Format::Csv) => {
                compare_csv(&files[0].agreement).map_err(|error| miette::miette!("cannot write CSV: {error}"))?
            }
            Kind::Svg => compare_svg(&files[0], title, units).into_bytes(),
            Kind::Png => picture::png(&compare_svg(&files[0], title, units), Size::Page)?,
            Kind::Rows(Format::Table) => {
                let mut tables: Vec<String> = files.iter().map(|file| compare_table(file, title, units)).collect();
                if files.len() > 1 {
                    tables.push(orders_table(orders));
                }
                tables.join("\n").into_bytes()
            }
        })
    }
}

fn write(path: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    let name = path.map_or("standard output".into(), |path| path.display().to_string());
    Ok(write_whole(path, bytes).map_err(source::cannot(&format!("write {name}")))?)
}
