//! Files that are opened together: what each is by its name, and which of them are opened.

use super::photographs::MOST_OTHERS;
use super::state::Severity;
use super::workspace::is_workspace;
use crate::view::{ElsewhereKind, ElsewherePaths, Origin};
use std::path::{Path, PathBuf};

/// Files that are opened together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilesToOpen {
    /// Photographs, in the order in which they are opened; the last is shown.
    pub photographs: Vec<Origin>,
    /// Whether the first photograph that can be read is to be opened last and therefore shown; the others follow it in their order.
    pub shows_first: bool,
    /// Pictures of another program: of the photograph of the workspace, of the last photograph where there is no workspace, of the open
    /// one where there is neither.
    pub elsewhere: ElsewherePaths,
    /// A workspace, opened after the photographs.
    pub workspace: Option<PathBuf>,
}

/// A sentence about a file, and its kind.
pub(super) type Note = (Severity, String);

/// What each of several files is, and sentences about files that are not opened or whose kind a person may not expect.
///
/// A workspace is known by its extension and a picture of another program by its name, where there is a photograph that it could belong
/// to: one that is open (`has_photograph`) or one among the files. Every other file is a photograph. Of several workspaces, label maps or
/// diffuse pictures the last is opened, and of photographs the first ones, as many as can be open.
pub(super) fn files_to_open(origins: Vec<Origin>, has_photograph: bool) -> (FilesToOpen, Vec<Note>) {
    let kind_of = |origin: &Origin| elsewhere_kind(origin.path()?);
    let is_of_workspace = |origin: &Origin| origin.path().is_some_and(is_workspace);
    let (workspaces, pictures): (Vec<Origin>, Vec<Origin>) = origins.into_iter().partition(is_of_workspace);
    let has_photograph =
        has_photograph || !workspaces.is_empty() || pictures.iter().any(|picture| kind_of(picture).is_none());
    let is_of_elsewhere = |origin: &Origin| has_photograph && kind_of(origin).is_some();
    let (of_elsewhere, mut photographs): (Vec<Origin>, Vec<Origin>) =
        pictures.into_iter().partition(is_of_elsewhere);
    let mut notes = Vec::new();
    let mut elsewhere = ElsewherePaths::default();
    for kind in ElsewhereKind::ALL {
        let paths = of_elsewhere.iter().filter_map(Origin::path);
        let paths: Vec<&Path> = paths.filter(|path| elsewhere_kind(path) == Some(kind)).collect();
        if let Some(&last) = paths.last() {
            notes.extend(notes_of_elsewhere(kind, last, paths.len()));
            elsewhere = elsewhere.with(kind, last.to_owned());
        }
    }
    let workspace = workspaces.last().and_then(Origin::path).map(Path::to_path_buf);
    if let Some(last) = workspace.as_ref().filter(|_| workspaces.len() > 1) {
        let text = format!(
            "one workspace is opened at a time: {} was opened, {} not",
            last.display(),
            others(workspaces.len())
        );
        notes.push((Severity::Warning, text));
    }
    notes.extend(leave_out(&mut photographs, workspace.is_some()));
    (FilesToOpen { photographs, shows_first: false, elsewhere, workspace }, notes)
}

/// The sentences about `count` pictures of another program of one kind, of which `last` is opened.
fn notes_of_elsewhere(kind: ElsewhereKind, last: &Path, count: usize) -> Vec<Note> {
    let (name, file) = (kind.name(), last.display());
    let by_name = format!(
        "{file} is taken for a {name} of another program because of its name; Ctrl+O opens it as a photograph"
    );
    let mut notes = vec![(Severity::Done, by_name)];
    if count > 1 {
        let text = format!(
            "one {name} is compared with a photograph at a time: {file} was opened, {} not",
            others(count)
        );
        notes.push((Severity::Warning, text));
    }
    notes
}

/// The files of `count` but one, in words.
fn others(count: usize) -> String {
    if count == 2 { "the other one was".to_owned() } else { format!("the {} others were", count - 1) }
}

/// Leaves out the last photographs where more are to be opened than can be open, and says so.
fn leave_out(photographs: &mut Vec<Origin>, with_workspace: bool) -> Option<Note> {
    let most = MOST_OTHERS + 1 - usize::from(with_workspace);
    let first = photographs.get(most)?.name();
    let left_out = photographs.len() - most;
    photographs.truncate(most);
    let beside = if with_workspace { " beside that of a workspace" } else { "" };
    let who = if left_out == 1 {
        format!("1 photograph ({first}) was not opened")
    } else {
        format!("{left_out} photographs (from {first} on) were not opened")
    };
    let text =
        format!("{who}: {most} can be open at once{beside}, and opening more closes those shown longest ago");
    Some((Severity::Warning, text))
}

/// Words in the name of a file that is a picture of another program.
const ELSEWHERE_WORDS: [(ElsewhereKind, &[&str]); 2] = [
    (ElsewhereKind::Labels, &["label", "labels", "labelmap", "segmentation", "segments"]),
    (ElsewhereKind::Diffuse, &["diffuse"]),
];

/// What a file is by the words of its name, where the file is a picture of another program.
fn elsewhere_kind(path: &Path) -> Option<ElsewhereKind> {
    let name = path.file_stem()?.to_string_lossy().to_lowercase();
    let words: Vec<&str> = name.split(|letter: char| !letter.is_alphabetic()).collect();
    let found = ELSEWHERE_WORDS.into_iter().find(|(_, known)| known.iter().any(|word| words.contains(word)));
    found.map(|(kind, _)| kind)
}

/// The sentence that says why a photograph or a workspace could not be read, and which pictures of another program are therefore not
/// opened.
pub(super) fn with_unopened(reason: String, elsewhere: &ElsewherePaths) -> String {
    let names: Vec<String> =
        elsewhere.files().map(|(kind, path)| format!("the {} {}", kind.name(), path.display())).collect();
    if names.is_empty() {
        return reason;
    }
    format!("{reason}; without it, {} cannot be compared and was not opened", names.join(" and "))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The files with these names, where a photograph is open or not; photographs by name.
    fn opened(names: &[&str], has_photograph: bool) -> (Vec<String>, FilesToOpen, Vec<Note>) {
        let origins = names.iter().map(|name| Origin::File(PathBuf::from(name))).collect();
        let (files, notes) = files_to_open(origins, has_photograph);
        (files.photographs.iter().map(Origin::name).collect(), files, notes)
    }

    #[test]
    fn a_picture_of_another_program_is_known_by_a_word_of_its_name() {
        for (name, kind) in [
            ("/a/labels.png", Some(ElsewhereKind::Labels)),
            ("cups-Segmentation_2.tif", Some(ElsewhereKind::Labels)),
            ("scene.diffuse.exr", Some(ElsewhereKind::Diffuse)),
            ("diffused.png", None),
            ("labels/camera8.png", None),
            ("", None),
        ] {
            assert_eq!(elsewhere_kind(Path::new(name)), kind, "{name}");
        }
    }

    #[test]
    fn each_file_is_what_its_name_says_where_there_is_a_photograph_for_it() {
        let names = ["a.png", "labels.png", "b.png", "w.dichroscope", "diffuse.png"];
        let (photographs, files, notes) = opened(&names, false);
        assert_eq!(photographs, ["a.png", "b.png"], "in their order");
        assert_eq!(files.elsewhere.get(ElsewhereKind::Labels), Some(Path::new("labels.png")));
        assert_eq!(files.elsewhere.get(ElsewhereKind::Diffuse), Some(Path::new("diffuse.png")));
        assert_eq!(files.workspace, Some("w.dichroscope".into()));
        assert!(notes.len() == 2 && notes.iter().all(|(_, text)| text.contains("because of its name")));
        let (photographs, files, notes) = opened(&["labels.png", "diffuse.png"], false);
        assert_eq!(photographs, ["labels.png", "diffuse.png"], "there is no photograph for them");
        assert!(files.elsewhere == ElsewherePaths::default() && notes.is_empty());
        let (photographs, files, _) = opened(&["labels.png", "diffuse.png"], true);
        assert!(photographs.is_empty() && files.elsewhere.files().count() == 2);
        let (photographs, files, _) = opened(&["labels.dichroscope", "labels.png"], false);
        assert!(photographs.is_empty() && files.workspace == Some("labels.dichroscope".into()));
        assert_eq!(files.elsewhere.get(ElsewhereKind::Labels), Some(Path::new("labels.png")));
    }

    #[test]
    fn of_files_of_which_one_can_be_open_the_last_is_opened_and_the_others_are_told() {
        let names = ["x.dichroscope", "old labels.png", "labels.png", "y.dichroscope", "z.dichroscope"];
        let (_, files, notes) = opened(&names, true);
        assert_eq!(files.elsewhere.get(ElsewhereKind::Labels), Some(Path::new("labels.png")));
        assert_eq!(files.workspace, Some("z.dichroscope".into()));
        let warnings: Vec<&str> = notes
            .iter()
            .filter(|(severity, _)| *severity == Severity::Warning)
            .map(|(_, text)| text.as_str())
            .collect();
        assert_eq!(
            warnings,
            [
                "one label map is compared with a photograph at a time: labels.png was opened, the other one was not",
                "one workspace is opened at a time: z.dichroscope was opened, the 2 others were not",
            ]
        );
    }

    #[test]
    fn photographs_beyond_those_that_can_be_open_are_left_out_and_told() {
        let names: Vec<String> = (1..=11).map(|number| format!("{number}.png")).collect();
        let mut names: Vec<&str> = names.iter().map(String::as_str).collect();
        let (photographs, _, notes) = opened(&names[..8], true);
        assert!(photographs.len() == 8 && notes.is_empty());
        let (photographs, _, notes) = opened(&names, true);
        assert_eq!(photographs, names[..8]);
        assert!(notes[0].1.starts_with("3 photographs (from 9.png on) were not opened: 8 can be open"));
        names.insert(0, "w.dichroscope");
        let (photographs, _, notes) = opened(&names[..9], true);
        assert_eq!(photographs, names[1..8], "the workspace has a photograph too");
        assert!(notes[0].1.starts_with("1 photograph (8.png) was not opened: 7 can be open at once beside"));
    }
}
