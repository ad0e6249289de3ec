//! The settings that the page shows in detail, and their intervals along a path.

use super::super::measured::Measured;
use glam::Vec3;
use meshsweep::builder::{FACES, Recipe};
use meshsweep::load::Loaded;
use meshsweep::surface::VertexBits;
use meshsweep::trade::{self, How, Points, Setting};
use meshsweep_core::{Budget, QueryError};
use serde_json::{Value, json};

/// Points of the path: half a diagonal.
const POINTS: usize = 500;

/// A few settings of the table that differ most: an exact one, a tolerance, a step budget, a tight
/// hull, a cut level.
pub fn asked(measured: &Measured) -> Vec<Setting> {
    let all = || measured.trade.rows.iter().map(|row| row.setting);
    let of_tree = |relative: f32, steps: u32| {
        all().find(|setting| {
            let Budget { relative: has, absolute, steps: within, .. } = setting.budget;
            setting.recipe == Recipe::Tree(VertexBits::Grid16)
                && (setting.how, setting.entries) == (How::Fresh, None)
                && (has, absolute, within) == (relative, 0.0, steps)
        })
    };
    let tight =
        all().rfind(|setting| matches!(setting.recipe, Recipe::Tight(faces) if faces <= FACES));
    let level = all().rfind(|setting| matches!(setting.recipe, Recipe::CutLevel(_)));
    let each = [of_tree(0.0, u32::MAX), of_tree(0.1, u32::MAX), of_tree(0.0, 8), tight, level];
    each.into_iter().flatten().collect()
}

/// The path, the distance of each of its points, and the intervals of some settings there.
pub fn as_json(
    loaded: &Loaded,
    measured: &Measured,
    asked: &[Setting],
) -> Result<Value, QueryError> {
    let points = trade::points(&loaded.mesh, Points::Path, POINTS);
    let steps = points.windows(2).map(|pair| {
        let [a, b] = [pair[0], pair[1]].map(|p| Vec3::from(p).as_dvec3());
        a.distance(b)
    });
    let along = steps.scan(0.0, |sum, step| {
        *sum += step;
        Some(*sum)
    });
    let along: Vec<f64> = std::iter::once(0.0).chain(along).take(points.len()).collect();
    let settings = asked.iter().map(|setting| {
        let intervals = intervals(measured, setting, &points)?;
        Ok(json!({
            "name": setting.to_string(),
            "lower": intervals.iter().map(|[lower, _]| f64::from(*lower)).collect::<Vec<_>>(),
            "upper": intervals.iter().map(|[_, upper]| f64::from(*upper)).collect::<Vec<_>>(),
        }))
    });
    Ok(json!({
        "settings": settings.collect::<Result<Vec<_>, QueryError>>()?,
        "points": points,
        "along": along,
        "truth": trade::distances(&loaded.mesh, &points),
    }))
}

/// The intervals of a setting that was measured.
pub fn intervals(
    measured: &Measured,
    setting: &Setting,
    points: &[[f32; 3]],
) -> Result<Vec<[f32; 2]>, QueryError> {
    let bytes = measured.trade.blob(setting.recipe).unwrap_or_default();
    trade::intervals(setting, bytes, points)
}
