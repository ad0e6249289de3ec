//! What paper 000 (Platis & Theoharis 2003) reports, for the columns beside ours.

use meshsweep::collapse::Priority;

/// A model of the paper's tables.
#[derive(Clone, Copy, Debug)]
pub struct Model {
    name: &'static str,
    /// Faces of the paper's version.
    pub faces: usize,
    /// Table 1: seconds to 2,000 faces, by strategy.
    pub seconds: [u32; 2],
    /// Table 2: percentages of void at 2,000 and at 200 faces, by strategy.
    pub void: [[f64; 2]; 2],
    /// Table 4: segments of 10,000 that hit.
    pub hits: u32,
    /// Seconds for them in trees of 6-, 14-, 18- and 26-DOPs.
    pub dops: [u32; 4],
    /// The same with progressive hulls.
    pub hull: u32,
}

const MODELS: [Model; 4] = [
    Model {
        name: "rocker-arm",
        faces: 20_088,
        seconds: [54, 8],
        void: [[2.87, 5.72], [28.90, 62.91]],
        hits: 2_044,
        dops: [45, 24, 21, 18],
        hull: 14,
    },
    Model {
        name: "screwdriver",
        faces: 54_300,
        seconds: [161, 26],
        void: [[2.21, 3.53], [20.70, 38.99]],
        hits: 1_641,
        dops: [120, 69, 50, 45],
        hull: 24,
    },
    Model {
        name: "horse",
        faces: 96_966,
        seconds: [298, 45],
        void: [[4.11, 6.86], [65.06, 65.60]],
        hits: 1_119,
        dops: [216, 79, 76, 52],
        hull: 21,
    },
    Model {
        name: "igea",
        faces: 134_342,
        seconds: [478, 69],
        void: [[2.04, 3.02], [12.06, 17.14]],
        hits: 1_808,
        dops: [298, 107, 68, 45],
        hull: 35,
    },
];

/// Hull sizes of the paper's tables 1 and 2.
pub const HULL_FACES: [usize; 2] = [2_000, 200];

/// Table 3, on the horse: base faces; faces tested and splits a segment with the first strategy,
/// then with the second.
pub const HORSE: [(usize, [[u32; 2]; 2]); 8] = [
    (200, [[759, 226], [798, 238]]),
    (500, [[812, 203], [868, 217]]),
    (1_000, [[939, 179], [986, 192]]),
    (2_000, [[1_209, 145], [1_254, 155]]),
    (3_000, [[1_522, 124], [1_550, 131]]),
    (4_000, [[1_841, 108], [1_871, 114]]),
    (5_000, [[2_176, 96], [2_200, 100]]),
    (10_000, [[3_904, 61], [3_907, 63]]),
];

/// The paper's strategies in the order of its columns.
pub const STRATEGIES: [(Priority, &str); 2] = [(Priority::Program, "1st"), (Priority::Span, "2nd")];

impl Model {
    /// The paper's model of a file's name.
    pub fn of(name: &str) -> Option<&'static Self> {
        MODELS.iter().find(|model| model.name == name)
    }

    /// A remark where the mesh at hand is not the paper's very model.
    pub fn remark(&self, faces: usize) -> Option<String> {
        let how = match faces.cmp(&self.faces) {
            std::cmp::Ordering::Less => "coarser",
            std::cmp::Ordering::Equal => return None,
            std::cmp::Ordering::Greater => "finer",
        };
        Some(format!(
            "this mesh has {faces} triangles, {how} than the paper's {}: not comparable as it is",
            self.faces
        ))
    }

    /// Whether Table 3 is about this model.
    pub fn is_horse(&self) -> bool {
        self.name == "horse"
    }
}
