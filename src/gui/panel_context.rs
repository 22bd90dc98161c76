//! The context of a panel: the state to show, and the commands of the panel.

use super::action::Action;
use super::theme::ThemeColors;
use crate::app::{Command, State, ViewCommand};
use crate::view::Item;

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
    /// Whether an item of a panel is under the pointer in this frame.
    pub hovers: bool,
}

impl<'a> PanelContext<'a> {
    /// The context of a frame of the window, without a graphics device, that sends to `commands` and `actions`.
    pub fn new(
        state: &'a State,
        palette: &'a ThemeColors,
        commands: &'a mut Vec<Command>,
        actions: &'a mut Vec<Action>,
    ) -> Self {
        Self { state, palette, gpu: None, is_export: false, commands, actions, hovers: false }
    }

    /// Sends a command, which is applied after the frame.
    pub fn send(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    /// Tells that an item of the panel is under the pointer. Panels call this in every frame in which it is so: an item that no panel names
    /// is hovered no more.
    pub fn hover(&mut self, item: Item) {
        self.hovers = true;
        if self.state.hover != Some(item) {
            self.send(ViewCommand::Hover(Some(item)));
        }
    }

    /// Asks for an action of the window, which is carried out in the next frame.
    pub fn act(&mut self, action: Action) {
        self.actions.push(action);
    }
}

/// Whether an item of a panel was under the pointer in the last frame.
#[derive(Default)]
pub struct LastHover(bool);

impl LastHover {
    /// Forgets what was under the pointer, once the pointer is on another panel, on the menu bar or out of the window. To be called after
    /// the panels are shown.
    pub fn end(&mut self, cx: &mut PanelContext) {
        if std::mem::replace(&mut self.0, cx.hovers) && !cx.hovers {
            cx.send(ViewCommand::Hover(None));
        }
    }
}
