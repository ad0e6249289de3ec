//! A width that is asked for is kept everywhere, in few bytes, or is refused.

use meshsweep::builder::{For, SdfKind, SdfLayout};
use meshsweep::mesh::RawMesh;
use meshsweep::{BuildError, Builder, Built};
use meshsweep_core::{Blob, Side};
use meshsweep_host_tests::generate::{Rng, Triangles, block, bracket, torus};
use meshsweep_host_tests::oracle::{distance_to_mesh, winding_number};

/// Points of each field, anywhere in it.
const POINTS: usize = 1500;

fn diagonal((positions, _): &Triangles) -> f64 {
    let along = |k: usize, pick: fn(f32, f32) -> f32| {
        f64::from(positions.iter().map(|p| p[k]).reduce(pick).expect("positions"))
    };
    (0..3).map(|k| (along(k, f32::max) - along(k, f32::min)).powi(2)).sum::<f64>().sqrt()
}

fn build((positions, triangles): &Triangles, builder: Builder<'_>) -> Result<Built, BuildError> {
    builder.serve(For::Sdf).build(RawMesh::from_f32(positions, triangles))
}

/// Asserts that each answer is as narrow as asked for and holds the distance of its kind. Returns
/// the largest part of the allowed width that an answer took.
fn assert_kept(name: &str, mesh: &Triangles, bytes: &[u8], error: f64, part: f64) -> f64 {
    let (positions, triangles) = mesh;
    let field = Blob::open(bytes).expect("opens").sdf().expect("a field");
    let [low, high] = field.bounds().map(|corner| corner.map(f64::from));
    let (mut rng, mut largest) = (Rng::new(7), 0f64);
    for _ in 0..POINTS {
        let p = [0, 1, 2].map(|k| (low[k] + (high[k] - low[k]) * rng.unit_f64()) as f32);
        let found = field.distance(p).expect("in the field");
        let [lower, upper] = [found.distance.lower, found.distance.upper].map(f64::from);
        let distance = distance_to_mesh(p, positions, triangles);
        let is_in = field.kind() != SdfKind::Surface
            && winding_number(p.map(f64::from), positions, triangles, diagonal(mesh)) > 0.5;
        let [least, most] = match (is_in, field.kind()) {
            (true, SdfKind::Signed) => [-distance.upper, -distance.lower],
            (true, _) => [0.0; 2],
            _ => [distance.lower, distance.upper],
        };
        assert!(lower <= most && least <= upper, "{name} {p:?}: {least} not in {lower} {upper}");
        assert!(!(is_in && found.side == Side::Outside), "{name} {p:?}");
        let away = if is_in && field.kind() == SdfKind::Solid { 0.0 } else { distance.upper };
        let taken = (upper - lower) / (error + part * away);
        assert!(taken <= 1.0, "{name} {p:?}: {lower} to {upper} takes {taken}");
        largest = largest.max(taken);
    }
    largest
}

fn assert_kept_by(name: &str, mesh: &Triangles, cases: &[(SdfKind, SdfLayout, f64, f64)]) {
    for &(kind, layout, percent, part) in cases {
        let error = percent / 100.0 * diagonal(mesh);
        let builder = Builder::new().sdf_kind(kind).sdf_layout(layout).sdf_error(error);
        let built = build(mesh, builder.sdf_relative(part)).expect("builds");
        let report = built.sdf.expect("a report");
        assert_eq!((report.kind, report.layout), (kind, layout));
        assert!(part > 0.0 || report.widest <= error, "{name}: {report:?}");
        let name = format!("{name} {kind:?} {layout:?} {percent} {part}");
        let taken = assert_kept(&name, mesh, built.bytes(), error, part);
        // Bytes are not spent on widths that nobody asked for.
        assert!(taken > 0.5, "{name}: {taken}");
    }
}

#[test]
fn intervals_of_a_machined_part_are_as_narrow_as_asked_for_and_hold_the_distance() {
    let cases = [
        (SdfKind::Signed, SdfLayout::Tree, 10.0, 0.0),
        (SdfKind::Solid, SdfLayout::Tree, 8.0, 0.2),
        (SdfKind::Surface, SdfLayout::Lattice, 10.0, 0.1),
    ];
    assert_kept_by("bracket", &bracket(), &cases);
}

#[test]
fn intervals_of_a_torus_are_as_narrow_as_asked_for_and_hold_the_distance() {
    let cases = [
        (SdfKind::Signed, SdfLayout::Tree, 8.0, 0.0),
        (SdfKind::Signed, SdfLayout::Lattice, 10.0, 0.0),
        (SdfKind::Signed, SdfLayout::Tree, 6.0, 0.2),
        (SdfKind::Solid, SdfLayout::Lattice, 10.0, 0.1),
    ];
    assert_kept_by("torus", &torus(3.0, 1.0, 16, 8), &cases);
}

#[test]
fn a_width_is_kept_in_bytes_whose_mean_is_narrower_and_whose_widest_cell_is_not() {
    let mesh = torus(3.0, 1.0, 16, 8);
    let error = 0.1 * diagonal(&mesh);
    let of = |error: f64| build(&mesh, Builder::new().sdf_error(error)).expect("builds");
    let [wide, narrow] = [of(error), of(0.6 * error)].map(|built| built.sdf.expect("a report"));
    assert!(wide.bytes < narrow.bytes, "{} {}", wide.bytes, narrow.bytes);
    let bytes = u32::try_from(wide.bytes).expect("few");
    let mean = build(&mesh, Builder::new().sdf_bytes(bytes)).expect("builds");
    let mean = mean.sdf.expect("a report");
    assert!(mean.widest > error && wide.widest <= error, "{mean:?} {wide:?}");
}

#[test]
fn a_width_without_a_field_is_refused_with_one_that_has() {
    let mesh = block([0.0; 3], [3.0, 2.0, 1.0]);
    // Without a margin, for fields near the narrowest have many cells.
    let of = |error: f64| build(&mesh, Builder::new().sdf_margin(0.0).sdf_error(error));
    let refused = of(1e-3).expect_err("refused");
    let BuildError::FieldNotNarrow { error, bytes, widest } = refused else {
        panic!("{refused}");
    };
    assert_eq!((error, bytes), (1e-3, 1 << 18));
    assert!(refused.to_string().contains("--sdf-error of about"), "{refused}");
    let built = of(1.2 * widest).expect("builds");
    assert!(built.sdf.expect("a report").widest <= 1.2 * widest);
    let few = |bytes: u32| build(&mesh, Builder::new().sdf_error(0.15).sdf_bytes(bytes));
    let refused = few(300).expect_err("refused");
    let BuildError::FieldNeedsBytes { error: 0.15, bytes: 300, needed } = refused else {
        panic!("{refused}");
    };
    assert!(few(2 * needed as u32).is_ok(), "{needed}");
    let refused = build(&mesh, Builder::new().sdf_relative(0.1)).expect_err("refused");
    assert!(matches!(refused, BuildError::Option { option: "--sdf-rel", .. }), "{refused}");
}
