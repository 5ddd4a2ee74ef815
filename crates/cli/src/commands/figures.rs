//! `dalembert figures`.

use rayon::prelude::*;
use std::path::PathBuf;

use clap::Args;

use crate::args::{in_threads, words};
use crate::failure::Failure;
use crate::file::{self, Format, write_folder};
use crate::output::{figure_data, figure_sheet, figures_index, rows_bytes};
use crate::source;
use dalembert_plot::draw::Size;
use dalembert_verify::VerifyError;
use dalembert_verify::figures::{FIGURES, Figure, FigureData};

#[derive(Args, Debug)]
#[command(
    after_help = "Figures: 1 to 8 of the paper, `regimes` and `tenth-bounce`. README.md in DIR says of each what is \
    reproduced and what is corrected.\n\n\
    Examples:\n  dalembert figures -o figures\n  dalembert figures --only 4,7 --size column -o figures"
)]
pub(crate) struct Figures {
    /// Only these, separated by commas
    #[arg(long, value_name = "A,B,C", value_delimiter = ',', value_parser = named)]
    only: Vec<&'static str>,
    /// Size of the pictures
    #[arg(long, value_parser = words::<Size>(), default_value_t)]
    size: Size,
    /// Number of threads; by default one for each core
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Write into this folder, which is made where there is none; all files or none
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

/// The formats of each figure; the index shows the first.
const PICTURES: &[Format] = match cfg!(feature = "raster") {
    true => &[Format::Png, Format::Svg, Format::Pdf],
    false => &[Format::Svg],
};

fn named(name: &str) -> Result<&'static str, String> {
    let names = FIGURES.map(|figure| figure.name);
    names.into_iter().find(|known| *known == name.trim()).ok_or_else(|| {
        let suggestion =
            source::nearest(name, names).map_or_else(String::new, |near| format!("; did you mean {near}?"));
        format!("found no figure of this name, expected one of {}{suggestion}", names.join(", "))
    })
}

impl Figures {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if self.output.exists() && !self.output.is_dir() {
            return Err(failure!("found the file {}, expected a folder", self.output.display()));
        }
        let chosen = |figure: &&Figure| self.only.is_empty() || self.only.contains(&figure.name);
        let figures: Vec<&Figure> = FIGURES.iter().filter(chosen).collect();
        let files = in_threads(self.threads, || self.files(&figures))??;
        write_folder(&self.output, &files)
    }

    fn files(&self, figures: &[&Figure]) -> Result<Vec<(String, Vec<u8>)>, Failure> {
        let data = figures.iter().map(|figure| FigureData::new(figure)).collect::<Result<Vec<_>, VerifyError>>()?;
        let files = (0..figures.len())
            .into_par_iter()
            .map(|k| {
                let (figure, data) = (figures[k], &data[k]);
                let svg = figure_sheet(figure, data)?.svg(self.size);
                let mut files = vec![(figure.file() + ".csv", rows_bytes(&figure_data(figure, data), Format::Csv)?)];
                for format in PICTURES {
                    let picture = file::picture(*format, svg.clone(), self.size)?;
                    files.push((format!("{}.{}", figure.file(), format.ending()), picture));
                }
                Ok::<_, Failure>(files)
            })
            .collect::<Result<Vec<_>, _>>()?;
        let endings: Vec<&str> = PICTURES.iter().map(|format| format.ending()).collect();
        let index = figures_index(figures, &data, &endings)?;
        Ok(files.into_iter().flatten().chain([("README.md".to_string(), index.into_bytes())]).collect())
    }
}
