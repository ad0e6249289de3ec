//! Child processes whose failure is a message.

use std::io::Read;
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Runs with the terminal's output.
pub fn run(command: &mut Command) -> Result<(), String> {
    let line = line(command);
    let status = command
        .stdin(Stdio::null())
        .status()
        .map_err(|error| format!("cannot start `{line}`: {error}"))?;
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
    command.stdin(Stdio::null()).output().map_err(|error| format!("cannot start `{line}`: {error}"))
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
    let status = loop {
        match child.try_wait() {
            Ok(Some(status)) => break Some(status),
            Ok(None) if Instant::now() < deadline => std::thread::sleep(Duration::from_millis(10)),
            _ => {
                let _ = child.kill();
                let _ = child.wait();
                break None;
            }
        }
    };
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
        while let Some((index, item)) = {
            let index = next.fetch_add(1, Ordering::Relaxed);
            items.get(index).map(|item| (index, item))
        } {
            let begun = Instant::now();
            let result = work(item);
            done.push((index, (result, begun.elapsed().as_secs_f64())));
        }
        done
    };
    let mut all = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(run)).collect();
        workers.into_iter().flat_map(|worker| worker.join().unwrap_or_default()).collect::<Vec<_>>()
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

fn read_aside(mut stream: impl Read + Send + 'static) -> std::thread::JoinHandle<String> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // What was read before an error is still worth showing.
        let _ = stream.read_to_end(&mut bytes);
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

fn line(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}
