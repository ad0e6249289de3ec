//! Fans and questions that a tree over fans asks them: a few, for images of boards.

use super::dop::Slabs;
use super::fan_kernel::{Fan, STORED, cross, distance_sq, dot, folded, hit, minus};
use super::fan_queries::elements;
use super::hierarchy::Hierarchy;
use glam::Vec3;
use meshsweep_host_tests::workload::{Points, Subject, points, segments};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Questions of each kind. With their fans they fit the flash of a Cortex-M0.
pub const ASKED: usize = 200;

/// Points and segments that the questions are taken from.
const DRAWN: usize = 10_000;

/// The fans that are asked, and the questions.
pub struct Sample {
    /// Centre, and rim.
    fans: Vec<([f32; 3], Vec<[f32; 3]>)>,
    /// A fan, and the point.
    distances: Vec<(usize, [f32; 3])>,
    /// A fan, the origin and the way.
    hits: Vec<(usize, [[f32; 3]; 2])>,
    /// Mean triangles of a fan that is asked.
    pub triangles: f64,
}

impl Sample {
    /// Of a mesh: every so many of all questions that the tree asks.
    ///
    /// # Errors
    /// There are no slabs.
    pub fn of(subject: &Subject) -> Result<Self, String> {
        let all = Slabs::all();
        let elements = elements(subject, true);
        let tree = Hierarchy::new(all.first().ok_or("no slabs")?, &elements, 1);
        let (mut near, mut crossed) = (Vec::new(), Vec::new());
        for p in points(subject, Points::Near, DRAWN) {
            tree.nearest(Vec3::from(p).as_dvec3(), |e, least| {
                near.push((e, p));
                let fan = single(&elements[e as usize]);
                let found = distance_sq::<0>(p, &Owned::of(&fan).fan());
                *least = least.min(f64::from(found) * (1.0 + 1e-5));
            });
        }
        for [a, b] in segments(subject, DRAWN) {
            let ends = [a, b].map(|end| Vec3::from(end).as_dvec3());
            tree.crossed(ends, |e| crossed.push((e, [a, minus(b, a)])));
        }
        let mut sample =
            Self { fans: Vec::new(), distances: Vec::new(), hits: Vec::new(), triangles: 0.0 };
        let mut numbers = BTreeMap::new();
        let mut number = |sample: &mut Self, e: u32| {
            *numbers.entry(e).or_insert_with(|| {
                sample.fans.push(single(&elements[e as usize]));
                sample.fans.len() - 1
            })
        };
        for &(e, p) in near.iter().step_by((near.len() / ASKED).max(1)).take(ASKED) {
            let fan = number(&mut sample, e);
            sample.distances.push((fan, p));
        }
        for &(e, ends) in crossed.iter().step_by((crossed.len() / ASKED).max(1)).take(ASKED) {
            let fan = number(&mut sample, e);
            sample.hits.push((fan, ends));
        }
        let asked = sample.distances.iter().map(|of| of.0).chain(sample.hits.iter().map(|of| of.0));
        let sizes: Vec<usize> = asked.map(|fan| sample.fans[fan].1.len() - 1).collect();
        sample.triangles = sizes.iter().sum::<usize>() as f64 / sizes.len().max(1) as f64;
        Ok(sample)
    }

    /// The bits of all distances and of all hits, which no kernel changes.
    ///
    /// # Errors
    /// A kernel gives other bits than the one of vertices alone.
    pub fn bits(&self) -> Result<[u32; 2], String> {
        let all =
            [self.bits_of::<0>(), self.bits_of::<1>(), self.bits_of::<2>(), self.bits_of::<3>()];
        match all.iter().position(|bits| *bits != all[0]) {
            Some(kind) => Err(format!("other answers from {}", STORED[kind])),
            None => Ok(all[0]),
        }
    }

    fn bits_of<const KIND: u8>(&self) -> [u32; 2] {
        let fans: Vec<Owned<'_>> = self.fans.iter().map(Owned::of).collect();
        let distances = self.distances.iter();
        let hits = self.hits.iter();
        [
            distances
                .fold(0, |sum, &(fan, p)| folded(sum, distance_sq::<KIND>(p, &fans[fan].fan()))),
            hits.fold(0, |sum, &(fan, [from, way])| {
                folded(sum, hit::<KIND>(from, way, &fans[fan].fan()))
            }),
        ]
    }

    /// Statics of Rust, which an image includes.
    #[must_use]
    pub fn source(&self) -> String {
        let fans: Vec<Owned<'_>> = self.fans.iter().map(Owned::of).collect();
        let (mut text, mut start) = (String::new(), 0);
        let mut starts = vec!["0".to_owned()];
        for fan in &fans {
            start += fan.rim.len();
            starts.push(start.to_string());
        }
        let list = |text: &mut String, name: &str, of: &str, items: Vec<String>| {
            let all = items.join(", ");
            writeln!(text, "pub static {name}: [{of}; {}] = [{all}];", items.len())
                .expect("a string has room");
        };
        let rims = |of: &dyn Fn(&Owned<'_>) -> Vec<String>| fans.iter().flat_map(of).collect();
        let places = |of: &[[f32; 3]]| of.iter().map(|&p| place(p)).collect::<Vec<_>>();
        list(&mut text, "STARTS", "u16", starts);
        list(&mut text, "CENTRES", "[f32; 3]", fans.iter().map(|fan| place(fan.centre)).collect());
        list(&mut text, "RIMS", "[f32; 3]", rims(&|fan| places(fan.rim)));
        list(&mut text, "EDGES", "[f32; 3]", rims(&|fan| places(&fan.edges)));
        let lengths = |fan: &Owned<'_>| fan.lengths.iter().map(|&x| number(x)).collect();
        list(&mut text, "LENGTHS", "f32", rims(&lengths));
        list(&mut text, "NORMALS", "[f32; 3]", rims(&|fan| places(&fan.normals)));
        let distances = self.distances.iter().map(|&(fan, p)| format!("({fan}, {})", place(p)));
        list(&mut text, "DISTANCES", "(u16, [f32; 3])", distances.collect());
        let hits = self.hits.iter();
        let hits =
            hits.map(|&(fan, [from, way])| format!("({fan}, {}, {})", place(from), place(way)));
        list(&mut text, "HITS", "(u16, [f32; 3], [f32; 3])", hits.collect());
        text
    }
}

/// An element in single precision.
fn single(element: &[glam::DVec3]) -> ([f32; 3], Vec<[f32; 3]>) {
    let mut vertices = element.iter().map(|p| p.as_vec3().to_array());
    (vertices.next().unwrap_or_default(), vertices.collect())
}

/// All digits of a number, as an expression.
fn number(x: f32) -> String {
    format!("f32::from_bits({})", x.to_bits())
}

fn place(p: [f32; 3]) -> String {
    format!("[{}]", p.map(number).join(", "))
}

/// A fan with all that it may store.
struct Owned<'a> {
    centre: [f32; 3],
    rim: &'a [[f32; 3]],
    edges: Vec<[f32; 3]>,
    lengths: Vec<f32>,
    normals: Vec<[f32; 3]>,
}

impl<'a> Owned<'a> {
    fn of((centre, rim): &'a ([f32; 3], Vec<[f32; 3]>)) -> Self {
        let edges: Vec<[f32; 3]> = rim.iter().map(|&end| minus(end, *centre)).collect();
        let lengths = edges.iter().map(|&edge| dot(edge, edge)).collect();
        let pairs = edges.windows(2).map(|pair| cross(pair[0], pair[1]));
        let normals = std::iter::once([0.0; 3]).chain(pairs).take(edges.len()).collect();
        Self { centre: *centre, rim, edges, lengths, normals }
    }

    fn fan(&self) -> Fan<'_> {
        let Self { centre, rim, edges, lengths, normals } = self;
        Fan { centre: *centre, rim, edges, lengths, normals }
    }
}

#[cfg(test)]
mod tests {
    use super::{ASKED, Sample};
    use crate::measure::brute::Brute;
    use meshsweep::mesh::Mesh;
    use meshsweep_host_tests::generate::rough_sphere;
    use meshsweep_host_tests::workload::Subject;

    #[test]
    fn what_is_stored_changes_no_answer_and_no_distance_is_below_the_mesh_s() {
        let (positions, triangles) = rough_sphere(3, 0.3, 2005);
        let subject = Subject::of("rough sphere", Mesh::new(positions, triangles));
        let sample = Sample::of(&subject).expect("there are slabs");
        assert_eq!((sample.distances.len(), sample.hits.len()), (ASKED, ASKED));
        assert!(sample.triangles > 3.0, "{}", sample.triangles);
        sample.bits().expect("the same bits");
        let brute = Brute::new(&subject);
        let fans: Vec<super::Owned<'_>> = sample.fans.iter().map(super::Owned::of).collect();
        let mut met = 0;
        for &(fan, p) in &sample.distances {
            let found = f64::from(super::distance_sq::<0>(p, &fans[fan].fan())).sqrt();
            assert!(found >= brute.distance(p) - 1e-3, "{found} {}", brute.distance(p));
            met += usize::from((found - brute.distance(p)).abs() < 1e-3);
        }
        assert!(met > 0, "no fan is the nearest one");
    }
}
