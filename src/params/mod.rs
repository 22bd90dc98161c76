//! What a run may be asked for: method, numbers, light and refinements (section 7.3, table 6).
//!
//! This room uses no other room, so that every other room can use its types.

mod preset;
mod refine;
mod setting;
mod stage;
mod values;

pub use preset::Preset;
pub use refine::Refine;
pub use setting::{AmbientSetting, IlluminantSetting, Setting};
pub use stage::Stage;
pub use values::{InvalidParameter, Method, Parameter, ParameterSpec, Params, UsedParams};
