//! `answers FOLDER`: hashes of the answers of the committed blobs, as `fixtures/answers.txt` has
//! them.

use std::path::Path;
use std::process::ExitCode;

use meshsweep_counted::answers::of_fixtures;

fn main() -> ExitCode {
    let folder = std::env::args().nth(1).ok_or_else(|| "answers FOLDER".to_owned());
    match folder.and_then(|folder| of_fixtures(Path::new(&folder))) {
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
