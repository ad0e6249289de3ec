//! `cargo xtask web`: the page of WebAssembly. Its one file, opened in a browser.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::checks::cargo;
use crate::chromium::Chromium;
use crate::cross::add_std;
use crate::process;
use crate::steps::Steps;
use crate::workspace;

/// Builds that need no operating system, and no glue of generated code.
const TARGET: &str = "wasm32-unknown-unknown";

/// Runs in the page: see there.
const PROBE: &str = include_str!("web_probe.js");

/// The build that the host makes too.
const OPTIONS: [&str; 4] = ["--for", "closest,segment,tight", "--tight", "200"];

/// What the page and the host refuse.
const BROKEN: (&str, &str) = ("broken.stl", "solid broken\n facet normal 0 0 1\n");

/// Points that both are asked at: far, near, inside, on the surface, an axis apart.
const POINTS: [[f32; 3]; 7] = [
    [10.0, 4.5, 7.0],
    [-1.0, 2.0, 3.0],
    [200.0, -300.5, 41.25],
    [20.0, 10.0, 90.0],
    [0.0, 0.0, 0.0],
    [12.125, 9.75, 3.0625],
    [1e-3, 40.0, -2.5],
];

/// Sizes of the window, whether it is dark, and the name of its picture.
const WINDOWS: [([u32; 2], bool, &str); 3] =
    [([1400, 900], false, "light"), ([1400, 900], true, "dark"), ([500, 1000], false, "narrow")];

/// Lints, builds and tests the page.
pub fn run(steps: &mut Steps) {
    if steps.run("setup: std for WebAssembly", || add_std(TARGET)).is_none() {
        return;
    }
    lints(steps);
    let Some(page) = steps.run("page", page) else { return };
    let Some(host) = steps.run("the host's answers", Host::ask) else { return };
    let Some(browser) = steps.run("browser", Chromium::find) else { return };
    let passed = steps.run("page in the browser", || {
        opened(&browser, &page, &host, true).map(|seen| say!("   {seen}"))
    });
    if passed.is_some() {
        steps.run("a page that fails is noticed", || fails(&browser, &page, &host));
    }
}

fn folder() -> PathBuf {
    workspace::root().join("alloc-ext/web")
}

fn dist() -> PathBuf {
    workspace::target().join("dist/web")
}

fn lints(steps: &mut Steps) {
    steps.run("formatting of the page's Rust", || process::run(&mut in_crate(&["fmt", "--check"])));
    let lint = ["clippy", "--quiet", "--locked", "--release", "--target", TARGET];
    steps.run("lints of the page's Rust", || {
        process::run(in_crate(&lint).args(["--", "-D", "warnings"]))
    });
}

/// cargo in the crate's own workspace.
fn in_crate(words: &[&str]) -> Command {
    let mut command = cargo(words);
    command.current_dir(folder()).env("CARGO_TARGET_DIR", workspace::target().join("web"));
    command
}

/// Compiles the library, and writes the page with all that it needs.
fn page() -> Result<PathBuf, String> {
    process::run(&mut in_crate(&[
        "build",
        "--quiet",
        "--locked",
        "--release",
        "--target",
        TARGET,
    ]))?;
    let library = workspace::target().join("web").join(TARGET).join("release/meshsweep_web.wasm");
    let packed = dist().join("packed");
    let failed = |error: std::io::Error| format!("{}: {error}", packed.display());
    fs::create_dir_all(dist()).map_err(failed)?;
    let gzip = process::output(Command::new("gzip").args(["-9", "-n", "-c"]).arg(&library))?;
    fs::write(&packed, gzip.stdout).map_err(failed)?;
    let wasm = base64(&packed)?;
    fs::remove_file(&packed).map_err(failed)?;
    let source = |name: &str| read(&folder().join("page").join(name));
    let mut text = source("index.html")?;
    for (mark, with) in [
        ("@SAMPLE@", read(&workspace::root().join("fixtures/groove.obj"))?),
        ("@INSTANCE@", source("instance.js")?),
        ("@WORKER@", source("worker.js")?),
        ("@TASKS@", source("tasks.js")?),
        ("@VIEW@", source("view.js")?),
        ("@PAGE@", source("page.js")?),
        // The last, because it is long.
        ("@WASM@", wasm),
    ] {
        if text.matches(mark).count() != 1 {
            return Err(format!("{mark} is not once in the page"));
        }
        text = text.replacen(mark, &with, 1);
    }
    let page = dist().join("index.html");
    fs::write(&page, &text).map_err(failed)?;
    say!("   {}: {} bytes", page.display(), text.len());
    Ok(page)
}

fn read(file: &Path) -> Result<String, String> {
    fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))
}

fn base64(file: &Path) -> Result<String, String> {
    process::capture(Command::new("base64").arg("-w0").arg(file))
}

/// What the program makes of the same files, in base64, and answers to the same points.
struct Host {
    mesh: String,
    blob: String,
    sources: [String; 3],
    /// Lower and upper distance and the closest point, as the page writes them.
    answers: String,
    refusal: String,
    /// The table of the sample's trade.
    trade: String,
}

impl Host {
    fn ask() -> Result<Self, String> {
        let mut build = cargo(&["build", "--quiet", "--workspace", "--bin", "meshsweep"]);
        process::capture(&mut build)?;
        let folder = workspace::target().join("web-host");
        fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
        let run = |words: &[&str]| {
            let program = workspace::target().join("debug/meshsweep");
            let mut command = Command::new(program);
            command.args(words).current_dir(&folder);
            command
        };
        let fixtures = workspace::root().join("fixtures");
        let put = |from: &str, to: &str| {
            fs::copy(fixtures.join(from), folder.join(to)).map_err(|error| error.to_string())
        };
        put("bracket.stl", "part.stl")?;
        put("groove.obj", "part.obj")?;
        let words = ["build", "part.stl", "-o", "part.msw", "--emit", "rust,c"];
        process::capture(&mut run(&[&words[..], &OPTIONS].concat()))?;
        let points = POINTS.map(|point| point.map(|x| x.to_string()).join(","));
        let points: Vec<&str> = points.iter().map(String::as_str).collect();
        let csv = process::capture(&mut run(&[&["closest", "part.msw"], &points[..]].concat()))?;
        fs::write(folder.join(BROKEN.0), BROKEN.1).map_err(|error| error.to_string())?;
        let refused = run(&["build", BROKEN.0, "-o", "broken.msw"]).output();
        let refused = refused.map_err(|error| error.to_string())?.stderr;
        let mut trade = run(&["trade", "part.obj", "--points", "20"]);
        let in_base64 = |name: &str| base64(&folder.join(name));
        Ok(Self {
            mesh: in_base64("part.stl")?,
            blob: in_base64("part.msw")?,
            sources: [in_base64("part.rs")?, in_base64("part.h")?, in_base64("part.c")?],
            answers: bits(&csv)?,
            refusal: String::from_utf8_lossy(&refused).trim().to_owned(),
            trade: process::capture(&mut trade)?,
        })
    }

    /// The probe with what it needs.
    fn probe(&self, is_whole: bool) -> String {
        let points = POINTS.map(|point| format!("[{}]", point.map(|x| x.to_string()).join(",")));
        let mut script = String::from("const given = {");
        let _ = write!(script, "mesh: '{}', points: [{}],", self.mesh, points.join(","));
        let _ = write!(script, "broken: ['{}', `{}`],", BROKEN.0, BROKEN.1);
        let _ = write!(script, "isWhole: {is_whole} }};\n{PROBE}");
        script
    }

    /// Compares what the page made with what the host made.
    fn compare(&self, made: &str) -> Result<String, String> {
        let parts: Vec<&str> = made.split('|').collect();
        let [seen, answers, blob, rust, header, source, refusal, trade] = parts[..] else {
            return Err(format!("the probe gave {} parts", parts.len()));
        };
        let [in_rust, in_header, in_source] = &self.sources;
        for (what, found, wanted) in [
            ("answers", answers, self.answers.as_str()),
            ("blob", blob, &self.blob),
            ("Rust source", rust, in_rust),
            ("C header", header, in_header),
            ("C source", source, in_source),
        ] {
            if found != wanted {
                let [found, wanted] = [found, wanted].map(|text| text.get(..200).unwrap_or(text));
                return Err(format!("{what} of the page: {found}\nof the host: {wanted}"));
            }
        }
        if refusal.is_empty() || !self.refusal.contains(refusal) {
            return Err(format!("the page says `{refusal}`, the program `{}`", self.refusal));
        }
        let is_there = |row: &&str| {
            let cells: Vec<&str> = row.split('/').collect();
            let [structure, dials, bytes] = cells[..] else { return false };
            self.trade.lines().map(str::trim).any(|line| {
                line.starts_with(structure)
                    && line.contains(&format!("  {dials}"))
                    && line.split(' ').any(|word| word == bytes)
            })
        };
        let mut rows = trade.split(';').filter(|row| !row.is_empty());
        if let Some(row) = rows.find(|row| !is_there(row)) {
            return Err(format!("a row of the page's trade is not the host's: {row}"));
        }
        Ok(format!("{seen}; {} points, blob, sources as the host's", POINTS.len()))
    }
}

/// The numbers of `meshsweep closest`, as the page writes them.
fn bits(csv: &str) -> Result<String, String> {
    let mut lines = csv.lines();
    let head: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let columns = ["lower", "upper", "px", "py", "pz"].map(|name| {
        let found = head.iter().position(|&column| column == name);
        found.ok_or_else(|| format!("no column {name} in {}", head.join(",")))
    });
    let mut rows = Vec::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let mut words = Vec::new();
        for column in columns.clone() {
            let number: f32 = fields[column?].parse().map_err(|_| line.to_owned())?;
            words.push(format!("{:08x}", number.to_bits()));
        }
        rows.push(words.join(" "));
    }
    Ok(rows.join(";"))
}

/// Opens the page and probes it; what was seen. Pictures lie beside the page.
fn opened(browser: &Chromium, page: &Path, host: &Host, is_whole: bool) -> Result<String, String> {
    let mut open = browser.open(page, WINDOWS[0].0)?;
    let made = open.run(&format!("(async () => {{\n{}\n}})()", host.probe(is_whole)))?;
    open.require_quiet()?;
    let mut seen = host.compare(&made)?;
    for (size, is_dark, name) in WINDOWS.into_iter().filter(|_| is_whole) {
        open.show_as(size, is_dark)?;
        // After the page has drawn itself anew.
        open.run("new Promise((done) => setTimeout(() => done('drawn'), 500))")?;
        let picture = dist().join(format!("{name}.png"));
        open.photograph(&picture)?;
        let _ = write!(seen, "\n   {}", picture.display());
    }
    open.require_quiet()?;
    Ok(seen)
}

/// A page with a fault of any kind must not pass.
fn fails(browser: &Chromium, page: &Path, host: &Host) -> Result<(), String> {
    let console = "in the console";
    let faults = [
        ("throws", "listen();", "listen(); setTimeout(() => null.x);", console),
        ("prints", "listen();", "listen(); console.error(1);", console),
        ("asks", "listen();", "listen(); new Image().src = 'https://example.org/x.png';", console),
        ("empty", "gl.drawElements(", "void (", "colours"),
        ("strays", "of, ...place,", "of, place[0] + 1e-6, place[1], place[2],", "answers"),
        ("alters", "blob = instance.part(Part.blob)", "blob = instance.part(Part.text)", ""),
        ("hushes", "textContent = message ?? \"\"", "textContent = \"\"", "the page says"),
    ];
    let text = read(page)?;
    for (name, was, is, noticed) in faults {
        if !text.contains(was) {
            return Err(format!("{was} is not in the page"));
        }
        let copy = page.with_file_name(format!("{name}.html"));
        let failed = |error: std::io::Error| format!("{}: {error}", copy.display());
        fs::write(&copy, text.replacen(was, is, 1)).map_err(failed)?;
        let result = opened(browser, &copy, host, false);
        fs::remove_file(&copy).map_err(failed)?;
        match result {
            Ok(_) => return Err(format!("a page that {name} passed")),
            Err(reason) if !reason.contains(noticed) => return Err(format!("{name}: {reason}")),
            Err(reason) => say!("   {name}: {}", reason.chars().take(200).collect::<String>()),
        }
    }
    Ok(())
}
