//! Words of the paper that a newcomer meets, each with a card: a small drawn skewed T with the part that the word names, and a
//! sentence or two.

use super::theme::{SMALL_PT, ThemeColors, heading_font};
use super::widgets::with_subscripts;
use egui::{Color32, Painter, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, pos2, vec2};

/// A word with a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// The unit of all intensities.
    Counts,
    /// The line of body reflection.
    MatteLine,
    /// The line of surface reflection.
    HighlightLine,
    /// The slab of colors around the dichromatic plane.
    Slice,
    /// A region in the making.
    Hypothesis,
    /// The taking of a pixel by a hypothesis.
    Claim,
    /// Whether the model explains a region.
    Holds,
    /// m_b.
    BodyAmount,
    /// m_s.
    SurfaceAmount,
    /// ε.
    Epsilon,
}

impl Term {
    /// All terms.
    pub const ALL: [Self; 10] = [
        Self::Counts,
        Self::MatteLine,
        Self::HighlightLine,
        Self::Slice,
        Self::Hypothesis,
        Self::Claim,
        Self::Holds,
        Self::BodyAmount,
        Self::SurfaceAmount,
        Self::Epsilon,
    ];

    /// The word.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Counts => "counts",
            Self::MatteLine => "matte line",
            Self::HighlightLine => "highlight line",
            Self::Slice => "slice",
            Self::Hypothesis => "hypothesis",
            Self::Claim => "claim",
            Self::Holds => "holds",
            Self::BodyAmount => "m_b, amount of body reflection",
            Self::SurfaceAmount => "m_s, amount of surface reflection",
            Self::Epsilon => "\u{3b5}, distance from the plane",
        }
    }

    /// What the word means, in a sentence or two, with the section of the paper.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Counts => {
                "The unit of light: proportional to the light that the camera measured, 255 at full scale. \
                 A tone curve of the file has been undone."
            }
            Self::MatteLine => {
                "An object without highlights has one color at different brightness. In the color cube its pixels lie \
                 on a line through black, along C_b (section 3.1)."
            }
            Self::HighlightLine => {
                "A highlight adds the color of the light. Its pixels leave the matte line along C_s; both lines \
                 together look like a skewed T (section 3.1)."
            }
            Self::Slice => {
                "Both lines span the dichromatic plane. Colors within a few \u{3c3}0 of the plane are in the slice and \
                 may belong to the object (section 5.4.2)."
            }
            Self::Hypothesis => {
                "A guess that some pixels are one object, with its line or plane. It grows, is merged or is given up; \
                 what is left at the end is a region (section 5.3)."
            }
            Self::Claim => {
                "A hypothesis takes a pixel, because the pixel's color lies inside its cylinder or slice \
                 (sections 5.3.2, 5.4.2)."
            }
            Self::Holds => {
                "A region holds where one skewed T explains its colors up to the noise. Where it does not, its plane is \
                 not used, and the pixels are split locally (section 6)."
            }
            Self::BodyAmount => {
                "How much light comes back out of the body of the object, along C_b (equation 13). In the result: \
                 after surface reflection below the noise was counted as none."
            }
            Self::SurfaceAmount => {
                "How much light is reflected at the surface, along C_s (equation 13): the highlight. In the result it \
                 is 0 where it is below the noise."
            }
            Self::Epsilon => {
                "What neither body nor surface reflection explains: the distance of the color from the dichromatic \
                 plane (section 6)."
            }
        }
    }

    /// Shows the card while the pointer rests on a widget. No other tooltip may belong to the widget.
    pub fn card(self, response: Response, palette: &ThemeColors) -> Response {
        let palette = *palette;
        response.on_hover_ui(move |ui| self.show(ui, &palette))
    }

    /// The contents of the card.
    fn show(self, ui: &mut Ui, palette: &ThemeColors) {
        ui.set_max_width(260.0);
        let mut title = with_subscripts(self.title(), 13.0, palette.text);
        for section in &mut title.sections {
            if section.format.font_id.family == egui::FontFamily::Proportional {
                section.format.font_id = heading_font(13.0);
            }
        }
        ui.label(title);
        let (rect, drawing) = ui.allocate_exact_size(vec2(240.0, 96.0), Sense::hover());
        drawing.widget_info(|| {
            let name = format!("drawing of: {}", self.title());
            egui::WidgetInfo::labeled(egui::accesskit::Role::Image, true, name)
        });
        self.draw(&ui.painter_at(rect), rect, palette);
        ui.label(with_subscripts(self.meaning(), SMALL_PT, palette.text));
    }

    /// Draws a skewed T with the part that the word names in the accent color.
    fn draw(self, painter: &Painter, rect: Rect, palette: &ThemeColors) {
        let drawing = Drawing { black: rect.left_bottom() + vec2(24.0, -18.0), painter, palette };
        let color = |parts: &[Self]| if parts.contains(&self) { palette.accent } else { palette.secondary };
        if matches!(self, Self::Slice | Self::Holds | Self::Claim) {
            drawing.slab();
        }
        drawing.points(self);
        drawing.line([0.0, 0.0], [150.0, 0.0], color(&[Self::MatteLine, Self::Hypothesis]));
        drawing.line([96.0, 0.0], [96.0, 60.0], color(&[Self::HighlightLine, Self::Hypothesis]));
        painter.circle(drawing.at([0.0, 0.0]), 3.0, palette.panel, Stroke::new(1.4, palette.secondary));
        drawing.text([-8.0, -14.0], "black", palette.secondary);
        match self {
            Self::BodyAmount => drawing.measure([0.0, -7.0], [96.0, -7.0]),
            Self::SurfaceAmount => drawing.measure([104.0, 0.0], [104.0, 40.0]),
            Self::Epsilon => drawing.measure([50.0, 0.0], [41.0, 24.0]),
            Self::Counts => {
                drawing.measure([0.0, -7.0], [150.0, -7.0]);
                drawing.text([140.0, -14.0], "255", palette.accent);
            }
            Self::MatteLine => drawing.text([100.0, -14.0], "C_b", palette.accent),
            Self::HighlightLine => drawing.text([118.0, 52.0], "C_s", palette.accent),
            _ => {}
        }
    }
}

/// A skewed T on the screen: the first axis along the matte line, the second along the highlight line.
struct Drawing<'a> {
    /// Position of black.
    black: Pos2,
    painter: &'a Painter,
    palette: &'a ThemeColors,
}

impl Drawing<'_> {
    /// Position of the amounts along both lines, points.
    fn at(&self, [body, surface]: [f32; 2]) -> Pos2 {
        self.black + vec2(body + 0.55 * surface, -surface - 0.12 * body)
    }

    fn line(&self, from: [f32; 2], to: [f32; 2], color: Color32) {
        self.painter.line_segment([self.at(from), self.at(to)], Stroke::new(1.8, color));
    }

    /// A length with a stroke at each end.
    fn measure(&self, from: [f32; 2], to: [f32; 2]) {
        let (a, b) = (self.at(from), self.at(to));
        let stroke = Stroke::new(1.8, self.palette.accent);
        let across = (b - a).normalized().rot90() * 4.0;
        self.painter.line_segment([a, b], stroke);
        for end in [a, b] {
            self.painter.line_segment([end - across, end + across], stroke);
        }
    }

    fn text(&self, at: [f32; 2], text: &str, color: Color32) {
        let galley = self.painter.layout_job(with_subscripts(text, SMALL_PT, color));
        let place = self.at(at);
        self.painter.galley(pos2(place.x, place.y - galley.size().y / 2.0), galley, color);
    }

    /// The slice as a translucent area around both lines.
    fn slab(&self) {
        let corners = [
            [-4.0, -6.0],
            [156.0, -6.0],
            [156.0, 6.0],
            [108.0, 8.0],
            [112.0, 66.0],
            [84.0, 66.0],
            [86.0, 7.0],
            [-4.0, 6.0],
        ];
        let stroke = Stroke::new(1.0, self.palette.accent);
        let corners: Vec<Pos2> = corners.into_iter().map(|corner| self.at(corner)).collect();
        self.painter.add(Shape::closed_line(corners, stroke));
    }

    /// Pixels near both lines; of a claim one is taken and one is not, and where the word is about the noise one lies away.
    fn points(&self, term: Term) {
        let matte = (0..12).map(|i| [12.0 + 11.5 * i as f32, if i % 2 == 0 { 2.0 } else { -2.0 }]);
        let highlight = (1..6).map(|i| [96.0 + if i % 2 == 0 { 3.0 } else { -3.0 }, 10.0 * i as f32]);
        for point in matte.chain(highlight) {
            self.painter.circle_filled(self.at(point), 1.7, self.palette.secondary);
        }
        match term {
            Term::Claim => {
                self.painter.circle_filled(self.at([72.0, 4.0]), 3.4, self.palette.accent);
                self.painter.circle_stroke(self.at([40.0, 36.0]), 3.4, Stroke::new(1.4, self.palette.text));
            }
            Term::Epsilon => {
                self.painter.circle_filled(self.at([41.0, 24.0]), 3.0, self.palette.text);
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_word_has_a_meaning_that_names_its_section_or_unit() {
        for term in Term::ALL {
            let meaning = term.meaning();
            let names_source = ["section", "equation", "255"].iter().any(|source| meaning.contains(source));
            assert!(names_source && meaning.ends_with('.'), "{term:?}: {meaning}");
        }
    }
}
