//! Helpers that run the program in a temporary folder.

use assert_cmd::cargo::cargo_bin_cmd;
use dichroscope::describe::Report;
use dichroscope::export::read_report;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A temporary folder in which the program runs.
pub struct WorkFolder {
    temporary: TempDir,
}

/// Exit code and output of a run.
pub struct Ended {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl WorkFolder {
    pub fn new() -> Self {
        Self { temporary: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.temporary.path().join(name)
    }

    /// Copies the tiny scene's photograph into the folder.
    pub fn photo(&self, name: &str) {
        self.put(name, &fs::read(tiny().join("camera8.png")).unwrap());
    }

    pub fn put(&self, name: &str, bytes: &[u8]) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }

    /// Runs the program without a display in its environment.
    pub fn run(&self, arguments: &str) -> Ended {
        self.run_piped(arguments, &[])
    }

    /// Like [`Self::run`], with `input` piped to the program's standard input.
    pub fn run_piped(&self, arguments: &str, input: &[u8]) -> Ended {
        let tiny = tiny().display().to_string();
        let arguments = arguments.split_whitespace().map(|word| word.replace("TINY", &tiny));
        let mut program = cargo_bin_cmd!("dichroscope");
        for name in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            program.env_remove(name);
        }
        program.current_dir(self.temporary.path()).args(arguments).write_stdin(input);
        let output = program.output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Ended { code: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
    }

    #[track_caller]
    pub fn succeeds(&self, arguments: &str) -> Ended {
        let ended = self.run(arguments);
        assert_eq!(ended.code, 0, "{arguments}: {}", ended.err);
        ended
    }

    #[track_caller]
    pub fn fails(&self, code: i32, arguments: &str, says: &str) {
        let ended = self.run(arguments);
        assert_eq!(ended.code, code, "{arguments}: {}", ended.err);
        assert!(ended.err.contains(says), "{arguments}: expected {says:?} in {:?}", ended.err);
    }

    pub fn report(&self, result: &str) -> Report {
        read_report(&self.path(result)).unwrap()
    }

    /// Names of the files in a folder, including hidden files.
    pub fn list(&self, folder: &str) -> Vec<String> {
        list(&self.path(folder))
    }
}

pub fn tiny() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/tiny")
}

pub fn list(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
