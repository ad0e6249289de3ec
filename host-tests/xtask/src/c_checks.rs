//! The C interface, tested by C programs: the bits of Rust on this machine and on a Cortex-M4F, no
//! symbol too many, no warning.

use std::path::PathBuf;
use std::process::Command;

use crate::boards::BOARDS;
use crate::c_library::{self, CTools};
use crate::checks::cargo;
use crate::firmware::Tools;
use crate::images::Profile;
use crate::process;
use crate::steps::Steps;
use crate::{host, workspace};

const WARNINGS: [&str; 5] = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-pedantic"];

/// Flags of the board's compiler; README.md of the C interface names the same.
const CORTEX_M4F: [&str; 9] = [
    "-mcpu=cortex-m4",
    "-mthumb",
    "-mfloat-abi=hard",
    "-mfpu=fpv4-sp-d16",
    "-O2",
    "-ffreestanding",
    "-nostdlib",
    "-ffunction-sections",
    "-Wl,--gc-sections",
];

/// The line that the example prints.
const PROBE: &str = "the probe stopped 2 above the part\n";

/// All of it.
pub fn run(steps: &mut Steps, tools: &Tools) {
    let Some(c) = steps.run("setup: arm-none-eabi-gcc, cppcheck", CTools::find) else { return };
    let Some(expected) = steps.run("C: Rust's answers", || host::run(&["c-answers"])) else {
        return;
    };
    steps.run("C: a program on this machine has Rust's bits", || on_host(&expected));
    steps.run("C: an image on the Cortex-M4F has Rust's bits", || on_board(tools, &c, &expected));
    steps.run("C: cppcheck", || cppcheck(&c));
}

fn examples() -> PathBuf {
    c_library::folder().join("examples")
}

/// Blobs, and the part of the example as C.
pub fn fixtures() -> PathBuf {
    workspace::root().join("core/fixtures")
}

fn answers() -> PathBuf {
    workspace::root().join("host-tests/c-answers")
}

/// A compiler with the flags that both programs share.
fn compiler(mut command: Command) -> Command {
    command.args(WARNINGS).arg("-I").arg(c_library::folder().join("include"));
    command.arg("-I").arg(fixtures()).arg(format!("-Wa,-I{}", fixtures().display()));
    command
}

/// Both programs on this machine. The library has the settings of the tests, so that it takes
/// seconds; `cargo xtask dist` does the same with the one that it packs.
fn on_host(expected: &str) -> Result<(), String> {
    process::capture(&mut cargo(&["build", "--quiet", "--workspace", "--lib"]))?;
    let library = workspace::target().join("debug/libmeshsweep_c_host.a");
    programs_on_host(&library, expected)
}

/// Builds and runs both programs with a library of this machine.
///
/// # Errors
/// Another line than Rust's, or the compiler's.
pub fn programs_on_host(library: &std::path::Path, expected: &str) -> Result<(), String> {
    let folder = workspace::target().join("c");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for (sources, wanted) in programs(expected) {
        let program = folder.join("host-program");
        let mut cc = compiler(Command::new("cc"));
        cc.args(["-O2"]).arg(examples().join("host.c")).args(sources).arg(library);
        process::capture(cc.args(["-lpthread", "-ldl", "-lm", "-o"]).arg(&program))?;
        compare(&process::capture(&mut Command::new(&program))?, wanted)?;
    }
    Ok(())
}

fn on_board(tools: &Tools, c: &CTools, expected: &str) -> Result<(), String> {
    let board = &BOARDS[0];
    let library = c_library::build(&tools.cross, c, board.target, Profile::Release)?;
    let start = examples().join("cortex-m4");
    for (sources, wanted) in programs(expected) {
        let image = library.with_file_name("image.elf");
        let mut gcc = compiler(c.command("arm-none-eabi-gcc"));
        gcc.args(CORTEX_M4F).arg("-T").arg(start.join("image.ld")).arg(start.join("startup.c"));
        process::capture(gcc.args(sources).arg(&library).args(["-lgcc", "-o"]).arg(&image))?;
        compare(&tools.qemu.run(board.machine, &image, None)?, wanted)?;
    }
    Ok(())
}

/// The sources of the example and of the program with all questions, and what they print.
fn programs(expected: &str) -> [([PathBuf; 2], &str); 2] {
    [
        ([examples().join("probe.c"), fixtures().join("groove.c")], PROBE),
        (["answers.c", "blobs.S"].map(|file| answers().join(file)), expected),
    ]
}

fn compare(printed: &str, expected: &str) -> Result<(), String> {
    if printed == expected {
        return Ok(());
    }
    Err(format!("C prints\n{printed}and Rust\n{expected}"))
}

fn cppcheck(c: &CTools) -> Result<(), String> {
    let mut command = c.cppcheck();
    command.args(["--quiet", "--std=c11", "--error-exitcode=1"]);
    command.args(["--enable=warning,style,performance,portability", "--inline-suppr"]);
    command.arg("-I").arg(c_library::folder().join("include"));
    command.arg("-I").arg(fixtures()).arg("--suppress=missingIncludeSystem");
    for file in ["probe.c", "host.c", "cortex-m4/startup.c"] {
        command.arg(examples().join(file));
    }
    process::capture(command.arg(answers().join("answers.c"))).map(drop)
}
