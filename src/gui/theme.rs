//! The look of the window: neutral grays, so that colors in images are not misjudged, one accent color, three font sizes.

use crate::view::Theme;
use egui::epaint::text::{FontInsert, FontPriority, InsertFontFamily};
use egui::{Color32, CornerRadius, FontFamily, FontId, Stroke, Style, TextStyle, Visuals, vec2};
use std::path::Path;
use std::sync::Arc;

/// The colors of a theme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ThemeColors {
    /// Background of images.
    pub background: Color32,
    /// Background of panels and controls.
    pub panel: Color32,
    /// Background of fields, buttons and slider rails.
    pub well: Color32,
    /// Boxes that can be checked, rails and handles of sliders, and scroll bars.
    pub mark: Color32,
    /// Separators and borders.
    pub line: Color32,
    /// Text and values.
    pub text: Color32,
    /// Secondary text: units, labels, inactive values.
    pub secondary: Color32,
    /// Cursor, selection and primary action.
    pub accent: Color32,
    /// Values that are bad: a region that does not fit, a result that is worse than the photograph.
    pub warning: Color32,
    /// Messages about errors.
    pub error: Color32,
}

impl ThemeColors {
    /// The colors of `theme`.
    pub fn of(theme: Theme) -> Self {
        match theme {
            Theme::Dark => Self {
                background: Color32::from_rgb(0x17, 0x18, 0x1A),
                panel: Color32::from_rgb(0x1F, 0x20, 0x22),
                well: Color32::from_rgb(0x2A, 0x2B, 0x2E),
                mark: Color32::from_rgb(0x6C, 0x6F, 0x74),
                line: Color32::from_rgb(0x30, 0x32, 0x36),
                text: Color32::from_rgb(0xE2, 0xE4, 0xE8),
                secondary: Color32::from_rgb(0xA4, 0xA8, 0xAE),
                accent: Color32::from_rgb(0xE8, 0xA3, 0x3D),
                warning: Color32::from_rgb(0xFF, 0x8A, 0x65),
                error: Color32::from_rgb(0xFF, 0x86, 0x7C),
            },
            Theme::Light => Self {
                background: Color32::from_rgb(0xDC, 0xDC, 0xDC),
                panel: Color32::from_rgb(0xF2, 0xF2, 0xF2),
                well: Color32::from_rgb(0xE2, 0xE2, 0xE2),
                mark: Color32::from_rgb(0x8A, 0x8B, 0x8E),
                line: Color32::from_rgb(0xC4, 0xC4, 0xC6),
                text: Color32::from_rgb(0x1E, 0x1F, 0x22),
                secondary: Color32::from_rgb(0x56, 0x59, 0x5E),
                accent: Color32::from_rgb(0x82, 0x4B, 0x00),
                warning: Color32::from_rgb(0x9E, 0x34, 0x00),
                error: Color32::from_rgb(0xA6, 0x20, 0x16),
            },
        }
    }
}

/// Opacity of the accent color behind what is selected: a row, a pressed button, the area of selected text.
const SELECTED_OPACITY: f32 = 0.2;

/// Font size in panels, points.
pub const BODY_PT: f32 = 13.0;
/// Font size of notes, ticks and tables, points.
pub const SMALL_PT: f32 = 11.5;
/// Font size of the titles of dialogs and of the start screen, points.
pub const TITLE_PT: f32 = 15.0;

/// The semibold font of headings.
pub fn heading_font(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(SEMIBOLD.into()))
}

/// The font of subscripts: letters and digits of the interface's font, smaller and below the line. An underscore has no width.
pub fn subscript_font(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(SUBSCRIPT.into()))
}

/// Name of the interface's font: Inter with tabular figures, reduced to Latin, Greek, Cyrillic and signs.
const REGULAR: &str = "Inter";
/// Name of the font of headings.
const SEMIBOLD: &str = "Inter SemiBold";
/// Name of the font of subscripts.
const SUBSCRIPT: &str = "Inter Subscript";

/// Files with fonts for scripts that the bundled fonts lack, on Linux, macOS and Windows. The first of each group that exists is
/// loaded.
const FURTHER_FONTS: [&[&str]; 2] = [
    &[
        "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/google-noto-cjk/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/google-noto-sans-cjk-fonts/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
        "/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc",
        "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
        "/System/Library/Fonts/Hiragino Sans GB.ttc",
        "/System/Library/Fonts/PingFang.ttc",
        "C:\\Windows\\Fonts\\msyh.ttc",
    ],
    &[
        "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/System/Library/Fonts/Supplemental/Arial Unicode.ttf",
        "C:\\Windows\\Fonts\\segoeui.ttf",
    ],
];

/// Whether a text has characters that the bundled fonts may lack: characters beyond Latin, Greek, Cyrillic and punctuation.
pub fn needs_further_fonts(text: &str) -> bool {
    text.chars().any(|letter| letter > '\u{52f}' && !('\u{1e00}'..='\u{206f}').contains(&letter))
}

/// Adds fonts of the system behind the bundled fonts, so that names in other scripts are readable. Without such a font, egui
/// shows boxes.
pub fn load_further_fonts(ctx: &egui::Context) {
    for file in
        FURTHER_FONTS.into_iter().filter_map(|group| group.iter().find(|file| Path::new(file).is_file()))
    {
        let Ok(bytes) = std::fs::read(file) else { continue };
        let families = [FontFamily::Proportional, FontFamily::Monospace]
            .map(|family| InsertFontFamily { family, priority: FontPriority::Lowest });
        ctx.add_font(FontInsert::new(file, egui::FontData::from_owned(bytes), families.to_vec()));
    }
}

/// Loads the bundled fonts. Signs that the interface's font lacks come from egui's own fonts.
pub fn load_fonts(ctx: &egui::Context) {
    let mut fonts = egui::FontDefinitions::default();
    for (name, bytes) in [
        (REGULAR, &include_bytes!("../../assets/fonts/Inter-Regular.ttf")[..]),
        (SEMIBOLD, &include_bytes!("../../assets/fonts/Inter-SemiBold.ttf")[..]),
        (SUBSCRIPT, &include_bytes!("../../assets/fonts/Inter-Subscript.ttf")[..]),
    ] {
        fonts.font_data.insert(name.to_owned(), Arc::new(egui::FontData::from_static(bytes)));
    }
    let mut fallbacks = fonts.families.get(&FontFamily::Proportional).cloned().unwrap_or_default();
    fallbacks.push("Hack".to_owned());
    for (family, names) in [
        (FontFamily::Proportional, &[REGULAR][..]),
        (FontFamily::Name(SEMIBOLD.into()), &[SEMIBOLD, REGULAR]),
        (FontFamily::Name(SUBSCRIPT.into()), &[SUBSCRIPT, REGULAR]),
    ] {
        let names = names.iter().map(|&name| name.to_owned()).chain(fallbacks.clone());
        fonts.families.insert(family, names.collect());
    }
    ctx.set_fonts(fonts);
}

/// Applies the look of `theme` to the whole context.
pub fn apply(ctx: &egui::Context, theme: Theme) {
    let palette = ThemeColors::of(theme);
    let base = if theme == Theme::Dark { egui::Theme::Dark } else { egui::Theme::Light };
    ctx.set_theme(base);
    ctx.all_styles_mut(|style| apply_to_style(style, theme, &palette));
}

/// Sets colors, fonts and spacing of a style.
fn apply_to_style(style: &mut Style, theme: Theme, palette: &ThemeColors) {
    style.visuals = visuals(theme, palette);
    let font = |size| FontId::new(size, FontFamily::Proportional);
    style.text_styles = [
        (TextStyle::Small, font(SMALL_PT)),
        (TextStyle::Body, font(BODY_PT)),
        (TextStyle::Button, font(BODY_PT)),
        (TextStyle::Heading, heading_font(TITLE_PT)),
        (TextStyle::Monospace, FontId::new(BODY_PT - 0.5, FontFamily::Monospace)),
    ]
    .into();
    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(8.0, 4.0);
    spacing.button_padding = vec2(8.0, 2.0);
    spacing.interact_size = vec2(24.0, 20.0);
    spacing.slider_rail_height = 4.0;
    spacing.icon_width = 14.0;
    spacing.icon_width_inner = 8.0;
    spacing.tooltip_width = 340.0;
    spacing.combo_width = 64.0;
    // A new list is at most so high; that of the layers is higher than egui's 400 points.
    spacing.default_area_size.y = 640.0;
    style.interaction.selectable_labels = false;
    style.interaction.tooltip_delay = 0.4;
    // Widgets change without animations, so that pictures of tests do not depend on the time.
    style.animation_time = 0.0;
}

/// The colors of egui's widgets.
fn visuals(theme: Theme, palette: &ThemeColors) -> Visuals {
    let mut visuals = if theme == Theme::Dark { Visuals::dark() } else { Visuals::light() };
    visuals.override_text_color = None;
    visuals.panel_fill = palette.panel;
    visuals.window_fill = palette.panel;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.extreme_bg_color = palette.well;
    visuals.faint_bg_color = palette.well.gamma_multiply(0.5);
    visuals.hyperlink_color = palette.accent;
    visuals.error_fg_color = palette.error;
    visuals.warn_fg_color = palette.accent;
    visuals.weak_text_color = Some(palette.secondary);
    visuals.selection.bg_fill = palette.accent.gamma_multiply(SELECTED_OPACITY);
    visuals.selection.stroke = Stroke::new(1.0, palette.text);
    visuals.slider_trailing_fill = true;
    visuals.menu_corner_radius = CornerRadius::same(4);
    visuals.window_corner_radius = CornerRadius::same(4);
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, palette.line);
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, palette.text);
    for (widget, fill) in [
        (&mut widgets.inactive, palette.well),
        (&mut widgets.hovered, palette.line),
        (&mut widgets.active, palette.line),
        (&mut widgets.open, palette.line),
    ] {
        widget.bg_fill = palette.mark;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.0, palette.text);
        widget.corner_radius = CornerRadius::same(3);
        widget.expansion = 0.0;
    }
    // Keyboard focus is drawn with the stroke of `hovered`.
    widgets.hovered.bg_stroke = Stroke::new(1.0, palette.secondary);
    visuals
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_other_scripts_need_further_fonts() {
        for name in
            ["cups.png", "caf\u{e9} \u{2013} \u{201c}a\u{201d}.png", "\u{447}\u{430}\u{448}\u{43a}\u{430}"]
        {
            assert!(!needs_further_fonts(name), "{name}");
        }
        for name in ["\u{8336}\u{676f}.png", "\u{5db}\u{5d5}\u{5e1}", "\u{ceb5}"] {
            assert!(needs_further_fonts(name), "{name}");
        }
    }

    /// Relative luminance of a color by WCAG 2.
    fn luminance(color: Color32) -> f32 {
        let [r, g, b] = [color.r(), color.g(), color.b()].map(egui::ecolor::linear_f32_from_gamma_u8);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// Contrast of two colors by WCAG 2.
    fn contrast_of(a: Color32, b: Color32) -> f32 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn text_has_enough_contrast_on_every_ground_in_both_themes() {
        for theme in [Theme::Dark, Theme::Light] {
            let colors = ThemeColors::of(theme);
            let texts = [colors.text, colors.secondary, colors.accent, colors.warning, colors.error];
            let selected = colors.panel.blend(visuals(theme, &colors).selection.bg_fill);
            let grounds = [colors.panel, colors.background, colors.well, selected];
            for (text, ground) in
                (0..texts.len()).flat_map(|text| (0..grounds.len()).map(move |ground| (text, ground)))
            {
                let contrast = contrast_of(texts[text], grounds[ground]);
                assert!(contrast >= 4.5, "{theme:?}: text {text} on ground {ground}: {contrast}");
            }
            assert!(contrast_of(colors.text, colors.line) >= 4.5, "{theme:?}: text on a hovered button");
            let marks = [(colors.mark, colors.panel), (colors.text, colors.mark)];
            for (mark, ground) in marks {
                assert!(contrast_of(mark, ground) >= 3.0, "{theme:?}: {mark:?} on {ground:?}");
            }
        }
    }
}
