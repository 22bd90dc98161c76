//! The context of a panel: the state that it shows, and the commands that it sends.

use super::theme::Palette;
use crate::app::{Command, State};

/// The argument of every panel, made anew in every frame.
pub struct PanelContext<'a> {
    /// The state to show.
    pub state: &'a State,
    /// The colors of the theme.
    pub palette: &'a Palette,
    /// The graphics device, where there is one.
    pub gpu: Option<&'a egui_wgpu::RenderState>,
    /// Whether views are drawn without their toolbars, because they are exported as pictures.
    pub is_export: bool,
    /// The commands that panels have sent in this frame.
    pub commands: &'a mut Vec<Command>,
}

impl PanelContext<'_> {
    /// Sends a command, which is applied after the frame.
    pub fn send(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }
}
