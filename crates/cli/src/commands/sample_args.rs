//! Arguments of `dalembert sample` and `dalembert reference`: quantities, times, points and the limit at a jump.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use clap::Args;

use crate::args::{SceneArgs, each_once, known_formats, list, words};
use crate::failure::{Failure, cannot};
use crate::file::{Destination, Format};
use crate::quantities::{NameParser, Scope, has_material, is_of_chain};
use dalembert::number::{List, Number};
use dalembert::problem::Parameter;
use dalembert::quantity::{Quantity, SLICE, Slice};
use dalembert::{Scene, Side};

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
pub(super) struct SampleArgs {
    #[command(flatten)]
    pub(super) scene: SceneArgs,
    /// Quantities and groups of them, separated by commas. Unless `t` is among them, `t` and `side` come first; a
    /// golden file has the columns as they are listed, by default all. Of a chain they are u_top.2 of the second body,
    /// force.bottom, force.1 of the joint above the first body, force.top, and so on; `gap` stands for all gaps,
    /// `end.2` for a group of one body, chain_energy and chain_momentum for sums over all bodies; by default all
    #[arg(long, visible_alias = "columns", value_name = "LIST", value_delimiter = ',')]
    #[arg(value_parser = NameParser::new(&[Scope::OverTime, Scope::AlongRod], []).open())]
    pub(super) quantity: Vec<String>,
    /// Times: numbers such as 0.3 or 1/3 separated by commas, or A..B:N for N times from A to B. The scene is followed
    /// to the last of them, whatever its own run says
    #[arg(long, value_name = "LIST", value_parser = list, allow_hyphen_values = true, group = "when")]
    pub(super) times: Option<List>,
    /// Times from a file, `-` for standard input: one a line, `#` begins a comment
    #[arg(long, value_name = "FILE", group = "when")]
    pub(super) times_from: Option<PathBuf>,
    /// Times 0, DT, 2 DT … up to --to
    #[arg(long, value_name = "DT", requires = "to", group = "when", allow_hyphen_values = true)]
    pub(super) dt: Option<Number>,
    /// The last time of --dt
    #[arg(long, value_name = "T", requires = "dt", allow_hyphen_values = true)]
    pub(super) to: Option<Number>,
    /// Points along the rod, in the same form as --times: the rows are the field there. With `field` the default is
    /// both ends and the middle. Of a chain they count from the lower end of each body: u.2, v.2, strain.2
    #[arg(long, value_name = "LIST", value_parser = list, allow_hyphen_values = true)]
    pub(super) points: Option<List>,
    /// Meaning of the field on the grid of the points
    #[arg(long, value_parser = words::<Slice>(), default_value_t, requires = "points")]
    pub(super) field: Slice,
    /// Limit where a jump passes: from earlier times, from later ones, or both in two rows; right by default, both in a
    /// golden file
    #[arg(long, value_enum)]
    pub(super) side: Option<SideArg>,
    /// Derivatives of the values by values of the scene, as with solve; time and point stay where they are
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = Parameter::differentiable)]
    pub(super) derivatives: Vec<Parameter>,
    /// Add the bound of the error of each value, in a column NAME_uncertainty beside each column
    #[arg(long)]
    pub(super) uncertainty: bool,
    /// Keep each row of a table on one line, however wide
    #[arg(long)]
    pub(super) wide: bool,
    /// Leave out the comments above a CSV, and digits beyond their bound where there is no column of bounds
    #[arg(long)]
    pub(super) bare: bool,
}

/// The formats of values over time; those of a golden file begin with CSV.
pub(super) const FORMATS: &[Format] = &[Format::Table, Format::Csv, Format::Json, Format::Npz];
const GOLDEN_FORMATS: &[Format] = &[Format::Csv, Format::Json, Format::Npz, Format::Table];

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(super) enum SideArg {
    /// The limit from earlier times
    Left,
    /// The limit from later times
    Right,
    /// Two rows where the limits differ, the limit from earlier times first
    Both,
}

impl SampleArgs {
    /// Refuses derivatives without times or with both limits, and those by one value twice.
    pub(super) fn check_derivatives(&self, times: &Option<List>, side: Option<Side>) -> Result<(), Failure> {
        if !self.derivatives.is_empty() && (times.is_none() || side.is_none() || self.field != Slice::Points) {
            return Err(failure!("found --derivatives, expected them with times, one side, and no --field"));
        }
        each_once(&self.derivatives)
    }

    /// Returns whether the quantities are those of a rod, and not of the joints and bodies of a chain.
    pub(super) fn are_of_rod(&self, is_golden: bool) -> bool {
        let has_place = self.quantity.iter().any(|name| is_of_chain(name));
        !has_place && (is_golden || !self.quantity.is_empty())
    }

    pub(super) fn destinations(&self, is_golden: bool) -> Result<Vec<Destination>, Failure> {
        let known = if is_golden { GOLDEN_FORMATS } else { FORMATS };
        let destinations = self.scene.output.destinations(known)?;
        if self.bare && destinations.iter().any(|destination| destination.format != Format::Csv) {
            return Err(failure!("found --bare, expected it with CSV only: JSON and NPZ have no comments"));
        }
        Ok(destinations)
    }

    /// Returns the limit at a jump; `None` for both.
    pub(super) fn side(&self, is_golden: bool) -> Option<Side> {
        match (self.side, is_golden && self.derivatives.is_empty()) {
            (Some(SideArg::Left), _) => Some(Side::Left),
            (Some(SideArg::Both), _) | (None, true) => None,
            (Some(SideArg::Right), _) | (None, false) => Some(Side::Right),
        }
    }

    /// Returns the columns of the rows.
    pub(super) fn quantities(&self, scene: &Scene, is_field: bool, is_golden: bool) -> Result<Vec<Quantity>, Failure> {
        let has_material = has_material(scene);
        let scope = if is_field { Scope::AlongRod } else { Scope::OverTime };
        if !is_field && self.quantity.iter().any(|name| name == "x") {
            return Err(failure!("found the quantity x without points, expected --points with it"));
        }
        let listed = scope.resolve(&self.quantity, has_material)?;
        Ok(match (listed.is_empty(), is_field) {
            (true, true) if is_golden => SLICE.to_vec(),
            (true, true) => self.with_keys(scope.resolve(&["field".into()], has_material)?, true),
            (true, false) if is_golden => scope.quantities(),
            (true, false) => return Err(failure!("found no quantity, expected some after --quantity, such as end")),
            (false, _) if is_golden || listed.contains(&Quantity::Time) => listed,
            (false, _) => self.with_keys(listed, is_field),
        })
    }

    /// Returns `quantities` after the time, the side and, of a field, the point.
    fn with_keys(&self, quantities: Vec<Quantity>, is_field: bool) -> Vec<Quantity> {
        let keys = if is_field { &SLICE[..3] } else { &SLICE[..2] };
        let others = quantities.into_iter().filter(|quantity| !keys.contains(quantity));
        keys.iter().copied().chain(others).collect()
    }

    /// Returns the requested times; `None` for the start, every impact and release, and the end.
    pub(super) fn times(&self) -> Result<Option<List>, Failure> {
        let times = match (&self.times, &self.times_from, &self.dt, &self.to) {
            (Some(list), ..) => list.clone(),
            (_, Some(path), ..) => read_times(path)?,
            (_, _, Some(dt), Some(to)) => List::steps(dt, to)?,
            _ => return Ok(None),
        };
        match times.least().filter(|first| first.to_f64() < 0.0) {
            Some(first) => Err(failure!("found time {first}, expected times from 0 on")),
            None => Ok(Some(times)),
        }
    }
}

/// Reads the times of a file, or of standard input for `-`: one a line; empty lines and the text after a `#` do not
/// count.
fn read_times(path: &Path) -> Result<List, Failure> {
    let is_stdin = path == Path::new("-");
    let name = if is_stdin { "standard input".to_string() } else { path.display().to_string() };
    let cannot_read = || cannot(&format!("read {name}"));
    let opened: Box<dyn Read> =
        if is_stdin { Box::new(std::io::stdin()) } else { Box::new(File::open(path).map_err(cannot_read())?) };
    let mut times = Vec::new();
    for (line, row) in BufReader::new(opened).lines().zip(1..) {
        let line = line.map_err(cannot_read())?;
        let text = line.split('#').next().unwrap_or_default().trim_start_matches('\u{feff}').trim();
        let values = text.split(|c: char| c == ',' || c == ';' || c.is_whitespace()).filter(|part| !part.is_empty());
        match values.count() {
            0 if text.is_empty() => continue,
            1 => (),
            count => return Err(failure!("{name}, row {row}: found {count} values, expected one time a line")),
        }
        let time: Number = text.parse().map_err(|error| failure!("{name}, row {row}: {error}"))?;
        if time.to_f64() < 0.0 {
            return Err(failure!("{name}, row {row}: found time {time}, expected times from 0 on"));
        }
        times.push(time);
    }
    if times.is_empty() {
        Err(failure!("{name}: found no times, expected one a line"))
    } else {
        Ok(List::Numbers(times))
    }
}
