//! The system's own file dialog, where the system has one. The dialog runs on a thread of its own, so that a dialog that hangs does not stop the
//! window.

use super::task::Task;
use egui::Context;
use std::path::PathBuf;

/// A dialog that answers within this time was never shown, seconds.
const NOT_SHOWN_SECONDS: f64 = 0.3;

/// What a person is to choose.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// A file that exists.
    FileToRead,
    /// A file that is written.
    FileToWrite,
    /// A folder that is written.
    Folder,
}

/// How a dialog ended.
pub enum Answer {
    /// A path was chosen.
    Chosen(PathBuf),
    /// The dialog was closed without a choice.
    Canceled,
    /// The system has no dialog.
    NotShown,
}

/// The system's file dialog, which may be open.
#[derive(Default)]
pub struct SystemDialog {
    task: Option<Task<Option<PathBuf>>>,
    /// The time at which the dialog was asked for, seconds.
    asked_at: f64,
}

impl SystemDialog {
    /// Whether the dialog is open.
    pub fn is_open(&self) -> bool {
        self.task.is_some()
    }

    /// Opens the dialog in the folder of `start`, and proposes the name of `start` where something is to be written.
    pub fn open(&mut self, ctx: &Context, start: PathBuf, wanted: Wanted) {
        self.asked_at = ctx.input(|input| input.time);
        let ask = move || {
            let mut dialog = rfd::AsyncFileDialog::new();
            if let Some(parent) = start.parent().filter(|parent| parent.is_dir()) {
                dialog = dialog.set_directory(parent);
            }
            if let Some(name) = start.file_name().filter(|_| wanted != Wanted::FileToRead) {
                dialog = dialog.set_file_name(name.to_string_lossy());
            }
            let answer = pollster::block_on(async {
                match wanted {
                    Wanted::Folder => dialog.pick_folder().await,
                    Wanted::FileToWrite => dialog.save_file().await,
                    Wanted::FileToRead => dialog.pick_file().await,
                }
            });
            answer.map(|file| file.path().to_path_buf())
        };
        self.task = Task::start(ctx, "file dialog", ask);
    }

    /// The answer of a dialog that ended, once.
    pub fn take_answer(&mut self, ctx: &Context) -> Option<Answer> {
        let chosen = Task::take(&mut self.task)?;
        let waited = ctx.input(|input| input.time) - self.asked_at;
        Some(match chosen {
            Some(path) => Answer::Chosen(path),
            // Without a portal, the answer comes at once and is the same as that of a canceled dialog.
            None if waited < NOT_SHOWN_SECONDS => Answer::NotShown,
            None => Answer::Canceled,
        })
    }
}
