//! `dichroscope screenshot`: a gallery of pictures of the window, drawn without a window.

use super::offscreen::OffscreenError;
use super::offscreen_app::OffscreenApp;
use super::pane::Pane;
use super::screenshot_lamps::lamp_pictures;
use crate::app::{Command, DebugCommand, Edit, JobCommand, Question, Severity, State, ViewCommand};
use crate::export::{PartFile, png_of_rgba};
use crate::params::Method;
use crate::raster::{PixelIndex, RegionId};
use crate::trace::{Event, Step, Topic};
use crate::truth::sample;
use crate::view::{
    Arrangement, ColorBy, CubeSettings, Fill, ImageSettings, Item, Layer, Origin, ProfileLine, Theme,
};
use std::io::Write;
use std::path::{Path, PathBuf};

/// The reason why a gallery could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ScreenshotError {
    /// The window cannot be drawn on this computer.
    #[error(transparent)]
    OffscreenApp(#[from] OffscreenError),
    /// A picture could not be written.
    #[error("{}: cannot be written: {cause}", path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The error of the operating system.
        cause: std::io::Error,
    },
    /// The photograph could not be opened.
    #[error("{0}")]
    Photograph(String),
}

/// One picture of the gallery.
struct GalleryPicture {
    name: &'static str,
    method: Method,
    /// The panel shown alone; `None` for the whole window.
    pane: Option<Pane>,
    theme: Theme,
    region: Option<RegionId>,
    image: ImageSettings,
    cube: CubeSettings,
    /// Position of the debugger's cursor; `None` for the end of the trace.
    moment: Option<Moment>,
    /// Whether the why panel shows a pixel's history and the parameters that would change the pixel's result.
    shows_why: bool,
}

/// A position in the trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Moment {
    /// The slice that takes most pixels has grown to three fifths (5.4.2).
    Slice,
    /// The candidate with the most pixels has passed as a highlight (5.4.1).
    Test,
}

impl Moment {
    /// The number of steps before the moment; `None` when the photograph has no slice or no highlight.
    fn steps(self, state: &State) -> Option<usize> {
        let trace = state.debugger.trace()?;
        match self {
            Self::Slice => {
                let slices = trace.blocks().filter(|block| matches!(block.topic, Topic::Slice(_)));
                let longest = slices.max_by_key(|block| block.steps.len())?;
                Some(longest.steps.start + longest.steps.len() * 3 / 5)
            }
            Self::Test => {
                let passed = trace.events().filter_map(|(n, event)| match event {
                    Event::CandidateTested(test) if test.verdict.accepted() => Some((n + 1, test.pixels)),
                    _ => None,
                });
                passed.max_by_key(|(_, pixels)| *pixels).map(|(n, _)| n)
            }
        }
    }
}

/// The whole window, with outlines of the regions.
fn whole_window(name: &'static str) -> GalleryPicture {
    GalleryPicture {
        name,
        method: Method::Refined,
        pane: None,
        theme: Theme::Dark,
        region: RegionId::from_label(1),
        image: ImageSettings { layer: Layer::Regions, fill: Fill::Outline, ..ImageSettings::default() },
        cube: CubeSettings::default(),
        moment: None,
        shows_why: false,
    }
}

/// The whole window with the debugger's cursor at a moment.
fn stopped(name: &'static str, moment: Moment) -> GalleryPicture {
    GalleryPicture { moment: Some(moment), image: ImageSettings::default(), ..whole_window(name) }
}

/// The image panel with a layer.
fn image(name: &'static str, layer: Layer) -> GalleryPicture {
    let image = ImageSettings { layer, ..ImageSettings::default() };
    GalleryPicture { pane: Some(Pane::Image), region: None, image, ..whole_window(name) }
}

/// The color space panel.
fn colors(name: &'static str, region: Option<RegionId>, color_by: ColorBy) -> GalleryPicture {
    let cube = CubeSettings { color_by, ..CubeSettings::default() };
    GalleryPicture { pane: Some(Pane::Colors), region, cube, ..whole_window(name) }
}

/// All pictures of the gallery.
fn gallery() -> Vec<GalleryPicture> {
    let wipe = ImageSettings {
        layer: Layer::Input,
        other: Layer::Body,
        arrangement: Arrangement::Wipe(0.5),
        ..ImageSettings::default()
    };
    let beside = ImageSettings {
        layer: Layer::Phoenix,
        other: Layer::Regions,
        arrangement: Arrangement::SideBySide,
        ..ImageSettings::default()
    };
    vec![
        whole_window("window"),
        GalleryPicture { theme: Theme::Light, ..whole_window("window-light") },
        GalleryPicture { image: wipe, ..image("image-wipe", Layer::Input) },
        image("image-classification", Layer::Classes),
        image("image-regions", Layer::Regions),
        image("image-surface", Layer::Surface),
        colors("colors", None, ColorBy::Own),
        colors("colors-region", RegionId::from_label(1), ColorBy::Region),
        GalleryPicture { pane: Some(Pane::Plane), ..whole_window("plane") },
        GalleryPicture { pane: Some(Pane::Geometry), ..whole_window("geometry") },
        GalleryPicture { pane: Some(Pane::Profile), ..whole_window("profile") },
        stopped("debugger-slice", Moment::Slice),
        stopped("debugger-skewed-t", Moment::Test),
        GalleryPicture { shows_why: true, region: None, ..whole_window("debugger-why") },
        // The last, as the window keeps the method.
        GalleryPicture { method: Method::Paper, ..whole_window("window-paper") },
        GalleryPicture { method: Method::Paper, ..image("paper-planar", Layer::Planar) },
        GalleryPicture { method: Method::Paper, ..image("paper-surface", Layer::Surface) },
        GalleryPicture { method: Method::Paper, pane: Some(Pane::Plane), ..whole_window("paper-plane") },
        // Color figure 15, with the regions of the paper's method beside it.
        GalleryPicture { method: Method::Paper, image: beside, ..image("paper-phoenix", Layer::Phoenix) },
    ]
}

/// Writes the gallery of `origin` into `folder` as PNG files: the whole window at `size_px` (columns, rows), single
/// panels at three fifths of that size. Returns the paths.
///
/// # Errors
/// When there is no graphics adapter, the photograph cannot be opened or a file cannot be written.
pub fn screenshot(folder: &Path, size_px: [u32; 2], origin: Origin) -> Result<Vec<PathBuf>, ScreenshotError> {
    let write = |path: &Path, cause| ScreenshotError::Write { path: path.to_path_buf(), cause };
    std::fs::create_dir_all(folder).map_err(|cause| write(folder, cause))?;
    let has_lamps = matches!(&origin, Origin::Sample(name) if name == sample::NAME);
    let mut offscreen = OffscreenApp::new(size_px, 1.0)?;
    offscreen.app.apply(JobCommand::Open(origin));
    if offscreen.app.state().picture.is_none() {
        let mut errors =
            offscreen.app.state().notices.iter().filter(|notice| notice.severity == Severity::Error);
        let reason = errors.next().map_or_else(String::new, |notice| notice.text.clone());
        return Err(ScreenshotError::Photograph(reason));
    }
    let mut written = Vec::new();
    for gallery_picture in gallery() {
        let size = if gallery_picture.pane.is_some() {
            size_px.map(|length| (length * 3 / 5).max(1))
        } else {
            size_px
        };
        prepare(&mut offscreen, &gallery_picture, size);
        let rgba = offscreen.picture()?;
        let path = folder.join(format!("{}.png", gallery_picture.name));
        write_whole(&path, &png_of_rgba(size, &rgba)).map_err(|cause| write(&path, cause))?;
        written.push(path);
    }
    // The three lamps belong to the gallery of the first sample.
    for picture in if has_lamps { lamp_pictures(&mut offscreen.app) } else { Vec::new() } {
        let path = folder.join(format!("{}.png", picture.name));
        write_whole(&path, &png_of_rgba(picture.size, &picture.rgba)).map_err(|cause| write(&path, cause))?;
        written.push(path);
    }
    Ok(written)
}

/// Writes a picture so that an earlier one at its place is replaced by the whole new one, or remains.
fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut file = PartFile::begin(path)?;
    file.write_all(bytes)?;
    file.publish()
}

/// The pixel of the last claim that two regions contested; `None` without such a claim.
fn contested_pixel(state: &State) -> Option<PixelIndex> {
    let mut steps = state.debugger.trace()?.steps().rev();
    steps.find_map(|(_, step)| match step {
        Step::Claim { pixel, contest: Some(_), .. } => Some(pixel),
        _ => None,
    })
}

/// Brings the application into the state of a picture.
fn prepare(offscreen: &mut OffscreenApp, gallery_picture: &GalleryPicture, size_px: [u32; 2]) {
    let app = &mut offscreen.app;
    if app.state().document.params.method != gallery_picture.method {
        app.apply(Edit::SetMethod(gallery_picture.method));
    }
    let notices: Vec<u64> = app.state().notices.iter().map(|notice| notice.id).collect();
    for id in notices {
        app.apply(ViewCommand::Dismiss(id));
    }
    app.apply(ViewCommand::Theme(gallery_picture.theme));
    app.apply(Edit::Select(gallery_picture.region.map(Item::Region)));
    app.apply(ViewCommand::Image(gallery_picture.image.clone()));
    app.apply(ViewCommand::Cube(gallery_picture.cube.clone()));
    app.apply(ViewCommand::Profile(ProfileLine::Row));
    let end = app.state().debugger.trace().map_or(0, |trace| trace.len());
    let steps = gallery_picture.moment.and_then(|moment| moment.steps(app.state())).unwrap_or(end);
    app.apply(Command::Debug(DebugCommand::Seek(steps)));
    if let Some(pixel) = contested_pixel(app.state()).filter(|_| gallery_picture.shows_why) {
        app.apply(Edit::Select(app.state().region_of(Item::Pixel(pixel)).map(Item::Region)));
        app.apply(Command::Ask(Question::Why(pixel)));
        app.apply(Command::Ask(Question::WhatIf(Some(pixel))));
    }
    app.show_alone(gallery_picture.pane);
    offscreen.resize(size_px);
}
