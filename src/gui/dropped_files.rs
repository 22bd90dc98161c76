//! Files that are dropped on the window, and paths and pictures that are pasted.

use super::PanelContext;
use super::files::is_workspace;
use super::typed_path::typed_paths;
use crate::app::{JobCommand, ViewCommand};
use crate::view::Origin;
use egui::{Event, Ui};
use std::path::PathBuf;
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

/// Opens a workspace or a photograph, by the extension of the path.
fn open_path(cx: &mut PanelContext, path: PathBuf) {
    cx.send(if is_workspace(&path) {
        JobCommand::OpenWorkspace(path)
    } else {
        JobCommand::Open(Origin::File(path))
    });
}
