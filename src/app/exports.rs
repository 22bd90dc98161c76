//! The table of the exports, from which [`ExportKind`], the export dialog and the writing follow.
//!
//! A new kind of export is a row here and a writer in `write.rs`.

use super::State;
use super::export_input::{ExportInput, ExportOptions, open_files};
use super::jobs::Stop;
use super::write::{self, Contents};
use crate::export::write_file;
use std::path::{Path, PathBuf};

/// A file or folder to be written.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// What is written.
    pub kind: ExportKind,
    /// The file or folder. The extension of some kinds says in which format.
    pub path: PathBuf,
    /// The options of the export.
    pub options: ExportOptions,
}

/// Receives the number of files written and the number of all files.
type Progress<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// The function that writes a kind of export.
enum Writer {
    /// The contents of one file.
    File(fn(&Path, &ExportOptions, &ExportInput) -> Result<Contents, String>),
    /// A folder, which the function writes; returned is the sentence to show.
    Folder(fn(&Path, &ExportOptions, &ExportInput, &Stop, Progress) -> Result<String, String>),
}

/// One kind of export.
struct ExportRow {
    /// The name in the export dialog.
    title: &'static str,
    /// The contents of the file or folder: a tooltip.
    tip: &'static str,
    /// The end of the proposed file name. Without an extension, a file gets the photograph's.
    file: &'static str,
    /// Whether the export dialog offers the kind; other kinds have dialogs of their own.
    offered: bool,
    /// Whether there is anything to write.
    available: fn(&State) -> bool,
    /// Whether the file holds something of the result.
    of_result: bool,
    /// The function that writes the export.
    writer: Writer,
}

/// Makes [`ExportKind`] and its rows from the table.
macro_rules! exports {
    ($($(#[$attribute:meta])* $kind:ident: $row:expr;)+) => {
        /// What an export writes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum ExportKind {
            $($(#[$attribute])* $kind,)+
        }

        impl ExportKind {
            /// All kinds, in the order of the export dialog.
            pub const ALL: [Self; [$(stringify!($kind)),+].len()] = [$(Self::$kind),+];

            const fn row(self) -> &'static ExportRow {
                match self {
                    $(Self::$kind => const { &$row },)+
                }
            }
        }
    };
}

exports! {
    /// The photograph without its highlights.
    Matte: ExportRow {
        title: "Photograph without highlights",
        tip: "The photograph in its own format, its surface reflection taken away (section 6).",
        file: "matte",
        offered: true,
        available: |_| true,
        of_result: true,
        writer: Writer::File(write::matte),
    };
    /// The files of `analyze`, as a folder.
    Result: ExportRow {
        title: "Everything, as a folder",
        tip: "The files of `dichroscope analyze`: body, surface and noise as floats, regions, stage pictures, report.",
        file: "result",
        offered: true,
        available: |_| true,
        of_result: true,
        writer: Writer::Folder(write::result),
    };
    /// The layer of the image view, one pixel of the file for each pixel of the photograph.
    Layer: ExportRow {
        title: "Image view as PNG",
        tip: "The layer that the image view shows, a pixel a pixel: .png as shown, .exr or .npy with its numbers.",
        file: "layer.png",
        offered: true,
        available: |_| true,
        of_result: true,
        writer: Writer::File(write::layer),
    };
    /// A picture that a view has drawn.
    View: ExportRow {
        title: "A view as PNG",
        tip: "Color space, plane or profile as they are now, at any size.",
        file: "view.png",
        offered: true,
        available: |_| true,
        of_result: false,
        writer: Writer::File(write::drawn),
    };
    /// The selection as a mask (`.png`), a table (`.csv`) or points (`.ply`).
    Selection: ExportRow {
        title: "Marked pixels",
        tip: "The marked pixels as a mask (.png), as a table (.csv) or as points in the color cube (.ply).",
        file: "selection.png",
        offered: true,
        available: |state| state.document.selection.marked.is_some(),
        of_result: false,
        writer: Writer::File(write::selection),
    };
    /// The area that the analysis is restricted to, as a mask for `--area`.
    Area: ExportRow {
        title: "Analyzed area",
        tip: "What the analysis is restricted to, as a mask for `analyze --area`.",
        file: "area.png",
        offered: true,
        available: |state| state.document.area.is_some(),
        of_result: false,
        writer: Writer::File(write::area),
    };
    /// The table of the regions, separated by commas, or by tabs in a file `.tsv` or `.txt`.
    Regions: ExportRow {
        title: "Regions table",
        tip: "The regions and their vectors: .csv separated by commas, .tsv and .txt by tabs.",
        file: "regions.csv",
        offered: true,
        available: |_| true,
        of_result: true,
        writer: Writer::File(write::regions),
    };
    /// The profile's numbers.
    Profile: ExportRow {
        title: "Profile",
        tip: "Input, body, surface and noise along the profile's line, as CSV.",
        file: "profile.csv",
        offered: true,
        available: |_| true,
        of_result: true,
        writer: Writer::File(write::profile_table),
    };
    /// The figures and tables of the paper for the photograph, as a page.
    Figures: ExportRow {
        title: "Figures and tables",
        tip: "The paper's color figures and tables for this photograph, as one HTML page to read, send and print.",
        file: "figures.html",
        offered: true,
        available: |_| true,
        of_result: true,
        writer: Writer::File(write::figures),
    };
    /// The parameters as TOML.
    Parameters: ExportRow {
        title: "Parameters",
        tip: "The parameters as TOML.",
        file: "parameters.toml",
        offered: false,
        available: |_| true,
        of_result: false,
        writer: Writer::File(write::parameters),
    };
    /// The workspace as JSON.
    Workspace: ExportRow {
        title: "Workspace",
        tip: "The photograph's place, parameters, selection and views.",
        file: "workspace.dichroscope",
        offered: false,
        available: |_| true,
        of_result: false,
        writer: Writer::File(write::workspace),
    };
}

impl ExportKind {
    /// The name in the export dialog.
    pub const fn title(self) -> &'static str {
        self.row().title
    }

    /// The contents of the file or folder: a tooltip.
    pub const fn tip(self) -> &'static str {
        self.row().tip
    }

    /// Whether the export dialog offers the kind; other kinds have dialogs of their own.
    pub const fn is_offered(self) -> bool {
        self.row().offered
    }

    /// Whether the kind is a folder.
    pub const fn is_folder(self) -> bool {
        matches!(self.row().writer, Writer::Folder(_))
    }

    /// Whether there is anything to write.
    pub fn is_available(self, state: &State) -> bool {
        (self.row().available)(state)
    }

    /// Whether the file holds something of the result, so that an analysis under way is to be waited for.
    pub const fn is_of_result(self, options: &ExportOptions) -> bool {
        // The pixels of a region are those of the result.
        self.row().of_result || options.region.is_some()
    }

    /// The end of the proposed file name. Without an extension, a file gets the photograph's.
    pub const fn file(self) -> &'static str {
        self.row().file
    }

    /// An export of this kind with default options.
    pub fn to(self, path: impl Into<PathBuf>) -> Export {
        Export { kind: self, path: path.into(), options: ExportOptions::default() }
    }
}

/// Writes an export; every file and folder appears whole or not at all. `report_progress` is called with the number of
/// files written and the number of files in all. The sentence says what was written, or what failed, why, and what to
/// do.
pub(super) fn write_export(
    export: &Export,
    input: &ExportInput,
    stop: &Stop,
    report_progress: Progress,
) -> Result<String, String> {
    let Export { kind, path, options } = export;
    expect_no_open_file(path, &input.open_files)?;
    let Contents { path, bytes, what } = match kind.row().writer {
        Writer::Folder(write) => return write(path, options, input, stop, report_progress),
        Writer::File(contents) => contents(path, options, input)?,
    };
    if stop.stopped() {
        return Ok(write::stopped(&path));
    }
    // The writer may have changed the extension.
    expect_no_open_file(&path, &input.open_files)?;
    match write_file(&path, &bytes) {
        Ok(()) => Ok(format!("wrote {what} to {}", path.display())),
        Err(error) => Err(format!("{}; choose another place", write::error_chain(&error))),
    }
}

/// Why a file at `path` cannot be written beside what `state` has open; `None` where it can.
pub fn problem_of_replacing(path: &Path, state: &State) -> Option<String> {
    expect_no_open_file(path, &open_files(state)).err()
}

/// Fails where writing to `path` would replace an open file, or the folder of one: a photograph cannot be got back.
fn expect_no_open_file(path: &Path, open_files: &[PathBuf]) -> Result<(), String> {
    let Ok(target) = path.canonicalize() else { return Ok(()) };
    let is_replaced = |file: &&PathBuf| file.canonicalize().is_ok_and(|file| file.starts_with(&target));
    open_files.iter().find(is_replaced).map_or(Ok(()), |file| {
        Err(format!(
            "{} is open, and is not replaced: choose another place than {}",
            file.display(),
            path.display()
        ))
    })
}

#[cfg(test)]
mod tests;
