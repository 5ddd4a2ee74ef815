//! Tables, JSON, CSV and pictures. Output computes no physics: it asks the history and the quantities.

mod check;
mod code;
mod compare_picture;
mod cost;
mod cost_picture;
mod csv;
mod draw;
mod figures;
mod file;
mod json;
mod outline;
mod plot;
mod record;
mod reference;
mod regimes;
mod straight;
mod sweep;
mod table;
mod target;
mod writer;

pub(crate) use check::{check_json, check_page, check_summary, check_table};
pub use code::{Language, code};
pub(crate) use compare_picture::compare_svg;
pub use cost::duration;
pub(crate) use cost::{cost_csv, cost_json, cost_table, effects_csv, effects_json, effects_table};
pub(crate) use cost_picture::cost_svg;
pub(crate) use csv::compare_csv;
pub use csv::{Part, history_csv, samples_csv};
#[cfg(feature = "plot")]
pub(crate) use draw::Rendered;
pub(crate) use draw::{Size, plain};
pub(crate) use figures::{figure_csv, figure_sheet, figures_index};
pub use file::write_whole;
pub(crate) use file::{write_files, write_filled, write_together};
pub use json::{SCHEMA, history_json, samples_json};
pub(crate) use outline::outline;
pub use plot::scene_svg;
pub(crate) use plot::{Along, Asked, Gathered, Picture, sheet};
pub use record::{Finished, Head, Quantity, Record, Sample, record, sample};
pub use reference::{Described, Golden, Preamble, Rows};
pub(crate) use regimes::{regimes_csv, regimes_npz, regimes_svg, regimes_text, threshold_csv};
pub(crate) use sweep::{sweep_csv, sweep_json, sweep_npz, sweep_table};
pub use table::{LEGEND, history_table, samples_table};
pub(crate) use table::{WIDTH, wrapped};
pub(crate) use target::{targets_csv, targets_json, targets_table};
