//! How files are read, by flags that all commands share.

use clap::Args;
use dichroscope::photo::{EncodingChoice, ReadOptions};

/// How to read files.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Reading")]
pub(super) struct Reading {
    /// What the file's values mean: auto (believe the file), linear, srgb, gamma:G, or contrast:C (sRGB and a camera's contrast curve)
    #[arg(long, value_name = "ENCODING", default_value_t)]
    encoding: EncodingChoice,
    /// Counts that the file's full scale stands for [default: 255]
    #[arg(long, value_name = "COUNTS", value_parser = positive)]
    full_scale: Option<f64>,
    /// Refuse larger pictures before memory is taken for them
    #[arg(long, value_name = "N", value_parser = positive,
          default_value_t = ReadOptions::default().max_megapixels)]
    max_megapixels: f64,
}

impl Reading {
    /// The options that the flags ask for.
    pub(super) fn options(self) -> ReadOptions {
        let Self { encoding, full_scale, max_megapixels } = self;
        ReadOptions { encoding, full_scale, max_megapixels }
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("expected a number above 0".to_owned()),
    }
}
