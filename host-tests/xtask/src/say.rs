//! Output that may be closed early, as `head` does. The work goes on: its files and its exit status
//! are wanted all the same.

use std::fmt;
use std::io::{self, Write};

/// A line to the standard output.
#[macro_export]
macro_rules! say {
    ($($arguments:tt)*) => {
        $crate::say::text(format_args!("{}\n", format_args!($($arguments)*)))
    };
}

/// A text to the standard output, as it is.
pub fn text(text: impl fmt::Display) {
    // An output that is closed is no reason to fail.
    let _ = write!(io::stdout(), "{text}");
}
