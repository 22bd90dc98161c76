//! The context of a panel: the state to show, and the commands of the panel.

use super::action::Action;
use super::theme::ThemeColors;
use crate::app::{Command, State};

/// The argument of every panel; each frame has a new one.
pub struct PanelContext<'a> {
    /// The state to show.
    pub state: &'a State,
    /// The colors of the theme.
    pub palette: &'a ThemeColors,
    /// The graphics device; none without a graphics adapter.
    pub gpu: Option<&'a egui_wgpu::RenderState>,
    /// Whether the panel is drawn into a file: views then have no toolbars.
    pub is_export: bool,
    /// The commands that panels have sent in this frame.
    pub commands: &'a mut Vec<Command>,
    /// The actions of the window that panels have asked for in this frame: dialogs to open, panels to show.
    pub actions: &'a mut Vec<Action>,
}

impl PanelContext<'_> {
    /// Sends a command, which is applied after the frame.
    pub fn send(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    /// Asks for an action of the window, which is carried out in the next frame.
    pub fn act(&mut self, action: Action) {
        self.actions.push(action);
    }
}
