//! Engines in C++, as Debian has their libraries: child processes that answer over pipes.
//!
//! The source is compiled when the race begins, and says which bytes go to and fro. The child
//! measures its own time; reading and writing is no part of it.

use std::env;
use std::fs;
use std::io::{BufReader, BufWriter, Read, Write};
use std::path::Path;
use std::process::{self as system, ChildStdin, ChildStdout, Command, Stdio};

use meshsweep::mesh::Mesh;
use meshsweep_xtask::process;
use meshsweep_xtask::toolbox::{Toolbox, Wanted};

/// What all of them include.
const SHARED: &str = include_str!("child.h");

/// A program in C++.
pub struct Source {
    /// Debian's packages.
    pub wanted: Wanted,
    /// Sources that the user has.
    pub checkout: Option<Checkout>,
    /// The program. It includes `child.h`.
    pub text: &'static str,
    /// Folders of headers below `usr/include`.
    pub headers: &'static [&'static str],
    /// More of the compiler's options: libraries, and the processor if the library allows.
    pub options: &'static [&'static str],
}

/// Sources that no package has.
pub struct Checkout {
    /// The environment variable that names their folder.
    pub variable: &'static str,
    /// Folders of headers in it.
    pub headers: &'static [&'static str],
}

/// A compiled program.
pub struct Program {
    toolbox: Toolbox,
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
        let mut checkout = Vec::new();
        if let Some(Checkout { variable, headers }) = &source.checkout {
            let folder = env::var_os(variable)
                .ok_or_else(|| format!("{variable} does not name a folder with its sources"))?;
            checkout.extend(headers.iter().map(|headers| Path::new(&folder).join(headers)));
        }
        let toolbox = Toolbox::open(&source.wanted)?;
        for (name, text) in [("race.cpp", source.text), ("child.h", SHARED)] {
            let file = toolbox.path(name);
            fs::write(&file, text)
                .map_err(|error| format!("cannot write {}: {error}", file.display()))?;
        }
        let mut compiler = Command::new("c++");
        compiler.args(["-std=c++17", "-O3", "-DNDEBUG"]);
        for folder in [""].iter().chain(source.headers) {
            compiler.arg("-isystem").arg(toolbox.path("usr/include").join(folder));
        }
        for folder in checkout {
            compiler.arg("-isystem").arg(folder);
        }
        compiler.arg(toolbox.path("race.cpp")).arg("-o").arg(toolbox.path("race"));
        for folder in toolbox.libraries() {
            compiler.arg("-L").arg(&folder).arg(format!("-Wl,-rpath-link,{}", folder.display()));
        }
        process::capture(compiler.args(source.options))?;
        Ok(Self { toolbox })
    }

    /// Starts it.
    ///
    /// # Errors
    /// The system's.
    pub fn start(&self) -> Result<Child, String> {
        let mut command = Command::new(self.toolbox.path("race"));
        self.toolbox.lend_libraries(&mut command);
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().map_err(|error| format!("cannot start: {error}"))?;
        let (Some(questions), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
            return Err("a child without pipes".to_owned());
        };
        let (questions, answers) = (Some(BufWriter::new(questions)), BufReader::new(answers));
        Ok(Child { child, questions, answers })
    }
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
    /// The child's end.
    pub fn send(&mut self, bytes: impl Iterator<Item = u8>) -> Result<(), String> {
        let Some(out) = &mut self.questions else { return Ok(()) };
        let bytes: Vec<u8> = bytes.collect();
        let sent = out.write_all(&bytes).and_then(|()| out.flush());
        sent.map_err(|error| format!("the child does not listen: {error}"))
    }

    /// Sends a mesh.
    ///
    /// # Errors
    /// The child's end.
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
    /// The child's end.
    pub fn send_question(&mut self, question: u32, count: usize) -> Result<(), String> {
        self.send([question, count as u32].into_iter().flat_map(u32::to_ne_bytes))
    }

    /// The next bytes.
    ///
    /// # Errors
    /// The child's end.
    pub fn receive<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let mut bytes = [0; N];
        let received = self.answers.read_exact(&mut bytes);
        received.map(|()| bytes).map_err(|error| format!("the child does not answer: {error}"))
    }

    /// The next number.
    ///
    /// # Errors
    /// The child's end.
    pub fn double(&mut self) -> Result<f64, String> {
        self.receive().map(f64::from_ne_bytes)
    }

    /// The next number.
    ///
    /// # Errors
    /// The child's end.
    pub fn float(&mut self) -> Result<f32, String> {
        self.receive().map(f32::from_ne_bytes)
    }

    /// The next number.
    ///
    /// # Errors
    /// The child's end.
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
