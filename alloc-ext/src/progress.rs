//! Progress of a build, and the request of its caller to end it.

use crate::error::BuildError;
use rayon::prelude::*;
use std::cell::{Cell, RefCell};
use std::fmt;
use std::ops::ControlFlow;

/// What a callback of progress returns: nothing, or whether to go on.
pub trait Answer {
    /// Whether the work goes on.
    fn goes_on(self) -> bool;
}

impl Answer for () {
    fn goes_on(self) -> bool {
        true
    }
}

impl Answer for ControlFlow<()> {
    fn goes_on(self) -> bool {
        self.is_continue()
    }
}

/// What a build is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Reading and repairing the mesh.
    Loading,
    /// Edges collapse, for the hull hierarchy or the beginning of a tight hull.
    Collapsing {
        /// Faces that are gone.
        done: usize,
        /// Faces to go.
        of: usize,
    },
    /// Distances of a hull hierarchy or a tight hull are certified.
    Certifying,
    /// The box tree.
    BoxTree,
    /// Triboxes.
    Triboxes,
    /// The distance field.
    Sdf,
    /// A tight hull's edges collapse against the mesh.
    Shrinking {
        /// Faces that are gone.
        done: usize,
        /// Faces to go.
        of: usize,
    },
    /// A tight hull is polished.
    Polishing {
        /// Steps done.
        done: usize,
        /// Steps in all.
        of: usize,
    },
    /// Curves.
    Curve,
    /// The blob is complete and was opened.
    Done,
}

impl Stage {
    /// In words.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Loading => "reading and repairing",
            Self::Collapsing { .. } => "collapsing edges",
            Self::Certifying => "certifying distances",
            Self::BoxTree => "box tree",
            Self::Triboxes => "triboxes",
            Self::Sdf => "distance field",
            Self::Shrinking { .. } => "shrinking hulls",
            Self::Polishing { .. } => "polishing hulls",
            Self::Curve => "curves",
            Self::Done => "done",
        }
    }
}

/// A callback for one build. It gets what is done and the part of the work that is done, from 0 to
/// 1, and tells whether to go on. The part never falls. Once it asks to end, it is not called
/// again.
pub struct Callback<F> {
    show: RefCell<F>,
    told: Cell<f64>,
    is_cancelled: Cell<bool>,
}

/// A callback without its type.
trait Call {
    /// Whether to go on.
    fn call(&self, stage: Stage, at: f64) -> bool;

    fn is_cancelled(&self) -> bool;
}

impl<A: Answer, F: FnMut(Stage, f64) -> A> Call for Callback<F> {
    fn call(&self, stage: Stage, at: f64) -> bool {
        if !self.is_cancelled.get() {
            self.told.set(self.told.get().max(at));
            let answer = (self.show.borrow_mut())(stage, self.told.get());
            self.is_cancelled.set(!answer.goes_on());
        }
        !self.is_cancelled.get()
    }

    fn is_cancelled(&self) -> bool {
        self.is_cancelled.get()
    }
}

impl<A: Answer, F: FnMut(Stage, f64) -> A> Callback<F> {
    /// Calls `show` on the thread that builds.
    pub const fn new(show: F) -> Self {
        Self { show: RefCell::new(show), told: Cell::new(0.0), is_cancelled: Cell::new(false) }
    }

    /// A watch over all of the work.
    pub fn watch(&self) -> Watch<'_> {
        Watch { callback: Some(self), ..Watch::NONE }
    }
}

/// The caller's view of a part of the work. It stays on the thread that began the build.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    callback: Option<&'a dyn Call>,
    stage: Stage,
    from: f64,
    to: f64,
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { stage, from, to, .. } = self;
        write!(f, "Watch({stage:?}, {from} to {to})")
    }
}

/// Items that are done in parallel between two calls.
const BLOCK: usize = 1024;

/// Queries between two calls.
const QUERIES: u32 = 256;

impl Watch<'_> {
    /// Nobody watches.
    pub const NONE: Watch<'static> =
        Watch { callback: None, stage: Stage::Loading, from: 0.0, to: 1.0 };

    /// The view of the part of the work between two fractions of this one.
    pub(crate) fn part(self, from: f64, to: f64) -> Self {
        let at = |fraction: f64| self.from + (self.to - self.from) * fraction;
        Self { from: at(from), to: at(to), ..self }
    }

    /// The same part, in which this is done.
    pub(crate) fn during(self, stage: Stage) -> Self {
        Self { stage, ..self }
    }

    /// Tells how much of this part is done; whether to go on.
    pub(crate) fn goes_on(self, fraction: f64) -> bool {
        let at = self.from + (self.to - self.from) * fraction.clamp(0.0, 1.0);
        self.callback.is_none_or(|callback| callback.call(self.stage, at))
    }

    /// As [`goes_on`](Self::goes_on), for `done` of `all` steps.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`].
    pub(crate) fn step(self, done: usize, all: usize) -> Result<(), BuildError> {
        if self.goes_on(done as f64 / all.max(1) as f64) {
            Ok(())
        } else {
            Err(BuildError::Cancelled)
        }
    }

    /// Refuses a result that was cut short, without a call.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`].
    pub(crate) fn check(self) -> Result<(), BuildError> {
        let is_cancelled = self.callback.is_some_and(|callback| callback.is_cancelled());
        if is_cancelled { Err(BuildError::Cancelled) } else { Ok(()) }
    }

    /// `of` for all numbers below `count`, on all threads.
    ///
    /// # Errors
    /// [`BuildError::Cancelled`].
    pub(crate) fn map<T: Send>(
        self,
        count: usize,
        of: impl Fn(usize) -> T + Sync + Send,
    ) -> Result<Vec<T>, BuildError> {
        if self.callback.is_none() {
            return Ok((0..count).into_par_iter().map(of).collect());
        }
        let mut all = Vec::with_capacity(count);
        while all.len() < count {
            let end = count.min(all.len() + BLOCK);
            all.par_extend((all.len()..end).into_par_iter().map(&of));
            self.step(end, count)?;
        }
        Ok(all)
    }

    /// A query that has no answer any more after the caller asked to end. `all` is about the number
    /// of queries.
    pub(crate) fn asks<Q, T>(
        self,
        all: usize,
        mut query: impl FnMut(Q) -> Option<T>,
    ) -> impl FnMut(Q) -> Option<T> {
        let mut asked = 0u32;
        move |of| {
            asked += 1;
            let is_turn = asked.is_multiple_of(QUERIES);
            let goes_on = !is_turn || self.goes_on(f64::from(asked) / all.max(1) as f64);
            if goes_on && self.check().is_ok() { query(of) } else { None }
        }
    }
}
