//! Answers as records, in this machine's byte order. The dtypes of
//! `python/meshsweep/_records.py` have the same fields in the same order.

use meshsweep::distances::{AnyWithin, Closest, Element};
use meshsweep_core::{
    ClosestPoint, CurveNeighbor, CurveSegment, CurveSignedDistance, Decided, DistanceBounds, Ended,
    FieldDistance, FirstHit, Interval, Neighbor, NodePair, PairContact, PairDistance, Penetration,
    Relation, Separation, Side, SignedBounds, SignedDistance, SolidDistance, TriangleHit,
    TrianglePair, TriboxBound, Undecided, Verdict, WindingNumber, Work,
};

/// An answer that has a record.
pub trait Answer {
    /// Writes the fields of the record.
    fn put(&self, put: &mut Put<'_>);
}

/// A record that is being written. Fields are aligned as those of a structure in C.
pub struct Put<'a> {
    record: &'a mut [u8],
    /// Bytes that are written.
    end: usize,
    /// The largest alignment of a field.
    align: usize,
}

/// Writes the record of an answer, which fills all of `record`.
pub fn write(answer: &impl Answer, record: &mut [u8]) {
    let mut put = Put::new(record);
    answer.put(&mut put);
    // A longer record would leave zeros that look like an answer.
    debug_assert_eq!(put.end.next_multiple_of(put.align), put.record.len());
}

impl<'a> Put<'a> {
    /// Writes from the beginning of `record`.
    fn new(record: &'a mut [u8]) -> Self {
        Self { record, end: 0, align: 1 }
    }

    /// Bytes of a field of `T`, or of several.
    fn bytes<T>(&mut self, bytes: &[u8]) -> &mut Self {
        let begin = self.end.next_multiple_of(align_of::<T>());
        self.end = begin + bytes.len();
        self.align = self.align.max(align_of::<T>());
        self.record[begin..self.end].copy_from_slice(bytes);
        self
    }

    fn byte(&mut self, byte: u8) -> &mut Self {
        self.bytes::<u8>(&[byte])
    }

    fn floats(&mut self, floats: &[f32]) -> &mut Self {
        floats.iter().fold(self, |put, x| put.bytes::<f32>(&x.to_ne_bytes()))
    }

    /// A place, or NaN.
    fn place(&mut self, place: Option<[f32; 3]>) -> &mut Self {
        self.floats(&place.unwrap_or([f32::NAN; 3]))
    }

    fn interval(&mut self, Interval { lower, upper }: Interval) -> &mut Self {
        self.floats(&[lower, upper])
    }

    /// The flag `is_certain` of `all_within`, which Python sets. Records of `nearest` have none.
    fn flag_of_list(&mut self) {
        if self.end.next_multiple_of(self.align) < self.record.len() {
            self.byte(0);
        }
    }

    /// A number of the input file, or -1.
    fn number(&mut self, number: Option<u32>) -> &mut Self {
        self.bytes::<i64>(&number.map_or(-1, i64::from).to_ne_bytes())
    }

    /// Two numbers, or -1 twice.
    fn numbers<T: Into<u32>>(&mut self, pair: Option<[T; 2]>) -> &mut Self {
        let [a, b] = pair.map_or([None; 2], |pair| pair.map(|number| Some(number.into())));
        self.number(a).number(b)
    }

    /// Polyline and segment.
    fn segment(&mut self, at: Option<CurveSegment>) -> &mut Self {
        self.number(at.map(|at| at.polyline)).number(at.map(|at| at.segment))
    }

    fn element(&mut self, element: Option<Element>, is_curve: bool) -> &mut Self {
        match element {
            Some(Element::Segment(at)) => self.segment(Some(at)),
            Some(Element::Triangle(triangle)) => self.number(Some(triangle)),
            None if is_curve => self.segment(None),
            None => self.number(None),
        }
    }

    fn verdict(&mut self, verdict: Verdict) -> &mut Self {
        self.byte(match verdict {
            Verdict::No => 0,
            Verdict::Yes => 1,
            _ => 2,
        })
    }

    /// The verdict of a proof that never tells the opposite.
    fn is_clear(&mut self, is_clear: bool) -> &mut Self {
        self.byte(if is_clear { 0 } else { 2 })
    }

    /// 1 outside, -1 inside, 0 undecided.
    fn side(&mut self, side: Side) -> &mut Self {
        let sign: i8 = match side {
            Side::Outside => 1,
            Side::Inside => -1,
            _ => 0,
        };
        self.bytes::<i8>(&sign.to_ne_bytes())
    }

    /// How a search ended, and its work.
    fn end(&mut self, ended: Ended, work: Work) {
        self.byte(match ended {
            Ended::Exact => 0,
            Ended::Tolerance => 1,
            Ended::Steps => 2,
            Ended::Scratch => 3,
            _ => 4,
        });
        self.bytes::<u32>(&work.total().to_ne_bytes());
    }

    /// The same of a search that gave a verdict.
    fn end_of(&mut self, verdict: Verdict, work: Work) {
        let ended = match verdict {
            Verdict::Yes | Verdict::No => Ended::Exact,
            Verdict::Undecided(Undecided::Steps) => Ended::Steps,
            Verdict::Undecided(Undecided::Scratch) => Ended::Scratch,
            _ => Ended::Resolution,
        };
        self.end(ended, work);
    }
}

/// The answers of a row, one behind the other.
impl<A: Answer> Answer for Vec<A> {
    fn put(&self, put: &mut Put<'_>) {
        let size = put.record.len() / self.len().max(1);
        let records = put.record.chunks_mut(size.max(1));
        self.iter().zip(records).for_each(|(answer, record)| write(answer, record));
        put.end = put.record.len();
    }
}

/// The number of a triangle.
#[derive(Clone, Copy)]
pub struct Triangle(pub u32);

/// How far a segment is clear.
pub struct Clipped(pub TriboxBound);

/// Records of answers, each by what it puts in a row.
macro_rules! records {
    ($($answer:ty: |$found:ident, $put:ident| $fields:expr;)*) => {$(
        impl Answer for $answer {
            fn put(&self, $put: &mut Put<'_>) {
                let $found = self;
                $fields;
            }
        }
    )*};
}

records! {
    Closest: |near, put| put.interval(near.distance).floats(&near.point)
        .element(near.element, near.safe_motion.is_some()).floats(near.safe_motion.as_slice())
        .end(near.ended, near.work);
    SignedDistance: |found, put| put.interval(found.distance).side(found.side)
        .floats(&found.closest.point).number(found.closest.triangle)
        .end(found.closest.ended, found.closest.work);
    CurveSignedDistance: |found, put| put.interval(found.distance).side(found.side)
        .floats(&found.closest.point).segment(Some(found.closest.segment))
        .floats(&[found.closest.safe_motion]).end(found.closest.ended, found.closest.work);
    DistanceBounds: |found, put| put.interval(found.distance).end(found.ended, found.work);
    SignedBounds: |found, put| put.interval(found.distance).side(found.side)
        .end(found.ended, found.work);
    // With the gradient.
    (FieldDistance, [f32; 3]): |found, put| put.interval(found.0.distance).side(found.0.side)
        .floats(&found.1);
    WindingNumber: |found, put| put.interval(found.number).side(found.side)
        .end(found.ended, found.work);
    // And whether it is of curves.
    (AnyWithin, bool): |found, put| put.verdict(found.0.verdict).element(found.0.element, found.1)
        .end_of(found.0.verdict, found.0.work);
    // Of one of a row's closest triangles: none of them is unknown.
    ClosestPoint: |near, put| put.interval(near.distance).floats(&near.point)
        .number(near.triangle);
    Triangle: |found, put| put.number(Some(found.0));
    // A verdict without a search.
    Verdict: |found, put| put.verdict(*found).end_of(*found, Work::NONE);
    Decided<u32>: |found, put| put.verdict(found.verdict).number(found.witness)
        .end_of(found.verdict, found.work);
    Decided<[u32; 2]>: |found, put| put.verdict(found.verdict).numbers(found.witness)
        .end_of(found.verdict, found.work);
    Neighbor: |near, put| put.interval(near.distance()).floats(&near.point())
        .number(Some(near.triangle())).flag_of_list();
    CurveNeighbor: |near, put| put.interval(near.distance()).floats(&near.point())
        .segment(Some(near.segment())).flag_of_list();
    FirstHit: |found, put| put
        .byte(match (found.is_clear(), found.ended) {
            (true, _) => 0,
            (_, Ended::Exact) => 1,
            _ => 2,
        })
        .interval(found.t).place(found.hit.map(|hit| hit.point))
        .number(found.hit.and_then(|hit| hit.triangle)).end(found.ended, found.work);
    TriangleHit: |found, put| put.byte(if found.is_certain { 1 } else { 2 })
        .floats(&[found.hit.t]).floats(&found.hit.point).number(found.hit.triangle);
    SolidDistance: |found, put| put.interval(found.distance).floats(found.points.as_flattened())
        .number(Some(found.triangle)).end(found.ended, found.work);
    PairDistance: |found, put| put.interval(found.distance).floats(found.points.as_flattened())
        .numbers(Some(found.triangles)).end(found.ended, found.work);
    PairContact: |found, put| put.is_clear(found.is_clear()).floats(&[found.clear_until])
        .floats(found.points.as_flattened()).numbers(Some(found.triangles))
        .end(found.ended, found.work);
    TrianglePair: |found, put| put.numbers(Some(found.triangles)).byte(u8::from(found.is_certain));
    Penetration: |found, put| put
        .byte(match found.relation {
            Relation::Apart => 0,
            Relation::Overlap => 1,
            Relation::FirstInside => 2,
            Relation::SecondInside => 3,
            _ => 4,
        })
        .interval(found.depth).place(found.apart.map(|pose| pose.translation))
        .place(found.deepest).end(found.ended, found.work);
    TriboxBound: |found, put| put.floats(&[found.lower]).number(found.node)
        .end(found.ended, found.work);
    Clipped: |found, put| found.0.put(put.is_clear(found.0.lower == f32::INFINITY));
    Separation: |found, put| put.is_clear(found.is_apart())
        .numbers(found.may_meet.map(|pair| [pair.a, pair.b])).end(found.ended, found.work);
    NodePair: |found, put| put.numbers(Some([found.a, found.b]));
}
