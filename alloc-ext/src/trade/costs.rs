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
            instructions: [2203.1, 504.3, 3.6, 0.0, 0.0, 589.3, 1260.3, 31.8],
            stack: 2732,
            least: 3240.0,
            dearest: 1.316,
            error: 0.2438,
            typical: 0.040,
        },
    ),
    (
        Board::CortexM4F,
        Search::TreeF32,
        Cost {
            instructions: [2682.2, 1238.6, 0.0, 33.0, 0.0, 542.8, 1921.0, 3.1],
            stack: 2732,
            least: 4040.0,
            dearest: 1.385,
            error: 0.1649,
            typical: 0.049,
        },
    ),
    (
        Board::CortexM4F,
        Search::Precise,
        Cost {
            instructions: [9293.4, 2842.6, 82.0, 0.0, 11209.2, 5.5, 2155.3, 0.0],
            stack: 4264,
            least: 23480.0,
            dearest: 1.300,
            error: 0.0802,
            typical: 0.028,
        },
    ),
    (
        Board::CortexM4F,
        Search::Hinted,
        Cost {
            instructions: [3599.5, 645.2, 0.0, 0.0, 0.0, 549.0, 1132.6, 0.0],
            stack: 2732,
            least: 4000.0,
            dearest: 1.267,
            error: 0.1812,
            typical: 0.035,
        },
    ),
    (
        Board::CortexM4F,
        Search::Coherent,
        Cost {
            instructions: [1927.0, 0.0, 49.5, 270.1, 0.0, 422.2, 0.0, 0.0],
            stack: 2748,
            least: 1400.0,
            dearest: 1.958,
            error: 0.1385,
            typical: 0.076,
        },
    ),
    (
        Board::CortexM4F,
        Search::Sweep,
        Cost {
            instructions: [14961.2, 6058.6, 391.3, 596.6, 10386.0, 753.5, 0.0, 371.0],
            stack: 2964,
            least: 36760.0,
            dearest: 1.131,
            error: 0.0532,
            typical: 0.015,
        },
    ),
    (
        Board::CortexM4F,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 7530.6, 389.5, 1482.1, 21471.5, 1665.4, 0.0, 268.7],
            stack: 2164,
            least: 19280.0,
            dearest: 1.250,
            error: 0.3251,
            typical: 0.034,
        },
    ),
    (
        Board::CortexM4F,
        Search::Tight,
        Cost {
            instructions: [1130.3, 5820.3, 0.0, 0.0, 0.0, 721.9, 1246.0, 0.0],
            stack: 3356,
            least: 3280.0,
            dearest: 1.489,
            error: 0.1669,
            typical: 0.046,
        },
    ),
    (
        Board::CortexM4F,
        Search::Triboxes,
        Cost {
            instructions: [1438.9, 0.0, 0.0, 0.0, 0.0, 2662.9, 0.0, 0.0],
            stack: 1884,
            least: 1320.0,
            dearest: 1.085,
            error: 0.0409,
            typical: 0.018,
        },
    ),
    (
        Board::CortexM4F,
        Search::PairOfTrees,
        Cost {
            instructions: [529.7, 18284.2, 0.0, 1553.8, 0.0, 3000.2, 0.0, 0.0],
            stack: 3908,
            least: 520.0,
            dearest: 2.313,
            error: 0.2118,
            typical: 0.043,
        },
    ),
    (
        Board::CortexM4F,
        Search::PairOfTriboxes,
        Cost {
            instructions: [3080.4, 0.0, 936.2, 0.0, 0.0, 1038.8, 0.0, 0.0],
            stack: 2116,
            least: 3320.0,
            dearest: 1.813,
            error: 0.1255,
            typical: 0.055,
        },
    ),
    (
        Board::CortexM0,
        Search::Tree,
        Cost {
            instructions: [34543.8, 14245.8, 0.0, 0.0, 0.0, 0.0, 9727.7, 1782.8],
            stack: 2816,
            least: 23080.0,
            dearest: 2.675,
            error: 0.4983,
            typical: 0.135,
        },
    ),
    (
        Board::CortexM0,
        Search::TreeF32,
        Cost {
            instructions: [19197.1, 44142.6, 0.0, 0.0, 0.0, 0.0, 61916.5, 540.8],
            stack: 2816,
            least: 21360.0,
            dearest: 1.764,
            error: 0.3519,
            typical: 0.080,
        },
    ),
    (
        Board::CortexM0,
        Search::Precise,
        Cost {
            instructions: [71965.0, 82318.4, 0.0, 189.4, 24439.4, 0.0, 59776.0, 0.0],
            stack: 4180,
            least: 151960.0,
            dearest: 1.474,
            error: 0.2467,
            typical: 0.055,
        },
    ),
    (
        Board::CortexM0,
        Search::Hinted,
        Cost {
            instructions: [71914.7, 29826.1, 0.0, 0.0, 0.0, 0.0, 8208.0, 0.0],
            stack: 2808,
            least: 40280.0,
            dearest: 2.226,
            error: 0.4054,
            typical: 0.103,
        },
    ),
    (
        Board::CortexM0,
        Search::Coherent,
        Cost {
            instructions: [60848.8, 0.0, 0.0, 4852.7, 0.0, 0.0, 0.0, 0.0],
            stack: 2832,
            least: 35160.0,
            dearest: 2.842,
            error: 0.3849,
            typical: 0.234,
        },
    ),
    (
        Board::CortexM0,
        Search::Sweep,
        Cost {
            instructions: [53396.1, 99263.2, 8478.2, 4714.3, 24895.7, 3257.9, 0.0, 982.9],
            stack: 3092,
            least: 247040.0,
            dearest: 1.226,
            error: 0.0776,
            typical: 0.030,
        },
    ),
    (
        Board::CortexM0,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 15989.4, 8191.0, 11047.1, 64557.2, 7812.2, 0.0, 209.3],
            stack: 2100,
            least: 43960.0,
            dearest: 1.228,
            error: 0.4258,
            typical: 0.059,
        },
    ),
    (
        Board::CortexM0,
        Search::Tight,
        Cost {
            instructions: [37941.7, 105656.0, 0.0, 0.0, 0.0, 0.0, 8450.6, 0.0],
            stack: 4028,
            least: 35880.0,
            dearest: 2.826,
            error: 0.4191,
            typical: 0.112,
        },
    ),
    (
        Board::CortexM0,
        Search::Triboxes,
        Cost {
            instructions: [28218.7, 0.0, 0.0, 0.0, 0.0, 55007.0, 0.0, 0.0],
            stack: 1948,
            least: 24560.0,
            dearest: 1.102,
            error: 0.0734,
            typical: 0.016,
        },
    ),
    (
        Board::CortexM0,
        Search::PairOfTrees,
        Cost {
            instructions: [16933.7, 243256.5, 0.0, 16017.2, 0.0, 45275.0, 0.0, 0.0],
            stack: 4164,
            least: 15160.0,
            dearest: 2.331,
            error: 0.2141,
            typical: 0.047,
        },
    ),
    (
        Board::CortexM0,
        Search::PairOfTriboxes,
        Cost {
            instructions: [111610.3, 0.0, 20706.4, 0.0, 0.0, 14297.9, 0.0, 0.0],
            stack: 2732,
            least: 120840.0,
            dearest: 1.339,
            error: 0.1192,
            typical: 0.031,
        },
    ),
];
