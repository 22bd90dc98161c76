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
//! use std::path::Path;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let photo = photo::read(Path::new("assets/tiny/camera8.png"), &photo::ReadOptions::default())?;
//! let analysis = Session::new(photo.image).run(&Params::default(), &mut ())?;
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
//! # Cargo features
//!
//! Both are on by default. A program that uses the library switches them off (`default-features = false`) and compiles neither
//! egui and wgpu nor clap.
//!
//! | feature | what it adds |
//! |---|---|
//! | `cli` | the program `dichroscope` |
//! | `gui` | the modules `gpu` and `gui`: the program's window, and pictures of it |
//!
//! # Units
//!
//! Colors are linear light in *counts*: 255 counts are full scale, whatever the depth of the file. Directions are unit
//! vectors in the order red, green, blue. Pictures are row-major [`raster::Raster`]s; region 0 is no region.
//!
//! # Map
//!
//! Where to begin: [`photo::read`] reads a photograph, [`params::Params`] says how to analyze it, [`analysis::Session`] runs
//! the analysis, [`describe::Report`] and [`export`] describe and write the result.
//!
//! | module | what is in it | for whom |
//! |---|---|---|
//! | [`photo`] | from a file to linear light; which pixels to believe; the camera's noise | every user |
//! | [`params`] | what a run may be asked for: method, numbers, light, refinements, stages | every user |
//! | [`analysis`] | one run over all stages, with progress, cancellation and cached outputs | every user |
//! | [`describe`] | what is told of a run: `report.json`, trace lines, sentences | every user |
//! | [`export`] | results as files | every user |
//! | [`truth`] | ground truth and scores | who measures accuracy |
//! | [`trace`] | decisions as data: recorders, the record of a run and its replay | who asks why |
//! | [`segment`] | section 5, from windows to regions | who runs one stage alone |
//! | [`baseline`] | the systems that the paper is held against: Phoenix, and clusters of the whole histogram | who compares methods |
//! | [`intrinsic`] | section 6, from regions to body, surface and noise | who runs one stage alone |
//! | [`reflection`] | the model: dichromatic planes, the transform T and its inverse, photometry (equations 3–11) | who computes with the model |
//! | [`color`] | points in the color cube: moments, eigenvectors, the χ² test, robust lines, cylinders | who computes with the model |
//! | [`raster`] | rectangles of values: pixels, masks, label maps | who reads pictures of a result |
//! | [`view`] | what the window's panels show, as plain data | the window |
//! | [`figures`] | the paper's figures and tables of a photograph, as an HTML page | every user |
//! | [`app`] | the window's state, commands and workers, without a screen | the window |
//! | `gpu` | the color space in three dimensions: camera, points, lines and solids, picking | the window |
//! | `gui` | the window: one file per panel | the window |
//!
//! Modules for the window are public because the program and its tests use them; they change without notice.
//!
//! A module uses only modules to its left; modules that stand together do not use each other:
//!
//! ```text
//! params, raster, color ← reflection ← photo ← trace ← segment ← intrinsic, baseline ← analysis ← describe ← truth, export ← view ← figures ← app ← gui
//! ```
//!
//! `gpu` uses no other module, and only `gui` uses it. The command line (`src/cli`) is part of the program, not of the library.
//! `tests/layering` fails when an arrow runs backwards. `params`, `raster`, `color`, `reflection`, `trace`, `segment`,
//! `intrinsic`, `baseline`, `analysis`, `describe` and `figures` are pure: no file, clock, environment or printing, and the same bytes at any number
//! of threads.

pub mod analysis;
pub mod app;
pub mod baseline;
pub mod color;
pub mod describe;
pub mod export;
pub mod figures;
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
