//! Descriptions of a run: `report.json`, trace lines, and decisions in words.
//!
//! The types of the report are its schema: the file holds their fields in their order, and a report that is read is equal to the
//! report that was written. Colors and distances are in counts (255 = full scale), directions are unit vectors.

mod events;
mod facts;
mod grouped;
mod light_facts;
mod light_words;
mod names;
mod region_facts;
mod scores;
mod skewed_t_facts;
mod trace_line;
mod words;

pub use facts::{
    AmbientAsked, AreaFacts, ImageFacts, LightFacts, ParameterFacts, ParamsFacts, Report, SCHEMA, ScaleFacts,
    Timings,
};
pub use grouped::{counted, grouped, grouped_decimals, with_grouped_numbers};
pub use light_facts::{
    AmbientFacts, CodingFacts, IlluminantFacts, LightEstimateFacts, NoiseFacts, SecondLampFacts,
};
pub use light_words::{ambient_reason, light_reason};
pub use names::Names;
pub use region_facts::{HighlightBranchFacts, RegionFacts};
pub use scores::Scores;
pub use skewed_t_facts::SkewedTFacts;
pub use trace_line::{TRACE_SCHEMA, schema_line, second_look_line, second_look_trace_line, trace_line};
pub use words::{
    Condensed, condense, grouped_sentences, reason_label, reason_meaning, sentences, what_if_sentence,
};

/// Name of the report in a result folder.
pub const FILE_NAME: &str = "report.json";

/// Why a text is no report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A field is missing, or the text is no JSON.
    #[error("it is not a report")]
    Json(#[from] serde_json::Error),
    /// The report has another schema.
    #[error("it has schema {0}, this program reads {SCHEMA}")]
    Schema(u32),
}

impl Report {
    /// Reads a report from the bytes of its file.
    ///
    /// # Errors
    /// The bytes are no report, or a report of another schema.
    pub fn from_json(text: &[u8]) -> Result<Self, ReportError> {
        let stamp: Stamp = serde_json::from_slice(text)?;
        if stamp.schema != SCHEMA {
            return Err(ReportError::Schema(stamp.schema));
        }
        Ok(serde_json::from_slice(text)?)
    }

    /// The report as pretty JSON with a final newline.
    ///
    /// # Errors
    /// None for a report that [`Report::new`] made; serialization in general can fail.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }
}

/// Whether a text is a report of this program, of whatever schema.
pub fn is_report(text: &[u8]) -> bool {
    serde_json::from_slice::<Stamp>(text).is_ok()
}

/// The fields by which a report is known, whatever else its schema holds.
#[derive(serde::Deserialize)]
struct Stamp {
    schema: u32,
    #[serde(rename = "program")]
    _program: String,
    #[serde(rename = "image")]
    _image: serde::de::IgnoredAny,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Session;
    use crate::params::{Method, Params, Setting};
    use crate::photo::LinearImage;
    use crate::raster::Raster;
    use std::sync::Arc;

    fn report() -> Report {
        let image = Arc::new(LinearImage::new(Raster::filled(4, 3, [9.0, 10.5, 11.0]), None));
        let params = Params { clip_threshold: Setting::Auto, ..Params::of(Method::Paper) };
        let mut analysis = Session::new(image).run(&params, &mut ()).unwrap();
        analysis.used.clip_threshold = f64::INFINITY;
        let facts = ImageFacts {
            file: "a.png".into(),
            sha256: "00".into(),
            width: 4,
            height: 3,
            encoding: "linear".into(),
            full_scale: 255.0,
        };
        Report::new(facts, &params, &analysis, &["alpha was composited on black".into()])
    }

    #[test]
    fn a_report_reads_back_as_it_was_written() {
        let mut report = report();
        report.timings_ms.read = Some(0.25);
        report.scores = Some(Scores { regions: 3, ari: 0.5, ..Scores::default() });
        report.regions.push(RegionFacts { id: 1, body: [0.6, 0.0, 0.8], ..RegionFacts::default() });
        let text = report.to_json().unwrap();
        assert_eq!(Report::from_json(text.as_bytes()).unwrap(), report);
        assert!(is_report(text.as_bytes()));
    }

    #[test]
    fn a_switched_off_threshold_is_null_and_fields_keep_their_order() {
        let json: serde_json::Value = serde_json::from_str(&report().to_json().unwrap()).unwrap();
        let keys: Vec<_> = json.as_object().unwrap().keys().map(String::as_str).collect();
        assert_eq!(
            keys,
            [
                "schema",
                "program",
                "image",
                "params",
                "noise",
                "scale",
                "illuminant",
                "ambient",
                "regions",
                "unassigned_pixels",
                "reasons",
                "warnings",
                "timings_ms"
            ]
        );
        assert_eq!(json["params"]["clip_threshold"]["asked"], "auto");
        assert!(json["params"]["clip_threshold"]["used"].is_null());
        assert_eq!(json["params"]["window_size"]["used"], 10.0);
        assert_eq!(json["params"]["method"], "paper");
        assert_eq!(json["params"]["refine"]["all_seeds"], false, "the paper's method refines nothing");
        assert_eq!(json["unassigned_pixels"], 12);
        let light = &json["illuminant"];
        assert!(light["direction"].is_null() && light["interval_deg"].is_null());
        assert_eq!(
            (&light["objects"], &light["given"], &light["basis"]),
            (&0.into(), &false.into(), &"none".into())
        );
        assert!(light["reason"].as_str().is_some_and(|why| why.starts_with("no highlight was found")));
        assert_eq!((&json["reasons"]["shadow"], &json["reasons"]["texture"]), (&12.into(), &0.into()));
    }

    #[test]
    fn what_is_no_report_is_said() {
        let foreign = br#"{"schema": 1, "coverage": {}}"#;
        assert!(matches!(Report::from_json(foreign), Err(ReportError::Json(_))));
        assert!(!is_report(foreign), "another program's report is not ours");
        let later = br#"{"schema": 7, "program": "9.0", "image": {}}"#;
        let message = Report::from_json(later).unwrap_err().to_string();
        assert_eq!(message, "it has schema 7, this program reads 1");
        assert!(is_report(later));
    }
}
