//! The mesh files under `fixtures/`.

use std::fs;
use std::io;
use std::path::Path;

use super::curves::{csv, fence};
use super::evil::{Outcome, evil};
use super::writers::{binary_ply, binary_stl, obj};
use super::{bracket, groove_block, torus};

/// Every mesh fixture as (path in the folder, content), with the README. Deterministic.
#[must_use]
pub fn files() -> Vec<(String, Vec<u8>)> {
    let good = [
        (
            "bracket.stl",
            binary_stl(&bracket()),
            "`bracket()`: CAD-like, flat faces, needles; closed, genus 2",
        ),
        (
            "groove.obj",
            obj(&groove_block()),
            "`groove_block()`: a T-slot that a hull bridges; closed, genus 0",
        ),
        (
            "torus.ply",
            binary_ply(&torus(2.0, 0.75, 48, 24)),
            "`torus(2.0, 0.75, 48, 24)`: closed, genus 1",
        ),
        (
            "fence.csv",
            csv(&fence()).into_bytes(),
            "`fence()`: a boundary with round corners and a post in it",
        ),
    ];
    let mut readme = String::from(
        "# Fixtures\n\n\
         Small meshes and a curve from the generators in `host-tests/src/generate`. This command\n\
         writes all of them, and this page:\n\n\
         ```\ncargo xtask fixtures\n```\n\n\
         A test compares the committed files with the generators' bytes.\n\n\
         | file | made by |\n| --- | --- |\n",
    );
    for (name, _, what) in &good {
        readme.push_str(&format!("| `{name}` | {what} |\n"));
    }
    readme.push_str(
        "\n| file | holds |\n| --- | --- |\n\
         | `groove.msw` | the box tree of `groove.obj`, with all sections |\n\
         | `bracket.msw` | the hull hierarchy of `bracket.stl` |\n\
         | `torus.msw` | triboxes of `torus.ply` |\n\
         | `hulls.msw` | tight hulls of `bracket.stl` |\n\
         | `fence.msw` | the curves of `fence.csv`, by `meshsweep build fence.csv -o fence.msw --closed` |\n\
         | `field.msw` | the signed distance field of `groove.obj` in 8 KiB |\n\
         | `both.msw` | the box tree of `groove.obj` and its signed distance field in 4 KiB |\n\
         | `sieve.msw` | the hierarchy for sweeps of a torus with holes |\n\
         | `bend.msw` | the hull hierarchy of `torus(2.0, 0.75, 16, 8)` and a key frame, bent |\n\
         | `answers.txt` | a hash of the answers to each kind of query: other bits are noticed |\n\
         | `part.svg` | the picture of `README.md`, by `cargo xtask picture` |\n\
         \n## kept/\n\n\
         Blobs that every later version reads, with the same answers to the bit: every kind of section is\n\
         in one of them. No command makes them again. The first five hold box trees of an earlier packer.\n\n\
         | file | holds |\n| --- | --- |\n\
         | `bracket_tree.msw` | the box tree of `bracket.stl` |\n\
         | `groove.msw` | the box tree of `groove.obj`, with all sections |\n\
         | `single_tree.msw` | the box tree of `torus(2.0, 0.75, 16, 10)`, vertices as f32 |\n\
         | `soup_tree.msw` | the box tree of a torus with holes, beside needles and triangles without area, with normal cones |\n\
         | `torus_tree.msw` | the box tree of `torus(2.0, 0.75, 20, 12)` |\n\
         | `sides.msw` | the box tree of two boxes that overlap and of one inside out: triangles turned, and without a side |\n\
         | `bend.msw` | the hull hierarchy of `torus(2.0, 0.75, 16, 8)` and a key frame, bent |\n\
         | `triboxes.msw` | triboxes of `torus.ply` |\n\
         | `hulls.msw` | tight hulls of `bracket.stl` |\n\
         | `zones.msw` | two circles, one of them the border of an exclusion zone |\n\
         | `field.msw` | the signed distance field of `groove.obj` in 8 KiB |\n\
         | `answers.txt` | a hash of the answers to each kind of query |\n\
         \n## evil/\n\n\
         Files that must be refused, by the named variant of `MeshError`, or mended. \"No solid\": `repair`\n\
         takes the file, and `require_closed_manifold` refuses it.\n\n\
         | file | flaw | outcome |\n| --- | --- | --- |\n",
    );
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for file in evil() {
        let outcome = match file.outcome {
            Outcome::Accepted => "accepted".to_owned(),
            Outcome::Unreadable(variant) => format!("`{variant}`"),
            Outcome::NoSolid(variant) => format!("no solid: `{variant}`"),
        };
        readme.push_str(&format!("| `{}` | {} | {outcome} |\n", file.name, file.flaw));
        files.push((format!("evil/{}", file.name), file.bytes));
    }
    readme.push_str(
        "\n## reported/\n\n\
         Meshes on which an answer was wrong. No generator makes them.\n\n\
         | file | holds |\n| --- | --- |\n\
         | `height_field.obj` | 128 triangles over a grid: segments through several corners |\n",
    );
    files.extend(good.into_iter().map(|(name, bytes, _)| (name.to_owned(), bytes)));
    files.push(("README.md".to_owned(), readme.into_bytes()));
    files
}

/// Writes [`files`] into `dir`, which is created if need be. Other files there stay.
///
/// # Errors
/// A folder or file cannot be written.
pub fn write_fixtures(dir: &Path) -> io::Result<()> {
    fs::create_dir_all(dir.join("evil"))?;
    for (name, bytes) in files() {
        fs::write(dir.join(name), bytes)?;
    }
    Ok(())
}
