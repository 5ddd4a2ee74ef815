//! `dalembert regimes`.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::args::in_threads;
use crate::failure::Failure;
use crate::file::{self, Format};
use crate::output::{regimes_data, regimes_npz, regimes_svg, regimes_text, threshold_data};
use crate::source;
use dalembert_plot::draw::Size;
use dalembert_verify::regimes::{GridError, Map};

#[derive(Args, Debug)]
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
    /// In place of the map, M of the curve at each R, as CSV
    #[arg(long)]
    curve: bool,
    /// How many points are solved at the same time; by default one for each core
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Write to this file, whole or not at all: .svg, .png, .pdf, .csv, or .npz; `-` is standard output, for CSV.
    /// Can be given several times. Without it the share of each regime is printed
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
}

const FORMATS: &[Format] = &[Format::Csv, Format::Npz, Format::Svg, Format::Png, Format::Pdf];

impl Regimes {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        // Before anything is solved.
        let formats = self.output.iter().map(|path| self.format(path)).collect::<Result<Vec<_>, _>>()?;
        let bar = source::bar(None, "{spinner} {pos} points, {elapsed}");
        // The curve takes R alone.
        let speeds = if self.curve { "1,2" } else { &self.speed_ratio };
        let map = in_threads(self.threads, || {
            let map = Map::new(&self.damping_ratio, speeds, &|| bar.inc(1))?;
            let drawn = formats.iter().any(|format| matches!(format, Format::Svg | Format::Png | Format::Pdf));
            Ok::<_, GridError>(if drawn { map.with_regions(&|| bar.inc(1)) } else { map })
        })??;
        bar.finish_and_clear();
        for (path, format) in self.output.iter().zip(formats) {
            file::write(Some(path), &self.bytes(&map, format)?)?;
        }
        match (self.output.is_empty(), self.curve) {
            (false, _) => Ok(()),
            (true, true) => file::write(None, &self.bytes(&map, Format::Csv)?),
            (true, false) => file::write(None, regimes_text(&map).as_bytes()),
        }
    }

    fn format(&self, path: &Path) -> Result<Format, Failure> {
        match Format::of(Some(path), None, FORMATS)? {
            Format::Csv => Ok(Format::Csv),
            _ if self.curve => Err(failure!("found --curve with {}, expected CSV", path.display())),
            format => Ok(format),
        }
    }

    fn bytes(&self, map: &Map, format: Format) -> Result<Vec<u8>, Failure> {
        match format {
            Format::Csv if self.curve => file::rows(&threshold_data(map), format),
            Format::Csv => file::rows(&regimes_data(map), format),
            Format::Npz => file::made("NPZ", regimes_npz(map)),
            picture => file::picture(picture, regimes_svg(map), Size::Page),
        }
    }
}
