//! The page of `meshsweep trade --report`, opened in a browser.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::checks::cargo;
use crate::chromium::Chromium;
use crate::process;
use crate::steps::Steps;
use crate::workspace;

/// Runs in the page: see there.
const PROBE: &str = include_str!("report_probe.js");

/// Pixels of the screenshot: the whole page.
const WINDOW: [u32; 2] = [1280, 2900];

/// Opens the pages of some meshes, by default of a fixture.
pub fn run(steps: &mut Steps, meshes: &[&str]) {
    let Some(browser) = steps.run("browser", Chromium::find) else { return };
    let Some(program) = steps.run("program", program) else { return };
    let bracket = workspace::root().join("fixtures/bracket.stl");
    let meshes: Vec<PathBuf> = match meshes {
        [] => vec![bracket],
        _ => meshes.iter().map(PathBuf::from).collect(),
    };
    for (number, mesh) in meshes.iter().enumerate() {
        let name = mesh.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let Some(page) = steps.run(&format!("page of {name}"), || written(&program, mesh)) else {
            continue;
        };
        let passed = steps.run(&format!("{name} in the browser"), || {
            opened(&browser, &page).map(|seen| say!("   {seen}"))
        });
        if number == 0 && passed.is_some() {
            steps.run("a page that fails is noticed", || fails(&browser, &page));
        }
    }
}

fn program() -> Result<PathBuf, String> {
    let mut command = cargo(&["build", "--quiet", "--workspace", "--bin", "meshsweep"]);
    process::capture(&mut command)?;
    Ok(workspace::target().join("debug/meshsweep"))
}

/// The page of a mesh, measured at few points: the test is of the drawing.
fn written(program: &Path, mesh: &Path) -> Result<PathBuf, String> {
    let folder = workspace::target().join("report");
    fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
    let page = folder.join(mesh.file_stem().unwrap_or_default()).with_extension("html");
    let mut command = Command::new(program);
    command.arg("trade").arg(mesh).args(["--points", "200", "--report"]).arg(&page);
    process::capture(&mut command)?;
    Ok(page)
}

/// Opens a page and probes it; what the probe saw. The screenshot lies beside the page.
fn opened(browser: &Chromium, page: &Path) -> Result<String, String> {
    let mut open = browser.open(page, WINDOW)?;
    open.run("drawn.then(() => 'drawn')")?;
    let picture = page.with_extension("png");
    open.photograph(&picture)?;
    open.require_quiet()?;
    let seen = open.run(PROBE)?;
    open.require_quiet()?;
    Ok(format!("{seen}\n   {}", picture.display()))
}

/// A page with a fault of any kind must not pass: an error of a script, one that is only
/// printed, an empty picture, a slider without effect, an address of the network.
fn fails(browser: &Chromium, page: &Path) -> Result<(), String> {
    const DRAWN: &str = "await drawPath();";
    let console = "in the console";
    let all = "[...switches, \"colour\", \"axis\", \"cut\"]";
    let (scene, no_scene) = ("Plotly.react(\"scene\", traces,", "Plotly.react(\"scene\", [],");
    let asks = "await drawPath(); new Image().src = \"https://example.org/x.png\";";
    let faults = [
        ("throws", DRAWN, "await drawPath(); setTimeout(() => null.x);", console),
        ("prints", DRAWN, "await drawPath(); console.error(1);", console),
        ("empty", scene, no_scene, "scene has"),
        ("stuck", all, "switches", "cut changes 0"),
        ("asks", DRAWN, asks, console),
    ];
    let failed = |error: std::io::Error| format!("{}: {error}", page.display());
    let text = fs::read_to_string(page).map_err(failed)?;
    for (name, was, is, noticed) in faults {
        if !text.contains(was) {
            return Err(format!("{was} is not in the page"));
        }
        let copy = page.with_extension(format!("{name}.html"));
        fs::write(&copy, text.replacen(was, is, 1)).map_err(failed)?;
        match opened(browser, &copy) {
            Ok(_) => return Err(format!("a page that {name} passed")),
            Err(reason) if !reason.contains(noticed) => return Err(reason),
            Err(reason) => {
                say!("   {name}: {}", reason.chars().take(300).collect::<String>());
            }
        }
    }
    Ok(())
}
