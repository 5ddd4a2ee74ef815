//! Tables, JSON, CSV, and the pictures of what is no history. Output computes no physics: it asks the history and the
//! quantities.

mod check;
mod code;
mod compare;
mod cost;
mod dataset;
mod derivatives;
mod figures;
mod file;
mod json;
mod npz;
mod outline;
mod record;
mod reference;
mod regimes;
mod sample;
mod solve;
mod sweep;
mod table;
mod target;
mod writer;

pub(crate) use check::{check_json, check_page, check_summary, check_table};
pub(crate) use code::{Language, code};
pub(crate) use compare::{compare_data, compare_svg};
pub(crate) use cost::{cost_data, cost_svg, effects_data};
pub(crate) use dataset::{Dataset, Shown};
pub(crate) use derivatives::shared;
pub(crate) use figures::{figure_data, figure_sheet, figures_index};
pub(crate) use file::{write_files, write_filled, write_together};
pub(crate) use json::{bound_json, number_json};
pub(crate) use outline::outline;
pub(crate) use record::{Derived, Head, Record};
pub(crate) use reference::{Preamble, Rows};
pub(crate) use regimes::{regimes_data, regimes_npz, regimes_svg, regimes_text, threshold_data};
pub(crate) use sample::{Quantity, Samples, samples, samples_data};
pub(crate) use solve::{Form, LEGEND, Part, history_json, history_part, history_table, record};
pub(crate) use sweep::sweep_data;
pub(crate) use table::{WIDTH, wrapped};
pub(crate) use target::targets_data;
pub(crate) use writer::{Format, SCHEMA};
