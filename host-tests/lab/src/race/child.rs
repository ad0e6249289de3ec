//! Engines that are no crates: child processes that answer over pipes.
//!
//! A source in C++ is compiled against Debian's libraries when the race begins, one in Python gets
//! an environment with PyPI's packages. The source says which bytes go to and fro. The child
//! measures its own time; reading and writing is no part of it.

use std::fs;
use std::io::{BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{self as system, ChildStdin, ChildStdout, Command, Stdio};

use meshsweep::mesh::Mesh;
use meshsweep_xtask::toolbox::{Toolbox, Wanted};
use meshsweep_xtask::{process, workspace};

/// What all in C++ include.
const SHARED: &str = include_str!("child.h");

/// A program in C++.
pub struct Source {
    /// Debian's packages.
    pub wanted: Wanted,
    /// The program. It includes `child.h`.
    pub text: &'static str,
    /// Folders of headers below `usr/include`.
    pub headers: &'static [&'static str],
    /// More of the compiler's options: libraries, and the processor if the library allows.
    pub options: &'static [&'static str],
}

/// A program that can be started.
pub struct Program {
    words: Vec<PathBuf>,
    /// Whose libraries it needs.
    toolbox: Option<Toolbox>,
}

impl Program {
    /// Fetches the packages if they are not there, and compiles.
    ///
    /// # Errors
    /// No compiler, no packages, or the compiler's complaint.
    pub fn compile(source: &Source) -> Result<Self, String> {
        if !process::on_path("c++") {
            return Err("no `c++` to compile it".to_owned());
        }
        let toolbox = Toolbox::open(&source.wanted)?;
        write(&toolbox.path("race.cpp"), source.text)?;
        write(&toolbox.path("child.h"), SHARED)?;
        let mut compiler = Command::new("c++");
        compiler.args(["-std=c++17", "-O3", "-DNDEBUG"]);
        for folder in [""].iter().chain(source.headers) {
            compiler.arg("-isystem").arg(toolbox.path("usr/include").join(folder));
        }
        compiler.arg(toolbox.path("race.cpp")).arg("-o").arg(toolbox.path("race"));
        for folder in toolbox.libraries() {
            compiler.arg("-L").arg(&folder).arg(format!("-Wl,-rpath-link,{}", folder.display()));
        }
        process::capture(compiler.args(source.options))?;
        Ok(Self { words: vec![toolbox.path("race")], toolbox: Some(toolbox) })
    }

    /// Makes an environment with the packages below `target`, if it is not there.
    ///
    /// # Errors
    /// One line: no `python3`, no `venv`, or no packages.
    pub fn python(name: &str, packages: &[&str], text: &str) -> Result<Self, String> {
        if !process::on_path("python3") {
            return Err("no `python3` to run it".to_owned());
        }
        let folder = workspace::target().join("race").join(name);
        let (python, list) = (folder.join("bin/python"), folder.join("packages"));
        if fs::read_to_string(&list).ok().as_deref() != Some(&packages.join(" ")) {
            let mut venv = Command::new("python3");
            let mut pip = Command::new(&python);
            pip.args(["-m", "pip", "install", "--quiet", "--only-binary", ":all:"]).args(packages);
            process::capture(venv.args(["-m", "venv", "--clear"]).arg(&folder))
                .and_then(|_| process::capture(&mut pip))
                .map_err(|reason| {
                    let is_error = |line: &&str| line.to_ascii_lowercase().starts_with("error");
                    let line = reason.lines().find(is_error).map(str::to_owned);
                    line.unwrap_or_else(|| reason.replace('\n', " "))
                })?;
            write(&list, &packages.join(" "))?;
        }
        let program = folder.join("race.py");
        write(&program, text)?;
        Ok(Self { words: vec![python, program], toolbox: None })
    }

    /// Starts it.
    ///
    /// # Errors
    /// The system's.
    pub fn start(&self) -> Result<Child, String> {
        let mut command = Command::new(&self.words[0]);
        command.args(&self.words[1..]);
        if let Some(toolbox) = &self.toolbox {
            toolbox.lend_libraries(&mut command);
        }
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(|error| format!("cannot start: {error}"))?;
        let (Some(questions), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("a child without pipes".to_owned());
        };
        let (questions, answers) = (Some(BufWriter::new(questions)), BufReader::new(answers));
        Ok(Child { child, questions, answers })
    }
}

fn write(file: &Path, text: &str) -> Result<(), String> {
    fs::write(file, text).map_err(|error| format!("cannot write {}: {error}", file.display()))
}

/// A running program.
pub struct Child {
    child: system::Child,
    /// Taken when the child is to end.
    questions: Option<BufWriter<ChildStdin>>,
    answers: BufReader<ChildStdout>,
}

impl Child {
    /// Sends bytes.
    ///
    /// # Errors
    /// The child ended.
    pub fn send(&mut self, bytes: impl Iterator<Item = u8>) -> Result<(), String> {
        let Some(out) = &mut self.questions else { return Ok(()) };
        let bytes: Vec<u8> = bytes.collect();
        let sent = out.write_all(&bytes).and_then(|()| out.flush());
        sent.map_err(|error| format!("the child does not listen: {error}"))
    }

    /// Sends a mesh.
    ///
    /// # Errors
    /// The child ended.
    pub fn send_mesh(&mut self, mesh: &Mesh) -> Result<(), String> {
        let corners = mesh.positions.as_flattened().iter().flat_map(|x| x.to_ne_bytes());
        let triangles = mesh.triangles.as_flattened().iter().flat_map(|v| v.to_ne_bytes());
        let count = |items: usize| (items as u32).to_ne_bytes();
        self.send(count(mesh.positions.len()).into_iter().chain(corners))?;
        self.send(count(mesh.triangles.len()).into_iter().chain(triangles))
    }

    /// Sends which question is asked about how many items.
    ///
    /// # Errors
    /// The child ended.
    pub fn send_question(&mut self, question: u32, count: usize) -> Result<(), String> {
        self.send([question, count as u32].into_iter().flat_map(u32::to_ne_bytes))
    }

    /// The next bytes.
    ///
    /// # Errors
    /// The child ended.
    pub fn receive<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let mut bytes = [0; N];
        let received = self.answers.read_exact(&mut bytes);
        received.map(|()| bytes).map_err(|error| format!("the child does not answer: {error}"))
    }

    /// The next number.
    ///
    /// # Errors
    /// The child ended.
    pub fn double(&mut self) -> Result<f64, String> {
        self.receive().map(f64::from_ne_bytes)
    }

    /// The next number.
    ///
    /// # Errors
    /// The child ended.
    pub fn float(&mut self) -> Result<f32, String> {
        self.receive().map(f32::from_ne_bytes)
    }

    /// The next number.
    ///
    /// # Errors
    /// The child ended.
    pub fn whole(&mut self) -> Result<u64, String> {
        self.receive().map(u64::from_ne_bytes)
    }
}

impl Drop for Child {
    /// The child ends where its input does.
    fn drop(&mut self) {
        self.questions = None;
        let _ = self.child.wait();
    }
}
