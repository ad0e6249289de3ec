//! Child processes whose failure is a message.

use std::cell::Cell;
use std::fs;
use std::io::Read;
use std::process::{Child, Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Runs with the terminal's output.
pub fn run(command: &mut Command) -> Result<(), String> {
    let line = line(command);
    let failed = |error: std::io::Error| format!("cannot start `{line}`: {error}");
    let mut child = command.stdin(Stdio::null()).spawn().map_err(failed)?;
    account_until(&mut child, None);
    let status = child.wait().map_err(failed)?;
    if status.success() { Ok(()) } else { Err(format!("`{line}`: {status}")) }
}

/// Runs in silence; the output is part of the message if it fails.
pub fn capture(command: &mut Command) -> Result<String, String> {
    let line = line(command);
    let output = output(command)?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        let (out, err) =
            (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        Err(format!("`{line}`: {}\n{out}{err}", output.status))
    }
}

/// Runs in silence. Any exit code will do.
pub fn output(command: &mut Command) -> Result<Output, String> {
    let line = line(command);
    let failed = |error: std::io::Error| format!("cannot start `{line}`: {error}");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(failed)?;
    // Read aside, so that a full pipe cannot block the child.
    let [out, err] = [child.stdout.take().map(bytes_aside), child.stderr.take().map(bytes_aside)];
    account_until(&mut child, None);
    let status = child.wait().map_err(failed)?;
    let [stdout, stderr] =
        [out, err].map(|reader| reader.and_then(|thread| thread.join().ok()).unwrap_or_default());
    Ok(Output { status, stdout, stderr })
}

/// Runs in silence and gives up after `limit`: for an emulator whose image hangs, or a download on
/// a closed network.
pub fn capture_within(command: &mut Command, limit: Duration) -> Result<String, String> {
    let line = line(command);
    let mut child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| format!("cannot start `{line}`: {error}"))?;
    // Read aside, so that a full pipe cannot block the child.
    let out = child.stdout.take().map(read_aside);
    let err = child.stderr.take().map(read_aside);
    let deadline = Instant::now() + limit;
    let in_time = account_until(&mut child, Some(deadline));
    if !in_time {
        let _ = child.kill();
    }
    let status = child.wait().ok().filter(|_| in_time);
    let [out, err] =
        [out, err].map(|reader| reader.and_then(|thread| thread.join().ok()).unwrap_or_default());
    match status {
        Some(status) if status.success() => Ok(out),
        Some(status) => Err(format!("`{line}`: {status}\n{}{err}", end(&out))),
        None => Err(format!("`{line}`: stopped after {} s\n{}{err}", limit.as_secs(), end(&out))),
    }
}

/// The last lines: an image prints hundreds before it fails.
fn end(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    lines[lines.len().saturating_sub(10)..].iter().flat_map(|line| [line, "\n"]).collect()
}

/// Does the same with each item on as many threads as the machine has cores; results in the items'
/// order, each with its seconds.
pub fn parallel<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<(R, f64)> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(items.len());
    let next = AtomicUsize::new(0);
    let run = || {
        let mut done = Vec::new();
        PROCESSOR.set(0.0);
        while let Some((index, item)) = {
            let index = next.fetch_add(1, Ordering::Relaxed);
            items.get(index).map(|item| (index, item))
        } {
            let begun = Instant::now();
            let result = work(item);
            done.push((index, (result, begun.elapsed().as_secs_f64())));
        }
        (done, PROCESSOR.get())
    };
    let mut all = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(run)).collect();
        let mut all = Vec::new();
        for (done, seconds) in workers.into_iter().flat_map(|worker| worker.join()) {
            all.extend(done);
            PROCESSOR.set(PROCESSOR.get() + seconds);
        }
        all
    });
    all.sort_by_key(|(index, _)| *index);
    all.into_iter().map(|(_, result)| result).collect()
}

/// Whether a program of this name is on the path.
pub fn on_path(program: &str) -> bool {
    std::env::var_os("PATH").is_some_and(|path| {
        std::env::split_paths(&path).any(|folder| folder.join(program).is_file())
    })
}

fn read_aside(stream: impl Read + Send + 'static) -> std::thread::JoinHandle<String> {
    std::thread::spawn(move || String::from_utf8_lossy(&read(stream)).into_owned())
}

fn bytes_aside(stream: impl Read + Send + 'static) -> std::thread::JoinHandle<Vec<u8>> {
    std::thread::spawn(move || read(stream))
}

fn read(mut stream: impl Read) -> Vec<u8> {
    let mut bytes = Vec::new();
    // What was read before an error is still worth showing.
    let _ = stream.read_to_end(&mut bytes);
    bytes
}

thread_local! {
    /// Processor seconds of the children that this thread has waited for.
    static PROCESSOR: Cell<f64> = const { Cell::new(0.0) };
}

/// Processor seconds of all children that this thread has waited for, and of theirs. 0 where the
/// system does not tell.
pub fn processor_seconds() -> f64 {
    PROCESSOR.get()
}

/// Waits until a child has ended, and adds its processor seconds to this thread's before the system
/// forgets them. Steps run beside each other, so what the system adds up for the whole process
/// tells nothing of one of them. Whether the child ended before the deadline.
fn account_until(child: &mut Child, deadline: Option<Instant>) -> bool {
    loop {
        let has_ended = match State::of(child.id()) {
            Some(State::Runs) => false,
            Some(State::Ended(seconds)) => {
                PROCESSOR.set(PROCESSOR.get() + seconds);
                true
            }
            // The system tells nothing of processes.
            None => !matches!(child.try_wait(), Ok(None)),
        };
        if has_ended || deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            return has_ended;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// What the system tells of a child that was not waited for.
enum State {
    Runs,
    /// With its processor seconds, and those of its own children.
    Ended(f64),
}

impl State {
    fn of(process: u32) -> Option<Self> {
        /// The system's unit of such times.
        const TICKS_A_SECOND: f64 = 100.0;
        let text = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
        // Behind the name, which may hold anything: the state, and ten fields later four times.
        let fields: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
        if *fields.first()? != "Z" {
            return Some(Self::Runs);
        }
        let ticks = fields.get(11..15)?.iter().filter_map(|field| field.parse::<f64>().ok());
        Some(Self::Ended(ticks.sum::<f64>() / TICKS_A_SECOND))
    }
}

fn line(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}
