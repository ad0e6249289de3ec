//! `answers FOLDER`: hashes of the answers of the committed blobs, as `fixtures/answers.txt` and
//! `fixtures/kept/answers.txt` have them.

use std::path::Path;
use std::process::ExitCode;

use meshsweep_counted::answers::{of_fixtures, of_kept};

fn main() -> ExitCode {
    let folder = std::env::args().nth(1).ok_or_else(|| "answers FOLDER".to_owned());
    let answers = folder.and_then(|folder| {
        let folder = Path::new(&folder);
        Ok(of_fixtures(folder)? + &of_kept(&folder.join("kept"))?)
    });
    match answers {
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
