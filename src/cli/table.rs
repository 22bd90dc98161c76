//! Scores of several results, for people and for programs.

use anyhow::Result;
use dichroscope::describe::Scores;
use dichroscope::truth::CandidateCounts;
use serde_json::{Map, Value, json};

/// For each figure's name the mean over the results that have the figure.
fn means(scored: &[(String, Scores)]) -> Vec<(&'static str, Option<f64>)> {
    Scores::default()
        .figures()
        .iter()
        .enumerate()
        .map(|(index, &(name, _))| {
            let values: Vec<f64> = scored.iter().filter_map(|(_, s)| s.figures()[index].1).collect();
            (name, (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64))
        })
        .collect()
}

/// `{"results": {NAME: scores}, "mean": scores}`, pretty, with a final newline; where candidates were counted, also
/// `"candidates": {NAME: counts}`.
pub(super) fn json(scored: &[(String, Scores)], counted: &[(String, CandidateCounts)]) -> Result<String> {
    let mut results = Map::new();
    for (name, scores) in scored {
        results.insert(name.clone(), serde_json::to_value(scores)?);
    }
    let mean: Map<String, Value> =
        means(scored).into_iter().map(|(name, mean)| (name.to_owned(), json!(mean))).collect();
    let mut all = json!({ "results": results, "mean": mean });
    if !counted.is_empty() {
        all["candidates"] = counted.iter().map(|(name, counts)| (name.clone(), json!(counts))).collect();
    }
    Ok(serde_json::to_string_pretty(&all)? + "\n")
}

/// One line per result and, of several, one with the means.
pub(super) fn aligned(scored: &[(String, Scores)]) -> String {
    let means = means(scored);
    let mut lines = vec![heading(&means)];
    lines.extend(scored.iter().map(|(name, scores)| line(name, &scores.figures())));
    if scored.len() > 1 {
        lines.push(line("MEAN", &means));
    }
    table(&lines)
}

/// Figures with their names, none where a figure does not exist.
pub(super) type Figures = Vec<(&'static str, Option<f64>)>;

/// Named rows of figures, which all have the same names, with a heading.
pub(super) fn figures(rows: &[(&str, Figures)]) -> String {
    let mut lines: Vec<Vec<String>> = rows.first().map(|(_, figures)| heading(figures)).into_iter().collect();
    if let Some(first) = lines.first_mut().and_then(|line| line.first_mut()) {
        first.clear();
    }
    lines.extend(rows.iter().map(|(name, figures)| line(name, figures)));
    table(&lines)
}

/// The counts of the tests of highlight candidates, one line per result and one with the sums.
pub(super) fn candidates(counted: &[(String, CandidateCounts)]) -> String {
    let cells = |name: &str, numbers: [usize; 6]| {
        std::iter::once(name.to_owned()).chain(numbers.map(|number| number.to_string())).collect::<Vec<_>>()
    };
    let numbers = |counts: &CandidateCounts| {
        [
            counts.tests,
            counts.highlights,
            counts.right_by_position,
            counts.accepted_by_position,
            counts.right_by_gershon,
            counts.accepted_by_gershon,
        ]
    };
    let heading =
        ["result", "candidates", "highlights", "50 % right", "accepted", "Gershon right", "accepted"];
    let mut lines = vec![heading.map(str::to_owned).to_vec()];
    let mut sums = [0; 6];
    for (name, counts) in counted {
        let of_result = numbers(counts);
        sums.iter_mut().zip(of_result).for_each(|(sum, number)| *sum += number);
        lines.push(cells(name, of_result));
    }
    lines.push(cells("SUM", sums));
    table(&lines)
}

/// Lines of cells with their columns aligned.
fn table(lines: &[Vec<String>]) -> String {
    let columns = lines[0].len();
    let widths: Vec<usize> = (0..columns)
        .map(|column| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0))
        .collect();
    lines.iter().map(|line| justified(line, &widths)).collect()
}

fn heading(figures: &[(&'static str, Option<f64>)]) -> Vec<String> {
    let names = figures.iter().map(|&(name, _)| {
        // The score of doing nothing stands behind the figure that it belongs to.
        if name.ends_with("_nothing") { "(nothing)" } else { name }.to_owned()
    });
    std::iter::once("result".to_owned()).chain(names).collect()
}

fn line(name: &str, figures: &[(&'static str, Option<f64>)]) -> Vec<String> {
    let cells = figures.iter().map(|&(name, figure)| match (name, figure) {
        (_, None) => "-".to_owned(),
        ("regions" | "objects", Some(count)) if count.fract() == 0.0 => format!("{count:.0}"),
        (name, Some(value)) if name.ends_with("_nothing") => format!("({value:.3})"),
        (_, Some(value)) => format!("{value:.3}"),
    });
    std::iter::once(name.to_owned()).chain(cells).collect()
}

/// A line of a table: the first cell aligned to the left, all others to the right.
fn justified(cells: &[String], widths: &[usize]) -> String {
    let first = format!("{:<width$}", cells[0], width = widths[0]);
    let others = cells.iter().zip(widths).skip(1).map(|(cell, width)| format!("{cell:>width$}"));
    std::iter::once(first).chain(others).collect::<Vec<_>>().join("  ") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two() -> [(String, Scores); 2] {
        let a = Scores {
            ari: 1.0,
            regions: 2,
            psnr_body: Some(46.0),
            psnr_nothing: Some(30.0),
            ..Scores::default()
        };
        let b = Scores { ari: 0.5, regions: 3, body_deg: Some(0.25), ..Scores::default() };
        [("cups".to_owned(), a), ("a longer name".to_owned(), b)]
    }

    #[test]
    fn columns_line_up_and_nothing_stands_beside_its_figure() {
        let text = aligned(&two());
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 4);
        assert!(lines.iter().all(|line| line.len() == lines[0].len()), "{text}");
        assert!(lines[0].contains("psnr_body  (nothing)"), "{text}");
        assert!(lines[1].contains("   46.000   (30.000)"), "{text}");
        assert!(lines[3].starts_with("MEAN") && lines[3].contains("0.750"), "{text}");
        assert!(lines[3].contains("2.500"), "mean of a count: {text}");
    }

    #[test]
    fn means_pass_over_what_is_missing() {
        let value: Value = serde_json::from_str(&json(&two(), &[]).unwrap()).unwrap();
        assert_eq!(value["mean"]["body_deg"], 0.25);
        assert_eq!(value["mean"]["psnr_restored"], Value::Null);
        assert_eq!(value["results"]["cups"]["psnr_body"], 46.0);
    }
}
