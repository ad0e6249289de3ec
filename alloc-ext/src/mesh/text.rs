//! Decimal text, as all formats of text share it.
//!
//! OBJ, OFF and STL are read here and not by a crate: `tobj` renumbers vertices and names neither
//! line nor face in its errors, `stl_io` reads only the first solid of an ASCII file, silently, and
//! rounds to `f32` without saying by how much.

use std::borrow::Cow;
use std::path::Path;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE};

use super::MeshError;

/// The text of a file in UTF-8 or UTF-16, without byte order mark, and without the NULs and the
/// mark of the end (^Z) that some writers append. Other bytes occur in names and comments only.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    // The marks of byte order go first.
    let (text, ..) = bare_utf_16(bytes).unwrap_or(UTF_8).decode(bytes);
    let is_padding = |c: char| matches!(c, '\0' | '\x1A') || c.is_ascii_whitespace();
    match text {
        Cow::Borrowed(text) => Cow::Borrowed(text.trim_end_matches(is_padding)),
        Cow::Owned(mut text) => {
            text.truncate(text.trim_end_matches(is_padding).len());
            Cow::Owned(text)
        }
    }
}

/// Whether a text is UTF-16, with a mark or without.
pub(super) fn is_utf_16(bytes: &[u8]) -> bool {
    matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]) || bare_utf_16(bytes).is_some()
}

/// UTF-16 without a mark: every second byte of the first words is zero.
fn bare_utf_16(bytes: &[u8]) -> Option<&'static Encoding> {
    match bytes {
        [1..=255, 0, 1..=255, 0, 1..=255, 0, ..] => Some(UTF_16LE),
        [0, 1..=255, 0, 1..=255, 0, 1..=255, ..] => Some(UTF_16BE),
        _ => None,
    }
}

/// The lines of a text, numbered from 1. A line ends with CR, LF or both.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let ended =
        text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'));
    ended.enumerate().map(|(i, line)| (i + 1, line))
}

/// A line without its comment, which begins with `#`. That of `1.#IND`, which the runtime of
/// Windows writes, begins none.
pub(super) fn without_comment(line: &str) -> &str {
    let begins = |&(at, _): &(usize, &str)| !line[..at].ends_with('.');
    line.match_indices('#').find(begins).map_or(line, |(at, _)| &line[..at])
}

/// Words across lines.
pub(super) struct Words<'a, L> {
    lines: L,
    /// The number of the line that has the word read last.
    pub(super) line: usize,
    rest: &'a str,
}

impl<'a, L: Iterator<Item = (usize, &'a str)>> Words<'a, L> {
    pub(super) fn new(lines: L) -> Self {
        Self { lines, line: 0, rest: "" }
    }

    /// The rest of the line.
    pub(super) fn rest(&self) -> &'a str {
        self.rest
    }

    /// The next word of the line.
    pub(super) fn peek(&self) -> Option<&'a str> {
        self.rest.split_ascii_whitespace().next()
    }

    /// The next word, if the line has another.
    pub(super) fn next_on_line(&mut self) -> Option<&'a str> {
        self.peek().and_then(|_| self.next())
    }

    /// How many words the line still has.
    pub(super) fn left_on_line(&self) -> usize {
        self.rest.split_ascii_whitespace().count()
    }

    /// How many words the rest of the line has, and each line that follows, if it has any.
    pub(super) fn widths(self) -> impl Iterator<Item = usize> {
        let lines = std::iter::once(self.rest).chain(self.lines.map(|(_, text)| text));
        lines.map(|text| text.split_ascii_whitespace().count()).filter(|&words| words > 0)
    }

    /// The bytes of all words that are left, each with the blank before it, if they are no numbers.
    /// Else the line of the first.
    pub(super) fn bytes_left(mut self) -> Result<usize, usize> {
        let Some(first) = self.next() else { return Ok(0) };
        if number(first).is_ok() {
            return Err(self.line);
        }
        Ok(first.len() + self.map(|word| word.len() + 1).sum::<usize>())
    }

    /// Goes to the end of the line, or to `rest` of it.
    pub(super) fn skip_to(&mut self, rest: &'a str) {
        self.rest = rest;
    }
}

impl<'a, L: Iterator<Item = (usize, &'a str)>> Iterator for Words<'a, L> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        loop {
            let rest = self.rest.trim_ascii_start();
            if !rest.is_empty() {
                let end = rest.bytes().position(|b| b.is_ascii_whitespace()).unwrap_or(rest.len());
                let (word, rest) = rest.split_at(end);
                self.rest = rest;
                return Some(word);
            }
            let (line, text) = self.lines.next()?;
            self.line = line;
            self.rest = text;
        }
    }
}

/// A word for a message: quoted, and cut if it is long.
pub(super) fn quoted(word: &str) -> String {
    const MOST: usize = 32;
    match word.char_indices().nth(MOST) {
        Some((end, _)) => format!("{:?} …", &word[..end]),
        None => format!("{word:?}"),
    }
}

/// A keyword, of which programs may write capitals.
pub(super) fn lowercase(word: &str) -> Cow<'_, str> {
    if word.bytes().any(|b| b.is_ascii_uppercase()) {
        Cow::Owned(word.to_ascii_lowercase())
    } else {
        Cow::Borrowed(word)
    }
}

/// A number that is not finite, as the C libraries write it: `-1.#IND`, `nan(ind)`.
pub(super) fn not_finite(word: &str) -> Option<f64> {
    let word = word.to_ascii_lowercase();
    let bare = word.trim_start_matches(['-', '+']);
    if bare.starts_with("nan")
        || ["#ind", "#qnan", "#snan", "#nan"].iter().any(|of| bare.contains(of))
    {
        return Some(f64::NAN);
    }
    let infinite = if word.starts_with('-') { f64::NEG_INFINITY } else { f64::INFINITY };
    (bare.starts_with("inf") || bare.contains("#inf")).then_some(infinite)
}

/// A word as a number, or why it is none.
pub(super) fn number(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(x) if x.is_infinite() && has_digit(word) => Err(too_large(word)),
        Ok(x) => Ok(x),
        Err(_) => not_finite(word).ok_or_else(|| why_no_number(word)),
    }
}

/// Whether a word is not the name of a number.
pub(super) fn has_digit(word: &str) -> bool {
    word.bytes().any(|b| b.is_ascii_digit())
}

pub(super) fn too_large(word: &str) -> String {
    format!("{} is too large a number", quoted(word))
}

/// A whole number. Some programs write all numbers alike, as `3.000e+00`.
pub(super) fn whole(word: &str) -> Option<i64> {
    const MOST: f64 = (1u64 << 53) as f64;
    let real = || word.parse().ok().filter(|x: &f64| x.fract() == 0.0 && x.abs() <= MOST);
    word.parse().ok().or_else(|| real().map(|x| x as i64))
}

pub(super) fn why_no_number(word: &str) -> String {
    let quoted = quoted(word);
    if word.contains(',') && word.replacen(',', ".", 1).parse::<f64>().is_ok() {
        return format!("{quoted} has a comma; numbers are written with a point");
    }
    format!("{quoted} is not a number")
}

/// The next three words as the coordinates of vertex `vertex`.
pub(super) fn point<'a>(
    file: &Path,
    line: usize,
    vertex: usize,
    words: &mut impl Iterator<Item = &'a str>,
) -> Result<[f64; 3], MeshError> {
    let mut at = [0.0f64; 3];
    for x in &mut at {
        let word = words.next().ok_or_else(|| "fewer than three coordinates".to_owned());
        *x = word.and_then(number).map_err(|reason| MeshError::Malformed {
            file: file.to_owned(),
            line: Some(line),
            place: format!("vertex {vertex}"),
            reason,
        })?;
    }
    finite(file, line, vertex, at)
}

/// The coordinates of vertex `vertex`, if they are finite.
pub(super) fn finite(
    file: &Path,
    line: usize,
    vertex: usize,
    at: [f64; 3],
) -> Result<[f64; 3], MeshError> {
    if at.iter().all(|x| x.is_finite()) {
        return Ok(at);
    }
    Err(MeshError::NotFinite { file: file.to_owned(), line: Some(line), vertex, at })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_with_cr_lf_or_both_and_are_counted() {
        let found: Vec<_> = lines("a\r\nb\rc\n\nd").collect();
        assert_eq!(found, [(1, "a"), (2, "b"), (3, "c"), (4, ""), (5, "d")]);
    }

    #[test]
    fn texts_of_all_marks_and_paddings_are_the_same() {
        let utf_16 = |with: fn(u16) -> [u8; 2], mark: &str| -> Vec<u8> {
            format!("{mark}v 1 2\n").encode_utf16().flat_map(with).collect()
        };
        for bytes in [
            b"v 1 2\n\0\0\x1A".to_vec(),
            b"\xEF\xBB\xBFv 1 2\r\n".to_vec(),
            utf_16(u16::to_le_bytes, "\u{FEFF}"),
            utf_16(u16::to_be_bytes, "\u{FEFF}"),
            utf_16(u16::to_le_bytes, ""),
            utf_16(u16::to_be_bytes, ""),
        ] {
            assert_eq!(decoded(&bytes), "v 1 2", "{bytes:?}");
        }
    }

    #[test]
    fn words_that_are_no_numbers_say_why() {
        let why = |word: &str| number(word).unwrap_err();
        assert!(why("1,5").contains("has a comma"), "{}", why("1,5"));
        assert_eq!(why("l0"), "\"l0\" is not a number");
        assert_eq!(why("-1e400"), "\"-1e400\" is too large a number");
        assert!(why(&"\u{0}".repeat(1000)).len() < 300);
        let wholes = ["3", "3.000e+00", "-1.0", "3.5", "x", "1e300", "nan"].map(whole);
        assert_eq!(wholes, [Some(3), Some(3), Some(-1), None, None, None, None]);
        for word in ["-1.#IND", "1.#QNAN", "nan", "NaN", "-nan(ind)", "1.#INF", "-inf", "Infinity"]
        {
            assert!(number(word).is_ok_and(|x| !x.is_finite()), "{word}");
        }
    }
}
