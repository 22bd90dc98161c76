//! Writers that are killed at any moment leave the old or the new whole: single files, and what the window writes.

use dichroscope::app::{Application, Executor, ExportKind, JobCommand, Workspace};
use dichroscope::export::{read_report, remove_leftovers, write_file};
use dichroscope::photo::{ReadOptions, read};
use dichroscope::view::Origin;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Number of bytes of a single file: as long as a workspace with an area.
const LENGTH: usize = 300_000;
const PLACE: &str = "DICHROSCOPE_TEST_PLACE";
const WRITES: &str = "DICHROSCOPE_TEST_WRITES";

/// What is written again and again.
#[derive(Clone, Copy, Debug)]
enum Written {
    /// A file of one letter.
    Letters,
    /// An export of the window.
    Export(ExportKind),
}

impl Written {
    const ALL: [Self; 5] = [
        Self::Letters,
        Self::Export(ExportKind::Workspace),
        Self::Export(ExportKind::Result),
        Self::Export(ExportKind::Matte),
        Self::Export(ExportKind::Layer),
    ];

    /// Fails where `place` is not whole.
    fn expect_whole(self, place: &Path) {
        match self {
            Self::Letters => {
                let text = fs::read(place).unwrap();
                assert_eq!(text.len(), LENGTH);
                assert!(text.iter().all(|letter| *letter == text[0]));
            }
            Self::Export(ExportKind::Workspace) => drop(Workspace::load(place).unwrap()),
            Self::Export(ExportKind::Result) => {
                read_report(place).unwrap();
                for entry in fs::read_dir(place).unwrap() {
                    let path = entry.unwrap().path();
                    if path.extension().is_some_and(|extension| extension != "json") {
                        read(&path, &ReadOptions::default()).unwrap();
                    }
                }
                assert_eq!(fs::read_dir(place).unwrap().count(), 16);
            }
            Self::Export(_) => drop(read(place, &ReadOptions::default()).unwrap()),
        }
    }
}

/// Writes again and again, for the test below, which kills it.
#[test]
#[ignore = "runs until it is killed"]
fn writes_until_killed() {
    let (Some(place), Ok(which)) = (std::env::var_os(PLACE), std::env::var(WRITES)) else { return };
    let place = Path::new(&place);
    match Written::ALL[which.parse::<usize>().unwrap()] {
        Written::Letters => {
            for letter in (b'a'..=b'z').cycle() {
                write_file(place, &vec![letter; LENGTH]).unwrap();
            }
        }
        Written::Export(kind) => {
            let mut application = Application::new(Executor::Inline, || ()).unwrap();
            application.apply(JobCommand::Open(Origin::Sample("cups3_yellow".to_owned())));
            loop {
                application.apply(JobCommand::Export(kind.to(place)));
            }
        }
    }
}

/// Whether there is anything at a place. Waits for it for ten seconds.
fn appears(place: &Path) -> bool {
    let begin = Instant::now();
    while !place.exists() && begin.elapsed() < Duration::from_secs(10) {
        std::thread::sleep(Duration::from_millis(2));
    }
    place.exists()
}

#[test]
fn what_is_written_is_whole_after_a_kill() {
    let rounds = if std::env::var_os("DICHROSCOPE_LONG_TESTS").is_some() { 200 } else { 4 };
    for (which, written) in Written::ALL.into_iter().enumerate() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("a.png");
        let mut found = 0;
        for round in 0..rounds {
            let mut writer = Command::new(std::env::current_exe().unwrap());
            writer.args(["--exact", "kills::writes_until_killed", "--ignored"]);
            writer.env(PLACE, &place).env(WRITES, which.to_string());
            let mut writer = writer.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            if round % 2 == 0 {
                assert!(appears(&place), "{written:?}");
            }
            std::thread::sleep(Duration::from_millis(20 + (round * 13) % 270));
            let _ = writer.kill();
            writer.wait().unwrap();
            if place.exists() {
                written.expect_whole(&place);
                found += 1;
            }
        }
        // The next writer, and the next run of the program, remove what the killed ones left.
        remove_leftovers(folder.path());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "{written:?}: nothing else is left");
        println!("{written:?}: {rounds} kills, {found} times there, each time whole");
    }
}
