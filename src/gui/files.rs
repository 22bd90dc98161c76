//! Dialogs for files: a field for the path, and beside the field the system's own file dialog, where the system has one.

use super::action::{Action, LayerFile, PixelSet};
use super::confirmed_path::{confirmed_path, problem_of};
use super::dialog::Dialog;
use super::export_form::ExportForm;
use super::lacking_result::ANALYZE_NOW;
use super::proposed_path::{proposed_layer_path, proposed_path, proposed_pixels_path};
use super::system_dialog::{Answer, SystemDialog, Wanted};
use super::typed_path::{file_name_span, typed_path};
use super::view_export::ViewExport;
use super::{PanelContext, dialog_room, open_form};
use crate::app::{Export, ExportKind, JobCommand, Notice, Severity, ViewCommand, is_workspace};
use crate::view::{Layer, Origin};
use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Key, Modifiers, RichText, Ui};
use std::path::PathBuf;

/// Least height of the choices of an export, points.
const LEAST_FORM_PT: f32 = 64.0;

/// The open dialog, and the system's file dialog that may be open beside it.
#[derive(Default)]
pub struct Dialogs {
    dialog: Option<Dialog>,
    path: String,
    export: ExportForm,
    view_export: Option<ViewExport>,
    /// Number of dialogs that were opened: each begins at the top of its contents.
    opened: usize,
    /// Height of the path's row and of what lies below it in the last frame, points.
    path_row_pt: f32,
    system_dialog: SystemDialog,
    /// Whether the field takes the focus in the next frame.
    focus: Option<Focus>,
    /// Whether the dialog was opened after the last frame.
    is_new: bool,
    /// The widget that had the focus before the dialog opened, and has it again afterwards.
    focus_before: Option<egui::Id>,
    /// Whether the path is confirmed without a key or a button, because the file was dropped.
    is_confirmed: bool,
    /// The file that exists and that the next confirmation replaces.
    replaced: Option<PathBuf>,
    /// What is wrong with the path, until the path is changed.
    problem: String,
    /// The work that was confirmed and is under way. The dialog stays open until the work has ended, so that an error leaves
    /// dialog and text as they are.
    waiting: Option<Waiting>,
}

/// What is selected in the field that takes the focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Focus {
    /// The name of the file: what is typed replaces a proposed name.
    Name,
    /// What was selected before.
    AsBefore,
}

/// The work that an open dialog waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Waiting {
    /// A file is being read; the number is the id of the newest notice before.
    Reading(u64),
    /// The result is being computed, which is written next.
    Analysis,
    /// A view is being drawn, which is written next.
    Drawing,
    /// A file or a folder is being written.
    Writing,
}

impl Waiting {
    /// What the dialog says meanwhile.
    const fn text(self) -> &'static str {
        match self {
            Self::Reading(_) => "Reading\u{2026}",
            Self::Analysis => {
                "The analysis is under way: the file is written when it has ended. Escape gives that up."
            }
            Self::Drawing | Self::Writing => {
                "Writing\u{2026} Escape closes this window, and the file is written."
            }
        }
    }
}

impl Dialogs {
    /// Opens a dialog.
    pub fn open(&mut self, dialog: Dialog) {
        (self.dialog, self.export.options.force) = (Some(dialog), false);
        self.opened += 1;
        self.focus = Some(Focus::Name);
        self.waiting = None;
        (self.export.options.layer, self.export.options.region) = (None, None);
        self.problem.clear();
        self.is_new = true;
        self.path.clear();
        self.replaced = None;
    }

    /// Opens the export dialog for a file of one layer.
    pub fn open_layer_export(&mut self, cx: &PanelContext, layer: Layer, file: LayerFile) {
        self.open(Dialog::Export);
        (self.export.kind, self.export.options.layer) = (ExportKind::Layer, Some(layer));
        self.path = proposed_layer_path(layer, file, cx).display().to_string();
    }

    /// Opens the export dialog for the pixels of a set, as a mask, a table or points.
    pub fn open_pixels_export(&mut self, cx: &PanelContext, pixels: PixelSet) {
        self.open(Dialog::Export);
        let region = match pixels {
            PixelSet::Marked => None,
            PixelSet::Region(region) => Some(region),
            PixelSet::SelectedRegion => cx.state.selected_region(),
        };
        (self.export.kind, self.export.options.region) = (ExportKind::Selection, region);
        self.path = proposed_pixels_path(region, cx).display().to_string();
    }

    /// Whether a dialog is open. An open dialog owns the keyboard: no key reaches the panels.
    pub fn is_open(&self) -> bool {
        self.dialog.is_some()
    }

    /// The title of the open dialog, where that asks for a file other than a photograph.
    pub fn asked_file(&self) -> Option<&'static str> {
        let dialog = self.dialog.filter(|dialog| *dialog != Dialog::Open && dialog.reads())?;
        Some(dialog.title())
    }

    /// Takes a file that was dropped on the window, where the open dialog asks for a file other than a photograph: as if its path had been
    /// typed and confirmed. Returns whether there was such a file.
    pub fn take_dropped(&mut self, ctx: &egui::Context) -> bool {
        if self.asked_file().is_none() {
            return false;
        }
        let first = |input: &egui::InputState| Some(input.raw.dropped_files.first()?.path().to_path_buf());
        let Some(path) = ctx.input(first) else { return false };
        self.path = path.display().to_string();
        self.problem.clear();
        self.is_confirmed = true;
        true
    }

    /// Closes the dialog, and gives the focus back.
    pub fn close(&mut self, ctx: &egui::Context) {
        (self.dialog, self.waiting) = (None, None);
        self.problem.clear();
        if let Some(id) = self.focus_before.take() {
            ctx.memory_mut(|memory| memory.request_focus(id));
        }
    }

    /// Closes the open dialog on Escape, before Escape clears the selection.
    pub fn close_on_escape(&mut self, ctx: &egui::Context) {
        if self.dialog.is_some() && ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            self.close(ctx);
        }
    }

    /// Shows the open dialog. Returns the view to draw, when the export of a view was confirmed.
    pub fn show(&mut self, ui: &Ui, cx: &mut PanelContext) -> Option<ViewExport> {
        self.take_chosen_path(ui);
        self.take_outcome(ui, cx);
        let dialog = self.dialog?;
        if std::mem::take(&mut self.is_new) {
            self.focus_before = ui.memory(egui::Memory::focused);
            self.propose_path(dialog, cx);
        }
        let mut open = true;
        let window = egui::Window::new(dialog.title()).open(&mut open);
        let shown = dialog_room::placed(window, ui.ctx(), dialog_room::PATH_ROW_PT).show(ui.ctx(), |ui| {
            let room = dialog_room::height(ui.ctx());
            dialog_room::scrolling(ui, &format!("dialog {}", self.opened), room, |ui| {
                self.contents(ui, dialog, cx, room)
            })
        });
        if let Some(shown) = &shown {
            // Tab stays inside the dialog.
            ui.ctx().memory_mut(|memory| memory.set_modal_layer(shown.response.layer_id));
        }
        if !open || shown.and_then(|shown| shown.inner).unwrap_or(false) {
            self.close(ui.ctx());
        }
        self.view_export.take()
    }

    /// Shows what a dialog holds in `room` points of height: the choices of an export scroll over the path. Returns whether the dialog is done.
    fn contents(&mut self, ui: &mut Ui, dialog: Dialog, cx: &mut PanelContext, room: f32) -> bool {
        if dialog == Dialog::Export {
            let form_pt = (room - self.path_row_pt - ui.spacing().item_spacing.y).max(LEAST_FORM_PT);
            dialog_room::scrolling(ui, &format!("export {}", self.opened), form_pt, |ui| {
                self.export_form(ui, cx);
            });
        }
        let top = ui.cursor().top();
        self.path_row(ui, dialog, cx);
        self.path_row_pt = ui.cursor().top() - top;
        if let Dialog::OpenElsewhere(kind) = dialog {
            open_form::elsewhere_note(ui, cx, kind);
        }
        dialog == Dialog::Open && open_form::samples_and_recent(ui, cx)
    }

    /// Proposes a path in a dialog that writes, where none was proposed when the dialog was opened.
    fn propose_path(&mut self, dialog: Dialog, cx: &PanelContext) {
        let kind = match dialog {
            Dialog::Export => self.export.kind,
            Dialog::SaveParameters => ExportKind::Parameters,
            Dialog::SaveWorkspace => ExportKind::Workspace,
            Dialog::Open | Dialog::LoadParameters | Dialog::OpenWorkspace | Dialog::OpenElsewhere(_) => {
                return;
            }
        };
        if self.path.is_empty() {
            self.path = proposed_path(kind, cx).display().to_string();
        }
    }

    /// Shows the kinds of export with their options, and proposes a path for a kind that was chosen.
    fn export_form(&mut self, ui: &mut Ui, cx: &PanelContext) {
        if self.export.show(ui, cx) {
            self.problem.clear();
            self.waiting.take_if(|waiting| *waiting == Waiting::Analysis);
            self.path = proposed_path(self.export.kind, cx).display().to_string();
            self.focus = Some(Focus::Name);
        }
    }

    /// Shows the path's field, the buttons, and what is under way or went wrong.
    fn path_row(&mut self, ui: &mut Ui, dialog: Dialog, cx: &mut PanelContext) {
        let mut confirmed = std::mem::take(&mut self.is_confirmed);
        let has_result = self.waiting == Some(Waiting::Analysis) && !cx.state.awaits_result();
        if has_result {
            (self.waiting, confirmed) = (None, true);
        }
        ui.horizontal_wrapped(|ui| {
            let label = ui.label("Path");
            let field =
                egui::TextEdit::singleline(&mut self.path).desired_width(dialog_room::path_width(ui.ctx()));
            // The id does not depend on the rows above, which differ between kinds of export.
            let field = field.id(egui::Id::unique("path of the dialog"));
            let response = ui.add(field.hint_text("path of a file")).labelled_by(label.id);
            if response.changed() {
                self.problem.clear();
                self.waiting.take_if(|waiting| *waiting == Waiting::Analysis);
            }
            if let Some(focus) = self.focus.take() {
                response.request_focus();
                if focus == Focus::Name {
                    select_name(ui, response.id, &self.path);
                }
            }
            confirmed |= response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            let browse = ui.add_enabled(!self.system_dialog.is_open(), egui::Button::new("Browse\u{2026}"));
            if browse.on_hover_text("The system's own dialog, where it has one.").clicked() {
                self.browse(ui.ctx(), dialog);
            }
            let ready = !self.path.trim().is_empty() && self.waiting.is_none();
            confirmed |= ui
                .add_enabled(
                    ready,
                    egui::Button::new(RichText::new(dialog.button()).color(cx.palette.accent)),
                )
                .clicked();
            confirmed &= ready;
        });
        if let Some(waiting) = self.waiting {
            ui.label(RichText::new(waiting.text()).color(cx.palette.secondary));
        }
        if dialog == Dialog::Export && cx.state.lacks_result() && !cx.state.shows_pinned() {
            analyze_offer(ui, cx);
        }
        if !self.problem.is_empty() {
            ui.add(egui::Label::new(RichText::new(&self.problem).color(cx.palette.error)).wrap());
        }
        if confirmed {
            self.confirm(dialog, cx);
        }
    }

    /// Does what the dialog is for with the typed path, or says what is wrong with the path. The dialog closes when the work has ended well.
    fn confirm(&mut self, dialog: Dialog, cx: &mut PanelContext) {
        let path = confirmed_path(&self.path, dialog, self.export.kind);
        if let Some(problem) = problem_of(dialog, &path, cx.state) {
            return self.fail(problem);
        }
        if !dialog.reads() && path.is_file() && self.replaced.as_ref() != Some(&path) {
            let (shown, button) = (path.display(), dialog.button());
            self.fail(format!("{shown}: exists; {button} once more replaces it, or choose another name"));
            self.replaced = Some(path);
            return;
        }
        self.problem.clear();
        let is_of_result = dialog == Dialog::Export && self.export.kind.is_of_result(&self.export.options);
        if is_of_result && cx.state.awaits_result() {
            self.waiting = Some(Waiting::Analysis);
            return;
        }
        self.waiting =
            Some(if dialog.reads() { Waiting::Reading(newest_notice(cx)) } else { Waiting::Writing });
        cx.send(match dialog {
            Dialog::Open if is_workspace(&path) => JobCommand::OpenWorkspace(path),
            Dialog::Open if path.is_dir() => JobCommand::OpenFolders(vec![Origin::File(path)]),
            Dialog::Open => JobCommand::Open(Origin::File(path)),
            Dialog::LoadParameters => JobCommand::LoadParams(path),
            Dialog::OpenWorkspace => JobCommand::OpenWorkspace(path),
            Dialog::OpenElsewhere(kind) => JobCommand::OpenElsewhere(kind, path),
            Dialog::SaveParameters => JobCommand::Export(ExportKind::Parameters.to(path)),
            Dialog::SaveWorkspace => JobCommand::Export(ExportKind::Workspace.to(path)),
            Dialog::Export if self.export.kind == ExportKind::View => {
                self.waiting = Some(Waiting::Drawing);
                self.view_export =
                    Some(ViewExport { pane: self.export.view, size_px: self.export.size_px, path });
                return;
            }
            Dialog::Export => JobCommand::Export(Export {
                kind: self.export.kind,
                path,
                options: self.export.options.clone(),
            }),
        });
    }

    /// Says in the dialog what failed. Everything that was entered stays, so that it can be corrected; a path that was to be replaced is to be
    /// confirmed anew.
    fn fail(&mut self, problem: String) {
        self.replaced = None;
        (self.problem, self.focus, self.waiting) = (problem, Some(Focus::AsBefore), None);
    }

    /// Takes a view that was drawn: it is written, or the dialog says why it was not drawn. Where the dialog was closed meanwhile, a
    /// notice says so.
    pub fn take_drawn(&mut self, drawn: Result<Export, String>, cx: &mut PanelContext) {
        let is_awaited = self.waiting == Some(Waiting::Drawing);
        match drawn {
            Ok(export) => {
                if is_awaited {
                    self.waiting = Some(Waiting::Writing);
                }
                cx.send(JobCommand::Export(export));
            }
            Err(problem) if is_awaited => self.fail(problem),
            Err(problem) => cx.send(ViewCommand::Notify(Severity::Error, problem)),
        }
    }

    /// Closes the dialog when the confirmed work has ended well. Where the work failed, the dialog stays, and the error moves from the notices
    /// into the dialog.
    fn take_outcome(&mut self, ui: &Ui, cx: &mut PanelContext) {
        let jobs = cx.state.jobs;
        let notices = &cx.state.notices;
        let failure: Option<&Notice> = match self.waiting {
            Some(Waiting::Reading(before)) if jobs.reading.is_none() => {
                notices.iter().find(|notice| notice.severity == Severity::Error && notice.id > before)
            }
            Some(Waiting::Writing) if jobs.export.is_none() => {
                notices.iter().find(|notice| Some(notice.id) == jobs.failed_export)
            }
            _ => return,
        };
        match failure {
            Some(error) => {
                self.fail(error.text.clone());
                cx.send(ViewCommand::Dismiss(error.id));
            }
            None => self.close(ui.ctx()),
        }
    }

    /// Opens the system's file dialog where the typed path leads.
    fn browse(&mut self, ctx: &egui::Context, dialog: Dialog) {
        let wanted = match dialog {
            Dialog::Export if self.export.kind.is_folder() => Wanted::Folder,
            _ if dialog.reads() => Wanted::FileToRead,
            _ => Wanted::FileToWrite,
        };
        self.problem.clear();
        self.system_dialog.open(ctx, typed_path(&self.path).unwrap_or_default(), wanted);
    }

    /// Takes the path that was chosen in the system's dialog.
    fn take_chosen_path(&mut self, ui: &Ui) {
        let Some(answer) = self.system_dialog.take_answer(ui.ctx()) else { return };
        self.focus = Some(Focus::Name);
        match answer {
            Answer::Chosen(path) => {
                self.path = path.display().to_string();
                // The system's dialog has asked whether to replace a file.
                self.replaced = Some(path);
            }
            Answer::NotShown => {
                "This system shows no file dialog. Type or paste a path, or drop a file on the window."
                    .clone_into(&mut self.problem);
            }
            Answer::Canceled => {}
        }
        ui.ctx().request_repaint();
    }
}

/// Shows that the present parameters have no result, and the button that analyzes; the button of the status line is under the dialog.
fn analyze_offer(ui: &mut Ui, cx: &mut PanelContext) {
    ui.horizontal_wrapped(|ui| {
        let button = RichText::new(ANALYZE_NOW).color(cx.palette.accent);
        let tip = "Analyze the photograph with the present parameters (F5).";
        if ui.button(button).on_hover_text(tip).clicked() {
            cx.act(Action::Analyze);
        }
        ui.label(RichText::new("The present parameters have no result yet.").color(cx.palette.secondary));
    });
}

/// Selects the name of the file in a field that holds a path.
fn select_name(ui: &Ui, field: egui::Id, path: &str) {
    let mut state = TextEditState::load(ui.ctx(), field).unwrap_or_default();
    let [first, last] = file_name_span(path).map(CCursor::new);
    state.cursor.set_char_range(Some(CCursorRange::two(first, last)));
    state.store(ui.ctx(), field);
}

/// The id of the newest notice; 0 without a notice.
fn newest_notice(cx: &PanelContext) -> u64 {
    cx.state.notices.iter().map(|notice| notice.id).max().unwrap_or(0)
}
