//! Debian packages, fetched by apt and unpacked into a folder of their own.
//!
//! Not installed: that would need root, and it would remove or downgrade what a machine has (a
//! `qemu-utils` from backports breaks the `qemu-system-*` of the release; `rustc-web` conflicts
//! with `rustc` and `rustup`). apt resolves, downloads and verifies against the machine's own
//! sources; `dpkg -x` unpacks. Neither needs root.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::process;
use crate::workspace;

/// Packages of one purpose.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// The folder's name.
    pub name: &'static str,
    /// Alternatives in the order of preference; releases of Debian cut their packages differently.
    pub alternatives: &'static [&'static [&'static str]],
    /// Installed packages of these beginnings are treated as not installed. They are unpacked even
    /// where they conflict with others.
    pub ignore_installed: &'static [&'static str],
}

/// An unpacked set of packages.
#[derive(Clone, Debug)]
pub struct Toolbox {
    root: PathBuf,
}

impl Toolbox {
    /// The toolbox of `wanted`, made now if it is not there.
    pub fn open(wanted: &Wanted) -> Result<Self, String> {
        let folder = workspace::tools()?.join(wanted.name);
        let (root, complete) = (folder.join("root"), folder.join("complete"));
        if !complete.is_file() {
            fill(wanted, &folder)?;
            fs::write(&complete, "")
                .map_err(|error| format!("cannot write {}: {error}", complete.display()))?;
        }
        Ok(Self { root })
    }

    /// A file of the toolbox.
    pub fn path(&self, inside: &str) -> PathBuf {
        self.root.join(inside)
    }

    /// A command for one of the programs in `usr/bin`, with the libraries that came with it.
    pub fn command(&self, program: &str) -> Command {
        let mut command = Command::new(self.path("usr/bin").join(program));
        self.lend_libraries(&mut command);
        command
    }

    /// Lets a program use the libraries that came with the packages.
    pub fn lend_libraries(&self, command: &mut Command) {
        let folders: Vec<String> =
            self.libraries().iter().map(|folder| folder.to_string_lossy().into_owned()).collect();
        command.env("LD_LIBRARY_PATH", folders.join(":"));
    }

    /// The folders of the libraries.
    pub fn libraries(&self) -> Vec<PathBuf> {
        let mut folders = Vec::new();
        for parent in ["usr/lib", "lib"].map(|folder| self.root.join(folder)) {
            for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
                if entry.file_name().to_string_lossy().contains("-linux-") {
                    folders.push(entry.path());
                }
            }
        }
        folders
    }
}

fn fill(wanted: &Wanted, folder: &Path) -> Result<(), String> {
    for program in ["apt-get", "dpkg"] {
        if !process::on_path(program) {
            return Err(format!(
                "no `{program}`: cannot fetch {} from Debian",
                wanted.alternatives[0].join(", ")
            ));
        }
    }
    let apt = Apt::new(wanted, folder)?;
    // The machine's package lists may be missing or stale, and only root may renew them: then
    // private ones are fetched.
    let first = apt.fetch(wanted);
    if let Err(reason) = first {
        say!(
            "   fetching package lists: {}",
            reason.lines().find(|line| line.starts_with("E:")).unwrap_or("none here")
        );
        let apt = apt.with_own_lists()?;
        apt.fetch(wanted)?;
    }
    let root = folder.join("root");
    for archive in files(&folder.join("archives"))? {
        process::capture(Command::new("dpkg").arg("-x").arg(&archive).arg(&root))?;
        // Unpacked, it is only in the way.
        let _ = fs::remove_file(&archive);
    }
    Ok(())
}

/// How apt is called.
struct Apt {
    folder: PathBuf,
    options: Vec<String>,
}

impl Apt {
    fn new(wanted: &Wanted, folder: &Path) -> Result<Self, String> {
        // A half-filled folder of an interrupted run is of no use.
        let _ = fs::remove_dir_all(folder);
        for inside in ["archives", "lists/partial", "root"] {
            let path = folder.join(inside);
            fs::create_dir_all(&path)
                .map_err(|error| format!("cannot make {}: {error}", path.display()))?;
        }
        let status = folder.join("status");
        let installed = fs::read_to_string("/var/lib/dpkg/status")
            .map_err(|error| format!("cannot read what is installed: {error}"))?;
        fs::write(&status, without(&installed, wanted.ignore_installed))
            .map_err(|error| format!("cannot write {}: {error}", status.display()))?;
        let options = vec![
            format!("Dir::State::status={}", status.display()),
            // The unprivileged user that root's apt downloads as cannot enter the folder.
            "APT::Sandbox::User=root".to_owned(),
            // Caches that would be written for this status alone.
            "Dir::Cache::pkgcache=".to_owned(),
            "Dir::Cache::srcpkgcache=".to_owned(),
        ];
        Ok(Self { folder: folder.to_path_buf(), options })
    }

    fn with_own_lists(mut self) -> Result<Self, String> {
        self.options.push(format!("Dir::State::lists={}", self.folder.join("lists").display()));
        // One unreachable source among several is not decisive: what counts is whether the packages
        // resolve.
        let update = process::capture(self.command().arg("update"));
        if let Err(reason) = update {
            say!("   apt-get update: {reason}");
        }
        Ok(self)
    }

    fn command(&self) -> Command {
        let mut command = Command::new("apt-get");
        command.env("LC_ALL", "C").current_dir(self.folder.join("archives"));
        for option in &self.options {
            command.arg("-o").arg(option);
        }
        command
    }

    fn fetch(&self, wanted: &Wanted) -> Result<(), String> {
        let mut reasons = Vec::new();
        for packages in wanted.alternatives {
            match self.resolve(packages) {
                Ok(versions) => {
                    say!("   fetching {} ({} packages)", packages.join(", "), versions.len());
                    let pinned =
                        versions.iter().map(|(package, version)| format!("{package}={version}"));
                    return process::capture(self.command().args(["-q", "download"]).args(pinned))
                        .map(drop);
                }
                Err(reason) => reasons.push(reason),
            }
        }
        Err(reasons.join("\n"))
    }

    /// The packages to unpack and their versions: the wanted ones and what they depend on that is
    /// not installed.
    fn resolve(&self, packages: &[&str]) -> Result<BTreeMap<String, String>, String> {
        let plan = process::capture(
            self.command().args(["-s", "-y", "--no-install-recommends", "install"]).args(packages),
        )?;
        Ok(planned(&plan))
    }
}

/// `Inst NAME [OLD] (VERSION RELEASES [ARCHITECTURE]) …` lines of a simulated installation.
fn planned(plan: &str) -> BTreeMap<String, String> {
    let lines = plan.lines().filter_map(|line| line.strip_prefix("Inst "));
    lines
        .filter_map(|line| {
            let package = line.split(' ').next()?;
            let version = line.split_once('(')?.1.split(' ').next()?;
            Some((package.to_owned(), version.to_owned()))
        })
        .collect()
}

/// dpkg's list of installed packages without those of some beginnings, and with what they are and
/// provide but not with what they want: apt then has nothing to keep intact, and resolves only what
/// is asked for.
fn without(status: &str, beginnings: &[&str]) -> String {
    const KEPT: [&str; 6] =
        ["Package:", "Status:", "Architecture:", "Multi-Arch:", "Version:", "Provides:"];
    let mut kept = String::new();
    for paragraph in status.split("\n\n") {
        let name = paragraph.trim_start().strip_prefix("Package: ").unwrap_or_default();
        if name.is_empty() || beginnings.iter().any(|beginning| name.starts_with(beginning)) {
            continue;
        }
        for line in
            paragraph.lines().filter(|line| KEPT.iter().any(|field| line.starts_with(field)))
        {
            kept.push_str(line);
            kept.push('\n');
        }
        kept.push('\n');
    }
    kept
}

fn files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder)
        .map_err(|error| format!("cannot list {}: {error}", folder.display()))?;
    Ok(entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect())
}

#[cfg(test)]
mod tests {
    use super::{planned, without};

    #[test]
    fn a_plan_yields_packages_and_versions() {
        let plan = "Reading…\nInst lib1 (1.2-3 Debian:12 [amd64])\nInst a [1:7.0] (1:7.2+b3 Debian:12 [amd64]) []\nConf a (x)";
        let versions = planned(plan);
        assert_eq!(versions.len(), 2);
        assert_eq!(versions["lib1"], "1.2-3");
        assert_eq!(versions["a"], "1:7.2+b3");
    }

    #[test]
    fn ignored_packages_leave_the_status() {
        let status =
            "Package: qemu-utils\nVersion: 10\n\nPackage: gcc\nDepends: libc6\nVersion: 12\n";
        assert_eq!(without(status, &["qemu-"]), "Package: gcc\nVersion: 12\n\n");
    }
}
