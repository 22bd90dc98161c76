//! What a run may be asked for: method, numbers, light and refinements (section 7.3, table 6).
//!
//! This room uses no other room, so that every other room can use its types.

mod feature;
mod invalid;
mod markdown;
mod method;
mod nearest;
mod paper;
mod phoenix;
mod preset;
mod reading;
mod refine;
mod setting;
mod stage;
mod table;
mod toml_error;
mod values;

pub use feature::{Feature, FeatureSet, UnknownFeature};
pub use invalid::InvalidParameter;
pub(crate) use invalid::LEAST_LAMPS_ANGLE_DEG;
pub use markdown::{parameter_table, phoenix_table, reading_table, switch_table};
pub use method::Method;
pub use paper::{Baseline, PaperMethod, Rules};
pub use phoenix::{PhoenixParameter, PhoenixSettings};
pub use preset::Preset;
pub use reading::{Reading, ReadingSpec, Readings, UnknownReading};
pub use refine::{Refine, Switch, UnknownSwitch};
pub use setting::{AmbientSetting, IlluminantSetting, Setting};
pub use stage::Stage;
pub(crate) use table::parameter_rows;
pub use table::{Parameter, ParameterSpec, SliderSpec};
pub use toml_error::{toml_error, unread_tables};
pub use values::{Params, UsedParams};
