//! Output that is complete or not there: a file is written beside its place, and renamed when it
//! is complete.

use crate::failure::Failure;
use std::fs::{self, File};
use std::io::{self, BufWriter, Stdout, Write};
use std::path::{Path, PathBuf};

/// The output of a command. A file that is dropped before [`finish`](Self::finish) leaves no trace.
pub struct Output {
    path: PathBuf,
    target: Target,
}

enum Target {
    Stdout(BufWriter<Stdout>),
    /// A pipe or a device: renaming would replace it.
    Device(BufWriter<File>),
    /// `temporary` is empty once it has been renamed.
    File {
        out: BufWriter<File>,
        temporary: PathBuf,
        place: PathBuf,
    },
}

impl Output {
    /// The file at `path`.
    pub fn file(path: &Path) -> Result<Self, Failure> {
        if path.as_os_str() == "-" {
            let what = "-: the standard output is for the report; name a file".to_owned();
            return Err(Failure::Usage { what });
        }
        let target = open(path).map_err(|error| Failure::write(path, error))?;
        Ok(Output { path: path.to_owned(), target })
    }

    /// The file at `path`; the standard output for `None` and `-`.
    pub fn file_or_stdout(path: Option<&Path>) -> Result<Self, Failure> {
        path.filter(|path| path.as_os_str() != "-").map_or_else(|| Ok(Self::stdout()), Self::file)
    }

    /// The standard output.
    pub fn stdout() -> Self {
        let target = Target::Stdout(BufWriter::new(io::stdout()));
        Output { path: PathBuf::from("standard output"), target }
    }

    /// Checks that `path` can be written, before hours of work.
    pub fn probe(path: &Path) -> Result<(), Failure> {
        // Opening and closing a pipe would tell its reader that the output is complete.
        let is_device =
            fs::metadata(path).is_ok_and(|existing| !existing.is_file() && !existing.is_dir());
        if is_device { Ok(()) } else { Self::file(path).map(drop) }
    }

    /// Checks that the file system allows files of so many bytes. It may still lack the space for
    /// one.
    pub fn require_size(&self, bytes: u64) -> Result<(), Failure> {
        let Target::File { out, .. } = &self.target else { return Ok(()) };
        let file = out.get_ref();
        let sized = file.set_len(bytes).and_then(|()| file.set_len(0));
        sized.map_err(|error| Failure::write(&self.path, error))
    }

    /// Runs `write` on the output, then puts the file in its place.
    pub fn finish(
        mut self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let written = write(&mut self);
        self.end(written)
    }

    fn end(mut self, written: io::Result<()>) -> Result<(), Failure> {
        let done = written.and_then(|()| self.commit());
        done.map_err(|error| {
            let is_stdout = matches!(self.target, Target::Stdout(_));
            if is_stdout && error.kind() == io::ErrorKind::BrokenPipe {
                Failure::ClosedPipe
            } else {
                Failure::write(&self.path, error)
            }
        })
    }

    /// The same for answers that may be `stopped` by a failure. The standard output gets the
    /// answers before it. A file is not written, for it would be incomplete.
    pub fn finish_until(
        self,
        stopped: Option<Failure>,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        match stopped {
            None => self.finish(write),
            Some(failure) if matches!(self.target, Target::File { .. }) => {
                Err(Failure::Unwritten { file: self.path.clone(), cause: Box::new(failure) })
            }
            Some(failure) => self.finish(write).and(Err(failure)),
        }
    }

    fn commit(&mut self) -> io::Result<()> {
        self.flush()?;
        if let Target::File { out, temporary, place } = &mut self.target {
            out.get_ref().sync_all()?;
            fs::rename(&*temporary, &*place)?;
            temporary.clear();
        }
        Ok(())
    }
}

/// Refuses an output that is one of the inputs.
pub fn refuse_same_file(output: Option<&Path>, inputs: &[&Path]) -> Result<(), Failure> {
    let Some(Ok(output_file)) = output.map(fs::canonicalize) else { return Ok(()) };
    let is_output = |input: &&Path| fs::canonicalize(input).is_ok_and(|input| input == output_file);
    match inputs.iter().copied().find(is_output) {
        Some(input) => Err(Failure::SameFile { file: input.to_owned() }),
        None => Ok(()),
    }
}

/// Refuses an output whose name does not end in `.extension`. `why` says why it must.
pub fn refuse_other_extension(output: &Path, extension: &str, why: &str) -> Result<(), Failure> {
    if output.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension)) {
        return Ok(());
    }
    let file = output.display();
    let what = format!("{file}: {why}; name an output that ends in .{extension}");
    Err(Failure::Usage { what })
}

fn open(path: &Path) -> io::Result<Target> {
    // The target of a link, so that the link stays.
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let existing = match fs::metadata(&place) {
        Ok(existing) => Some(existing),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    if let Some(existing) = &existing {
        if existing.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        // Renaming would ignore the permissions of the file; this asks for them.
        let device = File::options().write(true).open(&place)?;
        if !existing.is_file() {
            return Ok(Target::Device(BufWriter::new(device)));
        }
    }
    let name = place.file_name().ok_or(io::ErrorKind::IsADirectory)?;
    let mut hidden = std::ffi::OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".{}.part", std::process::id()));
    let temporary = place.with_file_name(hidden);
    let file = File::create_new(&temporary)?;
    let target = Target::File { out: BufWriter::new(file), temporary, place };
    if let (Target::File { out, .. }, Some(existing)) = (&target, existing) {
        // Best effort: a file system without permissions is no reason to fail.
        let _ = out.get_ref().set_permissions(existing.permissions());
    }
    Ok(target)
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.target {
            Target::Stdout(out) => out.write(bytes),
            Target::Device(out) | Target::File { out, .. } => out.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.target {
            Target::Stdout(out) => out.flush(),
            Target::Device(out) | Target::File { out, .. } => out.flush(),
        }
    }
}

impl Drop for Target {
    fn drop(&mut self) {
        if let Target::File { temporary, .. } = self
            && !temporary.as_os_str().is_empty()
        {
            // The first error is the one to report.
            let _ = fs::remove_file(temporary);
        }
    }
}
