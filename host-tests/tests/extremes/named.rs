//! A test of its own for each mesh of the list, named after what is extreme about it.

use meshsweep_host_tests::generate::extremes::{Extreme, extremes};

/// A test for each mesh, which calls a function with the mesh; or for the meshes named.
macro_rules! on_every_extreme {
    ($module:ident, $check:path) => {
        on_every_extreme!(@every [] $module, $check);
    };
    (ignored because $why:literal: $module:ident, $check:path) => {
        on_every_extreme!(@every [$why] $module, $check);
    };
    (@every [$($why:literal)?] $module:ident, $check:path) => {
        mod $module {
            on_every_extreme! { @ [$($why)?] $check;
                scale_1e_minus_30
                scale_1e30
                subnormal_coordinates
                the_largest_numbers
                scales_1e_minus_30_to_1e30_in_one_mesh
                ten_thousand_diagonals_away
                ten_thousand_diagonals_along_one_axis
                ten_million_diagonals_away
                a_tower_of_aspect_1e8
                needles_of_aspect_1e8
                slivers_of_aspect_1e8
                coplanar_triangles_that_overlap
                collinear_corners
                coincident_triangles
                points_lines_and_triangles
                a_lattice_of_equal_distances
                a_sphere
                one_triangle
                two_triangles
                four_triangles
                surfaces_that_cross
                a_solid_in_a_solid
                a_cavity
                an_open_mesh
            }
        }
    };
    ($module:ident, $check:path; $($name:ident)*) => {
        mod $module {
            on_every_extreme! { @ [] $check; $($name)* }
        }
    };
    (@ [] $check:path; $($name:ident)*) => {
        $(
            #[test]
            fn $name() {
                $check(&crate::named::extreme(stringify!($name)));
            }
        )*
        #[allow(dead_code, reason = "one list is compared with that of the meshes")]
        pub const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
    (@ [$why:literal] $check:path; $($name:ident)*) => {
        $(
            #[test]
            #[ignore = $why]
            fn $name() {
                $check(&crate::named::extreme(stringify!($name)));
            }
        )*
    };
}

on_every_extreme!(generated, super::is_small);

/// The mesh of this name.
pub fn extreme(name: &str) -> Extreme {
    extremes().into_iter().find(|extreme| extreme.name == name).expect("a mesh of this name")
}

fn is_small(extreme: &Extreme) {
    let (positions, triangles) = &extreme.mesh;
    assert!(
        (1..=100).contains(&triangles.len()) && positions.iter().flatten().all(|x| x.is_finite())
    );
}

#[test]
fn every_extreme_mesh_has_its_tests() {
    let names: Vec<_> = extremes().iter().map(|extreme| extreme.name).collect();
    assert_eq!(names, generated::NAMES);
}
