//! Answers as packed records, in this machine's byte order. The dtypes of
//! `python/meshsweep/_records.py` have the same fields in the same order.

use meshsweep::distances::{Closest, Element};
use meshsweep_core::{CurveSegment, Ended, FirstHit, Interval, Side, Undecided, Verdict};

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

    /// Polyline and segment.
    pub fn segment(&mut self, at: Option<CurveSegment>) -> &mut Self {
        self.number(at.map(|at| at.polyline)).number(at.map(|at| at.segment))
    }

    pub fn element(&mut self, element: Option<Element>, is_curve: bool) -> &mut Self {
        match element {
            Some(Element::Segment(at)) => self.segment(Some(at)),
            Some(Element::Triangle(triangle)) => self.number(Some(triangle)),
            None if is_curve => self.segment(None),
            None => self.number(None),
        }
    }

    pub fn closest(&mut self, found: &Closest) -> &mut Self {
        self.interval(found.distance).floats(&found.point);
        self.element(found.element, found.safe_motion.is_some());
        self.floats(found.safe_motion.as_slice());
        self.ended(found.ended).count(found.work.total())
    }

    pub fn first_hit(&mut self, found: &FirstHit) -> &mut Self {
        let verdict = match (found.is_clear(), found.ended) {
            (true, _) => 0,
            (_, Ended::Exact) => 1,
            _ => 2,
        };
        self.byte(verdict).interval(found.t);
        self.floats(&found.hit.map_or([f32::NAN; 3], |hit| hit.point));
        self.number(found.hit.and_then(|hit| hit.triangle));
        self.ended(found.ended).count(found.work.total())
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
