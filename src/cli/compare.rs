//! `dichroscope compare`: label maps and diffuse pictures that were made elsewhere, held against a result.

use super::one::Reference;
use super::reading::Reading;
use super::{Outcome, note, print, table};
use anyhow::{Context, Result, bail};
use clap::Args;
use dichroscope::color::ContrastCurve;
use dichroscope::describe::{Report, Scores};
use dichroscope::export::{
    is_result_folder, read_report, write_difference, write_foreign_diffuse, write_foreign_labels,
};
use dichroscope::photo;
use dichroscope::truth::sample::CAMERA_FILE;
use dichroscope::truth::{
    self, Agreement, ForeignResult, ResultPictures, doubt_about_truth, read_label_map, score,
};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Hold a label map or a diffuse picture that was made elsewhere against a result, and against the ground truth
#[derive(Debug, Args)]
pub struct Arguments {
    /// A result folder
    result_dir: PathBuf,
    /// The label map: a gray picture of 8 or 16 bits, 0 for no label, or a color picture with one color for each label and black for none
    #[arg(long, value_name = "FILE")]
    labels: Option<PathBuf>,
    /// The diffuse picture: the photograph without its highlights
    #[arg(long, value_name = "FILE")]
    diffuse: Option<PathBuf>,
    /// A ground truth folder
    #[arg(long, value_name = "DIR")]
    truth: Option<PathBuf>,
    /// Folder for pictures: the label map in the colors of the result's regions, the diffuse picture, and its difference from the body image
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print JSON: `{"agreement": figures, "elsewhere": scores, "result": scores}`
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    reading: Reading,
}

pub(super) fn run(arguments: &Arguments) -> Result<Outcome> {
    if arguments.labels.is_none() && arguments.diffuse.is_none() {
        bail!("expected --labels FILE, --diffuse FILE or both");
    }
    if !is_result_folder(&arguments.result_dir) {
        bail!(
            "{} holds no result (report.json): `dichroscope analyze` writes one",
            arguments.result_dir.display()
        );
    }
    let result = ResultPictures::read(&arguments.result_dir)?;
    let report = read_report(&arguments.result_dir)?;
    let foreign = read(arguments)?;
    let agreement = foreign.agreement(&result.regions, &result.body)?;
    let truth = arguments.truth.as_deref();
    let scores =
        truth.map(|folder| both_scores(arguments, folder, &foreign, &result, &report)).transpose()?;
    if let Some(folder) = &arguments.out
        && let Err(error) = write(
            folder,
            &foreign,
            &result,
            arguments.reading.options().encoding.contrast().map(ContrastCurve::new),
        )
    {
        note(&format!("error: {error:#}"));
        return Ok(Outcome::SomeFailed);
    }
    let held = Held { foreign: &foreign, agreement, scores };
    Ok(print(&if arguments.json { held.json()? } else { held.text() }))
}

/// Reads what was made elsewhere.
fn read(arguments: &Arguments) -> Result<ForeignResult> {
    let labels = arguments.labels.as_deref().map(read_label_map).transpose()?;
    let options = arguments.reading.options();
    let diffuse = arguments.diffuse.as_deref().map(|path| photo::read(path, &options)).transpose()?;
    Ok(ForeignResult { labels, diffuse: diffuse.map(|photo| Arc::unwrap_or_clone(photo.image).pixels) })
}

/// The scores of what was made elsewhere, and those of the result.
fn both_scores(
    arguments: &Arguments,
    folder: &Path,
    foreign: &ForeignResult,
    result: &ResultPictures,
    report: &Report,
) -> Result<[Scores; 2]> {
    let image = if report.image.file.is_empty() { CAMERA_FILE } else { &report.image.file };
    let Reference { truth, camera } = Reference::read(folder, image, &arguments.reading.options())?;
    if let Some(doubt) = doubt_about_truth(&truth, &result.sum()) {
        note(&format!("warning: {doubt}"));
    }
    let outcome =
        truth::Outcome { regions: &result.regions, body: &result.body, surface: &result.surface, report };
    Ok([foreign.scores(&truth, &camera, report)?, score(&truth, &camera, &outcome)?])
}

/// Writes pictures of what was made elsewhere. `contrast`: the camera's contrast curve with which it was read.
fn write(
    folder: &Path,
    foreign: &ForeignResult,
    result: &ResultPictures,
    contrast: Option<ContrastCurve>,
) -> Result<()> {
    std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    if let Some(labels) = &foreign.labels {
        write_foreign_labels(&folder.join("labels.png"), labels, &result.regions)?;
    }
    if let Some(diffuse) = &foreign.diffuse {
        write_foreign_diffuse(&folder.join("diffuse.png"), diffuse, contrast)?;
        write_difference(&folder.join("difference.png"), diffuse, &result.body)?;
    }
    Ok(())
}

/// What was found.
struct Held<'a> {
    foreign: &'a ForeignResult,
    agreement: Agreement,
    /// The scores of what was made elsewhere and of the result; none without a ground truth.
    scores: Option<[Scores; 2]>,
}

impl Held<'_> {
    fn text(&self) -> String {
        let mut text = table::figures(&[("agreement", self.agreement.figures())]);
        if let Some([elsewhere, result]) = &self.scores {
            text.push('\n');
            let rows =
                [("elsewhere", self.foreign.figures(elsewhere)), ("result", self.foreign.figures(result))];
            text.push_str(&table::figures(&rows));
        }
        text
    }

    fn json(&self) -> Result<String> {
        let object = |figures: table::Figures| {
            let entries =
                figures.into_iter().map(|(name, figure)| (name.to_owned(), serde_json::json!(figure)));
            serde_json::Value::Object(entries.collect())
        };
        let mut all = serde_json::json!({ "agreement": object(self.agreement.figures()) });
        if let Some([elsewhere, result]) = &self.scores {
            all["elsewhere"] = object(self.foreign.figures(elsewhere));
            all["result"] = object(self.foreign.figures(result));
        }
        Ok(serde_json::to_string_pretty(&all)? + "\n")
    }
}
