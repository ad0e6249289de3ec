//! The engines that take part.

use meshsweep_host_tests::workload::Subject;

use super::engine::Engine;
use super::{cwbvh, embree, fcpw, parry, tree};

/// A mesh's engine. The blob is for one that reads its index from bytes, which have to outlive it.
type Build = for<'a> fn(&Subject, &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String>;

/// An engine that takes part.
pub struct Entrant {
    /// The engine's name in tables.
    pub name: &'static str,
    /// What else there is to know of it, for the table of engines.
    pub remark: &'static str,
    /// Why it cannot take part on this machine, if it cannot.
    pub missing: fn() -> Option<String>,
    /// Builds its index.
    pub build: Build,
}

/// The engine that all others are compared with.
pub const REFERENCE: &str = "parry3d";

/// All engines, in the order of the tables.
pub const ENTRANTS: [Entrant; 9] = [
    Entrant {
        name: REFERENCE,
        remark: "TriMesh: project_local_point, cast_local_ray, intersects_local_ray",
        missing: || None,
        build: parry::build,
    },
    Entrant {
        name: "obvhs",
        remark: "CWBVH, very slow build, own triangle test: ray_traverse, ray_traverse_miss",
        missing: || None,
        build: cwbvh::build,
    },
    Entrant {
        name: "embree",
        remark: "Debian's, C++, SIMD, robust: rtcPointQuery, rtcIntersect1, rtcOccluded1",
        missing: embree::missing,
        build: embree::build,
    },
    Entrant {
        name: "fcpw",
        remark: "C++, SIMD of 8 lanes: findClosestPoint; bytes unknown",
        missing: fcpw::missing,
        build: fcpw::build,
    },
    Entrant {
        name: "tree",
        remark: "closest_point, first_hit, any_hit on the box tree, 16-bit grid, AVX2 if there",
        missing: || None,
        build: tree::build,
    },
    Entrant {
        name: "tree compiled",
        remark: "the same without FastBvh: by the instructions that the program is compiled for",
        missing: || None,
        build: tree::build_compiled,
    },
    Entrant {
        name: "coherent",
        remark: "CoherentQuery of 128 entries on the same tree, along paths",
        missing: || None,
        build: tree::build_coherent,
    },
    Entrant {
        name: "batch",
        remark: "bvh::closest_points on the same tree, one thread, Morton order included",
        missing: || None,
        build: tree::build_batch,
    },
    Entrant {
        name: "tree single",
        remark: "the same with vertices in f32",
        missing: || None,
        build: tree::build_single,
    },
];
