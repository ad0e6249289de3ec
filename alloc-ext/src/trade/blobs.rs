//! The blobs of recipes, or why a mesh has none.

use crate::builder::{Builder, Built, Recipe};
use crate::error::BuildError;
use crate::hull;
use crate::load::{Loaded, Source};
use std::fmt;

/// Why a mesh has no blob of a recipe.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NotBuilt {
    /// The builder refused.
    Refused(BuildError),
    /// The search for a tight hull stopped before it had as few faces as asked for.
    Stuck {
        /// Its faces.
        faces: usize,
    },
    /// Vertices of the hull hierarchy were rounded, and the refined hull needs them as they are.
    Rounded,
    /// Every level that is coarser than the surface is farther from it than asked.
    NoLevel,
}

impl fmt::Display for NotBuilt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            // Without the remedy of another structure.
            Self::Refused(BuildError::NotSolid { error, .. }) => error.fmt(f),
            Self::Refused(error) => error.fmt(f),
            Self::Stuck { faces } => write!(f, "the search stopped at {faces} faces"),
            Self::Rounded => f.write_str("f32 does not hold the coordinates as they are"),
            Self::NoLevel => f.write_str("every coarser level is farther from the surface"),
        }
    }
}

impl From<BuildError> for NotBuilt {
    fn from(error: BuildError) -> Self {
        Self::Refused(error)
    }
}

/// Builds a recipe of a mesh that is at hand as read and repaired.
///
/// # Errors
/// [`NotBuilt`].
pub fn build(recipe: Recipe, source: &Source, repaired: &Loaded) -> Result<Built, NotBuilt> {
    kept(recipe, &Builder::of(recipe).build_repaired(source, repaired)?)
}

/// Builds recipes that one build gives: a single one, or levels of one hierarchy.
pub(super) fn build_group(
    recipes: &[Recipe],
    source: &Source,
    repaired: &Loaded,
) -> Vec<Result<Built, NotBuilt>> {
    let Some(first) = recipes.first() else { return Vec::new() };
    let whole = Builder::of(*first).build_repaired(source, repaired);
    recipes.iter().map(|&recipe| kept(recipe, whole.as_ref().map_err(Clone::clone)?)).collect()
}

/// Of what the builder made, what the recipe wants.
pub(super) fn kept(recipe: Recipe, built: &Built) -> Result<Built, NotBuilt> {
    match (recipe, built.tight.first()) {
        (Recipe::CutLevel(error), _) => cut_level(built, error),
        (Recipe::Hull(_), _) if built.blob().hull().is_ok_and(|of| of.surface_error() > 0.0) => {
            Err(NotBuilt::Rounded)
        }
        (Recipe::Tight(most), Some(report)) if report.wrapped.faces > most as usize => {
            Err(NotBuilt::Stuck { faces: report.wrapped.faces })
        }
        _ => Ok(built.clone()),
    }
}

fn cut_level(built: &Built, error: f32) -> Result<Built, NotBuilt> {
    let blob = built.blob();
    let whole = blob.hull().map_err(|_| NotBuilt::NoLevel)?;
    let unit = whole.scale();
    let is_fine = |level: &meshsweep_core::HullLevel| {
        f64::from(level.hull_to_surface) * unit <= f64::from(error)
    };
    let index = whole.levels().position(|level| is_fine(&level));
    let last = whole.header().levels.saturating_sub(1);
    let index = index.map_or(last, |index| index as u32);
    let tables = if index == last { None } else { hull::cut(&whole, index) };
    Ok(built.with_bytes(tables.ok_or(NotBuilt::NoLevel)?.sections().to_bytes())?)
}
