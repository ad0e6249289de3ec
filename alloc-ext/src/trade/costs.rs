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
            instructions: [1893.1, 560.8, 13.4, 0.0, 0.0, 406.9, 791.0, 0.0],
            least: 2680.0,
            missed_by: 1.776,
            error: 0.2912,
            typical: 0.051,
        },
    ),
    (
        Board::CortexM4F,
        Search::TreeF32,
        Cost {
            instructions: [2219.4, 1272.1, 5.8, 102.1, 0.0, 413.1, 837.2, 0.0],
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
            instructions: [12738.5, 1294.4, 29.6, 176.1, 7810.9, 352.3, 425.0, 0.0],
            least: 20800.0,
            missed_by: 1.381,
            error: 0.0995,
            typical: 0.031,
        },
    ),
    (
        Board::CortexM4F,
        Search::Hinted,
        Cost {
            instructions: [2722.6, 688.7, 0.0, 0.0, 0.0, 488.6, 676.1, 0.0],
            least: 2880.0,
            missed_by: 1.380,
            error: 0.2631,
            typical: 0.041,
        },
    ),
    (
        Board::CortexM4F,
        Search::Coherent,
        Cost {
            instructions: [2058.8, 0.0, 3.5, 0.0, 0.0, 673.4, 1313.8, 0.0],
            least: 1360.0,
            missed_by: 1.789,
            error: 0.1761,
            typical: 0.075,
        },
    ),
    (
        Board::CortexM4F,
        Search::Sweep,
        Cost {
            instructions: [26644.3, 7040.1, 318.4, 826.0, 877.9, 406.5, 0.0, 533.8],
            least: 21160.0,
            missed_by: 1.454,
            error: 0.1827,
            typical: 0.054,
        },
    ),
    (
        Board::CortexM4F,
        Search::KeptSweep,
        Cost {
            instructions: [2760.5, 4211.5, 263.2, 1109.6, 20382.9, 1404.0, 0.0, 286.0],
            least: 19640.0,
            missed_by: 1.284,
            error: 0.3588,
            typical: 0.036,
        },
    ),
    (
        Board::CortexM4F,
        Search::Tight,
        Cost {
            instructions: [1934.5, 4284.2, 47.7, 0.0, 0.0, 328.7, 627.1, 0.0],
            least: 2320.0,
            missed_by: 1.742,
            error: 0.1927,
            typical: 0.072,
        },
    ),
    (
        Board::CortexM4F,
        Search::Triboxes,
        Cost {
            instructions: [116.9, 0.0, 1331.4, 0.0, 0.0, 0.0, 0.0, 0.0],
            least: 1320.0,
            missed_by: 1.084,
            error: 0.0411,
            typical: 0.017,
        },
    ),
    (
        Board::CortexM4F,
        Search::PairOfTrees,
        Cost {
            instructions: [534.8, 15686.9, 0.0, 1587.7, 0.0, 3557.6, 0.0, 0.0],
            least: 520.0,
            missed_by: 3.156,
            error: 0.4946,
            typical: 0.126,
        },
    ),
    (
        Board::CortexM4F,
        Search::PairOfTriboxes,
        Cost {
            instructions: [3041.6, 0.0, 842.8, 0.0, 0.0, 1197.1, 0.0, 0.0],
            least: 3320.0,
            missed_by: 1.864,
            error: 0.1330,
            typical: 0.059,
        },
    ),
    (
        Board::CortexM0,
        Search::Tree,
        Cost {
            instructions: [17612.3, 7212.3, 0.0, 0.0, 0.0, 0.0, 4314.9, 693.9],
            least: 11280.0,
            missed_by: 5.053,
            error: 0.5509,
            typical: 0.115,
        },
    ),
    (
        Board::CortexM0,
        Search::TreeF32,
        Cost {
            instructions: [17097.9, 24844.3, 0.0, 3819.4, 0.0, 10.3, 0.0, 0.0],
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
            instructions: [70952.2, 40610.6, 27.6, 3661.0, 14761.3, 0.0, 2738.9, 0.0],
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
            instructions: [21871.6, 7526.8, 0.0, 0.0, 0.0, 547.6, 3341.2, 0.0],
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
            instructions: [15176.9, 0.0, 0.0, 0.0, 0.0, 0.0, 18826.5, 0.0],
            least: 16200.0,
            missed_by: 3.946,
            error: 0.4785,
            typical: 0.315,
        },
    ),
    (
        Board::CortexM0,
        Search::Sweep,
        Cost {
            instructions: [72926.2, 70584.6, 4439.6, 3557.2, 4319.2, 1555.9, 0.0, 1154.0],
            least: 136600.0,
            missed_by: 1.222,
            error: 0.0932,
            typical: 0.024,
        },
    ),
    (
        Board::CortexM0,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 11570.7, 4284.3, 5692.0, 57824.9, 4796.4, 0.0, 525.3],
            least: 46400.0,
            missed_by: 1.195,
            error: 0.4025,
            typical: 0.096,
        },
    ),
    (
        Board::CortexM0,
        Search::Tight,
        Cost {
            instructions: [23404.6, 44834.4, 216.9, 0.0, 0.0, 0.0, 1698.1, 0.0],
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
            instructions: [27040.6, 0.0, 0.0, 0.0, 0.0, 52906.6, 0.0, 0.0],
            least: 24640.0,
            missed_by: 1.091,
            error: 0.0605,
            typical: 0.019,
        },
    ),
    (
        Board::CortexM0,
        Search::PairOfTrees,
        Cost {
            instructions: [17243.6, 199218.2, 0.0, 15960.8, 0.0, 54020.4, 0.0, 0.0],
            least: 15160.0,
            missed_by: 3.259,
            error: 0.5757,
            typical: 0.129,
        },
    ),
    (
        Board::CortexM0,
        Search::PairOfTriboxes,
        Cost {
            instructions: [110379.8, 0.0, 18595.2, 0.0, 0.0, 17663.9, 0.0, 0.0],
            least: 118800.0,
            missed_by: 1.379,
            error: 0.1295,
            typical: 0.034,
        },
    ),
];
