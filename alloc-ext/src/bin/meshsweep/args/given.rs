//! Queries as the command line gives them: numbers, or a file of numbers.

use clap::builder::{OsStringValueParser, TypedValueParser};
use meshsweep::number;
use meshsweep_core::internal::format::layout::MAGIC;
use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// `N` numbers with commas between them; or a file of queries, `-` being the standard input.
#[derive(Clone, Debug, PartialEq)]
pub enum Given<const N: usize> {
    Query([f32; N]),
    File(PathBuf),
}

/// A point of the plane or of space, or a file of either: what is asked decides which.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenPoint {
    Plane([f32; 2]),
    Space([f32; 3]),
    File(PathBuf),
}

impl GivenPoint {
    /// The point along z.
    pub fn in_plane(&self) -> Given<2> {
        match self {
            Self::Plane(point) | Self::Space([point @ .., _]) => Given::Query(*point),
            Self::File(path) => Given::File(path.clone()),
        }
    }

    /// The point of space.
    ///
    /// # Errors
    /// It is one of the plane, as numbers.
    pub fn in_space(&self) -> Result<Given<3>, String> {
        match self {
            Self::Plane([x, y]) => {
                let [x, y] = [number::Short(*x), number::Short(*y)];
                Err(format!("{x},{y}: 2 numbers, and a query of a mesh needs {}", names(3)))
            }
            Self::Space(point) => Ok(Given::Query(*point)),
            Self::File(path) => Ok(Given::File(path.clone())),
        }
    }
}

/// The numbers of a query by their count, which tells the kind of query.
pub fn names(count: usize) -> &'static str {
    match count {
        2 => "2: x, y; or 3, of which z is not looked at",
        3 => "3: x, y, z",
        6 => "6: ax, ay, az, bx, by, bz",
        7 => "7: x, y, z, qw, qx, qy, qz",
        _ => "12: m00, m01, m02, x, m10, m11, m12, y, m20, m21, m22, z",
    }
}

/// The `blobs`, and the files that are `given`.
pub fn files<'a, const N: usize>(blobs: &[&'a Path], given: &'a [Given<N>]) -> Vec<&'a Path> {
    let file = |given: &'a Given<N>| match given {
        Given::Query(_) => None,
        Given::File(path) => Some(path.as_path()),
    };
    blobs.iter().copied().chain(given.iter().filter_map(file)).collect()
}

/// The value parser of queries.
pub fn queries<const N: usize>() -> impl TypedValueParser<Value = Given<N>> {
    OsStringValueParser::new().try_map(given)
}

/// The value parser of points of the plane or of space.
pub fn points() -> impl TypedValueParser<Value = GivenPoint> {
    OsStringValueParser::new().try_map(given_point)
}

fn given_point(text: OsString) -> Result<GivenPoint, String> {
    let count = text.to_str().filter(|text| are_numbers(text)).map(|text| text.split(',').count());
    if count == Some(2) {
        return given::<2>(text).map(|given| match given {
            Given::Query(point) => GivenPoint::Plane(point),
            Given::File(path) => GivenPoint::File(path),
        });
    }
    given::<3>(text).map(|given| match given {
        Given::Query(point) => GivenPoint::Space(point),
        Given::File(path) => GivenPoint::File(path),
    })
}

/// A text of numbers alone is a query. A file of such a name must be given with its directory.
fn given<const N: usize>(text: OsString) -> Result<Given<N>, String> {
    let Some(characters) = text.to_str().filter(|text| are_numbers(text)) else {
        let file = PathBuf::from(text);
        return if file.as_os_str().is_empty() {
            Err(format!("no query; write {} with commas, or name a file", names(N)))
        } else if is_blob(&file) {
            Err("a blob, and a query is wanted here; name blobs first".to_owned())
        } else {
            Ok(Given::File(file))
        };
    };
    let numbers: Vec<f32> =
        characters.split(',').map(|field| number::parse(field.trim())).collect::<Result<_, _>>()?;
    let found = numbers.len();
    <[f32; N]>::try_from(numbers)
        .map(Given::Query)
        .map_err(|_| format!("{found} numbers, and a query needs {}", names(N)))
}

/// Whether a file is a blob, by its name or its first bytes. Options that take many queries would
/// take a blob for one more. Nothing is read from a pipe: its queries are read later.
fn is_blob(file: &Path) -> bool {
    let mut magic = [0; MAGIC.len()];
    let mut begins_as_blob = || {
        file.is_file()
            && File::open(file).and_then(|mut file| file.read_exact(&mut magic)).is_ok()
            && magic == MAGIC
    };
    file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("msw"))
        || begins_as_blob()
}

/// Whether a text is two or more numbers with commas between them.
fn are_numbers(text: &str) -> bool {
    text.contains(',') && text.split(',').all(|field| field.trim().parse::<f64>().is_ok())
}

/// Puts a blank before numbers that begin with a minus sign, so that clap takes them for no option.
pub fn shielded(argument: OsString) -> OsString {
    match argument.to_str() {
        Some(text) if text.starts_with('-') && are_numbers(text) => format!(" {text}").into(),
        _ => argument,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(text: &str) -> Result<Given<3>, String> {
        given(text.into())
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
    fn points_of_the_plane_are_told_from_points_of_space() {
        let point = |text: &str| given_point(text.into());
        let (plane, space) = (point("1,-2").expect("two"), point("1,-2,3").expect("three"));
        assert_eq!(
            (&plane, &space),
            (&GivenPoint::Plane([1.0, -2.0]), &GivenPoint::Space([1.0, -2.0, 3.0]))
        );
        assert_eq!([plane.in_plane(), space.in_plane()], [[1.0, -2.0]; 2].map(Given::Query));
        assert_eq!(space.in_space(), Ok(Given::Query([1.0, -2.0, 3.0])));
        assert!(plane.in_space().unwrap_err().starts_with("1,-2: 2 numbers"));
        assert_eq!(point("p.csv"), Ok(GivenPoint::File("p.csv".into())));
        assert!(point("1,2,3,4").unwrap_err().starts_with("4 numbers"));
        assert!(point("1,nan").unwrap_err().starts_with("is not finite"));
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
            ("1,2", "2 numbers, and a query needs 3: x, y, z"),
            ("1,2,3,4", "4 numbers"),
            ("1,2,nan", "is not finite"),
            ("1,2,1e39", "is beyond f32"),
            ("", "no query; write 3: x, y, z with commas, or name a file"),
            ("part.MSW", "a blob, and a query is wanted here; name blobs first"),
        ] {
            assert!(point(text).unwrap_err().starts_with(why), "{text}");
        }
    }
}
