//! Embree: Intel's trees for ray casts, as Debian has them, in a child process of C++.
//!
//! `embree.cpp` is compiled when the race begins, and says which bytes go to and fro. Scenes are
//! robust, so that no segment passes between two triangles, and of high quality, which takes
//! longer to build. The child measures its own time; reading and writing is no part of it.

use std::fs;
use std::io::{BufReader, BufWriter, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::LazyLock;

use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::process;
use meshsweep_xtask::toolbox::{Toolbox, Wanted};

use super::engine::{Answer, Engine};
use super::workload::Workload;

const SOURCE: &str = include_str!("embree.cpp");

const WANTED: Wanted = Wanted {
    name: "embree",
    alternatives: &[&["libembree-dev"]],
    ignore_installed: &["libembree", "libtbb", "libhwloc"],
};

/// The first number of a list, as `embree.cpp` names them.
const CLOSEST_POINT: u32 = 0;
const FIRST_HIT: u32 = 1;

/// The child, compiled once in a run: its command's program and libraries.
static PROGRAM: LazyLock<Result<Program, String>> = LazyLock::new(Program::compile);

struct Program {
    toolbox: Toolbox,
}

impl Program {
    fn compile() -> Result<Self, String> {
        if !process::on_path("c++") {
            return Err("no `c++` to compile it".to_owned());
        }
        let toolbox = Toolbox::open(&WANTED)?;
        let source = toolbox.path("race.cpp");
        fs::write(&source, SOURCE)
            .map_err(|error| format!("cannot write {}: {error}", source.display()))?;
        let mut compiler = Command::new("c++");
        compiler
            .args(["-std=c++17", "-O3", "-march=native", "-I"])
            .arg(toolbox.path("usr/include"));
        compiler.arg(&source).arg("-o").arg(toolbox.path("race"));
        for folder in toolbox.libraries() {
            compiler.arg("-L").arg(&folder).arg(format!("-Wl,-rpath-link,{}", folder.display()));
        }
        process::capture(compiler.arg("-lembree3"))?;
        Ok(Self { toolbox })
    }

    fn start(&self) -> Result<Child, String> {
        let mut command = Command::new(self.toolbox.path("race"));
        self.toolbox.lend_libraries(&mut command);
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        command.spawn().map_err(|error| format!("cannot start: {error}"))
    }
}

struct Embree {
    child: Child,
    /// Taken when the child is to end.
    questions: Option<BufWriter<ChildStdin>>,
    answers: BufReader<ChildStdout>,
    bytes: usize,
    build_seconds: f64,
    seconds: f64,
}

/// Why Embree cannot take part on this machine, if it cannot.
pub fn missing() -> Option<String> {
    PROGRAM.as_ref().err().cloned()
}

/// On every mesh.
///
/// # Errors
/// The child's end.
pub fn build<'a>(subject: &Subject, _: &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String> {
    let mut child = PROGRAM.as_ref().map_err(Clone::clone)?.start()?;
    let (Some(questions), Some(answers)) = (child.stdin.take(), child.stdout.take()) else {
        return Err("a child without pipes".to_owned());
    };
    let mut embree = Embree {
        child,
        questions: Some(BufWriter::new(questions)),
        answers: BufReader::new(answers),
        bytes: 0,
        build_seconds: 0.0,
        seconds: 0.0,
    };
    let mesh = &subject.mesh;
    let corners = mesh.positions.as_flattened().iter().flat_map(|x| x.to_ne_bytes());
    let triangles = mesh.triangles.as_flattened().iter().flat_map(|v| v.to_ne_bytes());
    let count = |items: usize| (items as u32).to_ne_bytes();
    embree.send(count(mesh.positions.len()).into_iter().chain(corners))?;
    embree.send(count(mesh.triangles.len()).into_iter().chain(triangles))?;
    embree.bytes = u64::from_ne_bytes(embree.receive()?) as usize;
    embree.build_seconds = f64::from_ne_bytes(embree.receive()?);
    Ok(Box::new(embree))
}

impl Embree {
    fn send(&mut self, bytes: impl Iterator<Item = u8>) -> Result<(), String> {
        let Some(out) = &mut self.questions else { return Ok(()) };
        let bytes: Vec<u8> = bytes.collect();
        let sent = out.write_all(&bytes).and_then(|()| out.flush());
        sent.map_err(|error| format!("the child does not listen: {error}"))
    }

    fn receive<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let mut bytes = [0; N];
        let received = self.answers.read_exact(&mut bytes);
        received.map(|()| bytes).map_err(|error| format!("the child does not answer: {error}"))
    }

    fn float(&mut self) -> Result<f32, String> {
        self.receive().map(f32::from_ne_bytes)
    }

    /// Sends a list; its answers follow.
    fn ask(&mut self, question: u32, count: usize, numbers: &[f32]) -> Result<(), String> {
        let head = [question, count as u32].map(u32::to_ne_bytes);
        let numbers = numbers.iter().flat_map(|x| x.to_ne_bytes());
        self.send(head.into_iter().flatten().chain(numbers))?;
        self.seconds = f64::from_ne_bytes(self.receive()?);
        Ok(())
    }
}

impl Engine for Embree {
    fn bytes(&self) -> usize {
        self.bytes
    }

    fn answers(&self, _: Workload) -> bool {
        true
    }

    fn own_build_seconds(&self) -> Option<f64> {
        Some(self.build_seconds)
    }

    fn own_seconds(&self) -> Option<f64> {
        Some(self.seconds)
    }

    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String> {
        answers.clear();
        self.ask(CLOSEST_POINT, points.len(), points.as_flattened())?;
        for _ in points {
            answers.push(Answer::Point([self.float()?, self.float()?, self.float()?]));
        }
        Ok(())
    }

    fn first_hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        answers: &mut Vec<Answer>,
    ) -> Result<(), String> {
        answers.clear();
        self.ask(FIRST_HIT, segments.len(), segments.as_flattened().as_flattened())?;
        for _ in segments {
            let parameter = self.float()?;
            answers.push(if parameter < 0.0 { Answer::Miss } else { Answer::Hit(parameter) });
        }
        Ok(())
    }
}

impl Drop for Embree {
    /// The child ends where its input does.
    fn drop(&mut self) {
        self.questions = None;
        let _ = self.child.wait();
    }
}
