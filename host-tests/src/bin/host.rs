//! What the commands of `cargo xtask` need of the library on this machine.
//!
//! ```text
//! host fixtures           writes fixtures/ anew
//! host picture            writes fixtures/part.svg
//! host blobs FOLDER       writes the firmware's blobs, each beside this machine's answers
//! host c-answers          prints the lines that c-answers/answers.c has to print
//! host place FOLDER QUESTION...
//!                         writes questions for `counted`, which a simulator runs: 0.bin, 1.bin ...
//! host lay QUESTION N FILE
//!                         writes such a question for a board; prints means, then this machine's
//!                         answers
//! host fit FOLDER MESH...
//!                         writes the questions that costs are fitted to: 0.bin, 0.rows, ...
//! host fuzz               prints the names of the fuzz targets
//! host unpack TARGET FOLDER
//!                         writes the inputs that fuzzing a target begins with
//! host pack TARGET FOLDER writes such inputs as the target's corpus; prints how many they are
//! ```

use std::path::Path;
use std::process::ExitCode;

use meshsweep_host_tests::{blobs, c_answers, counted, fuzz_targets, golden, picture};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures");
    let result = match words.as_slice() {
        ["fixtures"] => golden::write(&fixtures),
        ["picture"] => picture::part(&fixtures).and_then(|svg| {
            std::fs::write(fixtures.join("part.svg"), svg).map_err(|error| error.to_string())
        }),
        ["blobs", folder] => blobs::write(Path::new(folder)),
        ["c-answers"] => c_answers::of_fixtures(&fixtures).map(|lines| print!("{lines}")),
        ["place", folder, questions @ ..] => {
            counted::place(&fixtures, Path::new(folder), questions)
        }
        ["lay", question, queries, file] => queries
            .parse()
            .map_err(|_| format!("`{queries}` is not a number"))
            .and_then(|queries| counted::lay(&fixtures, question, queries, Path::new(file)))
            .map(|lines| print!("{lines}")),
        ["fit", folder, others @ ..] => {
            counted::fit(&fixtures, Path::new(folder), others).map(|lines| print!("{lines}"))
        }
        ["fuzz"] => {
            fuzz_targets::TARGETS.iter().for_each(|target| println!("{}", target.name));
            Ok(())
        }
        ["unpack", target, folder] => fuzz_targets::unpack(target, Path::new(folder)),
        ["pack", target, folder] => {
            fuzz_targets::pack(target, Path::new(folder)).map(|inputs| println!("{inputs}"))
        }
        _ => Err("host: unknown words; its source lists what it does".to_owned()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}
