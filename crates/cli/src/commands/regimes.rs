//! `dalembert regimes`.

use clap::Args;

use crate::args::{OutputArgs, in_threads, known_formats};
use crate::failure::{Failure, cannot};
use crate::file::{self, Format, write_all};
use crate::output::{regimes_data, regimes_npz, regimes_svg, regimes_text, rows_bytes, threshold_data};
use crate::terminal;
use dalembert_plot::draw::Size;
use dalembert_verify::regimes::{GridError, Map};

#[derive(Args, Debug)]
#[command(mut_arg("format", known_formats(FORMATS)))]
#[command(after_help = "Examples:\n  dalembert regimes -o regimes.png\n  dalembert regimes --damping-ratio 0..4:1000 \
    --speed-ratio 0.05..1e4:1000:log -o regimes.npz\n\nAll first contacts are those of two numbers, R = r t₁ and \
    M = μ/(g t₁), with the round trip t₁ = 2L/c. The bounce comes\nat t₁ above the curve \
    M = (I₀(R) + I₁(R))/(2 − I₀(R)); from R = π on there is none.")]
pub(crate) struct Regimes {
    /// R: A..B:N for N values from A to B, with :log in geometric progression, or V1,V2,…
    #[arg(long, value_name = "VALUES", default_value = "0..4:400", allow_hyphen_values = true)]
    damping_ratio: String,
    /// M, in the same form
    #[arg(long, value_name = "VALUES", default_value = "0.05..1e4:400:log", allow_hyphen_values = true)]
    speed_ratio: String,
    /// The curve in place of the map: M at each R, as CSV
    #[arg(long)]
    curve: bool,
    /// Number of threads; by default one for each core
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    #[command(flatten)]
    output: OutputArgs,
}

const FORMATS: &[Format] = &[Format::Table, Format::Csv, Format::Npz, Format::Svg, Format::Png, Format::Pdf];

impl Regimes {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let destinations = self.output.destinations_in(self.curve.then_some(Format::Csv), FORMATS)?;
        if self.curve && destinations.iter().any(|destination| destination.format != Format::Csv) {
            return Err(failure!("found --curve with another format, expected CSV"));
        }
        let bar = terminal::bar(None, "{spinner} {pos} points, {elapsed}");
        // The curve takes R alone.
        let speeds = if self.curve { "1,2" } else { &self.speed_ratio };
        let map = in_threads(self.threads, || {
            let map = Map::new(&self.damping_ratio, speeds, &|| bar.inc(1))?;
            let is_drawn = destinations.iter().any(|destination| destination.format.is_picture());
            Ok::<_, GridError>(if is_drawn { map.with_regions(&|| bar.inc(1)) } else { map })
        })??;
        bar.finish_and_clear();
        write_all(&destinations, |format| match format {
            Format::Table => Ok(regimes_text(&map).into_bytes()),
            Format::Csv if self.curve => rows_bytes(&threshold_data(&map), format),
            Format::Csv => rows_bytes(&regimes_data(&map), format),
            Format::Npz => regimes_npz(&map).map_err(cannot("write NPZ")),
            picture => file::picture(picture, regimes_svg(&map), Size::Page),
        })
    }
}
