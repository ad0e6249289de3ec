//! Which file of a crate uses which.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use crate::source::{Source, collect, root};

/// A module's path from its crate's root: `["bvh", "node"]`.
type Module = Vec<String>;

/// A crate's sources by their modules.
pub struct House {
    sources: BTreeMap<Module, Source>,
}

/// `file` uses `other` on `line`.
#[derive(Debug)]
struct Arrow {
    from: Module,
    to: Module,
    line: usize,
}

impl House {
    /// Reads all files below `folder`; those in `but` are another crate's.
    pub fn read(folder: &str, but: Option<&str>) -> Self {
        let folder = root().join(folder);
        let mut files = Vec::new();
        collect(&folder, &mut files);
        let but = but.map(|but| folder.join(but));
        let is_ours = |file: &&PathBuf| but.as_ref().is_none_or(|but| !file.starts_with(but));
        let mut house = Self { sources: BTreeMap::new() };
        for file in files.iter().filter(is_ours) {
            let inside = file.strip_prefix(&folder).expect("below it").with_extension("");
            let mut module: Module =
                inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
            if module.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
                module.pop();
            }
            if module.last().is_some_and(|last| last == "tests") {
                continue;
            }
            let text = fs::read_to_string(file).expect("readable");
            house.sources.insert(module.clone(), Source::of(file, &text));
        }
        assert!(!house.sources.is_empty(), "{}", folder.display());
        house
    }

    /// The file that defines the last name of a path, or its module's if the name is unknown.
    fn resolve(&self, from: &Module, path: &[String], depth: usize) -> Option<Module> {
        let (first, mut rest) = path.split_first()?;
        let mut module = match first.as_str() {
            "crate" => Vec::new(),
            "self" => from.clone(),
            "super" => {
                let mut module = from.clone();
                module.pop()?;
                while rest.first().is_some_and(|name| name == "super") {
                    module.pop()?;
                    rest = &rest[1..];
                }
                module
            }
            name => {
                // A module beside, or another crate.
                let child = [from.as_slice(), &[name.to_owned()]].concat();
                self.sources.contains_key(&child).then_some(())?;
                child
            }
        };
        while let Some((name, others)) = rest.split_first() {
            let child = [module.as_slice(), std::slice::from_ref(name)].concat();
            let source = self.sources.get(&module)?;
            if self.sources.contains_key(&child) {
                module = child;
            } else if let (Some(path), false) = (source.exports.get(name), depth > 8) {
                let path = [path.as_slice(), others].concat();
                return self.resolve(&module, &path, depth + 1).or(Some(module));
            } else if !source.items.contains(name) && depth <= 8 {
                let behind = source.globs.iter().find_map(|glob| {
                    let inside = self.resolve(&module, glob, depth + 1)?;
                    let source = self.sources.get(&inside)?;
                    let known = source.items.contains(name) || source.exports.contains_key(name);
                    let path = [&["self".to_owned()], rest].concat();
                    known.then(|| self.resolve(&inside, &path, depth + 1))?
                });
                return behind.or(Some(module));
            } else {
                return Some(module);
            }
            rest = others;
        }
        Some(module)
    }

    /// What each file uses of others; handing on alone is no use.
    fn arrows(&self) -> Vec<Arrow> {
        let mut arrows = Vec::new();
        for (from, source) in &self.sources {
            for named in source.named.iter().filter(|named| !named.is_export) {
                let to = self.resolve(from, &named.path, 0);
                if let Some(to) = to.filter(|to| to != from) {
                    arrows.push(Arrow { from: from.clone(), to, line: named.line });
                }
            }
        }
        arrows
    }

    fn place(&self, arrow: &Arrow) -> String {
        let file = self.sources[&arrow.from].file.strip_prefix(root()).expect("below it");
        format!("{}:{}", file.display(), arrow.line)
    }

    /// Uses that `folders` does not allow.
    pub fn strays(&self, folders: &[(&str, &[&str])]) -> Vec<String> {
        let mut strays = Vec::new();
        for arrow in self.arrows() {
            let ([from, ..], [to, ..]) = (arrow.from.as_slice(), arrow.to.as_slice()) else {
                // The crate's root may use all; what is defined in the root is used by none.
                if !arrow.from.is_empty() {
                    strays.push(format!(
                        "{} may not use the crate's root: {}",
                        arrow.from[0],
                        self.place(&arrow)
                    ));
                }
                continue;
            };
            if from == to {
                continue;
            }
            match folders.iter().find(|(folder, _)| folder == from) {
                None => strays
                    .push(format!("{from} is no folder of the design: {}", self.place(&arrow))),
                Some((_, may)) if !may.contains(&to.as_str()) => {
                    strays.push(format!("{from} may not use {to}: {}", self.place(&arrow)));
                }
                Some(_) => {}
            }
        }
        strays.sort();
        strays.dedup();
        strays
    }

    /// Groups of files that use each other in a circle.
    pub fn circles(&self) -> Vec<String> {
        let arrows = self.arrows();
        let mut uses: BTreeMap<&Module, BTreeSet<&Module>> = BTreeMap::new();
        for arrow in &arrows {
            uses.entry(&arrow.from).or_default().insert(&arrow.to);
        }
        let reach = |from: &Module| {
            let (mut seen, mut stack) = (BTreeSet::new(), vec![from]);
            while let Some(module) = stack.pop() {
                for &next in uses.get(module).into_iter().flatten() {
                    if seen.insert(next) {
                        stack.push(next);
                    }
                }
            }
            seen
        };
        let reached: BTreeMap<&Module, BTreeSet<&Module>> =
            self.sources.keys().map(|module| (module, reach(module))).collect();
        let mut circles = BTreeSet::new();
        for (module, after) in &reached {
            let circle: BTreeSet<&Module> =
                after.iter().copied().filter(|other| reached[other].contains(module)).collect();
            if circle.len() > 1 {
                circles.insert(circle);
            }
        }
        let told = |circle: &BTreeSet<&Module>| {
            let inside = arrows
                .iter()
                .filter(|arrow| circle.contains(&arrow.from) && circle.contains(&arrow.to));
            let mut lines: Vec<String> = inside
                .map(|arrow| format!("  {} uses {}", self.place(arrow), arrow.to.join("::")))
                .collect();
            lines.dedup_by_key(|line| line.clone());
            format!("{} files use each other:\n{}", circle.len(), lines.join("\n"))
        };
        circles.iter().map(told).collect()
    }
}
