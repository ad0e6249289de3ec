//! `counted-suite IMAGE BLOB BLOCKS`: asks a blob the questions of a firmware image. A line for
//! each kind of query, in the order of callgrind's dumps.

#[path = "../copies.rs"]
mod copies;

use std::process::ExitCode;

use meshsweep_counted::callgrind;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(lines) => {
            print!("{lines}");
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<String, String> {
    let [image, file, blocks] = arguments else {
        return Err("counted-suite IMAGE BLOB BLOCKS".to_owned());
    };
    let blocks = blocks.parse().map_err(|_| format!("`{blocks}` is not a number"))?;
    let blob = std::fs::read(file).map_err(|error| format!("{file}: {error}"))?;
    callgrind::ask(image, &blob, blocks)
}
