//! The compiled part of the Python package. All physics is in the crate `dalembert`.

mod argument;
mod chain;
mod compare;
mod history;
mod problem;
mod sweep;

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use argument::refuse;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// Time between two checks of whether Ctrl-C was pressed.
const POLL: Duration = Duration::from_millis(50);

/// Returns an observer that ends a solution when `stop` is set.
fn observer(stop: &Arc<AtomicBool>) -> dalembert::Observer {
    let stop = stop.clone();
    Arc::new(move |_, _| if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
}

/// Runs `work` on a thread of its own, without the interpreter's lock. Ctrl-C sets `stop` and returns at once; the
/// answer of work that does not look at `stop` is dropped.
fn run<T: Send + 'static, E: std::fmt::Display + Send + 'static>(
    py: Python<'_>,
    stop: &Arc<AtomicBool>,
    work: impl FnOnce() -> Result<T, E> + Send + 'static,
) -> PyResult<T> {
    stop.store(false, Ordering::Relaxed);
    let (sender, mut receiver) = channel();
    // Sending fails after Ctrl-C, when nobody waits.
    let worker = std::thread::Builder::new().spawn(move || drop(sender.send(work())));
    worker.map_err(|error| PyRuntimeError::new_err(format!("cannot start a thread: {error}")))?;
    loop {
        let answer = &mut receiver;
        match py.detach(move || answer.recv_timeout(POLL)) {
            Ok(answer) => return answer.map_err(refuse),
            Err(RecvTimeoutError::Timeout) => {
                py.check_signals().inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the solver ended unexpectedly"));
            }
        }
    }
}

#[pymodule]
mod _core {
    use dalembert::builtin::{ALL, CHAINS};
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::chain::Chain;
    #[pymodule_export]
    use super::chain::ChainHistory;
    #[pymodule_export]
    use super::compare::Comparison;
    #[pymodule_export]
    use super::history::History;
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::problem::bars;
    #[pymodule_export]
    use super::problem::unknown_parameter;
    #[pymodule_export]
    use super::sweep::sweep;

    /// Runs the command `dalembert` on `arguments`, the name of the program first, and returns its exit code.
    #[pyfunction]
    fn main(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> u8 {
        let code = py.detach(|| dalembert_cli::main(arguments));
        [0, 1].into_iter().find(|known| code == std::process::ExitCode::from(*known)).unwrap_or(2)
    }

    /// Runs the command `dalembert` on `arguments` after the name of the program; a failure is a `ValueError`.
    #[pyfunction]
    fn run_command(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> PyResult<()> {
        let arguments = std::iter::once("dalembert".into()).chain(arguments);
        super::run(py, &Default::default(), move || dalembert_cli::try_main(arguments).map(drop))
    }

    /// Returns names, summaries and texts of the built-in scenes.
    #[pyfunction]
    fn scenes() -> Vec<[&'static str; 3]> {
        ALL.iter().chain(CHAINS).map(|builtin| [builtin.name, builtin.summary, builtin.source]).collect()
    }
}
