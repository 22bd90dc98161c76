//! Files that are dropped on the window, and paths and pictures that are pasted.

use super::PanelContext;
use super::typed_path::typed_paths;
use crate::app::{JobCommand, Severity, ViewCommand};
use crate::view::Origin;
use egui::{DroppedFile, Event, Ui};
use std::sync::Arc;

/// Opens files that were dropped on the window together; returns whether there were any.
pub fn open_dropped(ui: &Ui, cx: &mut PanelContext) -> bool {
    let dropped = ui.input(|input| input.raw.dropped_files.clone());
    let mut origins = Vec::new();
    for file in &dropped {
        match origin_of(&**file) {
            Ok(origin) => origins.push(origin),
            Err(reason) => cx.send(ViewCommand::Notify(Severity::Error, reason)),
        }
    }
    open(cx, origins);
    !dropped.is_empty()
}

/// Opens pasted paths and pictures, unless a text is being edited.
pub fn open_pasted(ui: &Ui, cx: &mut PanelContext) {
    if ui.ctx().text_edit_focused() {
        return;
    }
    let pasted: Vec<Event> = ui.input(|input| {
        let is_paste = |event: &&Event| matches!(event, Event::Paste(_) | Event::PasteImage(_));
        input.events.iter().filter(is_paste).cloned().collect()
    });
    for event in pasted {
        match event {
            Event::Paste(text) => open(cx, typed_paths(&text).into_iter().map(Origin::File).collect()),
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

/// Opens files, if there are any.
fn open(cx: &mut PanelContext, origins: Vec<Origin>) {
    if !origins.is_empty() {
        cx.send(JobCommand::OpenFiles(origins));
    }
}

/// The place of a dropped file: its path, or its bytes where it came without one.
///
/// # Errors
/// A sentence, where the file has neither.
fn origin_of(file: &dyn DroppedFile) -> Result<Origin, String> {
    let path = file.path();
    if path.is_file() || path.parent().is_some_and(|parent| !parent.as_os_str().is_empty()) {
        return Ok(Origin::File(path.to_path_buf()));
    }
    let name = path.display().to_string();
    match file.bytes() {
        Ok(bytes) => Ok(Origin::Bytes { name, bytes: bytes.into() }),
        Err(reason) => Err(format!("{name}: what was dropped cannot be read: {reason}")),
    }
}
