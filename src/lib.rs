//! Physics-based color vision with the Dichromatic Reflection Model.
//!
//! A glossy object reflects light in two ways: from within its body, colored by its pigment, and from its surface, colored
//! like the light. In the color cube its pixels lie on a *skewed T*: a matte line from black, and a highlight line that
//! leaves it in the direction of the light's color. This crate finds those shapes in a photograph. It divides the picture
//! into one region per object, estimates the color of the light, and splits each pixel into body reflection, surface
//! reflection and noise. It follows G. J. Klinker, S. A. Shafer and T. Kanade, *A Physical Approach to Color Image
//! Understanding*, International Journal of Computer Vision 4 (1990): [`params::Method::Paper`] as it was written,
//! [`params::Method::Refined`] with refinements, each a switch in [`params::Refine`]. "Section 5.3", "table 6" and
//! "equation 13" in this documentation are the paper's.
//!
//! # In ten lines
//!
//! ```
//! use dichroscope::{analysis::Session, photo, params::Params};
//! use std::{path::Path, sync::Arc};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let photo = photo::read(Path::new("assets/tiny/camera8.png"), &photo::ReadOptions::default())?;
//! let analysis = Session::new(Arc::new(photo.image)).run(&Params::default(), &mut ())?;
//! println!("light: {:?}", analysis.illuminant);
//! for region in &analysis.intrinsic.regions {
//!     println!("{}: {} pixels, body {:?}, {:?}", region.id, region.pixels, region.body, region.warnings);
//! }
//! let (body, surface) = (&analysis.intrinsic.body, &analysis.intrinsic.surface);
//! # assert!(analysis.illuminant.is_some() && !analysis.intrinsic.regions.is_empty());
//! # assert_eq!(body.len(), surface.len());
//! # Ok(())
//! # }
//! ```
//!
//! More in `examples/`: reading regions, removing highlights, running one stage alone.
//!
//! # Units
//!
//! Colors are linear light in *counts*: 255 counts are full scale, whatever the depth of the file. Directions are unit
//! vectors in the order red, green, blue. Pictures are row-major [`raster::Raster`]s; region 0 is no region.
//!
//! # Map
//!
//! | module | what is in it |
//! |---|---|
//! | [`raster`] | rectangles of values: pixels, masks, label maps, morphology |
//! | [`color`] | points in the color cube: moments, eigenvectors, the χ² test, robust lines, cylinders |
//! | [`reflection`] | the model: dichromatic planes, the transform T and its inverse, photometry (equations 3–11) |
//! | [`photo`] | from a file to linear light; which pixels to believe; the camera's noise |
//! | [`trace`] | decisions as data: recorders, the log and its replay |
//! | [`params`] | what a run may be asked for: method, numbers, light, refinements, stages |
//! | [`segment`] | section 5, from windows to regions |
//! | [`intrinsic`] | section 6, from regions to body, surface and noise |
//! | [`analysis`] | one run over all stages, with progress, cancellation and cached outputs |
//! | [`describe`] | the schema of `report.json` |
//! | [`truth`] | ground truth and scores |
//! | [`export`] | results as files |
//! | [`app`] | the application without a screen |
//! | `gpu` | the color space in three dimensions (feature `gui`): camera, points, lines and solids, picking |
//! | `gui` | the window: one file per panel |
//!
//! Who may use whom, left by right; rooms between the same arrows do not know each other:
//!
//! ```text
//! params, raster, color ← reflection ← photo ← trace ← segment ← intrinsic ← analysis ← report ← truth, export ← workbench ← gui
//! ```
//!
//! The program's command line (`src/cli`, not part of the library) uses all of them. `tests/layering` fails when an arrow
//! runs backwards. `params`, `raster`, `color`, `reflection`, `trace`, `segment`, `intrinsic`, `analysis` and `report` are pure in
//! their results: no clock, no environment, no printing, and the same bytes at any number of threads.

pub mod analysis;
pub mod app;
pub mod color;
pub mod describe;
pub mod export;
#[cfg(feature = "gui")]
pub mod gpu;
#[cfg(feature = "gui")]
pub mod gui;
pub mod intrinsic;
pub mod params;
pub mod photo;
pub mod raster;
pub mod reflection;
pub mod segment;
pub mod trace;
pub mod truth;
pub mod view;
