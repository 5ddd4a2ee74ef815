//! Tables, JSON and CSV. Output computes no physics: it asks the history and the quantities.

mod csv;
mod file;
mod json;
mod record;
mod table;

pub use csv::{Part, history_csv, samples_csv};
pub use file::write_whole;
pub use json::{history_json, samples_json};
pub use record::{Finished, Head, Quantity, Record, Sample, Show, record, sample};
pub use table::{history_table, samples_table, table};
