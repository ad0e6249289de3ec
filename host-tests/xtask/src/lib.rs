//! What `cargo xtask` and the laboratory share: processes, tools, firmware images and tables.
//!
//! ```text
//! checks (fmt, clippy, tests, docs)
//! host (the program of host-tests: blobs, expected answers, fixtures, counted questions)
//! question (what a change of one question can break) ─ checks, firmware, count_suite, guard
//! fuzz (cargo-fuzz, on a nightly compiler) ─ host
//! processors (the committed answers on i686, AArch64, with vectors) ─ toolbox
//! report ─── chromium (the page of `meshsweep trade --report`) ─ toolbox
//! examples (core/examples) ─ images, qemu
//! rival (the laboratory's images) ─ cross
//! c_checks (C programs) ┐
//! dist (archives) ──────┴ c_library (one object that defines msw_*) ─ toolbox, cross
//! count, count_suite ── valgrind, on host ─┐
//!                                          ├─ tables (those of the documents), guard (costs.txt)
//! firmware ─┬ images ─ cross ───────┬─ toolbox (Debian packages, unpacked aside)
//!           ├ tools ─ qemu ─────────┘
//!           ├ reading (what an image printed) ─ compared with the host's own run
//!           ├ proof   (no panic left)
//!           ├ stack   (painted, and bounded by call_graph ─ instructions)
//!           └ elf     (sizes) ─ cost ─────────┘
//! ```

#[macro_use]
pub mod say;

pub mod blobs;
pub mod boards;
pub mod c_checks;
pub mod c_library;
pub mod call_graph;
pub mod checks;
pub mod chromium;
pub mod cost;
pub mod count;
pub mod count_suite;
pub mod cross;
pub mod dist;
pub mod elf;
pub mod examples;
pub mod firmware;
pub mod fit;
pub mod fuzz;
pub mod guard;
pub mod host;
pub mod images;
pub mod instructions;
#[path = "../../suite/src/kind.rs"]
pub mod kind;
pub mod process;
pub mod processors;
pub mod proof;
pub mod python;
pub mod qemu;
pub mod question;
#[path = "../../suite/src/questions.rs"]
pub mod questions;
pub mod reading;
pub mod release;
pub mod report;
pub mod rival;
pub mod stack;
pub mod stack_csv;
pub mod steps;
pub mod table;
pub mod tables;
pub mod toolbox;
pub mod tools;
pub mod valgrind;
pub mod web;
pub mod workspace;
