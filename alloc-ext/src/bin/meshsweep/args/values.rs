//! Values that need more than a number's syntax.

use meshsweep::builder::{For, ranges};
use meshsweep::mesh::Unit;
use meshsweep::number::{ABOVE_ZERO, FROM_ZERO, wanted};
use meshsweep_core::Solid;
use std::num::NonZeroUsize;

/// A question by its name, which is one of all.
pub fn question(name: String) -> For {
    For::ALL.into_iter().find(|of| of.name() == name).unwrap_or(For::Closest)
}

/// The margin of a grid around the mesh's box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Margin {
    /// In the mesh's unit.
    Length(f64),
    /// As a fraction of the longest edge of the box.
    Fraction(f64),
}

pub fn margin(text: &str) -> Result<Margin, String> {
    let wanted = "a length in the mesh's unit or a percentage of the box's longest edge is \
        wanted, as 2.5 or 10%";
    let number = |digits: &str| {
        let parsed =
            digits.trim().parse().ok().filter(|x: &f64| (0.0..=f64::from(f32::MAX)).contains(x));
        parsed.ok_or_else(|| wanted.to_owned())
    };
    match text.strip_suffix('%') {
        Some(percent) => Ok(Margin::Fraction(number(percent)? / 100.0)),
        None => Ok(Margin::Length(number(text)?)),
    }
}

/// Samples of a grid along each axis: one number for all, or three.
pub fn size(text: &str) -> Result<[usize; 3], String> {
    let wanted = "one number from 1 to 65536 is wanted, or three, as 64 or 64,32,32";
    let counts: Option<Vec<usize>> = text
        .split(',')
        .map(|count| count.trim().parse().ok().filter(|count| (1..=1 << 16).contains(count)))
        .collect();
    match counts.as_deref() {
        Some(&[all]) => Ok([all; 3]),
        Some(&[x, y, z]) => Ok([x, y, z]),
        _ => Err(wanted.to_owned()),
    }
}

/// A unit by its symbol.
pub fn unit(text: &str) -> Result<Unit, String> {
    let found = Unit::ALL.into_iter().find(|unit| unit.symbol() == text);
    found.ok_or_else(|| format!("one of {} is wanted", Unit::ALL.map(Unit::symbol).join(", ")))
}

/// A number of bytes, or of 1024 bytes with K.
pub fn sdf_bytes(text: &str) -> Result<u32, String> {
    let [least, most] = ranges::SDF_BYTES;
    let (digits, unit) = text.strip_suffix(['K', 'k']).map_or((text, 1), |digits| (digits, 1024));
    let bytes = digits.trim().parse::<u32>().ok().and_then(|count| count.checked_mul(unit));
    let bytes = bytes.filter(|bytes| (least..=most).contains(bytes));
    bytes
        .ok_or_else(|| format!("bytes from {least} to {}K are wanted, as 16K or 5000", most / 1024))
}

/// A whole number from `LEAST` to `MOST`.
pub fn whole<const LEAST: u32, const MOST: u32>(text: &str) -> Result<u32, String> {
    let wanted = || match MOST {
        u32::MAX => format!("a whole number is wanted, at least {LEAST}"),
        _ => format!("a whole number from {LEAST} to {MOST} is wanted"),
    };
    text.trim().parse().ok().filter(|n| (LEAST..=MOST).contains(n)).ok_or_else(wanted)
}

/// A number of threads. A thousand would wait for each other.
pub fn threads(text: &str) -> Result<NonZeroUsize, String> {
    let threads = text.parse().ok().filter(|&threads: &NonZeroUsize| threads.get() <= 256);
    threads.ok_or_else(|| "a whole number from 1 to 256 is wanted".to_owned())
}

/// A point: three finite numbers.
pub fn point(text: &str) -> Result<[f32; 3], String> {
    let wanted = "three numbers are wanted, as 1,-2.5,3";
    let coordinates: Option<Vec<f32>> =
        text.split(',').map(|x| x.trim().parse().ok().filter(|x: &f32| x.is_finite())).collect();
    coordinates.and_then(|p| <[f32; 3]>::try_from(p).ok()).ok_or_else(|| wanted.to_owned())
}

/// The corners of a convex tool when its place is 0,0,0.
#[derive(Clone, Debug, PartialEq)]
pub struct Tool(Vec<[f32; 3]>);

impl Tool {
    /// Its corners when it is at a place, rounded, and no less than how far rounding moved one.
    pub fn at(&self, place: [f32; 3]) -> (Vec<[f32; 3]>, f64) {
        let mut moved = 0f64;
        let corner = |corner: &[f32; 3]| {
            let at = [0, 1, 2].map(|k| corner[k] + place[k]);
            let off = [0, 1, 2].map(|k| {
                // The sum of two f32 is exact in f64, but for numbers of very different size.
                let (a, b) = (f64::from(corner[k]), f64::from(place[k]));
                let sum = a + b;
                let rest = if sum - a == b && sum - b == a { 0.0 } else { a.abs().min(b.abs()) };
                (f64::from(at[k]) - sum).abs() + rest
            });
            moved = moved.max(off.iter().sum());
            at
        };
        (self.0.iter().map(corner).collect(), moved)
    }
}

/// One to 32 points.
pub fn tool(text: &str) -> Result<Tool, String> {
    let numbers: Option<Vec<f32>> =
        text.split(',').map(|x| x.trim().parse().ok().filter(|x: &f32| x.is_finite())).collect();
    let numbers = numbers.unwrap_or_default();
    let (corners, rest) = numbers.as_chunks::<3>();
    if corners.is_empty() || !rest.is_empty() || corners.len() > Solid::MOST_CORNERS {
        let most = Solid::MOST_CORNERS;
        return Err(format!("three numbers for each of 1 to {most} corners, as 0,0,0,0,0,40"));
    }
    Ok(Tool(corners.to_vec()))
}

/// Two points: six finite numbers.
pub fn two_points(text: &str) -> Result<[[f32; 3]; 2], String> {
    let wanted = || "six numbers are wanted, as 1,-2.5,3,4,5,6".to_owned();
    let comma = text.match_indices(',').nth(2).ok_or_else(wanted)?.0;
    let end = |text: &str| point(text).map_err(|_| wanted());
    Ok([end(&text[..comma])?, end(&text[comma + 1..])?])
}

/// A direction: three finite numbers, not all 0.
pub fn direction(text: &str) -> Result<[f32; 3], String> {
    let along = point(text)?;
    if along == [0.0; 3] { Err("a direction is not 0,0,0".to_owned()) } else { Ok(along) }
}

pub fn tolerance(text: &str) -> Result<f32, String> {
    let wanted = "a number from 0 to 3.4e38 is wanted";
    text.parse().ok().filter(|x: &f32| *x >= 0.0 && x.is_finite()).ok_or_else(|| wanted.to_owned())
}

/// A key frame, or a place between two. The blob tells the last one.
pub fn frame(text: &str) -> Result<f32, String> {
    let wanted = "a key frame from 0 is wanted, as 2, or a place between two, as 1.25";
    text.parse().map_err(|_| wanted.to_owned())
}

fn number(text: &str, range: [f64; 2]) -> Result<f64, String> {
    let [least, most] = range;
    text.parse().ok().filter(|x| (least..=most).contains(x)).ok_or_else(|| wanted(range))
}

/// A number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text, ABOVE_ZERO)
}

/// A length above 0, in the mesh's unit.
pub fn distance(text: &str) -> Result<f64, String> {
    number(text, ABOVE_ZERO).map_err(in_unit)
}

/// A length from 0, in the mesh's unit.
pub fn length(text: &str) -> Result<f64, String> {
    number(text, FROM_ZERO).map_err(in_unit)
}

fn in_unit(wanted: String) -> String {
    format!("{wanted}, in the mesh's unit")
}

/// A percentage above 0, with or without its sign.
pub fn percent(text: &str) -> Result<f64, String> {
    let wanted = || "a finite percentage above 0 is wanted, as 15 or 15%".to_owned();
    positive(text.strip_suffix('%').unwrap_or(text).trim()).map_err(|_| wanted())
}

/// A factor from 0.
pub fn factor(text: &str) -> Result<f64, String> {
    number(text, ranges::EFFORT)
}

pub fn ratio(text: &str) -> Result<f64, String> {
    number(text, ranges::COMPACTNESS)
}

pub fn degrees(text: &str) -> Result<f64, String> {
    number(text, ranges::NORMAL_DEVIATION)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn margins_are_lengths_or_percentages() {
        assert_eq!(margin("2.5"), Ok(Margin::Length(2.5)));
        assert_eq!(margin("10%"), Ok(Margin::Fraction(0.1)));
        assert_eq!(margin("0"), Ok(Margin::Length(0.0)));
        for wrong in ["", "%", "-1", "nan", "inf", "1e39", "10 percent"] {
            assert!(margin(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn sizes_are_one_number_or_three() {
        assert_eq!(size("64"), Ok([64; 3]));
        assert_eq!(size("1, 2,3"), Ok([1, 2, 3]));
        for wrong in ["", "0", "1,2", "1,2,3,4", "-1", "65537", "1.5"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn counts_say_their_range() {
        assert_eq!(whole::<3, 255>("12"), Ok(12));
        for wrong in ["", "2", "256", "-3", "1.5"] {
            assert_eq!(
                whole::<3, 255>(wrong).unwrap_err(),
                "a whole number from 3 to 255 is wanted"
            );
        }
        assert_eq!(
            whole::<4, { u32::MAX }>("-3").unwrap_err(),
            "a whole number is wanted, at least 4"
        );
        assert!(threads("0").unwrap_err().contains("from 1 to 256") && threads("2").is_ok());
        assert!(threads("257").is_err() && threads("256").is_ok());
    }

    #[test]
    fn percentages_are_above_zero() {
        assert_eq!((percent("15"), percent("0.5 %")), (Ok(15.0), Ok(0.5)));
        for wrong in ["", "%", "0", "-1", "nan", "inf%"] {
            assert!(percent(wrong).is_err(), "{wrong}");
        }
        assert!(
            positive("0").is_err()
                && positive("1e-30").is_ok()
                && factor("0").is_ok()
                && factor("-1").is_err()
        );
    }

    #[test]
    fn lengths_are_finite_and_not_negative() {
        assert_eq!(
            (length("0"), length("2.5e-30"), length("1e39")),
            (Ok(0.0), Ok(2.5e-30), Ok(1e39))
        );
        for wrong in ["", "-1", "-1e-300", "nan", "inf", "1e999", "2%"] {
            for error in [length(wrong).unwrap_err(), distance(wrong).unwrap_err()] {
                assert!(
                    error.contains("finite") && error.contains("the mesh's unit"),
                    "{wrong}: {error}"
                );
            }
        }
        assert!(distance("0").is_err() && distance("1e-30") == Ok(1e-30));
    }

    #[test]
    fn points_are_three_finite_numbers_and_directions_not_all_zero() {
        assert_eq!(point("1,-2.5,3e2"), Ok([1.0, -2.5, 300.0]));
        for wrong in ["", "1,2", "1,2,3,4", "1,2,nan", "1,2,1e39"] {
            assert!(point(wrong).is_err(), "{wrong}");
        }
        assert_eq!(two_points("1,2,3,-4,5,6"), Ok([[1.0, 2.0, 3.0], [-4.0, 5.0, 6.0]]));
        for wrong in ["", "1,2,3", "1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,3,4,5,inf"] {
            assert!(two_points(wrong).is_err(), "{wrong}");
        }
        assert_eq!(direction("0,-1,0"), Ok([0.0, -1.0, 0.0]));
        assert!(direction("0,0,-0").is_err());
    }
}
