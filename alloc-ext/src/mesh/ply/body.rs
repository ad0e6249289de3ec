//! The elements of a PLY file, in text or binary.

use std::path::Path;

use super::super::MeshError;
use super::super::layout::{Breaks, next_word};
use super::super::text::{Words, has_digit, not_finite, quoted, too_large, whole, why_no_number};
use super::header::{Element, Encoding, Scalar};

/// What a property is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Skipped,
    /// A coordinate.
    Axis(usize),
    /// Numbers of vertices.
    Corners,
}

/// What is read of an element.
#[derive(Default)]
pub(super) struct Values {
    pub(super) at: [f64; 3],
    pub(super) corners: Vec<i64>,
}

/// The elements that are left.
pub(super) struct Body<'a, L> {
    pub(super) file: &'a Path,
    pub(super) encoding: Encoding,
    /// What line breaks in text mean. The format wants an element on each line.
    pub(super) breaks: Breaks,
    /// A word of the element was read.
    pub(super) is_begun: bool,
    pub(super) words: Words<'a, L>,
    /// The text does not end with a line's end.
    pub(super) may_be_cut: bool,
    /// The unread bytes of a binary file.
    pub(super) rest: &'a [u8],
    /// Lines of more values than the element has, and the first of them.
    pub(super) long_lines: (usize, usize),
    /// Words that follow the element read last on its line.
    pub(super) surplus: usize,
}

/// Why a value is not there.
enum Defect {
    End,
    Value(String),
}

impl<'a, L: Iterator<Item = (usize, &'a str)>> Body<'a, L> {
    /// The number of the line read last, counting from 1, if the file has lines.
    pub(super) fn line(&self) -> Option<usize> {
        (self.encoding == Encoding::Text).then_some(self.words.line)
    }

    /// Reads element `number`, its properties in the roles given.
    pub(super) fn read(
        &mut self,
        element: &Element,
        roles: &[Role],
        number: usize,
        values: &mut Values,
    ) -> Result<(), MeshError> {
        values.corners.clear();
        self.is_begun = false;
        for (property, &role) in element.properties.iter().zip(roles) {
            let done = match property.length {
                None => self.one(property.scalar, role, values),
                Some(length) => self.list(length, property.scalar, role, values),
            };
            done.map_err(|defect| self.refuse(element, number, defect))?;
        }
        if self.breaks != Breaks::None {
            self.surplus = self.words.left_on_line();
        }
        if self.surplus > 0 {
            let (count, first) = self.long_lines;
            self.long_lines = (count + 1, if count == 0 { self.words.line } else { first });
            self.words.skip_to("");
        }
        Ok(())
    }

    fn one(&mut self, scalar: Scalar, role: Role, values: &mut Values) -> Result<(), Defect> {
        match role {
            Role::Skipped if self.encoding == Encoding::Text => self.skip_word(scalar),
            Role::Skipped => self.take(scalar.bytes()).map(drop),
            Role::Axis(axis) => self.number(scalar).map(|x| values.at[axis] = x),
            Role::Corners => self.whole(scalar).map(|vertex| values.corners.push(vertex)),
        }
    }

    fn list(
        &mut self,
        length: Scalar,
        scalar: Scalar,
        role: Role,
        values: &mut Values,
    ) -> Result<(), Defect> {
        let count = self.whole(length)?;
        let count = usize::try_from(count)
            .map_err(|_| Defect::Value(format!("a list cannot have {count} values")))?;
        if role == Role::Skipped && self.encoding != Encoding::Text {
            let bytes = count.checked_mul(scalar.bytes()).ok_or(Defect::End)?;
            return self.take(bytes).map(drop);
        }
        (0..count).try_for_each(|_| self.one(scalar, role, values))
    }

    fn word(&mut self) -> Result<&'a str, Defect> {
        if !std::mem::replace(&mut self.is_begun, true) {
            return self.words.next().ok_or(Defect::End);
        }
        next_word(&mut self.words, self.breaks).ok_or_else(|| match self.breaks {
            Breaks::Lines => Defect::Value("the line has fewer values than the header says".into()),
            _ => Defect::End,
        })
    }

    fn skip_word(&mut self, scalar: Scalar) -> Result<(), Defect> {
        let word = self.word()?;
        let text = word.strip_prefix('"').filter(|_| scalar == Scalar::String);
        if let Some(begun) = text
            && !begun.ends_with('"')
        {
            // To the quote at its end, on the same line.
            let rest = self.words.rest();
            let end = rest
                .find('"')
                .ok_or_else(|| Defect::Value(format!("the text {} has no end", quoted(word))))?;
            self.words.skip_to(&rest[end + 1..]);
        }
        Ok(())
    }

    fn take(&mut self, bytes: usize) -> Result<&'a [u8], Defect> {
        let (taken, rest) = self.rest.split_at_checked(bytes).ok_or(Defect::End)?;
        self.rest = rest;
        Ok(taken)
    }

    /// A number in text as its type holds it.
    fn number(&mut self, scalar: Scalar) -> Result<f64, Defect> {
        if self.encoding != Encoding::Text {
            return self.binary(scalar).map(|number| number.as_f64());
        }
        let word = self.word()?;
        let parsed = match scalar {
            Scalar::F32 => word.parse::<f32>().ok().map(f64::from),
            _ => word.parse::<f64>().ok(),
        };
        match parsed {
            Some(x) if x.is_infinite() && has_digit(word) => Err(Defect::Value(too_large(word))),
            Some(x) => Ok(x),
            None => not_finite(word).ok_or_else(|| Defect::Value(why_no_number(word))),
        }
    }

    fn whole(&mut self, scalar: Scalar) -> Result<i64, Defect> {
        if self.encoding != Encoding::Text {
            return self.binary(scalar).map(|number| number.as_i64());
        }
        let word = self.word()?;
        whole(word).ok_or_else(|| Defect::Value(format!("{} is no whole number", quoted(word))))
    }

    fn binary(&mut self, scalar: Scalar) -> Result<Number, Defect> {
        let mut bytes = [0; 8];
        let bytes = &mut bytes[..scalar.bytes()];
        bytes.copy_from_slice(self.take(scalar.bytes())?);
        if self.encoding == Encoding::Big {
            bytes.reverse();
        }
        Ok(Number::of(scalar, bytes))
    }

    /// Whether a text ends with the word read last, which may be a part of one in a cut file.
    fn ends_in_a_word(&mut self) -> bool {
        self.encoding == Encoding::Text && self.may_be_cut && self.words.next().is_none()
    }

    fn refuse(&mut self, element: &Element, number: usize, defect: Defect) -> MeshError {
        let line = self.line();
        match defect {
            Defect::Value(reason) if !self.ends_in_a_word() => MeshError::Malformed {
                file: self.file.to_owned(),
                line,
                place: format!("{} {number}", element.name),
                reason,
            },
            _ => MeshError::Truncated {
                file: self.file.to_owned(),
                what: element.name.clone(),
                wanted: element.count as u64,
                found: number as u64,
            },
        }
    }
}

/// A number of a binary file.
enum Number {
    Whole(i64),
    Real(f64),
}

impl Number {
    /// From its bytes, the least first.
    fn of(scalar: Scalar, bytes: &[u8]) -> Self {
        let mut wide = [0; 8];
        wide[..bytes.len()].copy_from_slice(bytes);
        let [a, b, c, d, ..] = wide;
        match scalar {
            Scalar::I8 => Self::Whole(i8::from_le_bytes([a]).into()),
            Scalar::I16 => Self::Whole(i16::from_le_bytes([a, b]).into()),
            Scalar::I32 => Self::Whole(i32::from_le_bytes([a, b, c, d]).into()),
            Scalar::F32 => Self::Real(f32::from_le_bytes([a, b, c, d]).into()),
            Scalar::F64 => Self::Real(f64::from_le_bytes(wide)),
            Scalar::U8 | Scalar::U16 | Scalar::U32 | Scalar::I64 | Scalar::String => {
                Self::Whole(i64::from_le_bytes(wide))
            }
            Scalar::U64 => Self::Whole(i64::try_from(u64::from_le_bytes(wide)).unwrap_or(i64::MAX)),
        }
    }

    fn as_f64(&self) -> f64 {
        match *self {
            Self::Whole(x) => x as f64,
            Self::Real(x) => x,
        }
    }

    fn as_i64(&self) -> i64 {
        match *self {
            Self::Whole(x) => x,
            // The roles of whole numbers are given to them only.
            Self::Real(x) => x as i64,
        }
    }
}
