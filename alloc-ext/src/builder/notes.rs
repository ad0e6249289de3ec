//! The report of a build, in sentences.

use super::built::{Built, Note, Topic};
use super::options::{For, Options};
use crate::bvh::{SideDefect, SidesReport, WhyF32};
use crate::counted::Counted;
use crate::curve::CurveReport;
use crate::hull::{BuildReport, Kind, sticks_out_note, wires_note};
use crate::load::Loaded;
use crate::mesh::Mesh;
use crate::number::{About, AtMost};
use crate::sdf::{SdfKind, SdfLayout, SdfReport};
use crate::surface::VertexBits;
use crate::tight::{Goal, HullReport, margin_note, no_void_note, rounded_note};
use crate::tribox::{TriboxReport, volume};
use meshsweep_core::Blob;
use meshsweep_core::internal::format::layout::VertexFormat;

/// Notes of one topic.
fn notes(topic: Topic, texts: impl IntoIterator<Item = String>) -> impl Iterator<Item = Note> {
    texts.into_iter().map(move |text| Note { topic, text })
}

/// The curves' points that repeat the one before, and a fence that crosses itself.
pub(super) fn of_curve(report: &CurveReport) -> Vec<Note> {
    let points = Counted(report.repeated, "point");
    let text = format!("{points} repeated: kept, as segments without length");
    let repeated = (report.repeated > 0).then_some(text);
    let crossed = report.crossed.map(|polyline| {
        format!(
            "polyline {polyline} crosses itself: inside is what it winds around; between two \
             polygons belongs a blank line"
        )
    });
    notes(Topic::Input, repeated.into_iter().chain(crossed)).collect()
}

/// What was read, repaired and moved.
fn of_mesh(loaded: &Loaded, hull: Option<&BuildReport>) -> Vec<String> {
    let mut texts: Vec<String> =
        loaded.report.to_string().lines().map(|line| line.trim_start().to_owned()).collect();
    texts.extend(loaded.unit_note());
    if let Some(report) = hull {
        texts.push(kind(&report.kind));
        texts.extend(wires_note(report.wires));
    }
    if loaded.moved > 0.0 {
        let moved = AtMost(loaded.moved);
        texts.push(format!("vertices moved to the hull's grid by up to {moved}"));
    }
    texts
}

/// What was read, repaired and moved; what the structures lack, and what is doubtful about them.
pub(super) fn of_blob(
    options: &Options,
    loaded: &Loaded,
    blob: &Blob<'_>,
    built: &Built,
) -> Vec<Note> {
    let (mut hull, mut tree, mut sides, mut tight) = (vec![], vec![], vec![], vec![]);
    let (tree_report, reports) = (built.tree.as_ref(), &built.tight);
    if let Some(report) = &built.hull {
        hull.push(format!("base hull: {}", Counted(report.base_faces, "face")));
        hull.extend(report.stuck.map(|stuck| stuck.why(options.base_faces())));
        if matches!(report.kind, Kind::Hulls { .. }) {
            hull.extend(sticks_out_note(loaded.error()));
        }
        hull.extend(other_format(options.vertex_bits, blob.header().vertex_format));
    }
    if let Ok(bvh) = blob.bvh() {
        tree.extend(tree_report.and_then(|report| report.why_f32).map(off_grid));
        tree.extend(tree_report.map(|report| report.packing.to_string()));
        if bvh.serves_distances() && !bvh.serves_winding() {
            sides.extend(tree_report.and_then(|report| report.sides).map(sideless));
        }
    }
    if let Some(first) = reports.first() {
        tight.extend(left_out(options, reports));
        tight.extend(rounded_note(loaded.error()));
        tight.extend(margin_note(options.margin, "mesh"));
        tight.extend(no_void_note(&first.void));
        reports.iter().for_each(|report| tight.extend(of_tight(report)));
    }
    let sdf = built.sdf.as_ref().map_or_else(Vec::new, |report| of_sdf(options, report));
    let triboxes = built.triboxes.as_ref();
    let gains = triboxes.map_or_else(Vec::new, |report| of_gains(options, report, loaded));
    let triboxes = triboxes.and_then(|report| of_triboxes(options, report));
    let winding = if options.serves(For::Winding) { of_winding(loaded) } else { vec![] };
    notes(Topic::Input, of_mesh(loaded, built.hull.as_ref()))
        .chain(notes(Topic::Hull, hull))
        .chain(notes(Topic::BoxTree, tree))
        .chain(notes(Topic::Sides, sides))
        .chain(notes(Topic::Triboxes, gains.into_iter().chain(triboxes)))
        .chain(notes(Topic::Tight, tight))
        .chain(notes(Topic::Sdf, sdf))
        .chain(notes(Topic::Winding, winding))
        .collect()
}

/// Says what the levels of the hierarchy are.
fn kind(kind: &Kind) -> String {
    match *kind {
        Kind::Hulls { volume } => format!("volume {}", About(volume)),
        Kind::SweepOnly { holes, copies } => format!(
            "no hulls, distances and segments only: {}, {} where the mesh is no manifold",
            Counted(holes, "hole"),
            Counted(copies, "copied vertex")
        ),
    }
}

/// A note if the hull could not have the wanted format.
fn other_format(wanted: VertexBits, got: VertexFormat) -> Option<String> {
    let wanted = match wanted {
        VertexBits::Grid16 => VertexFormat::Grid16,
        VertexBits::Grid24 => VertexFormat::Grid24,
        VertexBits::Auto | VertexBits::F32 => return None,
    };
    let text = "the mesh is too small or too far from its origin for the hull's grid: its \
                coordinates are stored as f32";
    (got != wanted).then(|| text.to_owned())
}

/// Says why the box tree's coordinates are f32.
fn off_grid(why: WhyF32) -> String {
    let why = match why {
        WhyF32::TooFar => "the mesh is too far from its origin for the box tree's grid",
        WhyF32::Sides => "on the box tree's grid faces change places, and sides could be wrong",
    };
    format!("{why}: its coordinates are stored as f32")
}

/// Says where the nearest triangle tells no side, and why.
fn sideless(report: SidesReport) -> String {
    let SidesReport { defect, at, in_f32, sideless, are_lost, .. } = report;
    let surface = if in_f32 { "the surface" } else { "on the box tree's grid the surface" };
    let defect = match defect {
        SideDefect::Crossing([a, b]) => {
            format!("crosses, overlaps or touches itself, as triangles {a} and {b} do at {at:?}")
        }
        SideDefect::Winding(triangle) => {
            format!("is inside out or inside itself, as at triangle {triangle}, {at:?}")
        }
        SideDefect::Mixed(triangle) => format!(
            "has a component that the file winds both ways, with others in or around it, as at \
             triangle {triangle}, {at:?}"
        ),
    };
    let places = match are_lost {
        true => "sides by the nearest triangle are undecided".to_owned(),
        false => format!(
            "sides are undecided where the nearest triangle is one of {}",
            Counted(sideless, "triangle")
        ),
    };
    format!("{places}: {surface} {defect}; --for closest,winding decides them by winding numbers")
}

/// What the field's distances mean if the mesh decided it, how wide it is, and what its proof did.
fn of_sdf(options: &Options, report: &SdfReport) -> Vec<String> {
    let mut texts = Vec::new();
    if report.lacks_sides {
        let why = "the mesh is not closed, or walls of it were merged";
        texts.push(format!("{why}: the field's distances have no sign"));
    }
    let outside = if report.kind == SdfKind::Solid { " outside" } else { "" };
    texts.push(format!(
        "intervals{outside} up to a tenth of the diagonal from the surface: about {} wide, at most \
         about {}",
        About(report.mean_width),
        About(report.largest_width)
    ));
    let anywhere = format!("no interval in the field is wider than {}", AtMost(report.widest));
    texts.push(match (options.sdf_error, options.sdf_relative) {
        (None, _) => anywhere,
        (Some(error), None) => format!("{anywhere}: --sdf-error {error} allows no more"),
        (Some(error), Some(part)) => format!(
            "{anywhere}, or than {error} and {part} times the distance: the fewest bytes found"
        ),
    });
    let of_tree = report.layout == SdfLayout::Tree;
    if let Some(widths) = report.drafted_widths {
        let [kept, other] = if of_tree { ["tree", "lattice"] } else { ["lattice", "tree"] };
        let [of_kept, of_other] = widths.map(About);
        texts.push(format!(
            "{kept} kept: its mean width before the proof was {of_kept}, that of a {other} of as \
             many bytes {of_other}"
        ));
    }
    texts.push(format!(
        "proved by {}; {} became wider for it",
        Counted(report.boxes, "box"),
        Counted(report.widened, if of_tree { "leaf" } else { "cell" })
    ));
    if report.undecided > 0 {
        let all = report.cell_count;
        texts.push(format!(
            "in {} of {all} points have no certain side: the mesh crosses itself there, or is \
             inside out",
            Counted(report.undecided, if of_tree { "leaf" } else { "cell" })
        ));
    }
    texts
}

/// Says that triboxes are not as near as asked for.
fn of_triboxes(options: &Options, report: &TriboxReport) -> Option<String> {
    let (wanted, reached) = (options.tribox_error?, report.reached?);
    let text = format!(
        "a tribox is up to {} from the convex hull of what it holds, more than {wanted}: more \
         --triboxes may come nearer, up to the grid's rounding",
        AtMost(reached)
    );
    (reached > wanted).then_some(text)
}

/// Says what planes beyond extrema gained, and what turning triboxes did.
fn of_gains(options: &Options, report: &TriboxReport, loaded: &Loaded) -> Vec<String> {
    let solid = report.is_solid.then(|| volume(&loaded.mesh));
    let turned = options.orient.zip(report.oriented);
    let turned = turned.map(|(measure, gain)| (format!("--orient {}", measure.name()), gain));
    let planes = report.extrema.map(|gain| ("--extrema".to_owned(), gain));
    let all = planes.into_iter().chain(turned);
    all.map(|(option, gain)| gain.said(&option, solid).to_string()).collect()
}

/// Names the tight hulls that the blob lacks.
fn left_out(options: &Options, reports: &[HullReport]) -> Vec<String> {
    let mut asked = options.tight.clone();
    asked.sort_unstable();
    asked.dedup();
    asked.retain(|&faces| reports.iter().all(|report| report.asked != Goal::Faces(faces as usize)));
    let said = |faces| {
        format!("no tight hull of {faces} faces: it came to no fewer than the next finer one")
    };
    asked.into_iter().map(said).collect()
}

/// Why a tight hull has more faces than asked for, and how it began.
fn of_tight(report: &HullReport) -> Vec<String> {
    let mut texts = Vec::new();
    let has_more = |asked| report.wrapped.faces > asked;
    if matches!(report.asked, Goal::Faces(asked) if has_more(asked)) {
        let hull = Counted(report.wrapped.faces, "face");
        let why = report.wrapped.why_stopped(report.asked);
        texts.extend(why.map(|why| format!("tight hull of {hull}: {why}")));
    }
    texts.extend(report.wrapped.notes());
    texts
}

/// What makes the winding numbers of a mesh doubtful.
fn of_winding(Loaded { mesh, report, .. }: &Loaded) -> Vec<String> {
    let mut texts = Vec::new();
    let (parts, triangles) = (report.component_count, mesh.triangles.len());
    if triangles > 1 && 2 * parts > triangles {
        texts.push(format!(
            "{parts} connected parts of {triangles} triangles: which way each faces is taken from \
             the file, and winding numbers rely on it; weld the vertices first"
        ));
    }
    if faces_inwards(mesh) {
        texts.push(
            "the mesh faces inwards: its winding numbers are negative inside, and tell no side \
             there unless it is closed and faces inwards as a whole; reverse its triangles"
                .to_owned(),
        );
    }
    texts
}

/// Whether the volume between the file's triangles and the middle of all vertices is clearly
/// negative.
fn faces_inwards(mesh: &Mesh) -> bool {
    let triangles: Vec<[[f32; 3]; 3]> = match &mesh.filed {
        Some(filed) => (0..filed.triangles.len()).map(|t| filed.corners(t)).collect(),
        None => (0..mesh.triangles.len()).filter_map(|t| mesh.corners(t)).collect(),
    };
    let count = mesh.positions.len().max(1) as f64;
    let middle =
        [0, 1, 2].map(|k| mesh.positions.iter().map(|p| f64::from(p[k])).sum::<f64>() / count);
    let triple = |corners: &[[f32; 3]; 3]| {
        let [a, b, c] = corners.map(|p| [0, 1, 2].map(|k| f64::from(p[k]) - middle[k]));
        a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let terms = || triangles.iter().map(triple);
    terms().sum::<f64>() < -0.01 * terms().map(f64::abs).sum::<f64>()
}
