//! The engines that take part.

use meshsweep_host_tests::workload::Subject;

use super::child_engine::ChildEngine;
use super::engine::Engine;
use super::tree::{self, Mode};
use super::{cwbvh, embree, fcpw, parry};

/// A mesh's engine. The blob is for one that reads its index from bytes, which have to outlive it.
/// An error says why the engine cannot take part.
type Build = for<'a> fn(&Subject, &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String>;

/// An engine that takes part.
pub struct Entrant {
    /// The engine's name in tables.
    pub name: &'static str,
    /// What else there is to know of it, for the table of engines.
    pub remark: &'static str,
    /// Builds its index.
    pub build: Build,
}

/// The engine that all others are compared with.
pub const REFERENCE: &str = "parry3d";

/// All engines, in the order of the tables.
pub const ENTRANTS: [Entrant; 10] = [
    Entrant {
        name: REFERENCE,
        remark: "TriMesh: project_local_point, cast_local_ray, intersects_local_ray",
        build: parry::build,
    },
    Entrant {
        name: "obvhs",
        remark: "CWBVH, very slow build, own triangle test: ray_traverse, ray_traverse_miss",
        build: cwbvh::build,
    },
    Entrant {
        name: "embree",
        remark: "Debian's, C++, SIMD, robust: rtcPointQuery, rtcIntersect1, rtcOccluded1",
        build: |subject, _| ChildEngine::start(&embree::PROGRAM, subject),
    },
    Entrant {
        name: "fcpw",
        remark: "PyPI's, C++, AVX2: find_closest_points, intersect, has_line_of_sight; \
                 bytes unknown",
        build: |subject, _| ChildEngine::start(&fcpw::PROGRAM, subject),
    },
    Entrant {
        name: "tree",
        remark: "closest_point, first_hit, any_hit on the box tree, 16-bit grid, AVX2 if there",
        build: |subject, blob| tree::build(subject, blob, Mode::Alone, false),
    },
    Entrant {
        name: "tree compiled",
        remark: "the same without FastBvh: by the instructions that the program is compiled for",
        build: |subject, blob| tree::build(subject, blob, Mode::Compiled, false),
    },
    Entrant {
        name: "hint",
        remark: "closest_point_from on the same tree, AVX2 if there, along paths",
        build: |subject, blob| tree::build(subject, blob, Mode::Hint, false),
    },
    Entrant {
        name: "coherent",
        remark: "CoherentQuery of 128 entries on the same tree, without FastBvh, along paths",
        build: |subject, blob| tree::build(subject, blob, Mode::Coherent, false),
    },
    Entrant {
        name: "batch",
        remark: "bvh::closest_points on the same tree, one thread, Morton order included",
        build: |subject, blob| tree::build(subject, blob, Mode::Batch, false),
    },
    Entrant {
        name: "tree single",
        remark: "as tree, with vertices in f32",
        build: |subject, blob| tree::build(subject, blob, Mode::Alone, true),
    },
];
