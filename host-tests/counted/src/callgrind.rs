//! The suite's questions, counted one by one: callgrind collects only while the core answers.
//!
//! ```text
//! valgrind --tool=callgrind --collect-atstart=no counted-suite IMAGE BLOB BLOCKS
//! ```
//! Each kind of query ends with a dump, so one run of the simulator counts all kinds.

use meshsweep_suite::ask::{
    Refused, apart, both, curve, deform, hull, hull_moving, sdf, tight, tree, triboxes,
};
use meshsweep_suite::{Kind, Observer, Plan, Recorder, run};

/// Asks a blob the questions of a firmware image, so many blocks of each kind. A line for each
/// dump: the kind, and the queries that were asked.
///
/// # Errors
/// An unknown image, or a blob that is refused.
pub fn ask(image: &str, blob: &[u8], blocks: u32) -> Result<String, String> {
    let plan = Plan { tabled_blocks: blocks, blocks, ..Plan::STANDARD };
    let mut collect = Collect { queries: 0, lines: String::new() };
    let to = &mut collect;
    let ran = match image {
        "suite_tree" => run::<tree::Bvh<'_>>(blob, plan, &mut tree::Scratch::new(), to),
        "suite_apart" => run::<apart::Apart<'_>>(blob, plan, &mut apart::Scratch::new(), to),
        "suite_hull" => run::<hull::Model<'_>>(blob, plan, &mut hull::Scratch::new(), to),
        "suite_moving" => {
            run::<hull_moving::Moving<'_>>(blob, plan, &mut hull_moving::Scratch::new(), to)
        }
        "suite_triboxes" => {
            run::<triboxes::Triboxes<'_>>(blob, plan, &mut triboxes::Scratch::new(), to)
        }
        "suite_tight" => run::<tight::Hulls<'_>>(blob, plan, &mut tight::Scratch::new(), to),
        "suite_curve" => run::<curve::Curve<'_>>(blob, plan, &mut curve::Scratch::new(), to),
        "suite_sdf" => run::<sdf::Sdf<'_>>(blob, plan, &mut sdf::Scratch::new(), to),
        "suite_both" => run::<both::BvhWithSdf<'_>>(blob, plan, &mut both::Scratch::new(), to),
        "suite_deform" => {
            run::<deform::DeformableHull<'_>>(blob, plan, &mut deform::Scratch::new(), to)
        }
        _ => return Err(format!("no image `{image}`")),
    };
    ran.map_err(|Refused(error)| format!("the core refuses the blob: error {error}"))?;
    Ok(collect.lines)
}

/// Tells callgrind when to collect and when to write.
struct Collect {
    queries: u32,
    lines: String,
}

impl Observer for Collect {
    #[inline(always)]
    fn query_begins(&mut self) {
        request(Request::ToggleCollect);
    }

    #[inline(always)]
    fn query_ends(&mut self) {
        request(Request::ToggleCollect);
        self.queries += 1;
    }
}

impl Recorder for Collect {
    fn kind_begins(&mut self, _kind: Kind) {
        self.queries = 0;
    }

    fn block(&mut self, _kind: Kind, _index: u32, _hash: u64) {}

    fn kind_ends(&mut self, kind: Kind) {
        // What a blob says of itself is not timed.
        if self.queries > 0 {
            request(Request::DumpStats);
            self.lines.push_str(&format!("{} {}\n", kind.name(), self.queries));
        }
    }
}

/// Requests to callgrind, by the numbers of `callgrind.h`.
#[derive(Clone, Copy)]
enum Request {
    /// Writes the counters to a file of its own and sets them to zero.
    DumpStats = 0x4354_0000,
    /// Collects from here on, or no longer.
    ToggleCollect = 0x4354_0002,
}

/// Makes a request: the rotations of `valgrind.h`, which do nothing outside of valgrind.
#[inline(always)]
fn request(request: Request) {
    #[cfg(target_arch = "x86_64")]
    {
        let words = [request as u64, 0, 0, 0, 0, 0];
        // SAFETY: the rotations add up to 128 bits, so `rdi` is as before; valgrind reads six words
        // at `rax` and writes its answer to `rdx`.
        unsafe {
            core::arch::asm!(
                "rol rdi, 3",
                "rol rdi, 13",
                "rol rdi, 61",
                "rol rdi, 51",
                "xchg rbx, rbx",
                in("rax") words.as_ptr(),
                inlateout("rdx") 0u64 => _,
                options(nostack),
            );
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = request;
}
