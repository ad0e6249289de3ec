//! What the images carry: a mesh of so many triangles, and questions about it.

use std::fs;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use glam::Vec3;
use meshsweep::bvh::{self, TreeOptions};
use meshsweep::hull::{BuildOptions, hull_of};
use meshsweep::mesh::{Mesh, write_ply};
use meshsweep::progress::Watch;
use meshsweep_host_tests::generate::{Rng, rough_sphere};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::{Points, points, segments};
use meshsweep_lab::measure::rival::Rival;
use meshsweep_xtask::workspace;

/// Questions of each kind.
const COUNT: usize = 200;
/// A step of the path, of the diagonal.
const STEP: f32 = 3.0e-4;
/// How far off the surface the path is meant to stay, and by how much it may miss that, of the
/// diagonal.
const OFF: f32 = 0.0125;
const SLACK: f32 = 0.0025;

/// A mesh with its questions, written to a folder.
#[derive(Clone, Debug)]
pub struct Course {
    /// The reduced mesh.
    pub subject: Subject,
    /// Where the files are.
    pub folder: PathBuf,
    /// Sets of points by their names.
    pub points: [(&'static str, Vec<[f32; 3]>); 3],
    /// Segments by both ends.
    pub segments: Vec<[[f32; 3]; 2]>,
}

/// The mesh file, else a rough sphere of 20,480 triangles.
pub fn load(file: Option<&Path>) -> Result<Subject, String> {
    if let Some(file) = file {
        return Subject::load(file);
    }
    let (positions, triangles) = rough_sphere(5, 0.05, 1);
    Ok(Subject::of("rough-sphere", Mesh::new(positions, triangles)))
}

impl Course {
    /// Reduces a mesh to its outer hull of `faces` triangles, or to as few as it can have, and
    /// writes the files. Another `seed` is another path; the other questions stay.
    pub fn lay(mesh: &Subject, faces: usize, seed: u64) -> Result<Self, String> {
        let hull = hull_of(&mesh.mesh, faces, &BuildOptions::default(), Watch::NONE);
        let (reduced, _, _) = hull.map_err(|error| error.to_string())?;
        let subject = Subject::of(mesh.name.clone(), reduced);
        let folder = workspace::target().join("rival").join(format!("{}-{faces}", mesh.name));
        let path = path(&subject, seed)?;
        let course = Self {
            folder,
            points: [
                ("far", points(&subject, Points::Far, COUNT)),
                ("near", points(&subject, Points::Near, COUNT)),
                ("path", path),
            ],
            segments: segments(&subject, COUNT),
            subject,
        };
        course.write()?;
        Ok(course)
    }

    fn write(&self) -> Result<(), String> {
        let failed =
            |error: std::io::Error| format!("cannot write {}: {error}", self.folder.display());
        fs::create_dir_all(&self.folder).map_err(failed)?;
        let file =
            |name: &str, bytes: Vec<u8>| fs::write(self.folder.join(name), bytes).map_err(failed);
        let numbers = |records: &[[f32; 3]]| {
            records.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect()
        };
        let Mesh { positions, triangles, .. } = &self.subject.mesh;
        let (tables, _) =
            bvh::build(self.subject.mesh.as_input(), &TreeOptions::default(), Watch::NONE)
                .expect("builds");
        file("tree.msw", tables.to_bytes())?;
        file("vertices.f32", numbers(positions))?;
        file(
            "triangles.u32",
            triangles.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect(),
        )?;
        for (name, points) in &self.points {
            file(&format!("{name}.f32"), numbers(points))?;
        }
        file("segment.f32", numbers(self.segments.as_flattened()))?;
        let ply = fs::File::create(self.folder.join("mesh.ply")).map_err(failed)?;
        write_ply(&self.subject.mesh, &mut BufWriter::new(ply)).map_err(failed)
    }
}

/// Small steps along the surface, outside of it and off it by about [`OFF`], with a heading that
/// changes slowly: a tool or a gripper that feels its way.
fn path(subject: &Subject, seed: u64) -> Result<Vec<[f32; 3]>, String> {
    let surface = Rival::new(subject)?;
    let diagonal = subject.diagonal() as f32;
    let mut rng = Rng::new(seed);
    let mut here = start(subject, &surface, OFF * diagonal, &mut rng)
        .ok_or("no place outside of the mesh to start a path from")?;
    let mut heading = Vec3::from_array(rng.direction());
    let mut path = Vec::with_capacity(COUNT);
    while path.len() < COUNT {
        path.push(here.to_array());
        let from_surface = here - Vec3::from_array(surface.closest(here.to_array()));
        let distance = from_surface.length();
        let normal = from_surface / distance;
        heading += Vec3::from_array(rng.direction()) * 0.05;
        heading = (heading - normal * heading.dot(normal)).normalize();
        let back = ((OFF * diagonal - distance) / (SLACK * diagonal)).clamp(-1.0, 1.0);
        here += (heading + normal * back).normalize() * (STEP * diagonal);
    }
    Ok(path)
}

/// A point that is `off` away from the surface, on the way to a point near it, and that sees the
/// outside: the middle of some side of the box that the segments end on.
fn start(subject: &Subject, surface: &Rival, off: f32, rng: &mut Rng) -> Option<Vec3> {
    let candidates = points(subject, Points::Near, 1000);
    let outside = segments(subject, 20);
    (0..candidates.len()).find_map(|_| {
        let near = candidates[rng.below(candidates.len())];
        let foot = Vec3::from_array(surface.closest(near));
        let away = (Vec3::from_array(near) - foot).try_normalize()?;
        let place = foot + away * off;
        let distance = place.distance(Vec3::from_array(surface.closest(place.to_array())));
        let sees = |end: [f32; 3]| surface.first_hit([place.to_array(), end]).is_none();
        ((distance - off).abs() < 0.01 * off && outside.iter().any(|ends| sees(ends[0])))
            .then_some(place)
    })
}

#[cfg(test)]
mod tests {
    use super::{COUNT, OFF, SLACK, STEP, load, path};
    use glam::Vec3;
    use meshsweep_lab::measure::rival::Rival;

    #[test]
    fn the_path_keeps_its_step_and_its_distance() {
        let subject = load(None).expect("a sphere");
        let surface = Rival::new(&subject).expect("a mesh");
        let diagonal = subject.diagonal() as f32;
        for seed in 0..4 {
            let path = path(&subject, seed).expect("a path");
            assert_eq!(path.len(), COUNT);
            for pair in path.windows(2) {
                let [a, b] = [pair[0], pair[1]].map(Vec3::from_array);
                assert!((a.distance(b) / (STEP * diagonal) - 1.0).abs() < 0.01);
                let distance = b.distance(Vec3::from_array(surface.closest(pair[1])));
                assert!((distance / diagonal - OFF).abs() <= SLACK, "{}", distance / diagonal);
            }
        }
    }
}
