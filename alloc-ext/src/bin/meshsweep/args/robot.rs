//! Arguments of the command that reads a robot's description.

use super::reading::ThreadArgs;
use super::values::length;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct RobotArgs {
    /// Description of the robot (.urdf)
    pub urdf: PathBuf,
    /// Where to write: OUT.rs, and OUT_LINK.msw for each link
    #[arg(short, long = "output", value_name = "OUT")]
    pub output: PathBuf,
    /// Distance that all pairs of links keep, in metres; or that of one pair, as base,wrist=0.05
    #[arg(long, value_name = "D", value_parser = keep, required = true)]
    pub keep: Vec<Keep>,
    /// SRDF: the pairs that it disables are left out, except those with the reason Never
    #[arg(long, value_name = "FILE")]
    pub srdf: Option<PathBuf>,
    /// Folder of a package that mesh files are named by [default: a folder above, of its name]
    #[arg(long, value_name = "NAME=DIR", value_parser = package)]
    pub package: Vec<(String, PathBuf)>,
    /// Random places of the joints; a pair that meets at all of them is left out; 0: none is
    #[arg(long, value_name = "N", default_value = "1000", value_parser = clap::value_parser!(u32).range(..=1_000_000))]
    pub samples: u32,
    #[command(flatten)]
    pub threads: ThreadArgs,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// A distance to keep.
#[derive(Clone, Debug, PartialEq)]
pub struct Keep {
    /// `None`: of all pairs.
    pub pair: Option<[String; 2]>,
    pub distance: f64,
}

fn keep(text: &str) -> Result<Keep, String> {
    let wanted = "a length in metres is wanted, as 0.02, or that of two links, as base,wrist=0.05";
    let parsed = match text.rsplit_once('=') {
        None => Some((None, text)),
        Some((links, distance)) => links
            .split_once(',')
            .map(|(a, b)| (Some([a, b].map(|name| name.trim().to_owned())), distance)),
    };
    let (pair, distance) = parsed.ok_or(wanted)?;
    // It has to fit f32, with room for rounding.
    let distance = length(distance.trim()).ok().filter(|&x| x < 1e30).ok_or(wanted)?;
    match &pair {
        Some([a, b]) if a == b || a.is_empty() || b.is_empty() => Err(wanted.to_owned()),
        _ => Ok(Keep { pair, distance }),
    }
}

fn package(text: &str) -> Result<(String, PathBuf), String> {
    let parts =
        text.split_once('=').filter(|(name, folder)| !name.is_empty() && !folder.is_empty());
    let (name, folder) = parts.ok_or("a name and a folder are wanted, as my_arm=../src/my_arm")?;
    Ok((name.to_owned(), PathBuf::from(folder)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_of_all_pairs_or_of_two_links() {
        assert_eq!(keep("0.02"), Ok(Keep { pair: None, distance: 0.02 }));
        let pair = Some(["base".to_owned(), "tool=1".to_owned()]);
        assert_eq!(keep("base, tool=1=0.5"), Ok(Keep { pair, distance: 0.5 }));
        for wrong in ["", "20mm", "-1", "nan", "1e31", "a=1", "a,a=1", ",a=1", "a,b=", "a,b"] {
            assert!(keep(wrong).is_err(), "{wrong}");
        }
        assert!(package("arm=../arm").is_ok() && package("arm").is_err() && package("=x").is_err());
    }
}
