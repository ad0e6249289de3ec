//! Queries as they are given on the command line: numbers, or a file that holds some.

use clap::builder::{OsStringValueParser, TypedValueParser};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Numbers of one query, separated by commas; or a file of queries, `-` being the standard input.
#[derive(Clone, Debug, PartialEq)]
pub enum Given<const N: usize> {
    Query([f32; N]),
    File(PathBuf),
}

impl<const N: usize> Given<N> {
    /// The file, if it is one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Given::Query(_) => None,
            Given::File(path) => Some(path),
        }
    }
}

/// Points, or files of them.
pub fn points() -> impl TypedValueParser<Value = Given<3>> {
    OsStringValueParser::new().try_map(|text| given(text, "x,y,z"))
}

/// Segments, or files of them.
pub fn segments() -> impl TypedValueParser<Value = Given<6>> {
    OsStringValueParser::new().try_map(|text| given(text, "ax,ay,az,bx,by,bz"))
}

/// Motions as translation and quaternion, or files of them.
pub fn poses() -> impl TypedValueParser<Value = Given<7>> {
    OsStringValueParser::new().try_map(|text| given(text, "x,y,z,qw,qx,qy,qz"))
}

/// Motions as three rows of a matrix, each with its coordinate's translation, or files of them.
pub fn matrices() -> impl TypedValueParser<Value = Given<12>> {
    OsStringValueParser::new()
        .try_map(|text| given(text, "m00,m01,m02,x,m10,m11,m12,y,m20,m21,m22,z"))
}

/// Numbers alone are a query: a file of such a name has to be given with its directory.
fn given<const N: usize>(text: OsString, names: &str) -> Result<Given<N>, String> {
    let Some(characters) = text.to_str() else { return Ok(Given::File(text.into())) };
    if !are_numbers(characters) {
        return Ok(Given::File(text.into()));
    }
    let numbers: Vec<f32> =
        characters.split(',').map(|field| number(field.trim())).collect::<Result<_, _>>()?;
    let found = numbers.len();
    <[f32; N]>::try_from(numbers)
        .map(Given::Query)
        .map_err(|_| format!("{found} numbers, and a query needs {N}: {names}"))
}

/// Whether a text is two or more numbers with commas between them.
fn are_numbers(text: &str) -> bool {
    text.contains(',') && text.split(',').all(|field| field.trim().parse::<f64>().is_ok())
}

/// An argument that may begin with a negative number, so that it is not taken for an option:
/// numbers are read without the blank.
pub fn shielded(argument: OsString) -> OsString {
    match argument.to_str() {
        Some(text) if text.starts_with('-') && are_numbers(text) => format!(" {text}").into(),
        _ => argument,
    }
}

/// The nearest f32 of a decimal number, or what is wrong with it.
pub fn number(field: &str) -> Result<f32, &'static str> {
    let exact: f64 = field.parse().map_err(|_| "is not a number; write it like -1.25 or 3e-4")?;
    if !exact.is_finite() {
        return Err("is not finite; remove the query");
    }
    // From the text, not from the f64: rounding twice could miss the nearest.
    field
        .parse::<f32>()
        .ok()
        .filter(|x| x.is_finite())
        .ok_or("is beyond f32 (3.4e38); choose a larger unit")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(text: &str) -> Result<Given<3>, String> {
        given(text.into(), "x,y,z")
    }

    #[test]
    fn numbers_are_a_query_and_all_else_is_a_file() {
        assert_eq!(point("1,-2.5, 3e2"), Ok(Given::Query([1.0, -2.5, 300.0])));
        assert_eq!(point("-1,2,3"), Ok(Given::Query([-1.0, 2.0, 3.0])));
        for file in ["-", "p.csv", "a,b,c", "1,2.csv", "./1,2,3", "7"] {
            assert_eq!(point(file), Ok(Given::File(file.into())), "{file}");
        }
    }

    #[test]
    fn negative_numbers_are_no_options() {
        for (text, wanted) in [
            ("-1,2,3", " -1,2,3"),
            ("-.5,-2e3", " -.5,-2e3"),
            ("-1", "-1"),
            ("-n5", "-n5"),
            ("-o,3", "-o,3"),
            ("1,2,3", "1,2,3"),
        ] {
            assert_eq!(shielded(text.into()), wanted);
        }
        assert_eq!(point(" -1,2,3"), point("-1,2,3"));
    }

    #[test]
    fn wrong_numbers_are_refused() {
        for (text, why) in [
            ("1,2", "2 numbers, and a query needs 3: x,y,z"),
            ("1,2,3,4", "4 numbers"),
            ("1,2,nan", "is not finite"),
            ("1,2,1e39", "is beyond f32"),
        ] {
            assert!(point(text).unwrap_err().starts_with(why), "{text}");
        }
    }
}
