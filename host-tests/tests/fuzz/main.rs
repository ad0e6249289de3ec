//! The fuzz targets on a stable compiler: seeded bytes, and inputs that once broke something.

mod regressions;
mod seeded;
