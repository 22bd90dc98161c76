//! The geometry panel: the sphere of section 3 with its light and camera, equations (3)–(11), figure 6, and where the selected region's
//! highlight leaves its matte line.

mod curves;
mod diagram;

use super::theme::SMALL_PT;
use super::{PanelContext, widgets};
use crate::app::ViewCommand;
use crate::raster::RegionId;
use crate::reflection::photometry::{SphereGeometry, q_infinity};
use crate::reflection::{SpherePoint, phase_of_q};
use crate::view::{
    GeometrySettings, RegionPlane, ResultSnapshot, SPHERE_DISTANCES, meeting_share, region_plane,
};
use egui::{Grid, Label, RichText, ScrollArea, Slider, Ui, vec2};
use std::sync::Arc;

/// Width from which the drawings stand beside one another, points.
const BESIDE_PT: f32 = 430.0;
/// Smallest and largest height of a drawing, points.
const LEAST_DRAWING_PT: f32 = 110.0;
const MOST_DRAWING_PT: f32 = 220.0;

/// The geometry panel, with what was computed last.
#[derive(Default)]
pub struct GeometryPanel {
    /// The points of the sphere, and the settings that they were made for.
    points: Option<(GeometrySettings, Vec<SpherePoint>)>,
    /// The plane of the selected region in a result.
    plane: Option<(Arc<ResultSnapshot>, RegionId, Option<RegionPlane>)>,
}

impl GeometryPanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let before = cx.state.view.geometry;
        let mut settings = before;
        self.update(cx, before);
        let drawing_pt = (0.5 * ui.available_height()).clamp(LEAST_DRAWING_PT, MOST_DRAWING_PT);
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(8).show(ui, |ui| {
                ui.spacing_mut().item_spacing = vec2(8.0, 4.0);
                self.contents(ui, cx, &mut settings, drawing_pt);
            });
        });
        if settings != before {
            cx.send(ViewCommand::Geometry(settings));
        }
    }

    /// Computes points and plane anew where settings, result or region have changed.
    fn update(&mut self, cx: &PanelContext, settings: GeometrySettings) {
        if self.points.as_ref().is_none_or(|(of, _)| *of != settings) {
            self.points = Some((settings, settings.points()));
        }
        let Some((shown, region)) = cx.state.shown().zip(cx.state.selected_region()) else {
            self.plane = None;
            return;
        };
        let is_known = |(known, of, _): &(Arc<ResultSnapshot>, RegionId, Option<RegionPlane>)| {
            Arc::ptr_eq(known, shown) && *of == region
        };
        if !self.plane.as_ref().is_some_and(is_known) {
            self.plane = Some((Arc::clone(shown), region, region_plane(shown, region)));
        }
    }

    /// The plane of the selected region, where the region has one.
    fn plane(&self) -> Option<(RegionId, &RegionPlane)> {
        let (_, region, plane) = self.plane.as_ref()?;
        plane.as_ref().filter(|plane| plane.has_plane).map(|plane| (*region, plane))
    }

    /// Shows the diagram with the sliders, and the curves of figure 6 with the numbers: beside one another where there is room.
    fn contents(&self, ui: &mut Ui, cx: &PanelContext, settings: &mut GeometrySettings, drawing_pt: f32) {
        let plane = self.plane().map(|(_, plane)| plane);
        let points = self.points.as_ref().map_or(&[][..], |(_, points)| points);
        let share = plane.and_then(meeting_share);
        let size = |ui: &Ui| vec2(ui.available_width().max(40.0), drawing_pt);
        if ui.available_width() < BESIDE_PT {
            diagram::show(ui, cx.palette, size(ui), settings, points, plane);
            sliders(ui, settings);
            self.region(ui, cx, settings);
            curves::show(ui, cx.palette, size(ui), *settings, share);
            return numbers(ui, cx, *settings);
        }
        let each = (ui.available_width() - 12.0) / 2.0;
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.set_width(each);
                diagram::show(ui, cx.palette, size(ui), settings, points, plane);
                sliders(ui, settings);
                self.region(ui, cx, settings);
            });
            ui.vertical(|ui| {
                ui.set_width(each);
                curves::show(ui, cx.palette, size(ui), *settings, share);
                numbers(ui, cx, *settings);
            });
        });
    }

    /// Shows where the selected region's highlight leaves its matte line, and the box that draws the sphere's cluster.
    fn region(&self, ui: &mut Ui, cx: &PanelContext, settings: &mut GeometrySettings) {
        let text = match self.plane() {
            None => "Select a region with a dichromatic plane to compare its highlight with the sphere's."
                .to_owned(),
            Some((region, plane)) => region_text(region, plane, settings.distance),
        };
        let tip = "Draws the sphere's lit and visible points in the selected region's colors: as g goes to 0, the skewed T turns into a dog-leg (section 3.2).";
        let can_draw = self.plane().is_some() || settings.is_drawn;
        ui.add_enabled_ui(can_draw, |ui| {
            let check = ui.checkbox(&mut settings.is_drawn, "Draw it in color space and plane");
            check.on_hover_text(tip).on_disabled_hover_text(tip);
        });
        ui.add(Label::new(widgets::with_subscripts(&text, SMALL_PT, cx.palette.text)).wrap());
    }
}

/// Where the highlight of a region leaves its matte line, and the phase angle at which a sphere's highlight does so.
fn region_text(region: RegionId, plane: &RegionPlane, distance: f64) -> String {
    let Some(share) = meeting_share(plane) else {
        return format!("Region {region} has no highlight line.");
    };
    let sphere = match phase_of_q(1.0, distance, share) {
        Some(phase_deg) => format!("as that of a sphere at d = {distance:.1} r and g = {phase_deg:.0}\u{b0}"),
        None if share > 1.0 => "beyond the brightest matte point that was seen".to_owned(),
        None => format!("lower than that of any sphere at d = {distance:.1} r"),
    };
    format!(
        "The highlight line of region {region} starts at {:.0} % of its matte line, {sphere}.",
        100.0 * share
    )
}

/// Shows the sliders.
fn sliders(ui: &mut Ui, settings: &mut GeometrySettings) {
    let most = settings.in_range().sphere().map_or(180.0, SphereGeometry::max_phase_deg) - 0.1;
    Grid::new("geometry sliders").num_columns(2).spacing([8.0, 3.0]).show(ui, |ui| {
        ui.spacing_mut().slider_width = (ui.available_width() - 190.0).clamp(60.0, 220.0);
        let [low, high] = SPHERE_DISTANCES;
        let distance = Slider::new(&mut settings.distance, low..=high).logarithmic(true).max_decimals(2);
        row(
            ui,
            "distance d/r",
            "Distance of light and camera from the center, in radii (section 3.2).",
            distance,
        );
        let phase = Slider::new(&mut settings.phase_deg, 0.0..=most).max_decimals(1).suffix("\u{b0}");
        row(ui, "phase angle g", "Angle between light and camera, up to the angle of equation (4).", phase);
        let roughness = Slider::new(&mut settings.roughness_deg, 0.5..=40.0).max_decimals(1).suffix("\u{b0}");
        row(
            ui,
            "roughness",
            "Standard deviation of the highlight's lobe around the bisector (section 2.1).",
            roughness,
        );
        let strength = Slider::new(&mut settings.strength, 0.0..=4.0).max_decimals(2);
        row(
            ui,
            "highlight m_s",
            "Surface reflection at the peak, in units of the brightest body reflection (section 3.1).",
            strength,
        );
    });
}

/// Shows one slider with its name.
fn row(ui: &mut Ui, name: &str, tip: &str, slider: Slider<'_>) {
    let color = ui.visuals().text_color();
    let text = widgets::with_subscripts(name, super::theme::BODY_PT, color);
    let label = ui.label(text).on_hover_text(tip);
    // The slider has no tooltip, which would hide the rows below while a person drags.
    ui.add(slider).labelled_by(label.id);
    ui.end_row();
}

/// Shows the values of equations (3)–(11).
fn numbers(ui: &mut Ui, cx: &PanelContext, settings: GeometrySettings) {
    let Some(sphere) = settings.sphere() else { return };
    let degrees = |value: f64| format!("{value:.1}\u{b0}");
    let share =
        |value: Option<f64>| value.map_or_else(|| "\u{2013}".to_owned(), |value| format!("{value:.4}"));
    let rows = [
        (
            "(3) half of the sphere's angle \u{3b3}",
            degrees(sphere.cone_half_angle_deg()),
            "\u{3b3}, half of the angle at which light and camera see the sphere: 90\u{b0} minus \u{3b3} is the last normal that each of them sees.",
        ),
        (
            "(4) largest phase angle",
            degrees(sphere.max_phase_deg()),
            "Beyond it the camera sees no lit point.",
        ),
        (
            "(5) incidence at the highlight",
            degrees(sphere.highlight_incidence_deg()),
            "i_H, where the normal bisects g.",
        ),
        ("(6) m_b under the highlight", share(Some(sphere.highlight_body())), "m_bH, Lambertian, of 1."),
        (
            "(7) normal of the brightest point \u{3b1}",
            degrees(sphere.brightest_normal_deg()),
            "\u{3b1}, angle between the light's direction and the normal of the brightest visible point; 0 while the camera sees the point under the light.",
        ),
        (
            "(8) incidence at the brightest point",
            degrees(sphere.brightest_incidence_deg()),
            "i_MaxVisible, at the brightest visible point.",
        ),
        (
            "(9) m_b of the brightest point",
            share(Some(sphere.brightest_body())),
            "m_bMaxVisible, at the brightest visible point, of 1.",
        ),
        (
            "(10) start of the highlight line q",
            share(sphere.q()),
            "q, as a share of the matte line's length.",
        ),
        (
            "(11) q at an infinite distance",
            share(q_infinity(sphere.phase_deg())),
            "q for parallel light and view.",
        ),
    ];
    ui.spacing_mut().interact_size.y = 0.0;
    Grid::new("geometry numbers").num_columns(2).spacing([12.0, 1.0]).min_row_height(14.0).show(ui, |ui| {
        for (name, value, tip) in rows {
            let tip = format!("{tip} (Section 3.2.)");
            ui.label(RichText::new(value).size(SMALL_PT)).on_hover_text(&tip);
            let name = widgets::with_subscripts(name, SMALL_PT, cx.palette.secondary);
            ui.add(Label::new(name).truncate().show_tooltip_when_elided(false)).on_hover_text(tip);
            ui.end_row();
        }
    });
}
