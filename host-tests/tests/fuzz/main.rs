//! The fuzz targets on a stable compiler: seeded bytes, and inputs by name.

mod regressions;
mod seeded;
