//! Names of mesh files in a description, as paths.

use std::path::{Component, Path, PathBuf};

/// Where packages are.
pub(super) struct Packages<'a> {
    /// The folder of the description.
    folder: PathBuf,
    named: &'a [(String, PathBuf)],
}

impl<'a> Packages<'a> {
    pub(super) fn new(file: &Path, named: &'a [(String, PathBuf)]) -> Self {
        let folder = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
        Self { folder: folder.parent().map(Path::to_owned).unwrap_or_default(), named }
    }

    /// The file of a name. `package://NAME/PATH` and `model://NAME/PATH` are PATH in the package's
    /// folder: the one that was named, or else the nearest folder NAME above the description or
    /// beside such a folder that has the file. A PATH with `..` is refused. Without a scheme, or
    /// with `file://`, the name is a path from the description's folder.
    pub(super) fn find(&self, name: &str) -> Result<PathBuf, String> {
        let Some((scheme, rest)) = name.split_once("://") else {
            return Ok(self.folder.join(name));
        };
        match scheme {
            "file" => return Ok(self.folder.join(rest)),
            "package" | "model" => {}
            _ => return Err(format!("{name}: only files and packages are read")),
        }
        let (package, path) = rest.split_once('/').unwrap_or((rest, ""));
        let path = path.trim_start_matches('/');
        let parts = Path::new(package).join(path);
        let is_inside = parts.components().all(|part| matches!(part, Component::Normal(_)));
        if package.is_empty() || path.is_empty() || !is_inside {
            return Err(format!("{name}: a package and a file in it are wanted"));
        }
        if let Some((_, folder)) = self.named.iter().find(|(name, _)| name == package) {
            return Ok(folder.join(path));
        }
        for above in self.folder.ancestors() {
            let own =
                above.file_name().is_some_and(|name| name == package).then(|| above.join(path));
            let found = own.into_iter().chain([above.join(package).join(path)]);
            if let Some(found) = found.into_iter().find(|found| found.is_file()) {
                return Ok(found);
            }
        }
        Err(format!("{name}: no folder above has it; tell where it is by --package {package}=DIR"))
    }
}
