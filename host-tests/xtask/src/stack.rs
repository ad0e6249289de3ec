//! The processor's stack that each question takes on the boards: measured by painting, and bounded
//! by the image's own call graph.
//!
//! A question is a function of the suite. It calls the core and folds the answer. Painting measures
//! the stack below this call. The function's own frame, of the instance with the meter, is added.
//! The sum is no more than the function's bound in the same image. The bounds of the documents are
//! the larger ones of that image and of the proof's, which has all questions and no panic.
//!
//! The functions of `meshsweep.h` have bounds of their own, from the linked library.

use std::path::Path;

use crate::boards::Board;
use crate::c_library;
use crate::call_graph::CallGraph;
use crate::cross::Cross;
use crate::images::{self, Profile};
use crate::questions::{CLOSEST, QUESTIONS, Question};
use crate::reading::Reading;

/// Most bytes of stack of a closest point in a debug build with the override of the guide. Without
/// floating point eight triangles wait there. The suite's own function has 424 of them.
const MOST_IN_DEBUG: u32 = 2880;

/// The image that is built for debug builds: it asks a box tree four questions.
pub const DEBUG_IMAGE: &str = "size_tree_four";

/// Functions of `meshsweep.h`, and what a blob has to have for them.
pub const C_FUNCTIONS: &[(&str, &str)] = &[
    ("msw_open", "tree"),
    ("msw_open_trusted", "tree"),
    ("msw_closest_point", "closest"),
    ("msw_closest_point_from", "closest"),
    ("msw_coherent_closest_point", "closest"),
    ("msw_within", "closest"),
    ("msw_nearest", "closest"),
    ("msw_signed_distance", "closest"),
    ("msw_winding_number", "winding"),
    ("msw_first_hit", "segment"),
    ("msw_first_hit_of_ray", "segment"),
    ("msw_overlap", "segment"),
    ("msw_within_of", "segment"),
    ("msw_distance", "segment"),
    ("msw_coherent_pair_distance", "segment"),
    ("msw_coherent_pair_within", "segment"),
    ("msw_first_contact_of", "segment"),
    ("msw_scene_begin", "segment"),
    ("msw_scene_move", "segment"),
    ("msw_scene_within", "segment"),
    ("msw_solid_first_contact", "segment"),
    ("msw_open_triboxes", "triboxes"),
    ("msw_triboxes_apart", "triboxes"),
    ("msw_triboxes_within", "triboxes"),
    ("msw_triboxes_candidates", "triboxes"),
    ("msw_triboxes_distance", "triboxes"),
    ("msw_triboxes_clip", "triboxes"),
    ("msw_open_tight", "tight"),
    ("msw_tight_within", "tight"),
    ("msw_tight_model", "tight"),
    ("msw_open_hull", "hull"),
    ("msw_refine", "hull"),
    ("msw_refined_faces", "hull"),
    ("msw_sweep_begin", "hull"),
    ("msw_sweep_closest_point", "hull"),
    ("msw_sweep_move_to", "hull"),
    ("msw_sweep_next", "hull"),
    ("msw_refine_swept", "hull"),
    ("msw_hull_sweep_entries", "hull"),
    ("msw_open_deform", "deform"),
    ("msw_deform_scratch_entries", "deform"),
    ("msw_deform_records", "deform"),
    ("msw_deform_frames", "deform"),
    ("msw_deform_vertices", "deform"),
    ("msw_deform_hull", "deform"),
    ("msw_frame_closest_point", "deform"),
    ("msw_frame_first_hit", "deform"),
    ("msw_frame_sweep_begin", "deform"),
    ("msw_frame_sweep_closest_point", "deform"),
    ("msw_frame_sweep_move_to", "deform"),
    ("msw_frame_sweep_next", "deform"),
    ("msw_frame_sweep_to", "deform"),
    ("msw_moved_begin", "deform"),
    ("msw_moved_closest_point", "deform"),
    ("msw_moved_first_hit", "deform"),
    ("msw_moved_sweep_begin", "deform"),
    ("msw_moved_sweep_closest_point", "deform"),
    ("msw_moved_sweep_move_to", "deform"),
    ("msw_moved_sweep_next", "deform"),
    ("msw_moved_sweep_update", "deform"),
    ("msw_moved_update", "deform"),
    ("msw_open_curve", "curve"),
    ("msw_curve_closest_point", "curve"),
    ("msw_curve_within", "curve"),
    ("msw_curve_nearest", "curve"),
    ("msw_curve_all_within", "curve"),
    ("msw_curve_signed_distance", "curve"),
    ("msw_open_sdf", "sdf"),
    ("msw_sdf_distance", "sdf"),
    ("msw_sdf_distance_and_gradient", "sdf"),
    ("msw_sdf_within", "sdf"),
    ("msw_sdf_units_of", "sdf"),
    ("msw_sdf_distance_in_units", "sdf"),
    ("msw_sdf_gradient_in_units", "sdf"),
    ("msw_open_both", "both"),
    ("msw_both_within", "both"),
    ("msw_both_distance", "both"),
    ("msw_both_signed_distance", "both"),
    ("msw_both_closest_point", "both"),
    ("msw_both_solid_first_contact", "both"),
    ("msw_checksum", "any"),
    ("msw_pose_of_quaternion", "any"),
    ("msw_pose_then", "any"),
    ("msw_pose_inverse", "any"),
    ("msw_pose_relative_to", "any"),
    ("msw_pose_motion", "any"),
];

/// A function of the header that is not in the list takes less. `part.h` says so.
const MOST_UNLISTED: u32 = 64;

/// The function's whole path.
fn path(question: &Question) -> String {
    format!("meshsweep_suite::ask::{}", question.function)
}

/// The image of the suite that asks it: that of the structure.
fn image(question: &Question) -> String {
    let structure = question.function.split("::").next().unwrap_or_default();
    format!("suite_{}", structure.trim_start_matches("hull_"))
}

/// Whether a query of a kind, by its name, calls the function.
fn is_asked_by(question: &Question, kind: &str) -> bool {
    question.kinds.iter().any(|of| of.name() == kind)
}

/// What a question takes with one optimisation on one board.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stack {
    /// Most bytes that were seen.
    pub painted: Option<u32>,
    /// Bytes that are never exceeded.
    pub bound: Option<u32>,
}

/// What all questions take on a board, by profile.
#[derive(Clone, Debug, Default)]
pub struct Stacks([OfProfile; Profile::ALL.len() + Profile::DEBUG.len()]);

#[derive(Clone, Debug)]
struct OfProfile {
    questions: [Stack; QUESTIONS.len()],
    c_functions: [Option<u32>; C_FUNCTIONS.len()],
}

impl Default for OfProfile {
    fn default() -> Self {
        Self {
            questions: [Stack::default(); QUESTIONS.len()],
            c_functions: [None; C_FUNCTIONS.len()],
        }
    }
}

/// Why an image has no bounds.
const ADDRESS_TAKEN: &str =
    "the address of a function is taken: a pointer may call it, which the graph does not show";

impl Stacks {
    /// What each question takes with a profile.
    pub fn of(&self, profile: Profile) -> [Stack; QUESTIONS.len()] {
        self.0[profile as usize].questions
    }

    /// The bound of each of [`C_FUNCTIONS`] with a profile.
    pub fn of_c(&self, profile: Profile) -> [Option<u32>; C_FUNCTIONS.len()] {
        self.0[profile as usize].c_functions
    }

    /// Reads the bounds of the functions of `meshsweep.h` from a linked library.
    ///
    /// # Errors
    /// A function has none, or is missing in [`C_FUNCTIONS`].
    pub fn bound_c(&mut self, linked: &Path, profile: Profile) -> Result<(), String> {
        let graph = CallGraph::of(linked)?;
        if graph.takes_addresses {
            return Err(ADDRESS_TAKEN.to_owned());
        }
        for name in c_library::functions()? {
            let bound = graph.bound(&name).map_err(|reason| format!("{name}: {reason}"))?;
            match C_FUNCTIONS.iter().position(|(known, _)| *known == name) {
                Some(index) => self.0[profile as usize].c_functions[index] = Some(bound.bytes),
                None if bound.bytes < MOST_UNLISTED => {}
                None => {
                    return Err(format!(
                        "{name}: {} bytes of stack\n{}",
                        bound.bytes,
                        bound.text()
                    ));
                }
            }
        }
        Ok(())
    }

    /// Reads the bounds from the image of the proof.
    ///
    /// # Errors
    /// A question has none.
    pub fn bound(&mut self, cross: &Cross, board: &Board, profile: Profile) -> Result<(), String> {
        let graph = CallGraph::of(&images::image(cross, board.target, profile, "proof"))?;
        if graph.takes_addresses {
            return Err(ADDRESS_TAKEN.to_owned());
        }
        let mut refused = Vec::new();
        for (question, stack) in QUESTIONS.iter().zip(&mut self.0[profile as usize].questions) {
            match graph.bound(&path(question)) {
                Ok(bound) => stack.bound = stack.bound.max(Some(bound.bytes)),
                Err(reason) => refused.push(format!("{}: {reason}", question.name)),
            }
        }
        if refused.is_empty() { Ok(()) } else { Err(refused.join("\n")) }
    }

    /// Reads the bounds of a debug build, of the questions that its image asks.
    ///
    /// # Errors
    /// With the override a closest point takes more than 2,880 bytes, or has no bound.
    pub fn bound_debug(
        &mut self,
        cross: &Cross,
        board: &Board,
        profile: Profile,
    ) -> Result<(), String> {
        let graph = CallGraph::of(&images::image(cross, board.target, profile, DEBUG_IMAGE))?;
        for (question, stack) in QUESTIONS.iter().zip(&mut self.0[profile as usize].questions) {
            let bound = graph.bound(&path(question)).ok();
            stack.bound = bound.as_ref().map(|bound| bound.bytes);
            if profile == Profile::Overridden && question.name == CLOSEST {
                match bound {
                    Some(bound) if bound.bytes <= MOST_IN_DEBUG => {}
                    Some(bound) => {
                        return Err(format!(
                            "{CLOSEST}: {} bytes of stack in a debug build, not {MOST_IN_DEBUG}\n\
                             {}",
                            bound.bytes,
                            bound.text()
                        ));
                    }
                    None => return Err(format!("{CLOSEST}: no bound in a debug build")),
                }
            }
        }
        Ok(())
    }

    /// Takes what an image of the suite painted.
    ///
    /// # Errors
    /// It is more than the bound of the same image.
    pub fn paint(
        &mut self,
        profile: Profile,
        image: &Path,
        reading: &Reading,
    ) -> Result<(), String> {
        let graph = CallGraph::of(image)?;
        for (question, stack) in QUESTIONS.iter().zip(&mut self.0[profile as usize].questions) {
            if !image.ends_with(self::image(question)) {
                continue;
            }
            let path = path(question);
            let asked = reading.costs.iter().filter(|cost| is_asked_by(question, &cost.kind));
            let Some(below) = asked
                .map(|cost| cost.stack)
                .max()
                .or_else(|| question.kinds.is_empty().then_some(reading.opening))
            else {
                continue;
            };
            // The stack of opening is painted below its caller.
            let own = if question.kinds.is_empty() { Some(0) } else { graph.frame(&path, "Meter") };
            let painted = below + own.ok_or_else(|| format!("no function `{path}`"))?;
            let bound =
                graph.bound(&path).map_err(|reason| format!("{}: {reason}", question.name))?;
            if painted > bound.bytes {
                return Err(format!(
                    "{}: {painted} bytes of stack were seen, and {} are the bound:\n{}",
                    question.name,
                    bound.bytes,
                    bound.text()
                ));
            }
            stack.painted = stack.painted.max(Some(painted));
            stack.bound = stack.bound.max(Some(bound.bytes));
        }
        Ok(())
    }
}
