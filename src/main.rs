//! Arguments → window or command → exit code.

mod cli;

use std::process::ExitCode;

/// Size of the block that [`keep_freed_memory`] takes and frees: above that of any image of a picture of a third of a megapixel. With larger
/// blocks a photograph of 12 megapixels needs more memory at once.
const FREED_BYTES: usize = 6 << 20;

/// Makes the allocator of glibc keep freed images for the next ones. Freeing a block that was mapped alone raises the sizes from which glibc
/// maps blocks alone and gives freed memory back to the system (`M_MMAP_THRESHOLD` in mallopt(3)); before, each step of an analysis waits for
/// fresh pages anew, up to a quarter of its time. Other allocators are not affected.
fn keep_freed_memory() {
    drop(std::hint::black_box(Vec::<u8>::with_capacity(FREED_BYTES)));
}

fn main() -> ExitCode {
    keep_freed_memory();
    let arguments = match cli::parse() {
        Ok(arguments) => arguments,
        Err(ended) => return ended,
    };
    cli::start_log();
    if let Err(error) = cli::expect_files_to_show(&arguments) {
        cli::note(&format!("error: {error}"));
        return ExitCode::from(2);
    }
    #[cfg(feature = "gui")]
    match arguments.command {
        None => {
            let (labels, diffuse) = (arguments.labels, arguments.diffuse);
            let elsewhere = dichroscope::view::ElsewherePaths { labels, diffuse };
            return ended(dichroscope::gui::open(arguments.images, elsewhere));
        }
        Some(cli::Command::Screenshot(wish)) => return screenshot(wish),
        Some(_) => {}
    }
    cli::run(arguments)
}

#[cfg(feature = "gui")]
fn screenshot(wish: cli::ScreenshotArguments) -> ExitCode {
    use dichroscope::view::Origin;
    let origin = wish.image.map_or(Origin::Sample(wish.scene), Origin::File);
    match dichroscope::gui::screenshot(&wish.out, wish.size, origin) {
        Ok(paths) => {
            let lines: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
            cli::print_and_end(&(lines.join("\n") + "\n"))
        }
        Err(error) => ended(Err(error)),
    }
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
