//! Fitted costs. `cargo xtask fit` writes this file, from instructions that QEMU counts. The
//! costs are in the order of `FEATURES`. They are fitted to `bracket.stl`, `groove.obj` and
//! `torus.ply` of `fixtures` and to five meshes that `host-tests/src/counted/fit.rs`
//! generates. That file also names the meshes that `error` and `typical` are of.

use super::cost::{Board, Cost, Search};

/// Costs by board and search.
pub(super) const COSTS: [(Board, Search, Cost); 16] = [
    (
        Board::CortexM4F,
        Search::Tree,
        Cost {
            instructions: [2153.7, 572.4, 0.0, 0.0, 0.0, 520.9, 1218.2, 132.9],
            stack: 1660,
            least: 3120.0,
            dearest: 1.360,
            error: 0.2001,
            typical: 0.032,
        },
    ),
    (
        Board::CortexM4F,
        Search::TreeF32,
        Cost {
            instructions: [2724.9, 1432.7, 0.0, 154.6, 0.0, 433.5, 1135.3, 108.4],
            stack: 1660,
            least: 4080.0,
            dearest: 1.415,
            error: 0.1551,
            typical: 0.054,
        },
    ),
    (
        Board::CortexM4F,
        Search::Hinted,
        Cost {
            instructions: [3592.7, 652.7, 0.0, 0.0, 0.0, 559.0, 1132.9, 0.0],
            stack: 1660,
            least: 3800.0,
            dearest: 1.322,
            error: 0.1899,
            typical: 0.027,
        },
    ),
    (
        Board::CortexM4F,
        Search::Coherent,
        Cost {
            instructions: [1858.8, 0.0, 70.9, 273.6, 0.0, 272.2, 0.0, 0.0],
            stack: 1888,
            least: 1280.0,
            dearest: 1.953,
            error: 0.1388,
            typical: 0.080,
        },
    ),
    (
        Board::CortexM4F,
        Search::Sweep,
        Cost {
            instructions: [14076.9, 6026.1, 391.6, 600.1, 10324.5, 759.5, 0.0, 367.7],
            stack: 2924,
            least: 35720.0,
            dearest: 1.131,
            error: 0.0534,
            typical: 0.014,
        },
    ),
    (
        Board::CortexM4F,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 7377.0, 386.2, 1491.8, 21241.9, 1683.9, 0.0, 265.8],
            stack: 2516,
            least: 18920.0,
            dearest: 1.251,
            error: 0.3268,
            typical: 0.035,
        },
    ),
    (
        Board::CortexM4F,
        Search::Tight,
        Cost {
            instructions: [0.0, 9595.5, 0.0, 0.0, 0.0, 668.9, 1456.6, 0.0],
            stack: 3280,
            least: 3040.0,
            dearest: 1.605,
            error: 0.1873,
            typical: 0.047,
        },
    ),
    (
        Board::CortexM4F,
        Search::Triboxes,
        Cost {
            instructions: [78.8, 0.0, 1333.6, 0.0, 0.0, 0.0, 0.0, 0.0],
            stack: 956,
            least: 1280.0,
            dearest: 1.085,
            error: 0.0421,
            typical: 0.017,
        },
    ),
    (
        Board::CortexM0,
        Search::Tree,
        Cost {
            instructions: [27482.1, 13088.8, 0.0, 0.0, 0.0, 0.0, 16902.9, 2251.9],
            stack: 2100,
            least: 22360.0,
            dearest: 2.405,
            error: 0.4419,
            typical: 0.109,
        },
    ),
    (
        Board::CortexM0,
        Search::TreeF32,
        Cost {
            instructions: [20187.4, 51140.6, 0.0, 0.0, 0.0, 0.0, 49299.6, 158.4],
            stack: 2100,
            least: 20640.0,
            dearest: 2.091,
            error: 0.3941,
            typical: 0.129,
        },
    ),
    (
        Board::CortexM0,
        Search::Hinted,
        Cost {
            instructions: [89513.7, 32104.7, 0.0, 0.0, 0.0, 0.0, 16155.6, 0.0],
            stack: 2100,
            least: 39720.0,
            dearest: 1.910,
            error: 0.3173,
            typical: 0.092,
        },
    ),
    (
        Board::CortexM0,
        Search::Coherent,
        Cost {
            instructions: [67711.8, 7302.7, 0.0, 6313.4, 0.0, 0.0, 0.0, 0.0],
            stack: 2404,
            least: 33160.0,
            dearest: 2.539,
            error: 0.2856,
            typical: 0.190,
        },
    ),
    (
        Board::CortexM0,
        Search::Sweep,
        Cost {
            instructions: [52936.8, 99208.5, 8476.5, 4701.9, 24888.3, 3256.5, 0.0, 981.6],
            stack: 3092,
            least: 247520.0,
            dearest: 1.226,
            error: 0.0777,
            typical: 0.030,
        },
    ),
    (
        Board::CortexM0,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 16441.1, 8188.9, 11034.5, 64526.9, 7813.1, 0.0, 207.8],
            stack: 2588,
            least: 44000.0,
            dearest: 1.228,
            error: 0.4253,
            typical: 0.058,
        },
    ),
    (
        Board::CortexM0,
        Search::Tight,
        Cost {
            instructions: [0.0, 420628.9, 0.0, 0.0, 0.0, 0.0, 27530.0, 0.0],
            stack: 3756,
            least: 39600.0,
            dearest: 2.548,
            error: 0.2988,
            typical: 0.171,
        },
    ),
    (
        Board::CortexM0,
        Search::Triboxes,
        Cost {
            instructions: [28185.3, 0.0, 0.0, 0.0, 0.0, 55015.7, 0.0, 0.0],
            stack: 1164,
            least: 24520.0,
            dearest: 1.103,
            error: 0.0734,
            typical: 0.016,
        },
    ),
];
