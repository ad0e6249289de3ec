//! Questions whose instructions a simulator counts.
//!
//! ```text
//! host place (blob and rows of numbers, with the builder) ─ file ─ counted (the core alone)
//! ```
//! The builder is no part of the counted program: it compiles in a fraction of the time, and the
//! simulator does not run it.

pub mod answers;
pub mod callgrind;
mod deform;
mod hull;
pub mod placed;
mod tree;
pub mod triboxes;

use meshsweep_core::Pose;

/// A kind of question, the blob, and the numbers of each query.
#[derive(Clone, Debug, PartialEq)]
pub struct Counted<'t> {
    /// The structure and the question, such as `tree first_hit`.
    pub kind: &'t str,
    /// The blob; of kind `placed` with its places.
    pub blob: &'t [u8],
    /// The queries' numbers, one query after the other.
    pub numbers: Vec<f32>,
}

impl<'t> Counted<'t> {
    /// Its bytes: the line of the kind, the blob's length and bytes, the numbers; little-endian.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = format!("{}\n", self.kind).into_bytes();
        bytes.extend((self.blob.len() as u32).to_le_bytes());
        bytes.extend(self.blob);
        bytes.extend(self.numbers.iter().flat_map(|number| number.to_le_bytes()));
        bytes
    }

    /// Reads what [`to_bytes`](Self::to_bytes) wrote.
    #[must_use]
    pub fn read(bytes: &'t [u8]) -> Option<Self> {
        let line = bytes.iter().position(|&byte| byte == b'\n')?;
        let kind = std::str::from_utf8(&bytes[..line]).ok()?;
        let (length, rest) = bytes[line + 1..].split_first_chunk::<4>()?;
        let (blob, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        let numbers = rest.as_chunks().0.iter().map(|word| f32::from_le_bytes(*word)).collect();
        Some(Self { kind, blob, numbers })
    }

    /// Asks the first `queries`; `NODES TRIANGLES A_LEAF`: the nodes and triangles looked at, and
    /// the triangles of a leaf, where the question counts them.
    ///
    /// # Errors
    /// An unknown question, or a blob that is refused.
    pub fn ask(&self, queries: usize) -> Result<String, String> {
        let (structure, question) = self.kind.split_once(' ').unwrap_or((self.kind, ""));
        match structure {
            "tree" => return tree::ask(self, question, queries),
            "placed" => return Ok(format!("0 0 1 {}", placed::ask(self.blob, queries)?)),
            "hull" => hull::ask(self, question, queries),
            "triboxes" => triboxes::ask(self, question, queries),
            "deform" => deform::ask(self, question, queries),
            _ => Err(format!("no question `{}`", self.kind)),
        }
        .map(|()| "0 0 1".to_owned())
    }

    /// The first queries, of `N` numbers each.
    fn rows<const N: usize>(&self, queries: usize) -> &[[f32; N]] {
        let rows = self.numbers.as_chunks().0;
        &rows[..queries.min(rows.len())]
    }

    fn points(&self, queries: usize) -> impl Iterator<Item = [f32; 3]> {
        self.rows(queries).iter().copied()
    }

    fn segments(&self, queries: usize) -> impl Iterator<Item = [[f32; 3]; 2]> {
        self.rows(queries).iter().map(|&[a, b, c, d, e, f]| [[a, b, c], [d, e, f]])
    }

    fn poses(&self, queries: usize) -> impl Iterator<Item = Pose> {
        self.rows::<12>(queries).iter().map(|row| {
            let row = |k| [row[k], row[k + 1], row[k + 2]];
            Pose::rigid([row(0), row(3), row(6)], row(9))
        })
    }
}

/// The numbers of a pose, as [`Counted`] holds them.
#[must_use]
pub fn numbers_of(pose: &Pose) -> [f32; 12] {
    let [a, b, c] = pose.rotation;
    let mut rows = [a, b, c, pose.translation].into_iter().flatten();
    std::array::from_fn(|_| rows.next().unwrap_or_default())
}
