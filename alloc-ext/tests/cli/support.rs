//! Runs the program, and knows the truth by brute force in f64.

use meshsweep::mesh;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

pub type Point = [f64; 3];
pub type Triangle = [Point; 3];

/// The program, as if by its own name: its usage says how it was called.
pub fn meshsweep() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_meshsweep-tested"));
    #[cfg(unix)]
    std::os::unix::process::CommandExt::arg0(&mut command, "meshsweep");
    command
}

/// Runs the program on arguments.
pub fn run<S: AsRef<std::ffi::OsStr>>(args: impl IntoIterator<Item = S>) -> Output {
    meshsweep().args(args).output().expect("the program starts")
}

/// Runs it and demands success; the standard output.
pub fn ok<S: AsRef<std::ffi::OsStr>>(args: impl IntoIterator<Item = S>) -> String {
    let output = run(args);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("the output is UTF-8")
}

/// Demands the exit status and an error of one line that names `file`; the line.
pub fn refused(output: &Output, status: i32, file: &str) -> String {
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{stderr}");
    assert_eq!(stderr.lines().count(), 1, "one line: {stderr}");
    assert!(stderr.starts_with("error: ") && stderr.contains(file), "{stderr} should name {file}");
    stderr
}

pub fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures").join(name)
}

/// A torus as in `fixtures/torus.ply`, of 576 triangles: searches for few faces end at once.
pub fn coarse_torus(directory: &Path) -> PathBuf {
    let [around, across] = [24, 12];
    let turn = |step: usize, of: usize| std::f64::consts::TAU * step as f64 / of as f64;
    let mut text = String::new();
    for (i, j) in (0..around * across).map(|v| (v / across, v % across)) {
        let (a, b) = (turn(i, around), turn(j, across));
        let out = 2.0 + 0.75 * b.cos();
        let [x, y, z] = [out * a.cos(), out * a.sin(), 0.75 * b.sin()].map(|x| x as f32);
        text += &format!("v {x} {y} {z}\n");
    }
    for (i, j) in (0..around * across).map(|v| (v / across, v % across)) {
        let vertex = |i: usize, j: usize| i % around * across + j % across + 1;
        let corners = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        text += &format!("f {}\n", corners.map(|v| v.to_string()).join(" "));
    }
    let path = directory.join("coarse.obj");
    fs::write(&path, text).expect("the file can be written");
    path
}

/// An empty directory of a test's own.
pub fn scratch(name: &str) -> PathBuf {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli").join(name);
    let _ = fs::remove_dir_all(&directory);
    fs::create_dir_all(&directory).expect("the directory can be made");
    directory
}

/// A path as an argument.
pub fn arg(path: &Path) -> &str {
    path.to_str().expect("paths of the tests are UTF-8")
}

/// A blob of a fixture, in `directory`. The program builds it for the first test that asks. It
/// would build the same bytes again.
pub fn blob(directory: &Path, name: &str, options: &[&str]) -> PathBuf {
    type Built = HashMap<String, Arc<OnceLock<Vec<u8>>>>;
    static BUILT: LazyLock<Mutex<Built>> = LazyLock::new(Mutex::default);
    let asked = format!("{name} {options:?}");
    let built = Arc::clone(BUILT.lock().expect("no panic").entry(asked).or_default());
    let mut fresh = None;
    let bytes = built.get_or_init(|| {
        fs::read(fresh.insert(fresh_blob(directory, name, options))).expect("it was written")
    });
    fresh.unwrap_or_else(|| {
        let path = blob_path(directory, name);
        fs::write(&path, bytes).expect("the file can be written");
        path
    })
}

fn blob_path(directory: &Path, name: &str) -> PathBuf {
    let file = Path::new(name).file_name().expect("it has a name");
    directory.join(file).with_extension("msw")
}

/// A blob of a fixture, built now.
pub fn fresh_blob(directory: &Path, name: &str, options: &[&str]) -> PathBuf {
    let mesh = fixture(name);
    let path = blob_path(directory, name);
    ok([&["build", arg(&mesh), "-o", arg(&path)], options].concat());
    path
}

/// The same with the hull hierarchy alone.
pub fn hull_blob(directory: &Path, name: &str, options: &[&str]) -> PathBuf {
    blob(directory, name, &[&["--for", "hull"], options].concat())
}

/// What `info --json` says of a blob.
pub fn info(path: &Path) -> serde_json::Value {
    serde_json::from_str(&ok(["info", arg(path), "--json"])).expect("it is JSON")
}

/// Triangles of a mesh file as it is, coordinates in f64.
pub fn triangles(path: &Path) -> Vec<Triangle> {
    let raw = mesh::read(path).expect("the mesh is readable");
    raw.triangles.iter().map(|t| t.map(|v| raw.positions[v as usize])).collect()
}

/// `count` queries of `N` numbers, uniform in the box of `triangles` blown up by a half.
pub fn random_queries<const N: usize>(triangles: &[Triangle], count: usize) -> Vec<[f32; N]> {
    let corners = || triangles.iter().flatten();
    let low: [f64; 3] =
        core::array::from_fn(|k| corners().map(|p| p[k]).fold(f64::INFINITY, f64::min));
    let high: [f64; 3] =
        core::array::from_fn(|k| corners().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max));
    let mut state = 0x9E37_79B9_7F4A_7C15u64;
    let mut uniform = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let coordinate = |i: usize, u: f64| {
        let k = i % 3;
        ((low[k] + high[k]) / 2.0 + (u - 0.5) * 1.5 * (high[k] - low[k])) as f32
    };
    (0..count).map(|_| core::array::from_fn(|i| coordinate(i, uniform()))).collect()
}

/// Queries as text, with a header.
pub fn write_csv<const N: usize>(path: &Path, rows: &[[f32; N]]) {
    let mut text = String::from("some,header\n");
    for row in rows {
        let fields: Vec<String> = row.iter().map(f32::to_string).collect();
        text += &(fields.join(",") + "\n");
    }
    fs::write(path, text).expect("the file can be written");
}

/// Queries as raw f32.
pub fn write_raw<const N: usize>(path: &Path, rows: &[[f32; N]]) {
    let bytes: Vec<u8> = rows.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    fs::write(path, bytes).expect("the file can be written");
}

/// Rows of a CSV without its header, which must be `header`. Every row has all fields.
pub fn parse_csv(text: &str, header: &str) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let found = reader.headers().expect("there is a header");
    assert_eq!(found, header.split(',').collect::<Vec<_>>());
    let row = |row: csv::StringRecord| row.iter().map(str::to_owned).collect();
    reader.records().map(|found| row(found.expect("every row has all fields"))).collect()
}

pub fn number(field: &str) -> f64 {
    // Through f32, which is what was printed.
    f64::from(field.parse::<f32>().expect("a number"))
}

/// Volume that a closed surface bounds.
pub fn volume(triangles: &[Triangle]) -> f64 {
    triangles.iter().map(|&[a, b, c]| dot(a, cross(b, c)) / 6.0).sum()
}

// Written out, as what follows: tests are not optimised, and these took a third of their time.
pub fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Distance of a point and a segment.
fn to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (ab, ap) = (sub(b, a), sub(p, a));
    let t = (dot(ap, ab) / dot(ab, ab)).clamp(0.0, 1.0);
    let d = sub(ap, [t * ab[0], t * ab[1], t * ab[2]]);
    dot(d, d).sqrt()
}

/// Distance of a point and a triangle: that to its plane where the foot lies inside, else that to
/// the nearest side.
pub fn to_triangle(p: Point, [a, b, c]: Triangle) -> f64 {
    let n = cross(sub(b, a), sub(c, a));
    let is_within = |u: Point, v: Point| dot(cross(n, sub(v, u)), sub(p, u)) >= 0.0;
    let inside = is_within(a, b) && is_within(b, c) && is_within(c, a);
    let sides = to_segment(p, a, b).min(to_segment(p, b, c)).min(to_segment(p, c, a));
    let length = dot(n, n).sqrt();
    if inside && length > 0.0 { (dot(n, sub(p, a)) / length).abs() } else { sides }
}

/// Distance of a point and a mesh.
pub fn distance(p: Point, triangles: &[Triangle]) -> f64 {
    let mut least = f64::INFINITY;
    for &t in triangles {
        least = least.min(to_triangle(p, t));
    }
    least
}

/// Least parameter at which a segment in general position crosses a mesh.
pub fn first_crossing(a: Point, b: Point, triangles: &[Triangle]) -> Option<f64> {
    let crossing = |&[p, q, r]: &Triangle| {
        let d = sub(b, a);
        let volume = |u: Point, v: Point| dot(d, cross(sub(u, a), sub(v, a)));
        let [x, y, z] = [volume(p, q), volume(q, r), volume(r, p)];
        let n = cross(sub(q, p), sub(r, p));
        let t = dot(n, sub(p, a)) / dot(n, d);
        let through = x >= 0.0 && y >= 0.0 && z >= 0.0 || x <= 0.0 && y <= 0.0 && z <= 0.0;
        (through && (0.0..=1.0).contains(&t)).then_some(t)
    };
    triangles.iter().filter_map(crossing).min_by(f64::total_cmp)
}

/// How much a segment runs along a triangle's normal: negative where it meets the front.
pub fn ascent(a: Point, b: Point, [p, q, r]: Triangle) -> f64 {
    dot(sub(b, a), cross(sub(q, p), sub(r, p)))
}

/// Three f32 as f64.
pub fn wide(p: &[f32]) -> Point {
    [f64::from(p[0]), f64::from(p[1]), f64::from(p[2])]
}
