//! Fitted costs. `cargo xtask fit` writes this file, from instructions that QEMU counts. The
//! costs are in the order of `FEATURES`. They are fitted to `bracket.stl`, `groove.obj` and
//! `torus.ply` of `fixtures` and to five meshes that `host-tests/src/counted/fit.rs`
//! generates. That file also names the meshes that `error` and `typical` are of.

use super::cost::{Board, Cost, Search};

/// Costs by board and search.
pub(super) const COSTS: &[(Board, Search, Cost)] = &[
    (
        Board::CortexM4F,
        Search::Tree,
        Cost {
            instructions: [1893.1, 560.8, 13.3, 0.0, 0.0, 407.2, 790.9, 0.0],
            least: 2680.0,
            missed_by: 1.776,
            error: 0.2913,
            typical: 0.051,
        },
    ),
    (
        Board::CortexM4F,
        Search::TreeF32,
        Cost {
            instructions: [2219.2, 1272.1, 5.8, 102.0, 0.0, 413.3, 837.4, 0.0],
            least: 2680.0,
            missed_by: 1.623,
            error: 0.2661,
            typical: 0.080,
        },
    ),
    (
        Board::CortexM4F,
        Search::Precise,
        Cost {
            instructions: [12736.5, 1296.3, 29.7, 176.0, 7811.0, 351.7, 425.6, 0.0],
            least: 20840.0,
            missed_by: 1.381,
            error: 0.0995,
            typical: 0.031,
        },
    ),
    (
        Board::CortexM4F,
        Search::Hinted,
        Cost {
            instructions: [2722.8, 689.7, 0.0, 0.0, 0.0, 488.6, 676.1, 0.0],
            least: 2880.0,
            missed_by: 1.380,
            error: 0.2629,
            typical: 0.040,
        },
    ),
    (
        Board::CortexM4F,
        Search::Coherent,
        Cost {
            instructions: [2058.9, 0.0, 3.7, 0.0, 0.0, 671.4, 1313.7, 0.0],
            least: 1360.0,
            missed_by: 1.789,
            error: 0.1760,
            typical: 0.075,
        },
    ),
    (
        Board::CortexM4F,
        Search::Sweep,
        Cost {
            instructions: [26238.4, 7366.1, 319.4, 1002.5, 743.0, 385.8, 0.0, 542.9],
            least: 21160.0,
            missed_by: 1.521,
            error: 0.1939,
            typical: 0.047,
        },
    ),
    (
        Board::CortexM4F,
        Search::KeptSweep,
        Cost {
            instructions: [1269.6, 5945.3, 266.6, 1331.1, 20204.2, 1373.9, 0.0, 282.0],
            least: 19320.0,
            missed_by: 1.264,
            error: 0.3546,
            typical: 0.041,
        },
    ),
    (
        Board::CortexM4F,
        Search::Tight,
        Cost {
            instructions: [1938.2, 4284.1, 47.7, 0.0, 0.0, 328.3, 626.7, 0.0],
            least: 2320.0,
            missed_by: 1.742,
            error: 0.1925,
            typical: 0.072,
        },
    ),
    (
        Board::CortexM4F,
        Search::Triboxes,
        Cost {
            instructions: [115.8, 0.0, 1331.4, 0.0, 0.0, 0.0, 0.0, 0.0],
            least: 1320.0,
            missed_by: 1.084,
            error: 0.0408,
            typical: 0.018,
        },
    ),
    (
        Board::CortexM4F,
        Search::FirstHit,
        Cost {
            instructions: [162.6, 221.3, 0.0, 143.1, 0.0, 679.1, 0.0, 0.0],
            least: 160.0,
            missed_by: 1.314,
            error: 0.2953,
            typical: 0.061,
        },
    ),
    (
        Board::CortexM4F,
        Search::FirstHitF32,
        Cost {
            instructions: [162.8, 223.5, 0.0, 219.2, 0.0, 667.3, 68.6, 0.0],
            least: 160.0,
            missed_by: 1.504,
            error: 0.2627,
            typical: 0.049,
        },
    ),
    (
        Board::CortexM4F,
        Search::FirstHitOfHull,
        Cost {
            instructions: [132.4, 3196.3, 302.2, 268.9, 12299.6, 477.2, 0.0, 0.0],
            least: 400.0,
            missed_by: 1.308,
            error: 0.2028,
            typical: 0.073,
        },
    ),
    (
        Board::CortexM4F,
        Search::PairOfTrees,
        Cost {
            instructions: [410.9, 15484.5, 0.0, 1430.3, 0.0, 3244.6, 0.0, 0.0],
            least: 400.0,
            missed_by: 3.026,
            error: 0.4612,
            typical: 0.081,
        },
    ),
    (
        Board::CortexM4F,
        Search::PairOfTriboxes,
        Cost {
            instructions: [3041.4, 0.0, 842.6, 0.0, 0.0, 1197.5, 0.0, 0.0],
            least: 3320.0,
            missed_by: 1.865,
            error: 0.1330,
            typical: 0.059,
        },
    ),
    (
        Board::CortexM0,
        Search::Tree,
        Cost {
            instructions: [17612.8, 7211.8, 0.0, 0.0, 0.0, 0.0, 4314.9, 693.9],
            least: 11240.0,
            missed_by: 5.053,
            error: 0.5509,
            typical: 0.115,
        },
    ),
    (
        Board::CortexM0,
        Search::TreeF32,
        Cost {
            instructions: [17097.7, 24844.8, 0.0, 3819.4, 0.0, 10.2, 0.0, 0.0],
            least: 13080.0,
            missed_by: 1.907,
            error: 0.3512,
            typical: 0.096,
        },
    ),
    (
        Board::CortexM0,
        Search::Precise,
        Cost {
            instructions: [70952.7, 40611.3, 27.6, 3660.9, 14761.2, 0.0, 2739.2, 0.0],
            least: 72360.0,
            missed_by: 1.616,
            error: 0.2345,
            typical: 0.059,
        },
    ),
    (
        Board::CortexM0,
        Search::Hinted,
        Cost {
            instructions: [21871.9, 7526.5, 0.0, 0.0, 0.0, 547.7, 3341.2, 0.0],
            least: 13960.0,
            missed_by: 2.742,
            error: 0.3744,
            typical: 0.110,
        },
    ),
    (
        Board::CortexM0,
        Search::Coherent,
        Cost {
            instructions: [15176.7, 0.0, 0.0, 0.0, 0.0, 0.0, 18826.6, 0.0],
            least: 16200.0,
            missed_by: 3.947,
            error: 0.4785,
            typical: 0.315,
        },
    ),
    (
        Board::CortexM0,
        Search::Sweep,
        Cost {
            instructions: [74840.1, 72710.0, 4401.4, 3974.0, 4140.3, 1521.7, 0.0, 1169.1],
            least: 136600.0,
            missed_by: 1.224,
            error: 0.0900,
            typical: 0.020,
        },
    ),
    (
        Board::CortexM0,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 14176.1, 4194.4, 6903.1, 55937.9, 4793.8, 0.0, 508.2],
            least: 44400.0,
            missed_by: 1.197,
            error: 0.4004,
            typical: 0.098,
        },
    ),
    (
        Board::CortexM0,
        Search::Tight,
        Cost {
            instructions: [23404.9, 44834.4, 217.0, 0.0, 0.0, 0.0, 1697.5, 0.0],
            least: 11680.0,
            missed_by: 4.109,
            error: 0.4003,
            typical: 0.130,
        },
    ),
    (
        Board::CortexM0,
        Search::Triboxes,
        Cost {
            instructions: [587.5, 0.0, 26453.3, 0.0, 0.0, 0.0, 0.0, 0.0],
            least: 24640.0,
            missed_by: 1.091,
            error: 0.0605,
            typical: 0.019,
        },
    ),
    (
        Board::CortexM0,
        Search::FirstHit,
        Cost {
            instructions: [605.6, 5797.5, 0.0, 767.1, 0.0, 8347.1, 724.5, 0.0],
            least: 520.0,
            missed_by: 2.006,
            error: 0.3784,
            typical: 0.125,
        },
    ),
    (
        Board::CortexM0,
        Search::FirstHitF32,
        Cost {
            instructions: [585.7, 6205.0, 0.0, 4283.1, 0.0, 7830.9, 906.5, 0.0],
            least: 520.0,
            missed_by: 1.584,
            error: 0.2408,
            typical: 0.045,
        },
    ),
    (
        Board::CortexM0,
        Search::FirstHitOfHull,
        Cost {
            instructions: [65.5, 22892.4, 4993.4, 871.9, 102883.8, 2916.7, 0.0, 0.0],
            least: 4640.0,
            missed_by: 1.281,
            error: 0.3179,
            typical: 0.101,
        },
    ),
    (
        Board::CortexM0,
        Search::PairOfTrees,
        Cost {
            instructions: [15715.9, 199338.0, 0.0, 13961.0, 0.0, 47640.3, 0.0, 0.0],
            least: 13840.0,
            missed_by: 2.778,
            error: 0.5897,
            typical: 0.113,
        },
    ),
    (
        Board::CortexM0,
        Search::PairOfTriboxes,
        Cost {
            instructions: [110380.1, 0.0, 18595.3, 0.0, 0.0, 17663.8, 0.0, 0.0],
            least: 118800.0,
            missed_by: 1.379,
            error: 0.1295,
            typical: 0.034,
        },
    ),
];
