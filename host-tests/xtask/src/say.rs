//! Output that may be closed early, as `head` does. The work goes on: its files and its exit status
//! are wanted all the same.

use std::fmt;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the standard output is kept for something else.
static ASIDE: AtomicBool = AtomicBool::new(false);

/// From now on lines go to the standard error: the standard output is for another program.
pub fn aside() {
    ASIDE.store(true, Ordering::Relaxed);
}

/// A line to the standard output, or to the standard error after [`aside`](crate::say::aside).
#[macro_export]
macro_rules! say {
    ($($arguments:tt)*) => {
        $crate::say::text(format_args!("{}\n", format_args!($($arguments)*)))
    };
}

/// The same of a text as it is.
pub fn text(text: impl fmt::Display) {
    // An output that is closed is no reason to fail.
    let _ = if ASIDE.load(Ordering::Relaxed) {
        write!(io::stderr(), "{text}")
    } else {
        write!(io::stdout(), "{text}")
    };
}
