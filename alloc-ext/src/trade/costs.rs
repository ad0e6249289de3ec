//! Fitted costs. `cargo xtask fit` writes this file, from instructions that QEMU counts. The
//! costs are in the order of `FEATURES`. They are fitted to `bracket.stl`, `groove.obj` and
//! `torus.ply` of `fixtures` and to five meshes that `host-tests/src/counted/fit.rs`
//! generates, and to the curves of `fit_curves.rs`. These files also name the meshes and curves
//! that `error` and `typical` are of.

use super::cost::{Board, Cost, Search};

/// Costs by board and search.
pub(super) const COSTS: &[(Board, Search, Cost)] = &[
    (
        Board::CortexM4F,
        Search::Tree,
        Cost {
            instructions: [1903.2, 561.5, 13.6, 0.0, 0.0, 405.6, 790.3, 0.0],
            least: 2680.0,
            missed_by: 1.773,
            error: 0.2904,
            typical: 0.050,
        },
    ),
    (
        Board::CortexM4F,
        Search::TreeF32,
        Cost {
            instructions: [2230.5, 1272.6, 6.0, 102.1, 0.0, 411.6, 836.1, 0.0],
            least: 2680.0,
            missed_by: 1.622,
            error: 0.2655,
            typical: 0.078,
        },
    ),
    (
        Board::CortexM4F,
        Search::Precise,
        Cost {
            instructions: [12735.3, 1293.7, 29.6, 176.3, 7811.0, 352.1, 423.9, 0.0],
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
            instructions: [2720.8, 689.2, 0.0, 0.0, 0.0, 488.5, 676.1, 0.0],
            least: 2920.0,
            missed_by: 1.380,
            error: 0.2631,
            typical: 0.040,
        },
    ),
    (
        Board::CortexM4F,
        Search::Coherent,
        Cost {
            instructions: [2060.8, 0.0, 3.5, 0.0, 0.0, 673.3, 1313.5, 0.0],
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
            instructions: [26050.4, 7245.7, 321.3, 992.2, 730.8, 373.9, 0.0, 635.7],
            least: 21360.0,
            missed_by: 1.524,
            error: 0.1985,
            typical: 0.049,
        },
    ),
    (
        Board::CortexM4F,
        Search::KeptSweep,
        Cost {
            instructions: [1388.0, 6034.3, 270.9, 1346.2, 20304.4, 1365.2, 0.0, 303.0],
            least: 19560.0,
            missed_by: 1.256,
            error: 0.3560,
            typical: 0.042,
        },
    ),
    (
        Board::CortexM4F,
        Search::Tight,
        Cost {
            instructions: [1699.0, 8022.6, 50.3, 0.0, 0.0, 391.9, 621.7, 0.0],
            least: 2320.0,
            missed_by: 1.337,
            error: 0.1778,
            typical: 0.056,
        },
    ),
    (
        Board::CortexM4F,
        Search::Triboxes,
        Cost {
            instructions: [123.3, 0.0, 1332.8, 0.0, 0.0, 0.0, 0.0, 0.0],
            least: 1360.0,
            missed_by: 1.085,
            error: 0.0404,
            typical: 0.018,
        },
    ),
    (
        Board::CortexM4F,
        Search::FirstHit,
        Cost {
            instructions: [162.9, 219.6, 0.0, 143.1, 0.0, 679.6, 0.0, 0.0],
            least: 160.0,
            missed_by: 1.332,
            error: 0.2953,
            typical: 0.062,
        },
    ),
    (
        Board::CortexM4F,
        Search::FirstHitF32,
        Cost {
            instructions: [162.5, 223.4, 0.0, 219.5, 0.0, 667.3, 67.4, 0.0],
            least: 160.0,
            missed_by: 1.499,
            error: 0.2626,
            typical: 0.065,
        },
    ),
    (
        Board::CortexM4F,
        Search::FirstHitOfHull,
        Cost {
            instructions: [136.8, 3295.6, 299.8, 267.1, 11646.0, 471.5, 0.0, 0.0],
            least: 400.0,
            missed_by: 1.314,
            error: 0.2063,
            typical: 0.074,
        },
    ),
    (
        Board::CortexM4F,
        Search::OuterHit,
        Cost {
            instructions: [116.1, 0.0, 719.8, 366.7, 7505.6, 1094.8, 0.0, 0.0],
            least: 920.0,
            missed_by: 1.165,
            error: 0.1719,
            typical: 0.031,
        },
    ),
    (
        Board::CortexM4F,
        Search::PairOfTrees,
        Cost {
            instructions: [411.2, 15484.7, 0.0, 1430.2, 0.0, 3244.7, 0.0, 0.0],
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
            instructions: [2990.4, 0.0, 841.0, 0.0, 0.0, 1196.8, 0.0, 0.0],
            least: 3280.0,
            missed_by: 1.880,
            error: 0.1337,
            typical: 0.059,
        },
    ),
    (
        Board::CortexM4F,
        Search::Curve,
        Cost {
            instructions: [3736.6, 80.2, 0.0, 0.0, 4267.0, 540.5, 0.0, 788.4],
            least: 10960.0,
            missed_by: 1.198,
            error: 0.1041,
            typical: 0.026,
        },
    ),
    (
        Board::CortexM4F,
        Search::KeptCurve,
        Cost {
            instructions: [3757.7, 0.0, 1036.3, 0.0, 9802.9, 0.0, 0.0, 172.3],
            least: 10560.0,
            missed_by: 2.123,
            error: 0.6407,
            typical: 0.108,
        },
    ),
    (
        Board::CortexM4F,
        Search::CurveWithin,
        Cost {
            instructions: [1234.3, 80.1, 246.8, 0.0, 4838.9, 0.0, 0.0, 0.0],
            least: 1720.0,
            missed_by: 1.149,
            error: 0.0829,
            typical: 0.013,
        },
    ),
    (
        Board::CortexM4F,
        Search::CurveSigned,
        Cost {
            instructions: [4563.6, 2614.9, 315.8, 0.0, 2759.9, 146.8, 0.0, 617.9],
            least: 11240.0,
            missed_by: 1.168,
            error: 0.2279,
            typical: 0.015,
        },
    ),
    (
        Board::CortexM0,
        Search::Tree,
        Cost {
            instructions: [17613.5, 7212.3, 0.0, 0.0, 0.0, 0.0, 4315.0, 694.9],
            least: 11280.0,
            missed_by: 5.053,
            error: 0.5508,
            typical: 0.115,
        },
    ),
    (
        Board::CortexM0,
        Search::TreeF32,
        Cost {
            instructions: [17098.6, 24844.9, 0.0, 3819.4, 0.0, 10.7, 0.0, 0.0],
            least: 13080.0,
            missed_by: 1.908,
            error: 0.3512,
            typical: 0.096,
        },
    ),
    (
        Board::CortexM0,
        Search::Precise,
        Cost {
            instructions: [70953.8, 40609.7, 27.6, 3660.8, 14761.2, 0.0, 2740.1, 0.0],
            least: 72400.0,
            missed_by: 1.616,
            error: 0.2345,
            typical: 0.059,
        },
    ),
    (
        Board::CortexM0,
        Search::Hinted,
        Cost {
            instructions: [21874.4, 7526.0, 0.0, 0.0, 0.0, 547.7, 3341.2, 0.0],
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
            instructions: [15179.8, 0.0, 0.0, 0.0, 0.0, 0.0, 18827.0, 0.0],
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
            instructions: [74367.2, 72616.0, 4408.8, 3980.9, 4091.5, 1460.2, 0.0, 1305.0],
            least: 136520.0,
            missed_by: 1.225,
            error: 0.0895,
            typical: 0.020,
        },
    ),
    (
        Board::CortexM0,
        Search::KeptSweep,
        Cost {
            instructions: [0.0, 14863.5, 4189.2, 6873.2, 56482.1, 4763.9, 0.0, 545.2],
            least: 45440.0,
            missed_by: 1.195,
            error: 0.3974,
            typical: 0.096,
        },
    ),
    (
        Board::CortexM0,
        Search::Tight,
        Cost {
            instructions: [21341.8, 29533.9, 217.6, 0.0, 0.0, 0.0, 2401.5, 0.0],
            least: 11680.0,
            missed_by: 2.607,
            error: 0.3831,
            typical: 0.101,
        },
    ),
    (
        Board::CortexM0,
        Search::Triboxes,
        Cost {
            instructions: [27045.3, 0.0, 0.0, 0.0, 0.0, 52906.5, 0.0, 0.0],
            least: 24680.0,
            missed_by: 1.092,
            error: 0.0605,
            typical: 0.019,
        },
    ),
    (
        Board::CortexM0,
        Search::FirstHit,
        Cost {
            instructions: [604.5, 5798.3, 0.0, 767.2, 0.0, 8346.9, 723.9, 0.0],
            least: 520.0,
            missed_by: 2.007,
            error: 0.3783,
            typical: 0.125,
        },
    ),
    (
        Board::CortexM0,
        Search::FirstHitF32,
        Cost {
            instructions: [585.1, 6204.8, 0.0, 4283.4, 0.0, 7831.0, 904.9, 0.0],
            least: 520.0,
            missed_by: 1.585,
            error: 0.2408,
            typical: 0.045,
        },
    ),
    (
        Board::CortexM0,
        Search::FirstHitOfHull,
        Cost {
            instructions: [67.1, 23052.9, 5000.9, 877.1, 101607.0, 2914.1, 0.0, 0.0],
            least: 4640.0,
            missed_by: 1.280,
            error: 0.3178,
            typical: 0.101,
        },
    ),
    (
        Board::CortexM0,
        Search::OuterHit,
        Cost {
            instructions: [4690.2, 5759.3, 1323.7, 6876.1, 10932.1, 5759.4, 0.0, 0.0],
            least: 5600.0,
            missed_by: 1.084,
            error: 0.0462,
            typical: 0.022,
        },
    ),
    (
        Board::CortexM0,
        Search::PairOfTrees,
        Cost {
            instructions: [15715.7, 199338.4, 0.0, 13961.0, 0.0, 47640.2, 0.0, 0.0],
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
            instructions: [110354.0, 0.0, 18594.7, 0.0, 0.0, 17660.4, 0.0, 0.0],
            least: 118760.0,
            missed_by: 1.379,
            error: 0.1294,
            typical: 0.034,
        },
    ),
    (
        Board::CortexM0,
        Search::Curve,
        Cost {
            instructions: [1459.5, 5153.4, 5063.9, 0.0, 6705.0, 0.0, 0.0, 1606.9],
            least: 57640.0,
            missed_by: 1.340,
            error: 0.1753,
            typical: 0.064,
        },
    ),
    (
        Board::CortexM0,
        Search::KeptCurve,
        Cost {
            instructions: [0.0, 4375.3, 7110.5, 0.0, 34605.5, 0.0, 0.0, 0.0],
            least: 25320.0,
            missed_by: 2.385,
            error: 0.6879,
            typical: 0.115,
        },
    ),
    (
        Board::CortexM0,
        Search::CurveWithin,
        Cost {
            instructions: [1289.1, 1196.4, 4868.5, 0.0, 8791.3, 0.0, 0.0, 0.0],
            least: 10840.0,
            missed_by: 1.275,
            error: 0.1820,
            typical: 0.070,
        },
    ),
    (
        Board::CortexM0,
        Search::CurveSigned,
        Cost {
            instructions: [7182.0, 8726.9, 4216.6, 0.0, 5630.6, 1300.2, 0.0, 1357.5],
            least: 48880.0,
            missed_by: 1.087,
            error: 0.0935,
            typical: 0.023,
        },
    ),
];
