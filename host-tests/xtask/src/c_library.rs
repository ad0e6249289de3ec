//! The static library for C: one object that defines the functions of `meshsweep.h` and nothing
//! else.
//!
//! rustc's archive also defines what Rust's `core` and its compiler builtins define, which would
//! collide with the user's own. So the linker makes one relocatable object of all that the
//! functions reach, and all other names become local to it. Each function keeps its section: the
//! user's linker drops what his program does not call.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::boards::BOARDS;
use crate::cross::Cross;
use crate::images::{self, Profile};
use crate::process;
use crate::toolbox::{Toolbox, Wanted};
use crate::workspace;

const WANTED: Wanted = Wanted {
    name: "c",
    alternatives: &[&["gcc-arm-none-eabi", "binutils-riscv64-unknown-elf", "cppcheck"]],
    ignore_installed: &["gcc-arm-none-eabi", "binutils-arm-", "binutils-riscv64", "cppcheck"],
};

/// The board and the optimisation of the C images.
pub const IMAGES: (&str, Profile) = (BOARDS[0].cpu, Profile::Release);

/// This machine, as a target.
pub const HOST: &str = "x86_64-unknown-linux-gnu";

/// What the panic handler of `c-library` calls and nobody defines.
const PANIC: &str = "meshsweep_core_panics_here";

/// Functions of the C library that compilers call; a workstation has them.
const OF_THE_HOST: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "bcmp"];

/// Compilers of C, linkers, and cppcheck.
#[derive(Clone, Debug)]
pub struct CTools {
    toolbox: Toolbox,
}

impl CTools {
    /// Fetches them where they are not.
    pub fn find() -> Result<Self, String> {
        let toolbox = Toolbox::open(&WANTED)?;
        let tools = Self { toolbox };
        for program in ["arm-none-eabi-gcc", "cppcheck"] {
            let version = process::capture(tools.command(program).arg("--version"))?;
            say!("   {}", version.lines().next().unwrap_or_default());
        }
        Ok(tools)
    }

    /// A program of the toolbox.
    pub fn command(&self, program: &str) -> Command {
        self.toolbox.command(program)
    }

    /// cppcheck, which looks for its own files beside the place where Debian installs it, and where
    /// it is started.
    pub fn cppcheck(&self) -> Command {
        let mut command = self.command("cppcheck");
        let folders = self.toolbox.libraries();
        let mut folders = folders.into_iter().map(|folder| folder.join("cppcheck/cfg"));
        if let Some(folder) = folders.find(|folder| folder.is_dir()) {
            command.current_dir(folder);
        }
        command
    }

    /// One of `ld`, `objcopy`, `nm`, `ar` and `size` for a target.
    fn binutil(&self, target: &str, name: &str) -> Command {
        if target.starts_with("thumb") {
            self.command(&format!("arm-none-eabi-{name}"))
        } else if target.starts_with("riscv32") {
            self.command(&format!("riscv64-unknown-elf-{name}"))
        } else {
            Command::new(name)
        }
    }

    fn linker(&self, target: &str) -> Command {
        let mut command = self.binutil(target, "ld");
        if target.starts_with("riscv32") {
            command.args(["-m", "elf32lriscv"]);
        }
        command
    }
}

/// The folder of the C interface.
#[must_use]
pub fn folder() -> PathBuf {
    workspace::root().join("core/c-api")
}

/// The functions that `meshsweep.h` declares.
pub fn functions() -> Result<Vec<String>, String> {
    let file = folder().join("include/meshsweep.h");
    let text = std::fs::read_to_string(&file)
        .map_err(|error| format!("cannot read {}: {error}", file.display()))?;
    let results = ["int32_t ", "uint32_t ", "const char *"];
    let declared = text.lines().filter_map(|line| {
        let rest = results.iter().find_map(|result| line.strip_prefix(result))?;
        rest.split_once('(').map(|(name, _)| name.to_owned())
    });
    let mut names: Vec<String> = declared.collect();
    names.sort();
    if names.len() < 10 { Err(format!("{names:?} are too few functions")) } else { Ok(names) }
}

/// rustc's archive of a target.
fn archive(cross: &Cross, target: &str, profile: Profile) -> Result<PathBuf, String> {
    let mut cargo = images::cargo(cross, "build", &[target], profile);
    process::capture(cargo.args(["--package", "meshsweep-c-library"]))?;
    Ok(images::image(cross, target, profile, "libmeshsweep_c_library.a"))
}

/// The folder for what is made of it.
fn folder_of(target: &str, profile: Profile) -> Result<PathBuf, String> {
    let folder = workspace::target().join("c").join(target).join(profile.name());
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(folder)
}

/// Links all functions of a board's library into an image from which their stacks are bounded. It
/// keeps the sizes of frames and the relocations. Returns its path.
///
/// # Errors
/// The compiler's or the linker's; a question that can panic.
pub fn linked_for_stack(cross: &Cross, target: &str, profile: Profile) -> Result<PathBuf, String> {
    let archive = archive(cross, target, profile)?;
    let image = folder_of(target, profile)?.join("bounded");
    // LLVM's linker: GNU's would keep every function that has a frame.
    let mut ld = cross.linker()?;
    ld.args(["--gc-sections", "--emit-relocs", "--entry=0", "--image-base=0x10000"]);
    for function in functions()? {
        ld.args(["-u", &function]);
    }
    process::capture(ld.arg(&archive).arg("-o").arg(&image))?;
    Ok(image)
}

/// Builds the library of a target: its path.
///
/// # Errors
/// The compiler's; a question that can panic; a symbol too many or too few.
pub fn build(
    cross: &Cross,
    tools: &CTools,
    target: &str,
    profile: Profile,
) -> Result<PathBuf, String> {
    let made = archive(cross, target, profile)?;
    let folder = folder_of(target, profile)?;
    let (object, library) = (folder.join("meshsweep.o"), folder.join("libmeshsweep.a"));

    // `can_panic` leaves the name there, or its absence from the object proves nothing.
    let before = process::capture(tools.binutil(target, "nm").arg("--undefined-only").arg(&made))?;
    if !before.contains(PANIC) {
        return Err(format!("{target}: a panic does not leave `{PANIC}` in rustc's library"));
    }

    let functions = functions()?;
    let mut ld = tools.linker(target);
    ld.args(["-r", "--gc-sections"]);
    for function in &functions {
        ld.args(["-u", function]);
    }
    process::capture(ld.arg(&made).arg("-o").arg(&object))?;
    let mut objcopy = tools.binutil(target, "objcopy");
    objcopy.args(["--wildcard", "--keep-global-symbol=msw_*"]);
    // Also drops names that only dropped functions use: the linker leaves these in the table.
    objcopy.arg("--strip-unneeded");
    if target != HOST {
        // The first would let GNU ld warn of the user's files, which have none. The second would
        // keep all functions, as it names them; nothing unwinds.
        for section in [".note.GNU-stack", ".eh_frame", ".llvmbc", ".llvmcmd", ".stack_sizes"] {
            objcopy.args(["--remove-section", section]);
        }
    }
    process::capture(objcopy.arg(&object))?;
    // `ar` adds to what is there.
    let _ = std::fs::remove_file(&library);
    // D: no date, so that the same sources give the same bytes.
    process::capture(tools.binutil(target, "ar").arg("rcsD").arg(&library).arg(&object))?;
    check_symbols(tools, target, &library, &functions)?;
    Ok(library)
}

/// The library defines the functions of the header, and needs nothing.
fn check_symbols(
    tools: &CTools,
    target: &str,
    library: &Path,
    functions: &[String],
) -> Result<(), String> {
    let printed = process::capture(
        tools.binutil(target, "nm").args(["--extern-only", "--format=posix"]).arg(library),
    )?;
    let (mut defined, mut undefined) = (Vec::new(), Vec::new());
    for line in printed.lines() {
        // The archive's and the member's name end with a colon.
        let mut words = line.split_whitespace();
        if let (Some(name), Some(kind)) = (words.next(), words.next()) {
            if kind == "U" { undefined.push(name) } else { defined.push(name.to_owned()) }
        }
    }
    defined.sort();
    if defined != functions {
        return Err(format!("{target}: the library defines {defined:?}, the header {functions:?}"));
    }
    if undefined.contains(&PANIC) {
        return Err(format!("{target}: a question can panic"));
    }
    undefined.retain(|name| target != HOST || !OF_THE_HOST.contains(name));
    if undefined.is_empty() {
        Ok(())
    } else {
        Err(format!("{target}: the library needs {undefined:?}"))
    }
}

/// Bytes of code and constants of a program that calls some of the functions and nothing else.
///
/// # Errors
/// The linker's, or a function that the header does not have.
pub fn bytes(
    tools: &CTools,
    target: &str,
    library: &Path,
    functions: &[&str],
) -> Result<u64, String> {
    // The linker would pass over a name that is not there.
    let known = self::functions()?;
    if let Some(unknown) = functions.iter().find(|name| !known.iter().any(|known| known == *name)) {
        return Err(format!("meshsweep.h has no {unknown}"));
    }
    let image = library.with_file_name("linked");
    let mut ld = tools.linker(target);
    ld.args(["--gc-sections", "--unresolved-symbols=ignore-all", "--entry=0", "-Ttext=0x10000"]);
    for function in functions {
        ld.args(["-u", function]);
    }
    process::capture(ld.arg(library).arg("-o").arg(&image))?;
    let printed = process::capture(tools.binutil(target, "size").arg(&image))?;
    let words = printed.lines().nth(1).unwrap_or_default().split_whitespace();
    let numbers: Vec<u64> = words.take(3).filter_map(|word| word.parse().ok()).collect();
    match numbers.as_slice() {
        // No function writes memory of its own.
        [text, 0, 0] => Ok(*text),
        _ => Err(format!("{target}: static memory, or no size: {printed}")),
    }
}
