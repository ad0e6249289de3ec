//! Whether the arrays of a mesh are what the builders index.

use crate::error::BuildError;
use crate::mesh::Mesh;

/// Checks a mesh of at most `most` triangles and wires: each has a number in the input file, and
/// each vertex that it names is there and finite.
///
/// # Errors
/// [`BuildError::TooLarge`], [`BuildError::NoSuchVertex`], [`BuildError::NotFinite`] or
/// [`BuildError::SourceNumbers`].
pub(crate) fn require_valid(mesh: &Mesh, most: usize) -> Result<(), BuildError> {
    let triangles = mesh.triangles.len() + mesh.wires.len();
    if triangles > most {
        return Err(BuildError::TooLarge { triangles, most });
    }
    if mesh.source.len() != mesh.triangles.len() {
        let (triangles, numbers) = (mesh.triangles.len(), mesh.source.len());
        return Err(BuildError::SourceNumbers { triangles, numbers });
    }
    let vertices = mesh.positions.len();
    for (triangle, corners) in mesh.all_triangles().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
            return Err(BuildError::NoSuchVertex { triangle, vertex, vertices });
        }
    }
    let is_finite = |p: &[f32; 3]| p.iter().all(|x| x.is_finite());
    match mesh.positions.iter().position(|p| !is_finite(p)) {
        Some(vertex) => Err(BuildError::NotFinite { vertex }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_triangles_than_a_structure_holds_are_refused_before_they_are_read() {
        let mesh = Mesh { triangles: vec![[0; 3]; 9], ..Mesh::default() };
        let wanted = BuildError::TooLarge { triangles: 9, most: 8 };
        assert_eq!(require_valid(&mesh, 8), Err(wanted.clone()));
        assert!(wanted.to_string().starts_with("9 triangles are more than the 8"));
    }

    #[test]
    fn arrays_that_do_not_fit_each_other_are_refused_with_the_place() {
        let refused = |mesh: &Mesh| require_valid(mesh, 8).unwrap_err();
        let mesh = Mesh::new(vec![[0.0; 3], [1.0; 3], [2.0; 3]], vec![[0, 1, 2]]);
        assert_eq!(require_valid(&mesh, 1), Ok(()));
        let beyond = Mesh { triangles: vec![[0, 1, 3]], ..mesh.clone() };
        let wanted = BuildError::NoSuchVertex { triangle: 0, vertex: 3, vertices: 3 };
        assert_eq!(refused(&beyond), wanted);
        let unnumbered = Mesh { source: Vec::new(), ..mesh.clone() };
        let wanted = BuildError::SourceNumbers { triangles: 1, numbers: 0 };
        assert_eq!(refused(&unnumbered), wanted);
        for x in [f32::NAN, f32::INFINITY] {
            let mut infinite = mesh.clone();
            infinite.positions[1][2] = x;
            assert_eq!(refused(&infinite), BuildError::NotFinite { vertex: 1 });
        }
    }
}
