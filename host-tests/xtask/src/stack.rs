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
use crate::reading::Reading;

/// The question that is asked most.
const CLOSEST: &str = "closest point";

/// Most bytes of stack of a closest point in a debug build with the override of the guide. Without
/// floating point eight triangles wait there.
const MOST_IN_DEBUG: u32 = 2816;

/// The image that is built for debug builds: it asks a box tree four questions.
pub const DEBUG_IMAGE: &str = "size_tree_four";

/// A question, as the tables name it.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Its name.
    pub name: &'static str,
    /// What a blob has to have, as the builder's table of stacks names it.
    pub needs: &'static str,
    /// The function of the suite.
    function: &'static str,
    /// The suite's kinds of queries that call the function; none of opening.
    kinds: &'static [&'static str],
    /// The image of the suite that asks it.
    image: &'static str,
}

const fn question(
    name: &'static str,
    needs: &'static str,
    function: &'static str,
    kinds: &'static [&'static str],
    image: &'static str,
) -> Question {
    Question { name, needs, function, kinds, image }
}

/// The questions of the tables.
pub const QUESTIONS: [Question; 35] = {
    const TREE: &str = "suite_tree";
    const APART: &str = "suite_apart";
    const HULL: &str = "suite_hull";
    [
        question("open a box tree", "tree", "tree::open", &[], TREE),
        question(
            CLOSEST,
            "closest",
            "tree::distance::closest",
            &["closest_far", "closest_near"],
            TREE,
        ),
        question(
            "closest point from a hint",
            "closest",
            "tree::distance::follow",
            &["closest_path"],
            TREE,
        ),
        question(
            "closest point in f64",
            "closest",
            "tree::distance::precise",
            &["closest_precise"],
            TREE,
        ),
        question(
            "coherent query",
            "closest",
            "tree::distance::coherent",
            &["coherent_query"],
            TREE,
        ),
        question("closest points", "closest", "tree::distance::batch", &["batch_of_8"], TREE),
        question("within", "closest", "tree::distance::is_within", &["within"], TREE),
        question("nearest triangles", "closest", "tree::distance::nearest", &["nearest"], TREE),
        question("all within", "closest", "tree::distance::all_within", &["all_within"], TREE),
        question("signed distance", "closest", "tree::distance::signed", &["signed"], TREE),
        question("winding number", "winding", "apart::winding", &["winding"], APART),
        question("front facing", "cull", "tree::sight::cull", &["cull"], TREE),
        question("first hit", "segment", "tree::sight::first_hit", &["first_hit"], TREE),
        question("any hit", "segment", "tree::sight::any_hit", &["any_hit"], TREE),
        question("all hits", "segment", "tree::sight::all_hits", &["all_hits"], TREE),
        question("overlap", "segment", "tree::meeting::overlap", &["overlap"], TREE),
        question("distance of two models", "segment", "apart::distance", &["pair_distance"], APART),
        question("coherent pair", "segment", "apart::coherent", &["coherent_pair"], APART),
        question("scene", "segment", "apart::scene", &["scene"], APART),
        question("distance of a solid", "segment", "apart::solid", &["solid"], APART),
        question("first contact", "segment", "apart::contact", &["first_contact"], APART),
        question("penetration", "winding", "apart::penetration", &["penetration"], APART),
        question("open tight hulls", "tight", "tight::open", &[], "suite_tight"),
        question(
            "closest point of tight hulls",
            "tight",
            "tight::closest",
            &["closest_far", "closest_near"],
            "suite_tight",
        ),
        question("within of tight hulls", "tight", "tight::is_within", &["within"], "suite_tight"),
        question("open a hull hierarchy", "hull", "hull::open", &[], HULL),
        question(
            "closest point of a hull",
            "hull",
            "hull::closest",
            &["closest_far", "closest_near", "closest_path"],
            HULL,
        ),
        question("first hit of a hull", "hull", "hull::first_hit", &["first_hit"], HULL),
        question("outer hits", "hull", "hull::outer_hits", &["outer_hits"], HULL),
        question("refine", "hull", "hull::refine", &["refine"], HULL),
        question("sweep", "hull", "hull_moving::sweep", &["sweep"], "suite_moving"),
        question("open triboxes", "triboxes", "triboxes::open", &[], "suite_triboxes"),
        question(
            "triboxes apart",
            "triboxes",
            "triboxes::reject",
            &["triboxes_apart"],
            "suite_triboxes",
        ),
        question("open curves", "curve", "curve::open", &[], "suite_curve"),
        question(
            "closest point of curves",
            "curve",
            "curve::closest",
            &["closest_far", "closest_near"],
            "suite_curve",
        ),
    ]
};

/// Functions of `meshsweep.h`, and what a blob has to have for them.
pub const C_FUNCTIONS: [(&str, &str); 20] = [
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
    ("msw_overlap", "segment"),
    ("msw_models_within", "segment"),
    ("msw_solid_first_contact", "segment"),
    ("msw_open_tight", "tight"),
    ("msw_tight_within", "tight"),
    ("msw_tight_model", "tight"),
    ("msw_open_hull", "hull"),
    ("msw_refine", "hull"),
    ("msw_refined_faces", "hull"),
    ("msw_checksum", "any"),
];

/// A function of the header that is not in the list takes less. `part.h` says so.
const MOST_UNLISTED: u32 = 64;

impl Question {
    fn path(&self) -> String {
        format!("meshsweep_suite::ask::{}", self.function)
    }
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
            match graph.bound(&question.path()) {
                Ok(bound) => stack.bound = stack.bound.max(Some(bound.bytes)),
                Err(reason) => refused.push(format!("{}: {reason}", question.name)),
            }
        }
        if refused.is_empty() { Ok(()) } else { Err(refused.join("\n")) }
    }

    /// Reads the bounds of a debug build, of the questions that its image asks.
    ///
    /// # Errors
    /// With the override a closest point takes more than 2,816 bytes, or has no bound.
    pub fn bound_debug(
        &mut self,
        cross: &Cross,
        board: &Board,
        profile: Profile,
    ) -> Result<(), String> {
        let graph = CallGraph::of(&images::image(cross, board.target, profile, DEBUG_IMAGE))?;
        for (question, stack) in QUESTIONS.iter().zip(&mut self.0[profile as usize].questions) {
            let bound = graph.bound(&question.path()).ok();
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
            if !image.ends_with(question.image) {
                continue;
            }
            let path = question.path();
            let asked =
                reading.costs.iter().filter(|cost| question.kinds.contains(&cost.kind.as_str()));
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
