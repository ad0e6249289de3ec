//! Numbers as text: read to the nearest f32, printed in few digits. A printed bound stays a bound.

use std::fmt;

/// Digits of a measured number after the first one.
const DIGITS: u8 = 5;

/// An upper bound: rounded up.
pub struct AtMost<T>(pub T);

/// A lower bound: rounded down.
pub struct AtLeast<T>(pub T);

/// A measured number that is no bound: rounded to the nearest.
pub struct About<T>(pub T);

/// A percentage: three decimals where they suffice, else few digits, rounded up.
pub struct Percent<T>(pub T);

/// Percentages that three decimals suffice for. A smaller one would read as 0.
const THREE_DECIMALS: std::ops::Range<f64> = 1e-3..1e6;

/// A number of the command line: all its digits.
pub struct Typed<T>(pub T);

/// An f32 in the fewest characters that read back as the same f32. Large and small numbers have an
/// exponent.
pub struct Short(pub f32);

/// The least and the greatest number above 0.
pub const ABOVE_ZERO: [f64; 2] = [f64::from_bits(1), f64::MAX];

/// The least and the greatest number that is not negative.
pub const FROM_ZERO: [f64; 2] = [0.0, f64::MAX];

/// Says which numbers are in a range, from the least to the greatest.
#[must_use]
pub fn wanted(range: [f64; 2]) -> String {
    let [least, most] = range;
    if range == ABOVE_ZERO {
        "a finite number above 0 is wanted".to_owned()
    } else if range == FROM_ZERO {
        "a finite number from 0 is wanted".to_owned()
    } else {
        format!("a number from {least} to {most} is wanted")
    }
}

/// The f32 nearest to a decimal number, or the reason why there is none.
pub fn parse(field: &str) -> Result<f32, &'static str> {
    let exact: f64 = field.parse().map_err(|_| "is not a number; write it like -1.25 or 3e-4")?;
    if !exact.is_finite() {
        return Err("is not finite; remove the query");
    }
    // From the text, not from the f64: two roundings could miss the nearest f32.
    field
        .parse::<f32>()
        .ok()
        .filter(|x| x.is_finite())
        .ok_or("is beyond f32 (3.4e38); choose a larger unit")
}

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Short(x) = *self;
        let is_everyday = x == 0.0 || !x.is_finite() || (1e-5..1e16).contains(&x.abs());
        if is_everyday { write!(f, "{x}") } else { write!(f, "{x:e}") }
    }
}

/// Prints `$kind(x)` as the decimal that `$decimal` makes of `x`.
macro_rules! display {
    ($kind:ident, $decimal:expr) => {
        impl<T: Copy + Into<f64>> fmt::Display for $kind<T> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let x: f64 = self.0.into();
                let decimal: fn(f64) -> String = $decimal;
                f.pad(&text(decimal(x), is_everyday(x)))
            }
        }
    };
}

display!(AtMost, |x| rounded(x, |short| short >= x));
display!(AtLeast, |x| rounded(x, |short| short <= x));
display!(About, |x| rounded(x, |_| true));
display!(Typed, |x| format!("{x:e}"));

impl<T: Copy + Into<f64>> fmt::Display for Percent<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let x = self.0.into();
        if x == 0.0 || THREE_DECIMALS.contains(&x.abs()) {
            f.pad(&format!("{x:.3}"))
        } else {
            f.pad(&AtMost(x).to_string())
        }
    }
}

/// Whether a number is written without an exponent.
fn is_everyday(x: f64) -> bool {
    x == 0.0 || !x.is_finite() || (1e-3..1e7).contains(&x.abs())
}

/// The decimal of few digits that is nearest to `x` among the `fine` ones.
fn rounded(x: f64, fine: impl Fn(f64) -> bool) -> String {
    let nearest = format!("{x:.*e}", usize::from(DIGITS));
    let read = |text: &str| text.parse().unwrap_or(x);
    if !x.is_finite() || fine(read(&nearest)) {
        return nearest;
    }
    let Some((digits, exponent)) = nearest.split_once('e') else { return nearest };
    let Ok(digits) = digits.replace('.', "").parse::<i64>() else { return nearest };
    // One more may carry over, one less may leave fewer digits: both are read correctly.
    let beside = [digits + 1, digits - 1].map(|digits| format!("{digits}e{}", power(exponent)));
    beside.into_iter().find(|text| fine(read(text))).unwrap_or(nearest)
}

/// The exponent of a number whose digits are read as an integer.
fn power(exponent: &str) -> i32 {
    exponent.parse::<i32>().unwrap_or(0) - i32::from(DIGITS)
}

/// A decimal with or without an exponent, without zeros at its end.
fn text(decimal: String, is_everyday: bool) -> String {
    let x: f64 = decimal.parse().unwrap_or(f64::NAN);
    // The shortest text that reads back has no more digits than the decimal.
    if is_everyday { format!("{x}") } else { format!("{x:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_numbers_read_back() {
        for (x, wanted) in [
            (0.0, "0"),
            (-0.0, "-0"),
            (20.0, "20"),
            (-1.25, "-1.25"),
            (1e38, "1e38"),
            (-3.402_823_5e38, "-3.4028235e38"),
            (1e-38, "1e-38"),
            (1e-45, "1e-45"),
            (1.5e-5, "0.000015"),
            (f32::INFINITY, "inf"),
            (f32::NEG_INFINITY, "-inf"),
        ] {
            assert_eq!(Short(x).to_string(), wanted);
        }
        let mut x = f32::from_bits(1);
        while x.is_finite() {
            assert_eq!(Short(x).to_string().parse(), Ok(x));
            assert!(Short(x).to_string().len() <= 18, "{x}");
            x *= 1.7;
        }
    }

    #[test]
    fn bounds_stay_bounds_and_are_short() {
        let mut x = 1e-40f64;
        while x < 1e40 {
            for x in [x, -x] {
                let [up, down, near] =
                    [AtMost(x).to_string(), AtLeast(x).to_string(), About(x).to_string()];
                let read = |text: &String| text.parse::<f64>().unwrap();
                assert!(read(&up) >= x && read(&down) <= x, "{x:e}: {down} {up}");
                for text in [&up, &down, &near] {
                    assert!((read(text) - x).abs() <= 1.01e-5 * x.abs(), "{x:e}: {text}");
                    let digits =
                        text.split('e').next().unwrap().trim_matches(['-', '0']).replace('.', "");
                    assert!(
                        digits.trim_start_matches('0').len() <= 1 + usize::from(DIGITS),
                        "{x:e}: {text}"
                    );
                }
            }
            x *= 1.037;
        }
    }

    #[test]
    fn numbers_read_as_people_write_them() {
        assert_eq!(AtMost(0.123_456_78).to_string(), "0.123457");
        assert_eq!(AtLeast(0.123_456_78).to_string(), "0.123456");
        assert_eq!(AtMost(0.1f32).to_string(), "0.100001");
        assert_eq!(AtMost(0.1).to_string(), "0.1");
        assert_eq!(AtMost(999_999.2).to_string(), "1000000");
        assert_eq!(AtLeast(1_000_000.7).to_string(), "1000000");
        assert_eq!(AtMost(9.999_999e-8).to_string(), "1e-7");
        assert_eq!(
            (About(0.0).to_string(), AtMost(2.5f32).to_string()),
            ("0".into(), "2.5".into())
        );
        assert_eq!(About(1.234_567_8e9).to_string(), "1.23457e9");
        assert_eq!(
            (Typed(0.000_123_456_789).to_string(), Typed(0.1).to_string()),
            ("1.23456789e-4".into(), "0.1".into())
        );
        assert_eq!(format!("{:>8}|{:>8}", AtMost(2.5), AtLeast(0.0)), "     2.5|       0");
    }

    #[test]
    fn percentages_are_neither_nothing_nor_all_digits() {
        for (x, text) in [
            (0.0, "0.000"),
            (12.345_67, "12.346"),
            (1e-3, "0.001"),
            (999_999.0, "999999.000"),
            (9.99e-4, "9.99e-4"),
            (1.234_567_8e-9, "1.23457e-9"),
            (1e6, "1000000"),
            (1.234_561_2e85, "1.23457e85"),
            (-25.0, "-25.000"),
        ] {
            assert_eq!(Percent(x).to_string(), text);
        }
        assert_eq!(format!("{:>9}", Percent(1.5f32)), "    1.500");
    }

    #[test]
    fn the_ends_of_double_precision_are_written_too() {
        for x in [f64::MAX, f64::MIN_POSITIVE, f64::from_bits(1), -f64::MAX] {
            assert!(AtMost(x).to_string().parse::<f64>().unwrap() >= x, "{x:e}");
            assert!(AtLeast(x).to_string().parse::<f64>().unwrap() <= x, "{x:e}");
        }
        assert_eq!(
            (AtMost(f64::INFINITY).to_string(), About(f64::NAN).to_string()),
            ("inf".into(), "NaN".into())
        );
    }
}
