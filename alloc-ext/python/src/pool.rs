//! The threads that share the work, also in a process that was forked.
//!
//! A fork copies no threads. The child of a process that used rayon's pool has the pool without
//! its threads, and a question to it waits without end. So such a child makes a pool of its own.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{Scope, ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::process;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, OnceLock};
use std::thread;
use std::time::{Duration, Instant};

/// The process that used rayon's global pool first.
static FIRST: OnceLock<u32> = OnceLock::new();

/// The pools of its children, and of theirs.
static OF_CHILDREN: OnceLock<Box<Child>> = OnceLock::new();

/// Time between two looks for Ctrl-C, while other threads work.
const SIGNAL_POLL: Duration = Duration::from_millis(50);

/// Time that Ctrl-C leaves to a callback that runs.
const CALLBACK_WAIT: Duration = Duration::from_secs(5);

/// Time between two looks whether callbacks have ended.
const CALLBACK_POLL: Duration = Duration::from_millis(1);

struct Child {
    process: u32,
    pool: ThreadPool,
    /// The pool of a child of this child.
    next: OnceLock<Box<Child>>,
}

/// This process's own pool, if a parent used the global one.
///
/// # Errors
/// No threads can be had.
fn of_child() -> PyResult<Option<&'static ThreadPool>> {
    let process = process::id();
    if *FIRST.get_or_init(|| process) == process {
        return Ok(None);
    }
    let mut place = &OF_CHILDREN;
    loop {
        match place.get() {
            Some(child) if child.process == process => return Ok(Some(&child.pool)),
            Some(parent) => place = &parent.next,
            None => {
                let pool = ThreadPoolBuilder::new().build();
                let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
                // Another thread may have been faster: then its pool is found, and this one ends.
                drop(place.set(Box::new(Child { process, pool, next: OnceLock::new() })));
            }
        }
    }
}

/// Does work that takes all cores.
///
/// # Errors
/// No threads can be had.
pub fn on_all_cores<T: Send>(work: impl FnOnce() -> T + Send) -> PyResult<T> {
    Ok(match of_child()? {
        Some(pool) => pool.install(work),
        None => work(),
    })
}

/// Waits for the work's result, and looks for Ctrl-C. Only the thread of the interpreter's signals
/// sees one.
///
/// # Errors
/// Ctrl-C; the work ended without a result.
fn wait<T>(result: &Receiver<T>) -> PyResult<T> {
    loop {
        match result.recv_timeout(SIGNAL_POLL) {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) => Python::attach(|py| py.check_signals())?,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the work ended early"));
            }
        }
    }
}

/// Does work that takes all cores, until Ctrl-C. On the caller's thread the work looks for Ctrl-C
/// itself. On a pool this function looks, sets `stop`, and waits until the work has ended.
///
/// # Errors
/// Ctrl-C, if the work runs on a pool; no threads can be had.
pub fn on_all_cores_until_stopped<T: Send>(
    stop: &AtomicBool,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let Some(pool) = of_child()? else { return Ok(work()) };
    pool.in_place_scope(|scope| watched(scope, stop, work))
}

/// The same of work that never looks for Ctrl-C itself, but at `stop`.
///
/// # Errors
/// Ctrl-C; no threads can be had.
pub fn on_all_cores_watched<T: Send>(
    stop: &AtomicBool,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    // A thread of a pool, on which a callback asks, must not wait for that pool.
    if rayon::current_thread_index().is_some() {
        return on_all_cores(work);
    }
    match of_child()? {
        Some(pool) => pool.in_place_scope(|scope| watched(scope, stop, work)),
        None => rayon::in_place_scope(|scope| watched(scope, stop, work)),
    }
}

/// Does work on a pool, and looks for Ctrl-C meanwhile, which sets `stop`.
fn watched<'scope, T: Send + 'scope>(
    scope: &Scope<'scope>,
    stop: &AtomicBool,
    work: impl FnOnce() -> T + Send + 'scope,
) -> PyResult<T> {
    let (done, result) = channel();
    // The scope passes on a panic of the work.
    scope.spawn(move |_| drop(done.send(work())));
    wait(&result).inspect_err(|_| stop.store(true, Ordering::Relaxed))
}

/// Whether detached work is to end. Then the interpreter may end too, and no thread of the work may
/// take its lock.
#[derive(Default)]
pub struct Stop {
    is_set: AtomicBool,
    /// Threads that are in a callback.
    callbacks: AtomicUsize,
}

impl Stop {
    pub fn is_set(&self) -> bool {
        self.is_set.load(Ordering::SeqCst)
    }

    /// Calls with the interpreter's lock. `None` if the work is to end.
    pub fn attach<T>(&self, call: impl FnOnce(Python<'_>) -> T) -> Option<T> {
        // The count is raised before the flag is read. So who sets the flag, then reads a count of
        // 0, knows that nothing is called from then on.
        self.callbacks.fetch_add(1, Ordering::SeqCst);
        let called = if self.is_set() { None } else { Python::try_attach(call) };
        self.callbacks.fetch_sub(1, Ordering::SeqCst);
        called
    }

    /// Ends the work, without the interpreter's lock. Waits for callbacks that run.
    fn set(&self) {
        self.is_set.store(true, Ordering::SeqCst);
        let before = Instant::now();
        while self.callbacks.load(Ordering::SeqCst) > 0 && before.elapsed() < CALLBACK_WAIT {
            thread::sleep(CALLBACK_POLL);
        }
    }
}

/// Does work that cannot look for Ctrl-C itself, on threads of its own. Ctrl-C sets the work's
/// flag, and this function returns when no callback runs. The threads run on until the work looks
/// at its flag.
///
/// # Errors
/// Ctrl-C; no threads can be had.
pub fn run_detached<T: Send + 'static>(
    work: impl FnOnce(&Stop) -> PyResult<T> + Send + 'static,
) -> PyResult<T> {
    let pool = ThreadPoolBuilder::new().build();
    let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let (stop, (done, result)) = (Arc::new(Stop::default()), channel());
    let to_stop = Arc::clone(&stop);
    pool.spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(|| work(&to_stop)));
        // After Ctrl-C there is no receiver.
        drop(done.send(result));
    });
    let result = wait(&result).inspect_err(|_| stop.set())?;
    result.unwrap_or_else(|panic| resume_unwind(panic))
}
