//! Curves from CSV: x,y or x,y,z on a line, comments from a `#` on.

use crate::error::CurveError;
use csv::{ByteRecord, ReaderBuilder, Trim};
use meshsweep_core::Zone;
use robust::{Coord, orient2d};

/// Points that are joined in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    /// Points, input units. z is 0 in 2-D.
    pub points: Vec<[f64; 3]>,
    /// Whether the last point is joined with the first.
    pub is_closed: bool,
    /// Which side of it is allowed. An exclusion zone is closed.
    pub zone: Zone,
}

/// Where a point's fields stand in a record.
struct Columns {
    places: Vec<usize>,
    polyline: Option<usize>,
    zone: Option<usize>,
    /// Columns of other names, which are skipped.
    others: Vec<(usize, String)>,
    fields: usize,
}

/// The words of a column `zone`.
const ZONES: [(&str, Zone); 2] = [("inclusion", Zone::Inclusion), ("exclusion", Zone::Exclusion)];

/// The zone of a word.
fn zone_of(text: &[u8]) -> Option<Zone> {
    let named = ZONES.iter().find(|(name, _)| text.eq_ignore_ascii_case(name.as_bytes()));
    named.map(|&(_, zone)| zone)
}

impl Columns {
    /// Of a header line.
    fn named(record: &ByteRecord) -> Option<Columns> {
        let place = |name: &str| {
            record.iter().position(|field| field.eq_ignore_ascii_case(name.as_bytes()))
        };
        let places = [Some(place("x")?), Some(place("y")?), place("z")];
        let places: Vec<usize> = places.into_iter().flatten().collect();
        let (polyline, zone) = (place("polyline"), place("zone"));
        let is_other = |at: &usize| !places.contains(at) && ![polyline, zone].contains(&Some(*at));
        let name = |at: usize| (at, String::from_utf8_lossy(&record[at]).into_owned());
        let others = (0..record.len()).filter(is_other).map(name).collect();
        Some(Columns { places, polyline, zone, others, fields: record.len() })
    }

    /// Of a file without a header line, by its first record.
    fn of(record: &ByteRecord) -> Columns {
        let fields = record.len().clamp(2, 3);
        let places = (0..fields).collect();
        Columns { places, polyline: None, zone: None, others: Vec::new(), fields }
    }

    /// The zone that a record names, if there is a column for it.
    fn zone(&self, record: &ByteRecord, line: u64) -> Result<Option<Zone>, CurveError> {
        let Some(place) = self.zone else {
            // Else what is excluded would be included without a word.
            let is_zone = |at: usize| record.get(at).is_some_and(|text| zone_of(text).is_some());
            return match self.others.iter().find(|(at, _)| is_zone(*at)) {
                Some((_, name)) => Err(CurveError::ZoneColumn { line, name: name.clone() }),
                None => Ok(None),
            };
        };
        let Some(text) = record.get(place) else { return Ok(None) };
        match zone_of(text) {
            Some(zone) => Ok(Some(zone)),
            None => {
                let text = String::from_utf8_lossy(text).into_owned();
                Err(CurveError::Zone { line, text })
            }
        }
    }

    fn point(&self, record: &ByteRecord, line: u64) -> Result<[f64; 3], CurveError> {
        if record.len() != self.fields {
            return Err(CurveError::Fields { line, wanted: self.fields, found: record.len() });
        }
        let mut point = [0.0; 3];
        for (slot, &place) in point.iter_mut().zip(&self.places) {
            let text = String::from_utf8_lossy(&record[place]).into_owned();
            match text.parse::<f64>() {
                Ok(x) if (x as f32).is_finite() => *slot = x,
                _ => return Err(CurveError::Number { line, field: place + 1, text }),
            }
        }
        Ok(point)
    }
}

/// Whether a record is a header: its fields are words.
fn is_header(record: &ByteRecord) -> bool {
    let is_name = |field: &[u8]| {
        let text = String::from_utf8_lossy(field);
        text.starts_with(|c: char| c.is_alphabetic() || c == '_') && text.parse::<f64>().is_err()
    };
    record.iter().all(is_name)
}

/// A text without its comments.
struct Plain {
    bytes: Vec<u8>,
    /// Numbers of the lines that were comments alone, from 1: they are no blank lines.
    comments: Vec<u64>,
    separator: u8,
}

/// Columns whose values have no `#` of their own.
const NUMBERS: [&str; 4] = ["x", "y", "z", "zone"];

impl Plain {
    /// Leaves out lines that begin with a `#`, and what follows a `#` where columns hold numbers
    /// and zones alone: a polyline may be named `#1`. The separator is that of the first line.
    fn of(bytes: &[u8]) -> Self {
        let begin = |line: &[u8]| line.trim_ascii_start().first().copied();
        let mut lines = bytes.split(|&byte| byte == b'\n');
        let first = lines.find(|line| !matches!(begin(line), None | Some(b'#')));
        let first = first.unwrap_or_default();
        let separator = if first.contains(&b';') { b';' } else { b',' };
        let is_number = |field: &[u8]| {
            let text = String::from_utf8_lossy(field.trim_ascii()).to_ascii_lowercase();
            text.is_empty() || NUMBERS.contains(&text.as_str()) || text.parse::<f64>().is_ok()
        };
        let before = |line: &[u8]| line.split(|&byte| byte == b'#').next().map_or(0, <[u8]>::len);
        let cuts = first[..before(first)].split(|&byte| byte == separator).all(is_number);
        let (mut plain, mut comments) = (Vec::with_capacity(bytes.len() + 1), Vec::new());
        for (line, number) in bytes.split(|&byte| byte == b'\n').zip(1..) {
            // The reader would count the line at the next record.
            let line = line.strip_suffix(b"\r").unwrap_or(line);
            match begin(line) {
                Some(b'#') => comments.push(number),
                _ => plain.extend(&line[..if cuts { before(line) } else { line.len() }]),
            }
            // The end of a line counts lines, so the last one has an end too.
            plain.push(b'\n');
        }
        Self { bytes: plain, comments, separator }
    }
}

/// Reads polylines from CSV: x,y or x,y,z on a line, and at most one header line before, between
/// commas or semicolons. Lines that begin with a `#` are comments, and where no column but x, y, z
/// and `zone` is there, so is what follows a `#`. A blank line begins a new polyline. So does
/// another value in a column `polyline` of the header. Columns of other names are skipped. With
/// `close` each polyline's last point is joined with its first.
///
/// A column `zone` of the header makes zones of the polylines, `inclusion` or `exclusion`. Zones
/// are closed. A line of the other kind begins a new zone, and so does the line after one that
/// repeats the zone's first point. Two zones of a kind need that, or a blank line between them.
///
/// # Errors
/// [`CurveError`] names the line.
pub fn read_csv(bytes: &[u8], close: bool) -> Result<Vec<Polyline>, CurveError> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let Plain { bytes, comments, separator } = Plain::of(bytes);
    let mut reader = ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(bytes.as_slice());
    let mut polylines: Vec<Polyline> = Vec::new();
    let mut columns: Option<Columns> = None;
    let (mut name, mut last_line) = (None, 0);
    let mut begins = true;
    let mut record = ByteRecord::new();
    // Bytes in memory and records of any length: the reader has nothing to refuse.
    while reader.read_byte_record(&mut record).unwrap_or(false) {
        // The reader skips blank lines before a record.
        let line = reader.position().line() - 1;
        let is_blank = |skipped: u64| comments.binary_search(&skipped).is_err();
        let has_blank = record.position().is_some_and(|from| (from.line()..line).any(is_blank));
        begins |= has_blank || record.iter().all(<[u8]>::is_empty);
        if record.iter().all(<[u8]>::is_empty) {
            continue;
        }
        let columns = match &columns {
            Some(columns) => columns,
            None if is_header(&record) => {
                columns = Some(Columns::named(&record).ok_or(CurveError::Header { line })?);
                continue;
            }
            None => columns.insert(Columns::of(&record)),
        };
        let point = columns.point(&record, line)?;
        let zone = columns.zone(&record, line)?;
        let named = (columns.polyline.map(|place| record[place].to_vec()), zone);
        if begins || name.as_ref() != Some(&named) {
            complete(polylines.last(), name.as_ref().is_some_and(is_zone), last_line)?;
            let is_closed = close || zone.is_some();
            let zone = zone.unwrap_or_default();
            polylines.push(Polyline { points: Vec::new(), is_closed, zone });
        }
        let points = &mut polylines.last_mut().expect("one was begun").points;
        // A ring that is back at its first point is complete.
        let is_ring = zone.is_some() && points.len() > 2 && points.first() == Some(&point);
        points.push(point);
        (name, begins, last_line) = (Some(named), is_ring, line);
    }
    complete(polylines.last(), name.as_ref().is_some_and(is_zone), last_line)?;
    if polylines.is_empty() { Err(CurveError::NoPoints) } else { Ok(polylines) }
}

/// Whether a polyline's name and zone are those of a zone.
fn is_zone((_, zone): &(Option<Vec<u8>>, Option<Zone>)) -> bool {
    zone.is_some()
}

/// Refuses a polyline of one point, or a zone without area, whose last point is on `line`.
fn complete(polyline: Option<&Polyline>, is_zone: bool, line: u64) -> Result<(), CurveError> {
    match polyline {
        Some(polyline) if is_zone && is_flat(&polyline.points) => {
            Err(CurveError::FlatZone { line, corners: polyline.points.len() })
        }
        Some(polyline) if polyline.points.len() < 2 => Err(CurveError::OnePoint { line }),
        _ => Ok(()),
    }
}

/// Whether all points lie on one line of the plane, by an exact predicate.
fn is_flat(points: &[[f64; 3]]) -> bool {
    let coord = |p: &[f64; 3]| Coord { x: p[0], y: p[1] };
    let Some(a) = points.first().map(coord) else { return true };
    let Some(b) = points.iter().map(coord).find(|b| (b.x, b.y) != (a.x, a.y)) else { return true };
    points.iter().all(|p| orient2d(a, b, coord(p)) == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<Vec<[f64; 3]>>, CurveError> {
        let lines = read_csv(text.as_bytes(), false)?;
        Ok(lines.into_iter().map(|line| line.points).collect())
    }

    #[test]
    fn blank_lines_and_the_polyline_column_begin_polylines() {
        let [a, b, c, d] = [[1.0, 2.0, 0.0], [3.0, 4.0, 0.0], [5.0, 6.0, 0.0], [7.0, 8.0, 0.0]];
        let two = Ok(vec![vec![a, b], vec![c, d]]);
        assert_eq!(read("1,2\n3,4\n\n5,6\n7,8"), two);
        assert_eq!(read("\u{feff}x,y\r\n\r\n1,2\r\n3,4\r\n \r\n\r\n 5 , 6\r\n7,8\r\n"), two);
        assert_eq!(read("polyline,Y,note,X\na,2,?,1\na,4,,3\nb,6,,5\nb,8,,7\n"), two);
        let deep = Ok(vec![vec![[1.0, 2.0, 3.0], [-4.0, 5e-1, 6.0]]]);
        assert_eq!(read("x,y,z\n1,2,3\n-4,5e-1,6\n"), deep);
    }

    #[test]
    fn the_zone_column_makes_closed_polylines_and_begins_new_ones() {
        let text = "zone,x,y\ninclusion,0,0\ninclusion,9,0\ninclusion,9,9\n\
                    Exclusion,1,1\nexclusion,2,1\nexclusion,2,2\n\nEXCLUSION,5,5\n\
                    exclusion,6,5\nexclusion,6,6\nexclusion,5,5\nexclusion,7,7\n\
                    exclusion,8,7\nexclusion,8,8\n";
        let lines = read_csv(text.as_bytes(), false).expect("four zones");
        let told = lines.iter().map(|line| (line.points.len(), line.is_closed, line.zone));
        let wanted = [3, 3, 4, 3].map(|points| (points, true, Zone::Exclusion));
        let wanted = [&[(3, true, Zone::Inclusion)], &wanted[1..]].concat();
        assert_eq!(told.collect::<Vec<_>>(), wanted);
        for flat in
            ["0,0,inclusion\n9,9,inclusion\n", "0,0,inclusion\n1,1,inclusion\n3,3,inclusion\n"]
        {
            let text = format!("x,y,zone\n{flat}");
            let (line, corners) = (flat.lines().count() as u64 + 1, flat.lines().count());
            assert_eq!(read(&text), Err(CurveError::FlatZone { line, corners }));
        }
        let named = CurveError::ZoneColumn { line: 2, name: "type".to_owned() };
        assert_eq!(read("x,y,type\n0,0,Exclusion\n"), Err(named));
        let bad = CurveError::Zone { line: 2, text: "5001".to_owned() };
        assert_eq!(read("x,y,zone\n0,0,5001\n"), Err(bad));
        let none = CurveError::Zone { line: 3, text: String::new() };
        assert_eq!(read("x,y,zone\n0,0,inclusion\n1,0,\n"), Err(none));
    }

    #[test]
    fn comments_are_no_blank_lines_and_semicolons_separate_as_in_files_of_queries() {
        let [a, b, c, d] = [[1.0, 2.0, 0.0], [3.0, 4.0, 0.0], [5.0, 6.0, 0.0], [7.0, 8.0, 0.0]];
        let one = Ok(vec![vec![a, b, c, d]]);
        assert_eq!(read("# by hand\nx;y\n1;2 # first\n  # inner\n#\n3;4\r\n5;6\n7;8#"), one);
        let two = Ok(vec![vec![a, b], vec![c, d]]);
        assert_eq!(read("1,2\n3,4\n# next\n\n5,6\n7,8\n"), two);
        // What follows a name's # is the name's.
        assert_eq!(
            read("polyline,x,y\n#0,9,9\nfence #1,1,2\nfence #1,3,4\nfence #2,5,6\nfence #2,7,8\n"),
            two
        );
        assert_eq!(
            read("1,2\n# one\n\n3,x\n"),
            Err(CurveError::Number { line: 4, field: 2, text: "x".to_owned() })
        );
    }

    #[test]
    fn bad_lines_are_refused_by_their_number() {
        let number = |line, field, text: &str| {
            Err(CurveError::Number { line, field, text: text.to_owned() })
        };
        assert_eq!(read("x,y\n1,2\n\n3,four\n"), number(4, 2, "four"));
        assert_eq!(read("x,y\r\n1,2\r\n\r\n3,four\r\n"), number(4, 2, "four"));
        assert_eq!(read("1,nan\n"), number(1, 2, "nan"));
        assert_eq!(read("1,2\ninf,2"), number(2, 1, "inf"));
        assert_eq!(read("1,2\n\n\n3,1e39"), number(4, 2, "1e39"));
        assert_eq!(read("1,2\n3,4,5\n"), Err(CurveError::Fields { line: 2, wanted: 2, found: 3 }));
        assert_eq!(read("1\n"), Err(CurveError::Fields { line: 1, wanted: 2, found: 1 }));
        assert_eq!(read("1,2\n3,4\n\n5,6\n\n7,8\n9,9"), Err(CurveError::OnePoint { line: 4 }));
        assert_eq!(read("1,2"), Err(CurveError::OnePoint { line: 1 }));
        assert_eq!(read("a,b\n1,2\n"), Err(CurveError::Header { line: 1 }));
        assert_eq!(read("\n \n"), Err(CurveError::NoPoints));
    }
}
