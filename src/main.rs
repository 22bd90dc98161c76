//! Arguments → window or command → exit code.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    #[cfg(feature = "gui")]
    if arguments.command.is_none() {
        return window(arguments.image);
    }
    cli::run(arguments)
}

#[cfg(feature = "gui")]
fn window(photograph: Option<std::path::PathBuf>) -> ExitCode {
    match dichroscope::gui::open(photograph) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cli::note(&format!("error: {error}"));
            ExitCode::from(1)
        }
    }
}
