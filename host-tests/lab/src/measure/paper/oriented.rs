//! Triboxes along the mesh's axes and in the orientation of least volume or area (paper 001,
//! section 3), and triboxes that are split until each is near enough (section 4).

use meshsweep::progress::Watch;
use meshsweep::tribox::{self, Measure, TriboxOptions};
use meshsweep_core::Triboxes;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Table, fixed, row};

use crate::measure::stopwatch::Stopwatch;
use crate::measure::triboxes::faces;

/// Triboxes of the finest level.
const TRIBOXES: u32 = 64;

/// Levels that are shown.
const LEVELS: [u32; 4] = [1, 4, 16, 64];

/// Errors that are asked for, of the diagonal.
const ERRORS: [f64; 4] = [0.1, 0.05, 0.02, 0.01];

/// Most triboxes that an error may take.
const MOST: u32 = 4096;

fn built(subject: &Subject, options: &TriboxOptions) -> Result<Vec<u8>, String> {
    let tables = tribox::build(subject.mesh.as_input(), options, Watch::NONE);
    Ok(tables.map_err(|error| error.to_string())?.0.to_bytes())
}

/// Faces of a level's triboxes.
fn faces_of(triboxes: Triboxes<'_>) -> usize {
    triboxes.leaves().map(|(_, tribox)| faces(&tribox)).sum()
}

/// Void and faces of levels, along the mesh's axes and turned.
///
/// # Errors
/// The mesh is out of the domain.
pub fn orientations(subject: &Subject) -> Result<Table, String> {
    let columns = ["orientation", "turned", "triboxes", "faces", "void %", "error", "seconds"];
    let title = "Triboxes along the axes and turned, beside paper 001, section 3";
    let mut table = Table::new("tribox_orientations", title, &columns);
    let orients = [
        ("the mesh's", None),
        ("least volume", Some(Measure::Volume)),
        ("least area", Some(Measure::Area)),
    ];
    for (name, orient) in orients {
        for most in [1, TRIBOXES] {
            let begun = Stopwatch::start();
            let bytes = built(subject, &TriboxOptions::new(most).with_orient(orient))?;
            let seconds = begun.seconds();
            let all = Triboxes::open(&bytes).map_err(|error| error.to_string())?;
            for level in all.levels().filter(|level| LEVELS.contains(&level.triboxes)) {
                // One tribox alone may be turned another way than that of many.
                if (level.triboxes == 1) != (most == 1) {
                    continue;
                }
                table.push(row![
                    name,
                    if all.is_turned() { "yes" } else { "no" },
                    level.triboxes as usize,
                    faces_of(all.coarser(level.triboxes)),
                    fixed(100.0 * f64::from(level.void_ratio), 1),
                    fixed(f64::from(level.error), 4),
                    fixed(seconds, 2),
                ]);
            }
        }
    }
    table.note(
        "a mesh is turned if the triboxes of the finest level then have less volume or area in \
         all; of 1 and of 64 triboxes that is decided anew",
    );
    Ok(table)
}

/// Triboxes that an error takes, beside as many by gain.
///
/// # Errors
/// The mesh is out of the domain.
pub fn errors(subject: &Subject) -> Result<Table, String> {
    let columns = [
        "error, % of diagonal",
        "triboxes",
        "reached, %",
        "void %",
        "seconds",
        "as many by gain: reached, %",
        "void %",
    ];
    let title = "Triboxes split until each is near enough, beside paper 001, formula (10)";
    let mut table = Table::new("tribox_errors", title, &columns);
    let percent = |length: f64| fixed(100.0 * length / subject.diagonal(), 2);
    for part in ERRORS {
        let begun = Stopwatch::start();
        let options = TriboxOptions::new(MOST).with_error(Some(part * subject.diagonal()));
        let bytes = built(subject, &options)?;
        let seconds = begun.seconds();
        let all = Triboxes::open(&bytes).map_err(|error| error.to_string())?;
        let count = all.leaf_count();
        let by_gain = built(subject, &TriboxOptions::new(count))?;
        let by_gain = Triboxes::open(&by_gain).map_err(|error| error.to_string())?;
        let last = |of: &Triboxes<'_>| {
            let level = of.level(of.level_count() - 1);
            level.map_or((0.0, 0.0), |level| {
                (f64::from(level.error), 100.0 * f64::from(level.void_ratio))
            })
        };
        let ((reached, void), (other, other_void)) = (last(&all), last(&by_gain));
        table.push(row![
            fixed(100.0 * part, 1),
            count as usize,
            percent(reached),
            fixed(void, 1),
            fixed(seconds, 2),
            percent(other),
            fixed(other_void, 1),
        ]);
    }
    table.note("reached: the largest error of a tribox, (10) as a distance of convex bodies");
    Ok(table)
}
