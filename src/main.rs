//! The `dalembert` command: parse, run, report, exit code.

use std::process::ExitCode;

use clap::Parser;
use dalembert::cli::{Cli, run};

fn main() -> ExitCode {
    match run(Cli::parse()) {
        Ok(code) => code,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::from(2)
        }
    }
}
