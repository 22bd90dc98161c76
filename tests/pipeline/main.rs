//! Tests of the whole pipeline, from linear light to the split, on scenes with ground truth and on degenerate
//! pictures.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]
#![allow(clippy::float_cmp, reason = "what is exact by construction is tested for exactness")]

mod ambient;
mod area;
mod baselines;
mod by_hand;
mod cache;
mod cameras;
mod case_study;
mod clipped_objects;
mod common;
mod decisions;
mod degenerate;
mod files;
mod history;
mod identities;
mod light;
mod methods;
mod prints;
mod readings;
mod replay;
mod scale;
mod scenes;
mod second_lamp;
mod small_objects;
mod synthetic_scenes;
mod threads;

#[path = "../synthetic/marbled.rs"]
mod marbled;
#[path = "../synthetic/mod.rs"]
mod synthetic;
