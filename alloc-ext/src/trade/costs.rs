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
            instructions: [1971.7, 527.1, 5.4, 0.0, 0.0, 644.8, 1247.9, 22.7],
            stack: 1980,
            least: 3160.0,
            dearest: 1.324,
            error: 0.2457,
            typical: 0.040,
        },
    ),
    (
        Board::CortexM4F,
        Search::TreeF32,
        Cost {
            instructions: [2520.4, 1246.1, 0.0, 53.0, 0.0, 605.1, 1959.3, 0.0],
            stack: 1980,
            least: 4120.0,
            dearest: 1.359,
            error: 0.1571,
            typical: 0.052,
        },
    ),
    (
        Board::CortexM4F,
        Search::Hinted,
        Cost {
            instructions: [3441.8, 670.4, 0.0, 0.0, 0.0, 605.6, 1117.3, 0.0],
            stack: 1980,
            least: 3840.0,
            dearest: 1.270,
            error: 0.1795,
            typical: 0.025,
        },
    ),
    (
        Board::CortexM4F,
        Search::Coherent,
        Cost {
            instructions: [1849.9, 0.0, 56.0, 269.9, 0.0, 402.2, 0.0, 0.0],
            stack: 1980,
            least: 1280.0,
            dearest: 1.949,
            error: 0.1290,
            typical: 0.081,
        },
    ),
    (
        Board::CortexM4F,
        Search::Sweep,
        Cost {
            instructions: [14140.6, 6031.5, 391.9, 597.6, 10325.6, 759.8, 0.0, 367.6],
            stack: 2924,
            least: 35800.0,
            dearest: 1.131,
            error: 0.0534,
            typical: 0.014,
        },
    ),
    (
        Board::CortexM4F,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 7417.6, 386.4, 1482.8, 21275.9, 1683.9, 0.0, 266.5],
            stack: 2516,
            least: 18960.0,
            dearest: 1.250,
            error: 0.3264,
            typical: 0.036,
        },
    ),
    (
        Board::CortexM4F,
        Search::Tight,
        Cost {
            instructions: [998.4, 5829.4, 0.0, 0.0, 0.0, 780.7, 1220.6, 0.0],
            stack: 3936,
            least: 3120.0,
            dearest: 1.462,
            error: 0.1623,
            typical: 0.047,
        },
    ),
    (
        Board::CortexM4F,
        Search::Triboxes,
        Cost {
            instructions: [78.8, 0.0, 1333.6, 0.0, 0.0, 0.0, 0.0, 0.0],
            stack: 744,
            least: 1280.0,
            dearest: 1.085,
            error: 0.0421,
            typical: 0.018,
        },
    ),
    (
        Board::CortexM0,
        Search::Tree,
        Cost {
            instructions: [34355.9, 14239.1, 0.0, 0.0, 0.0, 0.0, 9625.2, 1785.4],
            stack: 2100,
            least: 22480.0,
            dearest: 2.674,
            error: 0.4991,
            typical: 0.135,
        },
    ),
    (
        Board::CortexM0,
        Search::TreeF32,
        Cost {
            instructions: [18471.4, 43603.2, 0.0, 0.0, 0.0, 0.0, 49534.9, 491.7],
            stack: 2016,
            least: 20760.0,
            dearest: 1.899,
            error: 0.4001,
            typical: 0.114,
        },
    ),
    (
        Board::CortexM0,
        Search::Hinted,
        Cost {
            instructions: [71584.1, 29847.6, 0.0, 0.0, 0.0, 0.0, 8115.7, 0.0],
            stack: 2132,
            least: 39960.0,
            dearest: 2.205,
            error: 0.4054,
            typical: 0.104,
        },
    ),
    (
        Board::CortexM0,
        Search::Coherent,
        Cost {
            instructions: [60080.4, 0.0, 0.0, 4840.3, 0.0, 0.0, 0.0, 0.0],
            stack: 2660,
            least: 33160.0,
            dearest: 2.846,
            error: 0.3837,
            typical: 0.231,
        },
    ),
    (
        Board::CortexM0,
        Search::Sweep,
        Cost {
            instructions: [52737.3, 99243.2, 8476.2, 4706.9, 24874.1, 3254.7, 0.0, 980.9],
            stack: 3092,
            least: 246320.0,
            dearest: 1.226,
            error: 0.0776,
            typical: 0.030,
        },
    ),
    (
        Board::CortexM0,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 15993.9, 8188.2, 11044.7, 64539.6, 7818.5, 0.0, 209.5],
            stack: 2588,
            least: 43960.0,
            dearest: 1.228,
            error: 0.4259,
            typical: 0.059,
        },
    ),
    (
        Board::CortexM0,
        Search::Tight,
        Cost {
            instructions: [37795.7, 104871.9, 0.0, 0.0, 0.0, 0.0, 8304.1, 0.0],
            stack: 4700,
            least: 35440.0,
            dearest: 2.775,
            error: 0.4200,
            typical: 0.111,
        },
    ),
    (
        Board::CortexM0,
        Search::Triboxes,
        Cost {
            instructions: [678.0, 0.0, 27507.7, 0.0, 0.0, 0.0, 0.0, 0.0],
            stack: 824,
            least: 24560.0,
            dearest: 1.103,
            error: 0.0734,
            typical: 0.016,
        },
    ),
];
