//! The files of another program's pictures of a photograph, by what each is.

use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The two kinds of pictures of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElsewhereKind {
    /// A label map: the region of each pixel.
    Labels,
    /// A diffuse picture: the photograph without highlights.
    Diffuse,
}

impl ElsewhereKind {
    /// Both kinds.
    pub const ALL: [Self; 2] = [Self::Labels, Self::Diffuse];

    /// The name in sentences.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Labels => "label map",
            Self::Diffuse => "diffuse picture",
        }
    }
}

/// The files of a label map and a diffuse picture.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ElsewherePaths {
    /// The label map; none where there is none.
    #[serde(default)]
    pub labels: Option<PathBuf>,
    /// The diffuse picture; none where there is none.
    #[serde(default)]
    pub diffuse: Option<PathBuf>,
}

impl ElsewherePaths {
    /// Each file with its kind.
    pub fn files(&self) -> impl Iterator<Item = (ElsewhereKind, &Path)> {
        let of = |kind| Some((kind, self.get(kind)?));
        ElsewhereKind::ALL.into_iter().filter_map(of)
    }

    /// The file of a kind.
    pub fn get(&self, kind: ElsewhereKind) -> Option<&Path> {
        match kind {
            ElsewhereKind::Labels => self.labels.as_deref(),
            ElsewhereKind::Diffuse => self.diffuse.as_deref(),
        }
    }

    /// The files with `path` as the file of a kind.
    #[must_use]
    pub fn with(self, kind: ElsewhereKind, path: PathBuf) -> Self {
        match kind {
            ElsewhereKind::Labels => Self { labels: Some(path), ..self },
            ElsewhereKind::Diffuse => Self { diffuse: Some(path), ..self },
        }
    }

    /// The files, and those of `others` of the kinds that have no file here.
    #[must_use]
    pub fn or(self, others: Self) -> Self {
        Self { labels: self.labels.or(others.labels), diffuse: self.diffuse.or(others.diffuse) }
    }

    /// The files of the kinds that have no file in `others`.
    #[must_use]
    pub fn except(&self, others: &Self) -> Self {
        let free = |kind| self.get(kind).filter(|_| others.get(kind).is_none()).map(Path::to_path_buf);
        Self { labels: free(ElsewhereKind::Labels), diffuse: free(ElsewhereKind::Diffuse) }
    }

    /// The paths after `change` was applied to each.
    #[must_use]
    pub fn map(&self, change: impl Fn(&Path) -> PathBuf) -> Self {
        Self { labels: self.labels.as_deref().map(&change), diffuse: self.diffuse.as_deref().map(&change) }
    }
}
