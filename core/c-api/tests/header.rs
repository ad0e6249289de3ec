//! `meshsweep.h` says the same as Rust: sizes, offsets, constants. Rust writes them down as static
//! assertions of C, and the machine's C compiler reads these and the header.

use std::fmt::Write;
use std::mem::{align_of, offset_of, size_of};
use std::path::{Path, PathBuf};
use std::process::Command;

use meshsweep_c::answer::*;
use meshsweep_c::both::{BOTH_WORDS, BothStorage};
use meshsweep_c::curve::{CURVE_WORDS, CurveStorage};
use meshsweep_c::deform::{DEFORM_WORDS, DeformStorage, MOVED_WORDS, MovedStorage};
use meshsweep_c::error::Error;
use meshsweep_c::hull::{HULL_WORDS, HullStorage};
use meshsweep_c::memory::{
    COHERENT_WORDS, CoherentStorage, PAIR_WORDS, PairStorage, REFINED_ENTRIES, RefinedEntry,
    SCENE_MODEL_ENTRIES, SceneEntry, scene_entries,
};
use meshsweep_c::pose::RoundedPoseC;
use meshsweep_c::question::{BudgetC, FocusC, HintC, KeptPairC, MotionC, PoseC, facing};
use meshsweep_c::scene::PlacedC;
use meshsweep_c::sdf::{SDF_WORDS, SdfStorage};
use meshsweep_c::sweep::{
    FRAME_SWEEP_WORDS, FrameSweepStorage, MOVED_SWEEP_WORDS, MovedSweepStorage, SWEEP_WORDS,
    SweepStorage,
};
use meshsweep_c::tight::{FINEST, TIGHT_WORDS, Tight};
use meshsweep_c::tree::{MODEL_WORDS, Model};
use meshsweep_c::triboxes::{TRIBOXES_WORDS, TriboxesStorage};
use meshsweep_core::{
    Bvh, Ended, Facing, Focus, Motion, MovedVertex, Pose, ScratchEntry, Side, Solid, Undecided,
    Verdict,
};

macro_rules! layouts {
    ($($name:literal: $rust:ty { $($field:ident),* })*) => {{
        let mut text = String::new();
        $(
            holds(&mut text, &format!("sizeof({})", $name), size_of::<$rust>());
            holds(&mut text, &format!("_Alignof({})", $name), align_of::<$rust>());
            $(
                let offset = format!("offsetof({}, {})", $name, stringify!($field));
                holds(&mut text, &offset, offset_of!($rust, $field));
            )*
        )*
        text
    }};
}

fn holds(text: &mut String, left: &str, right: impl ToString) {
    let right = right.to_string();
    writeln!(text, "_Static_assert({left} == {right}, \"{left} is {right} in Rust\");")
        .expect("text");
}

fn layouts() -> String {
    layouts! {
        "msw_model": Model {}
        "msw_tight": Tight {}
        "msw_hull": HullStorage {}
        "msw_triboxes": TriboxesStorage {}
        "msw_curve": CurveStorage {}
        "msw_sdf": SdfStorage {}
        "msw_both": BothStorage {}
        "msw_deform": DeformStorage {}
        "msw_moved": MovedStorage {}
        "msw_moved_vertex": MovedVertex {}
        "msw_sweep": SweepStorage {}
        "msw_frame_sweep": FrameSweepStorage {}
        "msw_moved_sweep": MovedSweepStorage {}
        "msw_coherent": CoherentStorage {}
        "msw_coherent_pair": PairStorage {}
        "msw_scene_entry": SceneEntry {}
        "msw_hint": HintC {}
        "msw_scratch_entry": ScratchEntry {}
        "msw_refined_entry": RefinedEntry {}
        "msw_budget": BudgetC { relative, absolute, steps }
        "msw_pose": PoseC { rotation, translation, is_affine }
        "msw_rounded_pose": RoundedPoseC { pose, turn, shift }
        "msw_placed": PlacedC { model, pose }
        "msw_kept_pair": KeptPairC { models, distance }
        "msw_motion": MotionC { kind, from, to }
        "msw_focus": FocusC { kind, a, b, radius, cosine, error_per_distance }
        "msw_interval": IntervalC { lower, upper }
        "msw_work": WorkC { bounds, triangles, exact, opened }
        "msw_closest": ClosestC { distance, point, triangle, ended, work }
        "msw_coherent_closest": CoherentC { closest, safe_radius }
        "msw_signed": SignedC { side, reason, distance, closest }
        "msw_winding": WindingC { number, side, reason, ended, work }
        "msw_hit": HitC { verdict, ended, t, hit_t, point, triangle, work }
        "msw_within_answer": WithinC { verdict, reason, triangle, work }
        "msw_neighbor": NeighborC { distance, point, triangle }
        "msw_all_within_answer": AllWithinC { stored, certain, dropped, ended, work }
        "msw_nearest_answer": NearestC { stored, ended, rest_lower, work }
        "msw_overlap_answer": OverlapC { verdict, reason, triangles, work }
        "msw_within_of_answer": OverlapC { verdict, reason, triangles, work }
        "msw_pair_distance": PairDistanceC { distance, points, triangles, ended, work }
        "msw_pair_contact": PairContactC {
            verdict, clear_until, points, triangles, ended, work
        }
        "msw_scene_answer": SceneC { verdict, reason, models, work }
        "msw_node_pair": NodePairC { a, b }
        "msw_apart_answer": ApartC { verdict, ended, may_meet, work }
        "msw_candidates_answer": CandidatesC { verdict, ended, stored, dropped, work }
        "msw_curve_closest": CurveClosestC {
            distance, point, polyline, segment, t, safe_motion, ended, work
        }
        "msw_curve_signed": CurveSignedC { side, reason, distance, closest }
        "msw_curve_neighbor": CurveNeighborC { distance, point, polyline, segment, t }
        "msw_curve_within_answer": CurveWithinC { verdict, reason, polyline, segment, work }
        "msw_sdf_answer": FieldC { side, reason, distance }
        "msw_sdf_gradient_answer": FieldGradientC { found, gradient }
        "msw_sdf_units": UnitsC { lower, upper }
        "msw_bounds_answer": BoundsC { distance, ended, work }
        "msw_signed_bounds_answer": SignedBoundsC { side, reason, distance, ended, work }
        "msw_verdict_answer": VerdictC { verdict, reason }
        "msw_tribox_bound": TriboxBoundC { lower, node, ended, work }
        "msw_refinement": RefinementC { is_complete, error_left, faces, performed, undone }
        "msw_face": FaceC { corners, error }
        "msw_faces_answer": FacesC { stored, dropped }
    }
}

fn constants() -> String {
    let mut text = String::new();
    holds(&mut text, "MSW_VERSION", format!("{}u", meshsweep_c::VERSION));
    holds(&mut text, "MSW_MODEL_WORDS", MODEL_WORDS);
    holds(&mut text, "MSW_TIGHT_WORDS", TIGHT_WORDS);
    holds(&mut text, "MSW_HULL_WORDS", HULL_WORDS);
    holds(&mut text, "MSW_COHERENT_WORDS", COHERENT_WORDS);
    holds(&mut text, "MSW_COHERENT_PAIR_WORDS", PAIR_WORDS);
    holds(&mut text, "MSW_TRIBOXES_WORDS", TRIBOXES_WORDS);
    holds(&mut text, "MSW_CURVE_WORDS", CURVE_WORDS);
    holds(&mut text, "MSW_SDF_WORDS", SDF_WORDS);
    holds(&mut text, "MSW_BOTH_WORDS", BOTH_WORDS);
    holds(&mut text, "MSW_DEFORM_WORDS", DEFORM_WORDS);
    holds(&mut text, "MSW_MOVED_WORDS", MOVED_WORDS);
    holds(&mut text, "MSW_SWEEP_WORDS", SWEEP_WORDS);
    holds(&mut text, "MSW_FRAME_SWEEP_WORDS", FRAME_SWEEP_WORDS);
    holds(&mut text, "MSW_MOVED_SWEEP_WORDS", MOVED_SWEEP_WORDS);
    holds(&mut text, "MSW_SCENE_MODEL_ENTRIES", SCENE_MODEL_ENTRIES);
    for (models, pairs) in [(0, 0), (9, 21), (2, 2)] {
        let entries = scene_entries(models, pairs).expect("few");
        holds(&mut text, &format!("MSW_SCENE_ENTRIES({models}, {pairs})"), entries);
    }
    holds(&mut text, "MSW_MOST_CORNERS", Solid::MOST_CORNERS);
    holds(&mut text, "MSW_REFINED_ENTRIES(7)", REFINED_ENTRIES + 7);
    holds(&mut text, "MSW_OVERLAP_ENTRIES", Bvh::OVERLAP_ENTRIES);
    holds(&mut text, "MSW_DISTANCE_ENTRIES", Bvh::DISTANCE_ENTRIES);
    holds(&mut text, "MSW_NO_TRIANGLE", format!("{NO_TRIANGLE}u"));
    holds(&mut text, "MSW_NO_NODE", format!("{NO_NODE}u"));
    holds(&mut text, "MSW_NO_MODEL", format!("{NO_MODEL}u"));
    holds(&mut text, "MSW_NO_SEGMENT", format!("{NO_SEGMENT}u"));
    holds(&mut text, "MSW_FINEST", format!("{FINEST}u"));
    let (yes, decided) = verdict(Verdict::Yes);
    let undecided = Verdict::Undecided(Undecided::Steps);
    for (name, code) in [
        ("UNDECIDED", verdict(undecided).0),
        ("YES", yes),
        ("NO", verdict(Verdict::No).0),
        ("SIDE_UNDECIDED", side(Side::Undecided(Undecided::Steps)).0),
        ("SIDE_INSIDE", side(Side::Inside).0),
        ("SIDE_OUTSIDE", side(Side::Outside).0),
        ("REASON_DECIDED", decided),
        ("REASON_STEPS", reason(Undecided::Steps)),
        ("REASON_SCRATCH", reason(Undecided::Scratch)),
        ("REASON_RESOLUTION", reason(Undecided::Resolution)),
        ("REASON_OPEN_MESH", reason(Undecided::OpenMesh)),
        ("REASON_ON_SURFACE", reason(Undecided::OnSurface)),
        ("REASON_FEATURE", reason(Undecided::Feature)),
        ("ENDED_EXACT", ended(Ended::Exact)),
        ("ENDED_TOLERANCE", ended(Ended::Tolerance)),
        ("ENDED_STEPS", ended(Ended::Steps)),
        ("ENDED_SCRATCH", ended(Ended::Scratch)),
        ("ENDED_RESOLUTION", ended(Ended::Resolution)),
    ] {
        holds(&mut text, &format!("MSW_{name}"), code);
    }
    let facings = [("BOTH", Facing::Both), ("FRONT", Facing::Front), ("BACK", Facing::Back)];
    for (code, (name, wanted)) in (0..).zip(facings) {
        assert!(facing(code) == Ok(wanted));
        holds(&mut text, &format!("MSW_FACING_{name}"), code);
    }
    for (code, name) in (0..).zip(["EVERYWHERE", "BALL", "BOX", "SEGMENT", "EYE"]) {
        let focus = FocusC { kind: code, ..FocusC::EVERYWHERE }.focus();
        assert!(matches!(
            (name, focus),
            ("EVERYWHERE", Ok(Focus::Everywhere))
                | ("BALL", Ok(Focus::Ball { .. }))
                | ("BOX", Ok(Focus::Box { .. }))
                | ("SEGMENT", Ok(Focus::Segment { .. }))
                | ("EYE", Ok(Focus::Eye { .. }))
        ));
        holds(&mut text, &format!("MSW_FOCUS_{name}"), code);
    }
    assert!(FocusC { kind: 5, ..FocusC::EVERYWHERE }.focus() == Err(Error::Value));
    assert!(facing(3) == Err(Error::Value));
    let motion = |kind| MotionC { kind, from: PoseC::IDENTITY, to: PoseC::IDENTITY }.motion();
    let same = Pose::IDENTITY;
    assert!(
        motion(0) == Ok(Motion::straight(same, same))
            && motion(1) == Motion::screw(same, same).map_err(Error::from)
    );
    assert!(motion(2) == Err(Error::Value));
    for (code, name) in [(0, "STRAIGHT"), (1, "SCREW")] {
        holds(&mut text, &format!("MSW_MOTION_{name}"), code);
    }
    for error in Error::ALL {
        holds(&mut text, &c_name(*error), error.code());
    }
    text
}

/// `NotABlob` as `MSW_ERROR_NOT_A_BLOB`.
fn c_name(error: Error) -> String {
    let mut name = "MSW_ERROR".to_owned();
    for letter in format!("{error:?}").chars() {
        if letter.is_uppercase() {
            name.push('_');
        }
        name.push(letter.to_ascii_uppercase());
    }
    name
}

fn here() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// What the C compiler says of a text behind the header.
fn compile(text: &str, name: &str) -> Result<(), String> {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&file, format!("#include \"meshsweep.h\"\n{text}")).expect("written");
    let mut cc = Command::new("cc");
    cc.args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-pedantic", "-fsyntax-only", "-I"]);
    let output = cc.arg(here().join("include")).arg(&file).output().expect("a C compiler");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.success() { Ok(()) } else { Err(said) }
}

#[test]
fn sizes_offsets_and_constants_are_those_of_rust() {
    let text = layouts() + &constants();
    assert!(text.lines().count() > 150);
    if let Err(said) = compile(&text, "header.c") {
        panic!("{said}");
    }
}

#[test]
fn the_table_of_storage_is_that_of_rust() {
    let readme = std::fs::read_to_string(here().join("README.md")).expect("the table's file");
    let words = [
        ("msw_model", MODEL_WORDS),
        ("msw_tight", TIGHT_WORDS),
        ("msw_hull", HULL_WORDS),
        ("msw_triboxes", TRIBOXES_WORDS),
        ("msw_curve", CURVE_WORDS),
        ("msw_sdf", SDF_WORDS),
        ("msw_both", BOTH_WORDS),
        ("msw_coherent", COHERENT_WORDS),
        ("msw_coherent_pair", PAIR_WORDS),
        ("msw_deform", DEFORM_WORDS),
        ("msw_moved", MOVED_WORDS),
        ("msw_sweep", SWEEP_WORDS),
        ("msw_frame_sweep", FRAME_SWEEP_WORDS),
        ("msw_moved_sweep", MOVED_SWEEP_WORDS),
    ];
    for (name, of_64_bits) in words {
        let row = readme.lines().find(|line| line.starts_with(&format!("| `{name}` |")));
        let last = row.and_then(|row| row.trim_end_matches(" |").rsplit("| ").next());
        let bytes = last.map(|bytes| bytes.replace(',', ""));
        assert_eq!(bytes, Some((8 * of_64_bits).to_string()), "{name}");
    }
}

#[test]
fn a_wrong_size_is_noticed() {
    let mut text = String::new();
    holds(&mut text, "sizeof(msw_closest)", size_of::<ClosestC>() + 1);
    assert!(compile(&text, "wrong.c").is_err_and(|said| said.contains("sizeof(msw_closest)")));
}

#[test]
fn all_errors_of_the_header_have_a_text() {
    let header = std::fs::read_to_string(here().join("include/meshsweep.h")).expect("there");
    let named = header.matches("    MSW_ERROR_").count();
    assert_eq!(named, Error::ALL.len());
    let other = Error::text(i32::MIN);
    assert!(Error::ALL.iter().all(|error| Error::text(error.code()) != other));
}

#[test]
fn only_one_module_has_unsafe_blocks() {
    for entry in std::fs::read_dir(here().join("src")).expect("there").flatten() {
        let text = std::fs::read_to_string(entry.path()).expect("read");
        let blocks = text.matches("unsafe {").count();
        assert!(blocks == 0 || entry.file_name() == "memory.rs", "{}", entry.path().display());
    }
}
