//! The threads that share the work, also in a process that was forked.
//!
//! A fork copies no threads. The child of a process that used rayon's pool has the pool without
//! its threads, and a question to it waits without end. So such a child makes a pool of its own.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// The process that used rayon's global pool first.
static FIRST: OnceLock<u32> = OnceLock::new();

/// The pools of its children, and of theirs.
static OF_CHILDREN: OnceLock<Box<Child>> = OnceLock::new();

/// Between two looks for Ctrl-C, while threads of a child's pool build.
const LOOK: Duration = Duration::from_millis(50);

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

/// The same with looks for Ctrl-C. The work looks itself where it runs on the caller's thread. Else
/// it gets the word to end by `stop`.
///
/// # Errors
/// Ctrl-C, where the work did not look; no threads can be had.
pub fn on_all_cores_until_stopped<T: Send>(
    stop: &AtomicBool,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let Some(pool) = of_child()? else { return Ok(work()) };
    let (mut found, mut stopped) = (None, Ok(()));
    pool.in_place_scope(|scope| {
        let (done, is_done) = channel::<()>();
        let found = &mut found;
        scope.spawn(move |_| {
            *found = Some(work());
            drop(done);
        });
        while is_done.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
            // Only the thread of the interpreter's signals sees one.
            if let Err(error) = Python::attach(|py| py.check_signals()) {
                stop.store(true, Ordering::Relaxed);
                stopped = Err(error);
            }
        }
    });
    // The scope passes on a panic of the work, so that it is there.
    let missing = || PyRuntimeError::new_err("the build ended early");
    stopped.and_then(|()| found.ok_or_else(missing))
}
