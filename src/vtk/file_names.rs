//! Names of files in other files: relative to the folder of the file that names them.

use std::io;
use std::path::{Component, Path, PathBuf};

/// The path of a file that `list` names.
pub(super) fn beside(list: &Path, name: &str) -> PathBuf {
    list.parent().unwrap_or(Path::new("")).join(name)
}

/// How `list` names a file: relative to its folder where the two have a root in common,
/// with slashes on every system.
pub(super) fn name_from(list: &Path, file: &Path) -> io::Result<String> {
    let list = std::path::absolute(list)?;
    let folder = list.parent().unwrap_or(Path::new(""));
    let file = std::path::absolute(file)?;
    let name = relative(folder, &file);
    let parts: Option<Vec<_>> = name.iter().map(|part| part.to_str()).collect();
    let parts = parts.ok_or_else(|| {
        let text = format!("the name of '{}' is not Unicode", file.display());
        io::Error::new(io::ErrorKind::InvalidInput, text)
    })?;
    match name.is_absolute() {
        true => Ok(name.to_string_lossy().into_owned()),
        false => Ok(parts.join("/")),
    }
}

fn relative(folder: &Path, file: &Path) -> PathBuf {
    let from: Vec<Component<'_>> = folder.components().collect();
    let to: Vec<Component<'_>> = file.components().collect();
    let common = from.iter().zip(&to).take_while(|(left, right)| left == right).count();
    if common == 0 {
        return file.to_owned();
    }
    let up = from.iter().skip(common).map(|_| Component::ParentDir);
    up.chain(to.iter().skip(common).copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_to_their_files() {
        let list = Path::new("/a/b/list.pvd");
        for (file, name) in [
            ("/a/b/x.vtu", "x.vtu"),
            ("/a/b/c/x.vtu", "c/x.vtu"),
            ("/a/x.vtu", "../x.vtu"),
            ("/d/e/x.vtu", "../../d/e/x.vtu"),
        ] {
            assert_eq!(name_from(list, Path::new(file)).unwrap(), name);
        }
        assert_eq!(beside(list, "c/x.vtu"), Path::new("/a/b/c/x.vtu"));
        assert_eq!(beside(list, "/d/x.vtu"), Path::new("/d/x.vtu"));
        assert_eq!(beside(Path::new("list.pvd"), "x.vtu"), Path::new("x.vtu"));
    }

    #[test]
    fn relative_paths_are_those_of_the_working_folder() {
        assert_eq!(name_from(Path::new("a/l.pvd"), Path::new("b/x.vtu")).unwrap(), "../b/x.vtu");
        assert_eq!(name_from(Path::new("l.pvd"), Path::new("b/x.vtu")).unwrap(), "b/x.vtu");
    }
}
