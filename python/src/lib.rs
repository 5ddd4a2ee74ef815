//! The wheel: Python values in, Python values out. All physics is in the crate `dalembert`.

#![cfg_attr(not(feature = "mp"), allow(unused_variables, reason = "without long numbers no history has digits"))]

mod compare;
mod history;
mod number;
mod problem;
mod sweep;

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// How often Python is asked whether Ctrl-C was pressed.
const POLL: Duration = Duration::from_millis(50);

/// A refusal, with the text of the command.
fn refuse(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// The one of `known` that is called `found`.
fn one_of<T: Copy>(name: &str, found: &Bound<'_, PyAny>, known: &[(&str, T)]) -> PyResult<T> {
    let text: Option<String> = found.extract().ok();
    known.iter().find(|(word, _)| text.as_deref() == Some(word)).map(|(_, value)| *value).ok_or_else(|| {
        let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
        refuse(format!("found {name} = {found}, expected {}", words.join(" or ")))
    })
}

/// What ends a solution when `stop` is set.
fn observer(stop: &Arc<AtomicBool>) -> dalembert::Observer {
    let stop = stop.clone();
    Arc::new(move |_, _| if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
}

/// Runs `work` on a thread of its own, without the interpreter's lock. Ctrl-C sets `stop` and returns at once; work
/// that does not look at `stop` ends unseen.
fn run<T: Send + 'static, E: std::fmt::Display + Send + 'static>(
    py: Python<'_>,
    stop: &Arc<AtomicBool>,
    work: impl FnOnce() -> Result<T, E> + Send + 'static,
) -> PyResult<T> {
    stop.store(false, Ordering::Relaxed);
    let (sender, mut receiver) = channel();
    // Where nobody waits any more, the answer is dropped.
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
    use dalembert::builtin::ALL;
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::compare::Comparison;
    #[pymodule_export]
    use super::history::History;
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::sweep::sweep;

    /// The command `dalembert`: `arguments` with the name of the program first; its exit code.
    #[pyfunction]
    fn main(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> u8 {
        let code = py.detach(|| dalembert_cli::main(arguments));
        [0, 1].into_iter().find(|known| code == std::process::ExitCode::from(*known)).unwrap_or(2)
    }

    /// Names, summaries and texts of the built-in scenes.
    #[pyfunction]
    fn scenes() -> Vec<[&'static str; 3]> {
        ALL.iter().map(|builtin| [builtin.name, builtin.summary, builtin.source]).collect()
    }
}
