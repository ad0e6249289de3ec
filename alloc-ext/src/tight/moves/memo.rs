//! Answers about stars. The search asks for the same stars again and again, because most edits are
//! taken back and the others change little.

use super::star::StarFace;
use crate::tight::shared_map::SharedMap;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// A question about a star.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Question {
    /// The place where a vertex settles.
    Settle = 1,
    /// The cost of a collapse.
    Collapse = 2,
    /// The cost of a split.
    Split = 3,
    /// Whether a flip is possible.
    Flip = 4,
}

/// The hash of a star and a question. If two have the same hash an edit is passed over, or tried
/// and refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key(u64);

/// An odd number whose bits have no pattern (the golden ratio).
pub(crate) const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

impl Key {
    /// `salt` stands for everything else that the answer depends on. The order of the faces does
    /// not count, nor which corner of a face is first.
    pub fn new(question: Question, salt: u64, star: &[StarFace]) -> Self {
        let corner = |p: DVec3| {
            let mix = |h: u64, x: f64| (h.rotate_left(23) ^ x.to_bits()).wrapping_mul(GOLDEN);
            let h = mix(mix(mix(GOLDEN, p.x), p.y), p.z);
            (h ^ (h >> 29)).wrapping_mul(GOLDEN | 0x100)
        };
        let face = |f: &StarFace| {
            let [a, b, c] = f.corners.map(corner);
            let cyclic = a.rotate_left(7).wrapping_mul(b | 1)
                ^ b.rotate_left(7).wrapping_mul(c | 1)
                ^ c.rotate_left(7).wrapping_mul(a | 1);
            (cyclic ^ (cyclic >> 31)).wrapping_mul(GOLDEN)
        };
        let all = star.iter().map(face).fold(0u64, u64::wrapping_add);
        let asked = (question as u64 ^ salt.wrapping_mul(GOLDEN)).wrapping_mul(GOLDEN);
        Self((all ^ asked).wrapping_mul(GOLDEN))
    }
}

/// Number of answers at which all are forgotten.
const CAPACITY: usize = 1 << 18;

/// The place for a star's vertex and the volume that it adds; `None` if there is no place.
pub(super) type Answer = Option<(DVec3, f64)>;

/// Answers by star.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memo(SharedMap<Key, Answer>);

impl Memo {
    /// The answer before.
    pub fn get(&self, key: Key) -> Option<Answer> {
        self.0.get(key)
    }

    /// Remembers an answer.
    pub fn put(&mut self, key: Key, answer: Answer) {
        self.0.insert(key, answer, CAPACITY);
    }

    /// Takes out the answers that no clone shares.
    pub fn take_added(&mut self) -> FxHashMap<Key, Answer> {
        self.0.take_added()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_is_recognised_in_any_order_of_its_faces_and_others_are_not() {
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let [v, a, b, c] =
            [at(0.0, 0.0, 1.0), at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(-1.0, -1.0, 0.0)];
        let star = |v: DVec3| [[v, a, b], [v, b, c], [v, c, a]].map(|t| StarFace::new(t, None));
        let key = |question, salt, star: &[StarFace]| Key::new(question, salt, star);
        let plain = key(Question::Settle, 24, &star(v));
        let turned = [[c, a, v], [a, b, v], [c, v, b]].map(|t| StarFace::new(t, None));
        assert_eq!(plain, key(Question::Settle, 24, &turned));
        let others = [
            key(Question::Collapse, 24, &star(v)),
            key(Question::Settle, 48, &star(v)),
            key(Question::Settle, 24, &star(v + at(0.0, 0.0, f64::EPSILON))),
            key(Question::Settle, 24, &star(v)[..2]),
            key(
                Question::Settle,
                24,
                &[[v, b, a], [v, c, b], [v, a, c]].map(|t| StarFace::new(t, None)),
            ),
        ];
        assert!(others.iter().all(|other| *other != plain));
        let mut memo = Memo::default();
        memo.put(plain, Some((v, -1.0)));
        assert_eq!((memo.get(plain), memo.get(others[0])), (Some(Some((v, -1.0))), None));
    }
}
