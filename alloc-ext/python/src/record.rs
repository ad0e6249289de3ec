//! Answers as packed records, in this machine's byte order. The dtypes of
//! `python/meshsweep/_records.py` have the same fields in the same order.

use meshsweep_core::{Ended, Interval, Side, Undecided, Verdict};

/// A record that is being written.
pub struct Put<'a>(&'a mut [u8]);

impl<'a> Put<'a> {
    /// Writes from the beginning of `record`.
    pub fn new(record: &'a mut [u8]) -> Self {
        Self(record)
    }

    fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        let record = core::mem::take(&mut self.0);
        let (now, later) = record.split_at_mut(bytes.len());
        now.copy_from_slice(bytes);
        self.0 = later;
        self
    }

    pub fn floats(&mut self, floats: &[f32]) -> &mut Self {
        floats.iter().fold(self, |put, x| put.bytes(&x.to_ne_bytes()))
    }

    pub fn interval(&mut self, Interval { lower, upper }: Interval) -> &mut Self {
        self.floats(&[lower, upper])
    }

    /// A number of the input file, or -1.
    pub fn number(&mut self, number: Option<u32>) -> &mut Self {
        self.bytes(&number.map_or(-1, i64::from).to_ne_bytes())
    }

    pub fn count(&mut self, count: u32) -> &mut Self {
        self.bytes(&count.to_ne_bytes())
    }

    pub fn byte(&mut self, byte: u8) -> &mut Self {
        self.bytes(&[byte])
    }

    pub fn verdict(&mut self, verdict: Verdict) -> &mut Self {
        self.byte(match verdict {
            Verdict::No => 0,
            Verdict::Yes => 1,
            _ => 2,
        })
    }

    /// The verdict of a proof that never tells the opposite.
    pub fn is_clear(&mut self, is_clear: bool) -> &mut Self {
        self.byte(if is_clear { 0 } else { 2 })
    }

    /// 1 outside, -1 inside, 0 undecided.
    pub fn side(&mut self, side: Side) -> &mut Self {
        let sign: i8 = match side {
            Side::Outside => 1,
            Side::Inside => -1,
            _ => 0,
        };
        self.bytes(&sign.to_ne_bytes())
    }

    pub fn ended(&mut self, ended: Ended) -> &mut Self {
        self.byte(match ended {
            Ended::Exact => 0,
            Ended::Tolerance => 1,
            Ended::Steps => 2,
            Ended::Scratch => 3,
            _ => 4,
        })
    }
}

/// How a search ended that gave a verdict.
pub fn ended(verdict: Verdict) -> Ended {
    match verdict {
        Verdict::Yes | Verdict::No => Ended::Exact,
        Verdict::Undecided(Undecided::Steps) => Ended::Steps,
        Verdict::Undecided(Undecided::Scratch) => Ended::Scratch,
        _ => Ended::Resolution,
    }
}
