//! Oracles, generators and corrupters that the tests, benches and fuzz targets share.

pub mod check;
pub mod corrupt;
pub mod fuzz_targets;
pub mod generate;
pub mod golden;
pub mod measure;
pub mod oracle;
pub mod race;
