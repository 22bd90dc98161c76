//! What a panel may see, and where it leaves its commands.

use super::theme::Tones;
use crate::app::{Command, State};

/// Handed to every panel, every frame.
pub struct PanelContext<'a> {
    /// All there is to show.
    pub state: &'a State,
    /// The colors of the theme.
    pub tones: &'a Tones,
    /// The graphics device, where there is one.
    pub gpu: Option<&'a egui_wgpu::RenderState>,
    /// Whether a view is to be drawn without its toolbar: it is a picture, not an instrument.
    pub bare: bool,
    /// What the panel asks for.
    pub out: &'a mut Vec<Command>,
}

impl PanelContext<'_> {
    /// Leaves a command.
    pub fn send(&mut self, command: impl Into<Command>) {
        self.out.push(command.into());
    }
}
