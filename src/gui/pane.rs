//! The panels by name. Their drawing and their first arrangement are rows of a table in `dock`.

use serde::{Deserialize, Serialize};

/// Makes [`Pane`], [`Pane::ALL`] and the titles.
macro_rules! panes {
    ($($(#[$attribute:meta])* $pane:ident = $title:literal;)+) => {
        /// A panel of the window.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
        pub enum Pane {
            $($(#[$attribute])* $pane,)+
        }

        impl Pane {
            /// All panels, in the order of the View menu.
            pub const ALL: [Self; [$(stringify!($pane)),+].len()] = [$(Self::$pane),+];

            /// The name on the panel's tab.
            pub const fn title(self) -> &'static str {
                match self {
                    $(Self::$pane => $title,)+
                }
            }
        }
    };
}

panes! {
    /// The photograph and its layers.
    Image = "Image";
    /// The color space.
    #[serde(alias = "Colours")]
    Colors = "Color space";
    /// The dichromatic plane of one region.
    Plane = "Plane";
    /// Body, surface and ε along a line.
    Profile = "Profile";
    /// The sphere, light and camera of section 3.
    Geometry = "Geometry";
    /// Sliders and switches.
    Parameters = "Parameters";
    /// The regions as a table.
    Regions = "Regions";
    /// Statistics of the selection.
    Selection = "Selection";
    /// Pinned and newest result.
    Compare = "Compare";
    /// The steps of undo and redo in words.
    History = "History";
    /// The decisions in their order, and the cursor among them.
    Timeline = "Timeline";
    /// The verdict on what is hovered, selected, marked or stepped to, with values and limits, and its history.
    #[serde(alias = "Why")]
    Inspector = "Inspector";
    /// Values at the cursor.
    Watch = "Watch";
    /// Conditions that stop the cursor.
    Breakpoints = "Breakpoints";
}
