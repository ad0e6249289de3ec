//! Queries as text: one on a line, with the separator that the line uses.
//!
//! The `csv` crate does not fit: it knows one separator for all lines, no runs of blanks, comments
//! only where a line begins, and counts no blank lines before a record.

use crate::args::names;
use crate::failure::Failure;
use meshsweep::number;
use std::path::Path;

/// The queries of a text, up to its end or to the first line that is no query.
pub struct Rows<const N: usize> {
    pub rows: Vec<[f32; N]>,
    /// The line that each row was on, counting from 1.
    pub lines: Vec<usize>,
    /// The failure of the line after the last row.
    pub broken: Option<Failure>,
}

/// Reads `N` numbers a line, each rounded to the nearest f32; of points of the plane a third one
/// too, which is dropped. Skips blank lines, comments from a `#` on, and a first line of names.
pub fn parse<const N: usize>(file: &Path, bytes: &[u8]) -> Rows<N> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut found = Rows { rows: Vec::new(), lines: Vec::new(), broken: None };
    let mut may_be_header = true;
    for (number, line) in bytes.split(|&b| b == b'\n').enumerate() {
        let text = String::from_utf8_lossy(line);
        let text = text.split('#').next().unwrap_or_default().trim();
        if text.is_empty() {
            continue;
        }
        let line = number + 1;
        let first = std::mem::replace(&mut may_be_header, false);
        if first && fields(text).all(is_name) {
            continue;
        }
        match row(file, line, text) {
            Ok(row) => found.rows.push(row),
            Err(failure) => {
                found.broken = Some(failure);
                break;
            }
        }
        found.lines.push(line);
    }
    found
}

/// Whether a field may head a column: it begins with a letter or a quotation mark, and is no
/// number, as `nan` is.
fn is_name(field: &str) -> bool {
    let begins = field.starts_with(|c: char| c.is_alphabetic() || c == '"' || c == '_');
    begins && field.parse::<f64>().is_err()
}

/// The fields of a line: between semicolons if it has any, else between commas, else between
/// blanks.
fn fields(text: &str) -> Box<dyn Iterator<Item = &str> + '_> {
    match [';', ','].into_iter().find(|&separator| text.contains(separator)) {
        Some(separator) => Box::new(text.split(separator).map(str::trim)),
        None => Box::new(text.split_whitespace()),
    }
}

fn row<const N: usize>(file: &Path, line: usize, text: &str) -> Result<[f32; N], Failure> {
    let mut row = [0f32; N];
    let mut found = 0;
    let most = if N == 2 { 3 } else { N };
    for field in fields(text) {
        if found < most {
            let refuse = |reason| Failure::Field {
                file: file.to_owned(),
                line,
                field: found + 1,
                text: field.to_owned(),
                reason,
            };
            let number = number::parse(field).map_err(refuse)?;
            if let Some(slot) = row.get_mut(found) {
                *slot = number;
            }
        }
        found += 1;
    }
    if !(N..=most).contains(&found) {
        return Err(Failure::FieldCount { file: file.to_owned(), line, wanted: names(N), found });
    }
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Rows<3> {
        parse(Path::new("a.csv"), text.as_bytes())
    }

    #[test]
    fn what_stands_before_a_broken_line_is_read() {
        let Rows { rows, lines, broken } = read("x,y,z\n1,2,3\n\n4,5,6\n7,8\n9,9,9\n");
        assert_eq!((rows, lines), (vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], vec![2, 4]));
        assert!(
            broken
                .is_some_and(|failure| failure.to_string().starts_with("a.csv, line 5: 2 fields"))
        );
    }

    #[test]
    fn separators_headers_comments_and_blank_lines_are_understood() {
        let text = "\u{feff}x,y,z\r\n\n1,2,3 # here\n 1 ; 2; 3\r\n# 9,9,9\n1\t2  3\n";
        let Rows { rows, lines, broken } = read(text);
        assert!(broken.is_none());
        assert_eq!(rows, [[1.0, 2.0, 3.0]; 3]);
        assert_eq!(lines, [3, 4, 6]);
    }

    #[test]
    fn points_of_the_plane_may_have_a_z() {
        let read = |text: &str| parse::<2>(Path::new("a.csv"), text.as_bytes());
        assert_eq!(read("x,y\n1,2\n3,4,5\n").rows, [[1.0, 2.0], [3.0, 4.0]]);
        for (text, why) in [("1", "1 field"), ("1,2,3,4", "4 fields"), ("1,2,z", "field 3")] {
            let told = read(text).broken.expect("refused").to_string();
            assert!(told.contains(why), "{told}");
        }
    }

    #[test]
    fn malformed_lines_are_refused_with_line_and_field() {
        let at = |text: &str| read(text).broken.unwrap().to_string();
        assert!(
            at("x y z\n1 2 3\n1 2 three\n")
                .starts_with("a.csv, line 3, field 3: \"three\" is not a number")
        );
        assert!(at("1,2,3\nx,y,z").starts_with("a.csv, line 2, field 1"));
        assert!(at("1,,3").starts_with("a.csv, line 1, field 2: \"\" is not a number"));
        assert!(at("1,2,3,").starts_with("a.csv, line 1: 4 fields"));
        assert!(at("\n1,2").starts_with("a.csv, line 2: 2 fields"));
        assert!(at("1,nan,2").starts_with("a.csv, line 1, field 2: \"nan\" is not finite"));
        assert!(at("1,2,-1e39").starts_with("a.csv, line 1, field 3: \"-1e39\" is beyond f32"));
        assert!(at("x,2,3").starts_with("a.csv, line 1, field 1"));
        assert!(at("1,5;2,5;3,5").starts_with("a.csv, line 1, field 1: \"1,5\" is not a number"));
        assert!(at("\0\0\0\0").starts_with("a.csv, line 1"));
    }
}
