//! The `dalembert` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    dalembert_cli::main(std::env::args_os())
}
