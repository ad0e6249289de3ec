//! `counted FILE N`: asks the first N queries of a question that `host place` wrote.

#[path = "../copies.rs"]
mod copies;

use std::process::ExitCode;

use meshsweep_counted::Counted;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<String, String> {
    let [file, queries] = arguments else { return Err("counted FILE N".to_owned()) };
    let queries = queries.parse().map_err(|_| format!("`{queries}` is not a number"))?;
    let bytes = std::fs::read(file).map_err(|error| format!("{file}: {error}"))?;
    Counted::read(&bytes).ok_or_else(|| format!("{file} is no question"))?.ask(queries)
}
