//! What a new event, parameter or switch needs and the compiler does not ask for: a stage that records or reads it.

use crate::source::mentions;
use crate::{collect_rust_files, module_path};
use dichroscope::params::{Parameter, Reading, Switch};
use std::io;
use std::path::Path;

/// Rooms whose code records events.
const RECORDING: &[&str] = &["segment", "baseline", "intrinsic", "analysis"];

/// A new event does not compile without its row, its properties and its sentence; this test names the event that
/// no stage records.
#[test]
fn every_event_of_the_trace_is_recorded_by_a_stage() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = std::fs::read_to_string(root.join("src/trace/events/mod.rs"))?;
    // Rows contain `boxed Event(Structure)` or `inline Event(Structure)`.
    let structures: Vec<&str> = table
        .lines()
        .filter(|line| line.contains("{ boxed ") || line.contains("{ inline "))
        .flat_map(|line| line.split(['(', ')']).skip(1).step_by(2))
        .collect();
    assert!(structures.len() > 30, "the table was not found: {structures:?}");
    let mut named = Vec::new();
    for room in RECORDING {
        let mut files = Vec::new();
        collect_rust_files(&root.join("src").join(room), &mut files)?;
        for file in files {
            let path = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
            let source = std::fs::read_to_string(&file)?;
            let found =
                mentions(&source, &module_path(&path), path.ends_with("tests.rs")).unwrap_or_default();
            named.extend(
                found.into_iter().filter(|mention| !mention.in_test).filter_map(|mut m| m.path.pop()),
            );
        }
    }
    let forgotten: Vec<&&str> =
        structures.iter().filter(|name| !named.iter().any(|found| found == *name)).collect();
    assert!(forgotten.is_empty(), "recorded by no stage: {forgotten:?}");
    Ok(())
}

/// A new parameter, switch or reading does not compile without its row; this test names the one that no stage reads.
#[test]
fn every_parameter_switch_and_reading_is_read_by_a_stage() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    // Products of parameters are computed in `params/values.rs`.
    let mut files = vec![root.join("params/values.rs")];
    for room in ["photo", "segment", "intrinsic", "analysis"] {
        collect_rust_files(&root.join(room), &mut files)?;
    }
    // The values of `auto` are no reading of a parameter. The scale is read where it is resolved.
    files.retain(|file| !file.ends_with("analysis/resolve.rs"));
    let sources = files.iter().map(std::fs::read_to_string).collect::<io::Result<Vec<_>>>()?;
    let is_read = |name: &str| {
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        let field = format!(".{name}");
        sources.iter().any(|source| source.split(&field).skip(1).any(ends))
    };
    let parameters = Parameter::ALL.into_iter().filter(|&parameter| parameter != Parameter::Scale);
    let names =
        parameters.map(|parameter| parameter.spec().name).chain(Switch::ALL.into_iter().map(Switch::name));
    let names = names.chain(Reading::ALL.into_iter().map(Reading::name));
    let forgotten: Vec<&str> = names.filter(|name| !is_read(name)).collect();
    assert!(forgotten.is_empty(), "read by no stage: {forgotten:?}");
    Ok(())
}
