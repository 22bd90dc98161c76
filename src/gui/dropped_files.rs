//! Files that are dropped on the window, and paths and pictures that are pasted.

use super::PanelContext;
use super::theme::{TITLE_PT, ThemeColors};
use super::typed_path::typed_paths;
use crate::app::{JobCommand, Severity, ViewCommand};
use crate::view::Origin;
use egui::{
    Align2, Area, DroppedFile, Event, Frame, HoveredFile, Id, LayerId, Order, RichText, Stroke, StrokeKind,
    Ui, Vec2,
};
use std::path::Path;
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

/// What is told while files are dragged over the window.
#[derive(Default)]
pub struct DropHint {
    /// Whether the drag has ended without a message of the program that began it: pointer or keys were used since.
    is_over: bool,
}

impl DropHint {
    /// Shows over everything what a drop does, while files are dragged over the window. `asked`: the title of an open dialog that asks for
    /// a file other than a photograph.
    pub fn show(&mut self, ui: &Ui, palette: &ThemeColors, asked: Option<&str>) {
        let (hovered, is_used) = ui.input(|input| {
            let is_of_person = |event: &Event| matches!(event, Event::PointerMoved(_) | Event::Key { .. });
            (input.raw.hovered_files.clone(), input.events.iter().any(is_of_person))
        });
        self.is_over = !hovered.is_empty() && (self.is_over || is_used);
        if hovered.is_empty() || self.is_over {
            return;
        }
        let what = dragged(&hovered);
        let text = asked.map_or_else(
            || format!("Drop to open {what}"),
            |asked| format!("Drop for \u{201c}{asked}\u{201d}: {what}"),
        );
        let (ctx, id) = (ui.ctx(), Id::unique("drop hint"));
        let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, id.with("frame")));
        painter.rect_stroke(ctx.content_rect(), 0.0, Stroke::new(3.0, palette.accent), StrokeKind::Inside);
        let area = Area::new(id).order(Order::Tooltip).anchor(Align2::CENTER_CENTER, Vec2::ZERO);
        area.interactable(false).show(ctx, |ui| {
            let frame = Frame::popup(ui.style()).fill(palette.panel).stroke(Stroke::new(1.0, palette.accent));
            frame.inner_margin(16).show(ui, |ui| ui.label(RichText::new(text).size(TITLE_PT)));
        });
    }
}

/// The files that are dragged, in words.
fn dragged(files: &[HoveredFile]) -> String {
    match files {
        [file] => {
            let name = file.path.as_ref().and_then(|path| path.file_name());
            name.map_or_else(|| "a file".to_owned(), |name| name.to_string_lossy().into_owned())
        }
        several => format!("{} files", several.len()),
    }
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

/// Opens files, if there are any, and the photographs in folders.
fn open(cx: &mut PanelContext, origins: Vec<Origin>) {
    if origins.iter().any(is_folder) {
        cx.send(JobCommand::OpenFolders(origins));
    } else if !origins.is_empty() {
        cx.send(JobCommand::OpenFiles(origins));
    }
}

/// Whether a path is that of a folder.
fn is_folder(origin: &Origin) -> bool {
    origin.path().is_some_and(Path::is_dir)
}

/// The place of a dropped file: its path, or its bytes where it came without one.
///
/// # Errors
/// A sentence, where the file has neither.
fn origin_of(file: &dyn DroppedFile) -> Result<Origin, String> {
    let path = file.path();
    if path.is_file() || path.is_dir() || path.parent().is_some_and(|parent| !parent.as_os_str().is_empty()) {
        return Ok(Origin::File(path.to_path_buf()));
    }
    let name = path.display().to_string();
    match file.bytes() {
        Ok(bytes) => Ok(Origin::Bytes { name, bytes: bytes.into() }),
        Err(reason) => Err(format!("{name}: what was dropped cannot be read: {reason}")),
    }
}
