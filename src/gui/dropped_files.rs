//! Files that are dropped on the window, and paths and pictures that are pasted.

use super::PanelContext;
use super::files::is_workspace;
use super::typed_path::typed_paths;
use crate::app::{JobCommand, ViewCommand};
use crate::view::{ElsewhereKind, Origin};
use egui::{Event, Ui};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Opens files that were dropped on the window, and pasted paths and pictures.
pub fn open_dropped_and_pasted(ui: &Ui, cx: &mut PanelContext) {
    let is_text_edited = ui.ctx().text_edit_focused();
    let (dropped, pasted) = ui.input(|input| {
        let is_paste = |event: &&Event| matches!(event, Event::Paste(_) | Event::PasteImage(_));
        let pasted: Vec<Event> =
            if is_text_edited { Vec::new() } else { input.events.iter().filter(is_paste).cloned().collect() };
        (input.raw.dropped_files.clone(), pasted)
    });
    // Of several files the last one is opened: one photograph is open at a time.
    if let Some(file) = dropped.last() {
        let path = file.path().to_path_buf();
        if path.is_file() || path.parent().is_some_and(|parent| !parent.as_os_str().is_empty()) {
            open_path(cx, path);
        } else {
            match file.bytes() {
                Ok(bytes) => {
                    let name = path.display().to_string();
                    cx.send(JobCommand::Open(Origin::Bytes { name, bytes: bytes.into() }));
                }
                Err(reason) => {
                    let text = format!("{}: what was dropped cannot be read: {reason}", path.display());
                    cx.send(ViewCommand::Notify(crate::app::Severity::Error, text));
                }
            }
        }
    }
    for event in pasted {
        match event {
            Event::Paste(text) => {
                let mut paths = typed_paths(&text).into_iter();
                let Some(first) = paths.next() else { continue };
                let others = paths.count();
                if others > 0 {
                    let text = format!(
                        "{} files were pasted, and one is open at a time: {} was opened",
                        others + 1,
                        first.display()
                    );
                    cx.send(ViewCommand::Notify(crate::app::Severity::Done, text));
                }
                open_path(cx, first);
            }
            Event::PasteImage(image) => {
                let size = [image.size[0] as u32, image.size[1] as u32];
                let rgba: Vec<u8> =
                    image.pixels.iter().flat_map(egui::Color32::to_srgba_unmultiplied).collect();
                let bytes: Arc<[u8]> = crate::export::png_of_rgba(size, &rgba).into();
                cx.send(JobCommand::Open(Origin::Bytes { name: "clipboard".to_owned(), bytes }));
            }
            _ => {}
        }
    }
}

/// Words in the name of a file that is a picture of another program, where a photograph is open.
const ELSEWHERE_WORDS: [(ElsewhereKind, &[&str]); 2] = [
    (ElsewhereKind::Labels, &["label", "labels", "labelmap", "segmentation", "segments"]),
    (ElsewhereKind::Diffuse, &["diffuse"]),
];

/// What a file is by the words of its name, where the file is a picture of another program.
fn elsewhere_kind(path: &Path) -> Option<ElsewhereKind> {
    let name = path.file_stem()?.to_string_lossy().to_lowercase();
    let words: Vec<&str> = name.split(|letter: char| !letter.is_alphabetic()).collect();
    let found = ELSEWHERE_WORDS.into_iter().find(|(_, known)| known.iter().any(|word| words.contains(word)));
    found.map(|(kind, _)| kind)
}

/// Opens a workspace by its extension, a picture of another program by its name where a photograph is open, and anything else as a
/// photograph.
fn open_path(cx: &mut PanelContext, path: PathBuf) {
    if let Some(kind) = elsewhere_kind(&path).filter(|_| cx.state.picture.is_some() && !is_workspace(&path)) {
        let text = format!(
            "{} is taken for a {} of another program because of its name; Ctrl+O opens it as a photograph",
            path.display(),
            kind.name()
        );
        cx.send(ViewCommand::Notify(crate::app::Severity::Done, text));
        return cx.send(JobCommand::OpenElsewhere(kind, path));
    }
    cx.send(if is_workspace(&path) {
        JobCommand::OpenWorkspace(path)
    } else {
        JobCommand::Open(Origin::File(path))
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_of_another_program_is_known_by_a_word_of_its_name() {
        for (name, kind) in [
            ("/a/labels.png", Some(ElsewhereKind::Labels)),
            ("cups-Segmentation_2.tif", Some(ElsewhereKind::Labels)),
            ("scene.diffuse.exr", Some(ElsewhereKind::Diffuse)),
            ("diffused.png", None),
            ("labels/camera8.png", None),
            ("", None),
        ] {
            assert_eq!(elsewhere_kind(Path::new(name)), kind, "{name}");
        }
    }
}
