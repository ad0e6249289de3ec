//! The C interface, tested by C programs: the bits of Rust on this machine and on a Cortex-M4F, no
//! symbol too many, no warning.

use std::path::PathBuf;
use std::process::Command;

use crate::boards::BOARDS;
use crate::c_library::{self, CTools};
use crate::checks::cargo;
use crate::examples::{self, EXAMPLES, Example};
use crate::process;
use crate::steps::Steps;
use crate::tools::Tools;
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

/// All of it.
pub fn run(steps: &mut Steps, tools: &Tools) {
    let Some(c) = steps.run("setup: arm-none-eabi-gcc, cppcheck", CTools::find) else { return };
    let programs = || programs(&host::run(&["c-answers"])?);
    let Some(programs) = steps.run("C: Rust's answers", programs) else { return };
    steps.run("C: programs on this machine have Rust's bits", || on_host(&programs));
    steps.run("C: images on the Cortex-M4F have Rust's bits", || on_board(tools, &c, &programs));
    steps.run("C: cppcheck", || cppcheck(&c));
}

fn folder() -> PathBuf {
    c_library::folder().join("examples")
}

/// Blobs.
fn fixtures() -> PathBuf {
    workspace::root().join("core/fixtures")
}

fn answers() -> PathBuf {
    workspace::root().join("host-tests/c-answers")
}

/// A compiler with the flags that all programs share.
fn compiler(mut command: Command) -> Command {
    command.args(WARNINGS).arg("-I").arg(c_library::folder().join("include"));
    command.arg("-I").arg(folder()).arg(format!("-Wa,-I{}", fixtures().display()));
    command
}

/// The programs on this machine. The library has the settings of the tests, so that it takes
/// seconds; `cargo xtask dist` does the same with the one that it packs.
fn on_host(programs: &[Program]) -> Result<(), String> {
    process::capture(&mut cargo(&["build", "--quiet", "--workspace", "--lib"]))?;
    let library = workspace::target().join("debug/libmeshsweep_c_host.a");
    build_and_run(&library, programs)
}

/// Builds and runs the programs with a library of this machine.
///
/// # Errors
/// Another line than Rust's, or the compiler's.
pub fn programs_on_host(library: &std::path::Path, expected: &str) -> Result<(), String> {
    build_and_run(library, &programs(expected)?)
}

fn build_and_run(library: &std::path::Path, programs: &[Program]) -> Result<(), String> {
    let made = workspace::target().join("c");
    std::fs::create_dir_all(&made).map_err(|error| format!("{}: {error}", made.display()))?;
    for Program { sources, lines, .. } in programs {
        let program = made.join("host-program");
        let mut cc = compiler(Command::new("cc"));
        cc.args(["-O2"]).arg(folder().join("host.c")).args(sources).arg(library);
        process::capture(cc.args(["-lpthread", "-ldl", "-lm", "-o"]).arg(&program))?;
        compare(&process::capture(&mut Command::new(&program))?, lines)?;
    }
    Ok(())
}

fn on_board(tools: &Tools, c: &CTools, programs: &[Program]) -> Result<(), String> {
    let (board, (_, profile)) = (&BOARDS[0], c_library::IMAGES);
    let library = c_library::build(&tools.cross, c, board.target, profile)?;
    let start = folder().join("cortex-m4");
    let script = |program: &Program| {
        let file = start.join("image.ld");
        if program.is_example {
            return Ok(file);
        }
        // All questions are more than an example's part has room for. The emulated one has 4 MB.
        let named = |error: std::io::Error| format!("{}: {error}", file.display());
        let text = std::fs::read_to_string(&file).map_err(named)?;
        let large = library.with_file_name("large.ld");
        std::fs::write(&large, text.replace("512K", "4M")).map_err(named)?;
        Ok::<PathBuf, String>(large)
    };
    for program in programs {
        let Program { sources, lines, .. } = program;
        let image = library.with_file_name("image.elf");
        let mut gcc = compiler(c.command("arm-none-eabi-gcc"));
        gcc.args(CORTEX_M4F).arg("-T").arg(script(program)?).arg(start.join("startup.c"));
        process::capture(gcc.args(sources).arg(&library).args(["-lgcc", "-o"]).arg(&image))?;
        compare(&tools.qemu.run(board.machine, &image, None)?, lines)?;
    }
    Ok(())
}

/// A program's own sources, and the lines that it prints.
struct Program {
    sources: Vec<PathBuf>,
    lines: String,
    is_example: bool,
}

/// The examples, and the program with all questions.
fn programs(answers_of_rust: &str) -> Result<Vec<Program>, String> {
    let mut programs = Vec::new();
    for Example { name, models } in EXAMPLES {
        let stems = [name].into_iter().chain(models.iter().copied());
        let sources = stems.map(|stem| folder().join(format!("{stem}.c"))).collect();
        programs.push(Program { sources, lines: examples::promised(name)?, is_example: true });
    }
    let sources = ["answers.c", "blobs.S"].map(|file| answers().join(file)).to_vec();
    programs.push(Program { sources, lines: answers_of_rust.to_owned(), is_example: false });
    Ok(programs)
}

fn compare(printed: &str, expected: &str) -> Result<(), String> {
    let printed = examples::without_costs(printed);
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
    command.arg("-I").arg(folder()).arg("--suppress=missingIncludeSystem");
    for Example { name, .. } in EXAMPLES {
        command.arg(folder().join(name).with_extension("c"));
    }
    for file in ["host.c", "cortex-m4/startup.c"] {
        command.arg(folder().join(file));
    }
    process::capture(command.arg(answers().join("answers.c"))).map(drop)
}
