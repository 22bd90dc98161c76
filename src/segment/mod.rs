//! Section 5: from windows to regions, one file per stage of the paper.

mod params;

pub use params::{InvalidParameter, Method, Parameter, ParameterSpec, Params, Refine, Setting, UsedParams};
