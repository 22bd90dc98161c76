//! One key of the list of keys.

use crate::gui::action::Action;
use egui::{Key, KeyboardShortcut, Modifiers};

/// A key, the action of the key, and a description of the action.
pub struct Shortcut {
    /// The group of the help that the key is listed in.
    pub group: &'static str,
    /// Modifiers and key.
    pub keys: KeyboardShortcut,
    /// The action that the key starts.
    pub action: Action,
    /// The effect of the action, for the help.
    pub description: &'static str,
}

impl Shortcut {
    /// A key with modifiers.
    pub const fn new(
        group: &'static str,
        modifiers: Modifiers,
        key: Key,
        action: Action,
        description: &'static str,
    ) -> Self {
        Self { group, keys: KeyboardShortcut::new(modifiers, key), action, description }
    }
}
