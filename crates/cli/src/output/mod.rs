//! Tables, JSON, CSV and pictures. Output computes no physics: it asks the history and the quantities.

mod check;
mod code;
mod compare;
mod cost;
mod dataset;
mod derivatives;
mod figures;
mod header;
mod npz;
mod outline;
mod regimes;
mod rows;
mod run_info;
mod solve;
mod sweep;
mod table;
mod target;
mod writer;

pub(crate) use check::{check_json, check_page, check_summary, check_table};
pub(crate) use code::{Language, code};
pub(crate) use compare::{compare_data, compare_svg};
pub(crate) use cost::{cost_data, cost_svg, effects_data};
pub(crate) use dataset::Cell;
pub(crate) use derivatives::{derivative_rows, derivative_table};
pub(crate) use figures::{figure_data, figure_sheet, figures_index};
pub(crate) use header::Header;
pub(crate) use outline::outline;
pub(crate) use regimes::{regimes_data, regimes_npz, regimes_svg, regimes_text, threshold_data};
pub(crate) use rows::{Column, Layout, RowWriter};
pub(crate) use run_info::RunInfo;
pub(crate) use solve::{HistoryPart, HistoryTables, LEGEND, STRAIGHT_ERROR};
pub(crate) use sweep::sweep_data;
pub(crate) use table::wrapped;
pub(crate) use target::targets_data;
pub(crate) use writer::{SCHEMA, json_bytes, rows_bytes};
