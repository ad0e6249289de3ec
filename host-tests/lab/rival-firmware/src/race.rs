//! Asks an engine the questions that the image carries, and prints what each set of them took.
//!
//! One line a fact, words separated by one space:
//! ```text
//! calibration INSTRUCTIONS TICKS
//! reading ROUNDS TICKS                                what reading the counter costs
//! build TICKS STACK HEAP MOST MEMORY                  bytes of heap after it, and the most while
//! it ran; bytes beside heap and stack asked KIND QUERIES TICKS MAX STACK HEAP FOUND SUM   heap
//! beyond what building left; f64 sum of the answers, its bits done
//! ```

use core::hint::black_box;

use meshsweep_firmware::{board, stack};
use semihosting::{println, process};

use crate::records::Records;

/// An engine that answers for one mesh.
pub trait Engine {
    /// Its answer to a closest-point question. Only making it is timed.
    type Closest;
    /// Bytes of RAM that it keeps for its queries outside of heap and stack.
    fn memory(&self) -> usize {
        0
    }
    /// Closest point of the surface.
    fn closest(&mut self, point: [f32; 3]) -> Self::Closest;
    /// Closest point to the next point of a path: an engine may start from what it found for the
    /// one before.
    fn follow(&mut self, point: [f32; 3]) -> Self::Closest {
        self.closest(point)
    }
    /// The distance in such an answer: for the sum by which the host knows that the answers are
    /// right.
    fn distance(point: [f32; 3], closest: &Self::Closest) -> f32;
    /// Parameter of a segment's first hit, 0 at `a` and 1 at `b`.
    fn first_hit(&mut self, a: [f32; 3], b: [f32; 3]) -> Option<f32>;
}

/// Questions of all kinds, by their names.
#[derive(Clone, Copy, Debug)]
pub struct Questions {
    /// Sets of query points that have nothing to do with each other.
    pub points: [(&'static str, Records<3>); 2],
    /// Points along a path.
    pub path: (&'static str, Records<3>),
    /// Segments: both ends.
    pub segments: (&'static str, Records<6>),
}

/// Bytes of heap in use, and the most since it was last asked.
pub type Heap = fn() -> (usize, usize);

/// Rounds that find out what reading the counter costs: a tick is many instructions, so only a mean
/// tells.
const ROUNDS: u32 = 4_000;

/// Builds an engine, asks it everything, prints, and leaves the emulator. An engine without a heap
/// passes `|| (0, 0)`.
pub fn run<E: Engine>(questions: &Questions, heap: Heap, build: impl FnOnce() -> E) -> ! {
    board::start_counter();
    let (instructions, ticks) = board::calibrate();
    println!("calibration {instructions} {ticks}");
    println!("reading {ROUNDS} {}", reading());
    stack::paint();
    let begun = board::now();
    let mut engine = build();
    let ticks = board::elapsed(begun, board::now());
    let deep = depth();
    let (used, most) = heap();
    println!("build {ticks} {deep} {used} {most} {}", engine.memory());
    for (name, points) in questions.points {
        let mut asked = Asked::new(heap);
        for point in points.numbers() {
            let closest = asked.time(|| engine.closest(black_box(point)));
            asked.found(E::distance(point, &closest));
        }
        asked.print(name);
    }
    let (name, path) = questions.path;
    let mut asked = Asked::new(heap);
    for point in path.numbers() {
        let closest = asked.time(|| engine.follow(black_box(point)));
        asked.found(E::distance(point, &closest));
    }
    asked.print(name);
    let (name, segments) = questions.segments;
    let mut asked = Asked::new(heap);
    for [ax, ay, az, bx, by, bz] in segments.numbers() {
        let hit = asked.time(|| {
            let [a, b] = black_box([[ax, ay, az], [bx, by, bz]]);
            engine.first_hit(a, b)
        });
        if let Some(parameter) = hit {
            asked.found(parameter);
        }
    }
    asked.print(name);
    println!("done");
    process::exit(0)
}

/// Bytes of the stack below the caller that were used since [`stack::paint`].
#[inline(always)]
fn depth() -> usize {
    board::stack_pointer().saturating_sub(stack::lowest())
}

fn reading() -> u32 {
    (0..ROUNDS)
        .map(|_| {
            let begun = board::now();
            board::elapsed(begun, board::now())
        })
        .sum()
}

/// What one set of questions took.
struct Asked {
    heap: Heap,
    used: usize,
    queries: u32,
    ticks: u64,
    max: u32,
    found: u32,
    sum: f64,
}

impl Asked {
    fn new(heap: Heap) -> Self {
        let (used, _) = heap();
        stack::paint();
        Self { heap, used, queries: 0, ticks: 0, max: 0, found: 0, sum: 0.0 }
    }

    #[inline(always)]
    fn time<T>(&mut self, question: impl FnOnce() -> T) -> T {
        let begun = board::now();
        let answer = black_box(question());
        let ticks = board::elapsed(begun, board::now());
        self.queries += 1;
        self.ticks += u64::from(ticks);
        self.max = self.max.max(ticks);
        answer
    }

    fn found(&mut self, value: f32) {
        self.found += 1;
        self.sum += f64::from(value);
    }

    fn print(self, name: &str) {
        // Before printing, whose own frames must not count.
        let deep = depth();
        let most = (self.heap)().1 - self.used;
        let Self { queries, ticks, max, found, sum, .. } = self;
        println!(
            "asked {name} {queries} {ticks} {max} {deep} {most} {found} {:016x}",
            sum.to_bits()
        );
    }
}
