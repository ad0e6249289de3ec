//! Triangle fans on a Cortex-M4F and a Cortex-M0: instructions of a fan that is asked, by what it
//! stores (paper 003, 3.3 and 4.3).

use meshsweep_host_tests::workload::Subject;
use meshsweep_lab::measure::paper::fan_kernel::{NOTHING, STORED};
use meshsweep_lab::measure::paper::fan_sample::{ASKED, Sample};
use meshsweep_xtask::boards::{BOARDS, Board};
use meshsweep_xtask::process;
use meshsweep_xtask::qemu::Qemu;
use meshsweep_xtask::rival::fans;
use meshsweep_xtask::table::{Table, fixed};
use meshsweep_xtask::tools::Tools;
use meshsweep_xtask::workspace;
use std::fs;
use std::path::Path;

/// Questions, in the order of the columns.
const QUESTIONS: [&str; 2] = ["distance", "segment"];

/// The table of a mesh. The bits of all answers are the host's, or it is an error.
pub fn table(tools: &Tools, mesh: &Path) -> Result<Table, String> {
    let subject = Subject::load_any(mesh)?;
    let sample = Sample::of(&subject)?;
    let folder = workspace::target().join("fans").join(&subject.name);
    fs::create_dir_all(&folder)
        .and_then(|()| fs::write(folder.join("fans.rs"), sample.source()))
        .map_err(|error| format!("{}: {error}", folder.display()))?;
    let qemu = Qemu::find()?;
    let bits = sample.bits()?;
    let boards = &BOARDS[..2];
    let counts = boards.iter().map(|board| {
        let (mut command, image) = fans(tools.cross(), board, "build");
        process::capture(command.arg("--release").env("MESHSWEEP_FANS", &folder))?;
        let printed = qemu.run(board.machine, &image, None)?;
        QUESTIONS
            .iter()
            .zip(bits)
            .map(|(question, bits)| parse(&printed, board, question, bits))
            .collect()
    });
    let counts = counts.collect::<Result<Vec<Vec<Vec<f64>>>, String>>()?;
    let columns = ["stored", "M4F, distance", "M4F, segment", "M0, distance", "M0, segment"];
    let title = "What fans may store, paper 003, 3.3 and 4.3: instructions of a fan asked, mean";
    let mut table = Table::new("fan_storage_on_boards", title, &columns);
    for (kind, stored) in STORED.into_iter().enumerate() {
        let cells = counts.iter().flatten().map(|of| fixed(of[kind], 0));
        table.push(std::iter::once(stored.into()).chain(cells).collect());
    }
    table.note(format!(
        "{ASKED} fans that a tree asks about points near the surface, and {ASKED} about segments, \
         of {:.1} triangles in the mean; numbers of f32, the loop around the kernel not counted",
        sample.triangles
    ));
    Ok(table)
}

/// Instructions of a mean question, of each kernel.
fn parse(printed: &str, board: &Board, question: &str, bits: u32) -> Result<Vec<f64>, String> {
    let mut counts = Vec::new();
    for line in printed.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let ["asked", of, kind, asked, ticks, told] = words[..] else { continue };
        if of != question {
            continue;
        }
        if told != bits.to_string() && kind != NOTHING.to_string() {
            return Err(format!("`{line}`: other answers than {bits}"));
        }
        let number = |text: &str| text.parse::<f64>().map_err(|_| format!("`{line}`"));
        counts.push(number(ticks)? * board.instructions_per_tick / number(asked)?);
    }
    let [kernels @ .., loop_alone] = counts.as_slice() else {
        return Err(format!("the image printed:\n{printed}"));
    };
    if kernels.len() != STORED.len() || !printed.ends_with("done\n") {
        return Err(format!("the image printed:\n{printed}"));
    }
    Ok(kernels.iter().map(|count| count - loop_alone).collect())
}
