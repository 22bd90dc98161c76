//! Arguments → window or command → exit code.

mod cli;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    cli::start_log();
    #[cfg(feature = "gui")]
    match arguments.command {
        None => return ended(dichroscope::gui::open(arguments.image)),
        Some(cli::Command::Screenshot(wish)) => return ended(screenshot(wish)),
        Some(_) => {}
    }
    cli::run(arguments)
}

#[cfg(feature = "gui")]
fn screenshot(wish: cli::ScreenshotArguments) -> Result<(), dichroscope::gui::ScreenshotError> {
    use dichroscope::view::Origin;
    let origin = wish.image.map_or(Origin::Sample(wish.scene), Origin::File);
    for path in dichroscope::gui::screenshot(&wish.out, wish.size, origin)? {
        cli::print(&format!("{}\n", path.display()));
    }
    Ok(())
}

#[cfg(feature = "gui")]
fn ended<E: std::fmt::Display>(outcome: Result<(), E>) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cli::note(&format!("error: {error}"));
            ExitCode::from(1)
        }
    }
}
