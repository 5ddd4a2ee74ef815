//! The `dalembert` command.

fn main() -> std::process::ExitCode {
    dalembert::cli::main()
}
