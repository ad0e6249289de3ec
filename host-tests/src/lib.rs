//! Oracles, generators and corrupters that the tests, benches and fuzz targets share.

pub mod generate;
pub mod oracle;
