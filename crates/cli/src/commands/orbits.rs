//! `dalembert orbits`.

use clap::Args;

use crate::args::{NumberArgs, OutputArgs, known_formats, list};
use crate::failure::Failure;
use crate::file::{self, Format, write_all};
use crate::output::{OrbitRow, orbits_data, orbits_svg, rows_bytes};
use crate::source::{self, AnyScene};
use crate::terminal;
use dalembert::number::List;
use dalembert::orbits::Orbit;
use dalembert::solve::Numbers;
use dalembert::{Number, Parameters, Rational, Scene, Units};
use dalembert_plot::draw::Size;

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
#[command(after_help = "Examples:\n  dalembert orbits periodic-free-rod --finest 4 --stability 32\n  \
    dalembert orbits first-nonsmooth-mode --period 3.8,3.5,3.01\n  \
    dalembert orbits first-nonsmooth-mode --finest 40 -o backbone.svg\n  \
    dalembert orbits periodic-free-rod --period 6 -o orbit.toml && dalembert plot orbit.toml -o orbit.svg\n\n\
    The scene gives the rod, its gravity and, under a fixed top, its gap. The rod is undamped. An orbit touches the \
    ground once\nin each period T, which is a fraction of the round trip t₁ = 2L/c. As a scene it starts with its \
    impact.")]
pub(crate) struct Orbits {
    /// A scene file of a single rod, `-`, or a built-in scene
    scene: String,
    /// Periods, as V1,V2,… or A..B:N, which are fractions of the round trip; by default all of --finest and --longest
    #[arg(long, value_name = "LIST", value_parser = list, conflicts_with = "period_ratio")]
    period: Option<List>,
    /// Periods over the round trip, in the same form
    #[arg(long, value_name = "LIST", value_parser = list)]
    period_ratio: Option<List>,
    /// Periods m/n of the round trip with n up to N
    #[arg(long, value_name = "N", default_value_t = 8, conflicts_with_all = ["period", "period_ratio"])]
    finest: u32,
    /// Longest period, in round trips
    #[arg(long, value_name = "N", default_value_t = 4, conflicts_with_all = ["period", "period_ratio"])]
    longest: u32,
    /// Impact speed of a held rod whose lower end just touches the ground at rest: there any will do
    #[arg(long, value_name = "V", default_value = "1", allow_hyphen_values = true)]
    speed: Number,
    /// Only the orbit with this number in the list
    #[arg(long, value_name = "K")]
    orbit: Option<usize>,
    /// Follow each orbit through N periods with the derivatives by its velocities, and estimate the factor by which a
    /// small disturbance grows in a period: 1 where it does not
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    stability: u32,
    /// Periods through which a scene of an orbit runs
    #[arg(long, value_name = "N", default_value_t = 2)]
    periods: u32,
    #[command(flatten)]
    numbers: NumberArgs,
    #[command(flatten)]
    output: OutputArgs,
}

const FORMATS: &[Format] =
    &[Format::Table, Format::Json, Format::Csv, Format::Npz, Format::Toml, Format::Svg, Format::Png, Format::Pdf];

impl Orbits {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let destinations = self.output.destinations(FORMATS)?;
        let AnyScene::Rod(scene) = source::read(&self.scene)? else {
            return Err(failure!("found a chain in `{}`, expected the scene of a single rod", self.scene));
        };
        let numbers = self.numbers.numbers_to(scene.accuracy);
        let units = Units::new(&scene.problem, scene.units);
        let mut rows = Vec::new();
        for orbit in self.orbits(&scene)? {
            if let Some(values) = orbit.values(&scene.problem, &units, &self.speed, numbers)? {
                rows.push(OrbitRow { number: rows.len() + 1, orbit, values, growth: None });
            }
        }
        for (period, ratio) in self.ratios(&scene)?.unwrap_or_default() {
            if !rows.iter().any(|row| row.orbit.period_ratio() == ratio) {
                terminal::warn(format_args!("no orbit with one contact in each period has the period {period}"));
            }
        }
        if let Some(number) = self.orbit {
            let count = rows.len();
            rows.retain(|row| row.number == number);
            if rows.is_empty() {
                return Err(failure!("found --orbit {number}, expected one from 1 to {count}, the orbits of the list"));
            }
        }
        if self.stability > 0 {
            let bar = terminal::bar(Some(rows.len() as u64), "{bar:40} {pos} of {len} orbits");
            for row in &mut rows {
                row.growth = row.orbit.growth(&scene.problem, &self.speed, self.stability)?;
                bar.inc(1);
            }
            bar.finish_and_clear();
        }
        let digits = match numbers {
            Numbers::Digits(digits) | Numbers::Certified(digits) => digits,
            _ => 0,
        };
        let title = scene.title.as_deref();
        write_all(&destinations, |format| match format {
            Format::Toml => self.scene_of(&scene, &rows),
            Format::Svg | Format::Png | Format::Pdf => {
                file::picture(format, orbits_svg(&rows, &units, title), Size::Page)
            }
            format => rows_bytes(&orbits_data(&rows, &units, title, (digits, self.stability > 0)), format),
        })
    }

    /// Returns the orbits of the chosen periods, those of a gap that the scene does not have among them.
    fn orbits(&self, scene: &Scene) -> Result<Vec<Orbit>, Failure> {
        let top = scene.problem.top();
        let Some(ratios) = self.ratios(scene)? else { return Ok(Orbit::up_to(top, self.finest, self.longest)?) };
        let mut orbits = Vec::new();
        for (period, ratio) in ratios {
            // A fraction prints as its numerator over its denominator.
            let ratio = ratio.to_string();
            let (cells, round_trip) = ratio.split_once('/').unwrap_or((&ratio, "1"));
            let (Ok(cells), Ok(round_trip)) = (cells.parse(), round_trip.parse()) else {
                let most = dalembert::orbits::MOST_CELLS;
                let found = format!("found the period {period}, which is {ratio} of the round trip");
                return Err(failure!("{found}, expected a fraction m/n above zero with m and n up to {most}"));
            };
            orbits.extend(Orbit::of_period(top, cells, round_trip)?);
        }
        Ok(orbits)
    }

    /// Returns the chosen periods, each as it was given and over the round trip; `None` where none is chosen.
    fn ratios(&self, scene: &Scene) -> Result<Option<Vec<(Rational, Rational)>>, Failure> {
        let (periods, unit) = match (&self.period, &self.period_ratio) {
            (None, None) => return Ok(None),
            (Some(periods), _) => (periods, Parameters::<Rational>::of(&scene.problem, &())?.round_trip()),
            (None, Some(ratios)) => (ratios, Rational::from(1)),
        };
        let ratio = |period: Rational| (period.clone(), period / &unit);
        Ok(Some(periods.lift::<Rational>(&()).into_iter().map(ratio).collect()))
    }

    /// Returns the only one of `rows` as a scene.
    fn scene_of(&self, scene: &Scene, rows: &[OrbitRow]) -> Result<Vec<u8>, Failure> {
        let [row] = rows else {
            let failure = failure!("found {} orbits, expected one to be written as a scene", rows.len());
            return Err(failure.help("--orbit K takes one of the list"));
        };
        let Some(start) = row.orbit.start(&scene.problem, &self.speed, self.periods)? else {
            return Err(failure!("found no orbit of this rod"));
        };
        let mut made = Scene::from(start);
        let (ratio, contact) = (row.orbit.period_ratio(), row.orbit.contact_ratio());
        made.title = Some(format!("A periodic orbit: T = {ratio} t₁, in contact for {contact} t₁"));
        made.units = scene.units;
        Ok(made.to_toml().into_bytes())
    }
}
