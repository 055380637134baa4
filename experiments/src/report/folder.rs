//! The report's folder, replaced as a whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::{PARAMETERS, SUMMARY, summary};

/// Why a report cannot be written where it was asked for.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FolderError {
    /// There is something that this program did not write.
    #[error("{} is there and is not a report of this program; name another folder with --out", .0.display())]
    Foreign(PathBuf),
    /// The path names no folder: empty, a root, or ending in `..`.
    #[error("'{}' cannot be the name of a report's folder", .0.display())]
    Name(PathBuf),
    /// The system refused.
    #[error("cannot write {}", path.display())]
    Io {
        /// What was to be written.
        path: PathBuf,
        /// The system's words.
        source: io::Error,
    },
}

/// A folder beside the report's, filled first and renamed at the end; dropped before that, it leaves nothing.
#[derive(Debug)]
pub struct Staging {
    target: PathBuf,
    folder: PathBuf,
    made: Vec<PathBuf>,
}

impl Staging {
    /// Opens an empty folder beside `target`, making the folders above it.
    ///
    /// # Errors
    /// `target` cannot be a folder, is there and is not a report, or cannot be written beside.
    pub fn open(target: &Path) -> Result<Self, FolderError> {
        let name = || FolderError::Name(target.to_owned());
        // A link to a report is followed, so that the report is replaced and not the link.
        let target = if target.symlink_metadata().is_ok() {
            target.canonicalize().map_err(|source| FolderError::Io { path: target.to_owned(), source })?
        } else {
            target.to_owned()
        };
        let mut beside = target.file_name().ok_or_else(name)?.to_owned();
        check(&target)?;
        beside.push(format!(".partial-{}", std::process::id()));
        let folder = target.with_file_name(beside);
        let mut staging = Self { target, folder, made: Vec::new() };
        let above: Vec<PathBuf> =
            staging.folder.ancestors().skip(1).take_while(|path| missing(path)).map(Path::to_owned).collect();
        for path in above.into_iter().rev().chain([staging.folder.clone()]) {
            fs::create_dir(&path)
                .map_err(|source| FolderError::Io { path: staging.target.clone(), source })?;
            staging.made.push(path);
        }
        Ok(staging)
    }

    /// The folder to fill.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Puts the filled folder in the place of the report; an earlier report is removed only after that.
    ///
    /// # Errors
    /// Something foreign has come there meanwhile, or the system refused; an earlier report is then still there.
    pub fn finish(mut self) -> Result<PathBuf, FolderError> {
        check(&self.target)?;
        let io = |source| FolderError::Io { path: self.target.clone(), source };
        let earlier = self.folder.with_extension(format!("earlier-{}", std::process::id()));
        let replaced = self.target.exists();
        if replaced {
            fs::rename(&self.target, &earlier).map_err(io)?;
        }
        if let Err(source) = fs::rename(&self.folder, &self.target) {
            if replaced {
                fs::rename(&earlier, &self.target).map_err(io)?;
            }
            return Err(io(source));
        }
        self.made.clear();
        if replaced {
            fs::remove_dir_all(&earlier).map_err(|source| FolderError::Io { path: earlier, source })?;
        }
        Ok(std::mem::take(&mut self.target))
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // What could not be removed is left beside the report: there is no one to tell.
        if self.made.contains(&self.folder) {
            let _ = fs::remove_dir_all(&self.folder);
        }
        for path in self.made.iter().rev() {
            let _ = fs::remove_dir(path);
        }
    }
}

fn missing(path: &Path) -> bool {
    !path.as_os_str().is_empty()
        && path.symlink_metadata().is_err_and(|error| error.kind() == io::ErrorKind::NotFound)
}

/// Whether a report may stand at `target`: nothing is there, an empty folder, or a report.
fn check(target: &Path) -> Result<(), FolderError> {
    if missing(target) {
        return Ok(());
    }
    let entries = match fs::read_dir(target) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotADirectory && target.is_file() => {
            return Err(FolderError::Foreign(target.to_owned()));
        }
        Err(source) => return Err(FolderError::Io { path: target.to_owned(), source }),
    };
    let empty = entries.into_iter().next().is_none();
    let ours = |name| fs::read_to_string(target.join(name)).is_ok_and(|text| summary::is_ours(&text));
    if empty || [SUMMARY, PARAMETERS].into_iter().any(ours) {
        Ok(())
    } else {
        Err(FolderError::Foreign(target.to_owned()))
    }
}
