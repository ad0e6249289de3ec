//! The suite's recorder on a board: prints hashes, counts ticks, measures the stack.

use meshsweep_suite::{Kind, Observer, Recorder};
use semihosting::println;

use crate::{board, stack};

/// Ticks of one kind, and the stack below the functions of the suite that call the core.
#[derive(Debug)]
pub struct Meter {
    begun: u32,
    /// Where the stack ended when the core was called.
    pointer: usize,
    overhead: u32,
    last: u32,
    queries: u32,
    min: u32,
    sum: u64,
    max: u32,
    deepest: usize,
}

impl Meter {
    /// A meter that has measured what reading the counter costs.
    #[must_use]
    pub fn new() -> Self {
        let mut meter = Self {
            begun: 0,
            pointer: 0,
            overhead: 0,
            last: 0,
            queries: 0,
            min: u32::MAX,
            sum: 0,
            max: 0,
            deepest: 0,
        };
        // The least of several: else one reading that a tick falls into would take a tick from
        // every query.
        meter.overhead = u32::MAX;
        for _ in 0..8 {
            meter.query_begins();
            meter.overhead = meter.overhead.min(board::elapsed(meter.begun, board::now()));
        }
        meter
    }
}

impl Meter {
    /// Prints the hash of a block of answers and the ticks of all queries so far, and looks how
    /// deep the stack was.
    pub fn block_of(&mut self, name: &str, index: u32, hash: u64) {
        // Before and after printing, whose own frames must not count.
        self.deepest = self.deepest.max(self.pointer.saturating_sub(stack::lowest()));
        println!("block {name} {index} {hash:016x} {}", self.sum);
        stack::paint();
    }

    /// Ticks of the last query.
    #[must_use]
    pub const fn last(&self) -> u32 {
        self.last
    }

    /// Prints ticks and stack.
    pub fn costs_of(&self, name: &str) {
        let Self { queries, min, sum, max, deepest, .. } = *self;
        // What a blob says of itself is not timed.
        if queries > 0 {
            println!("ticks {name} {queries} {min} {sum} {max}");
            println!("stack {name} {deepest}");
        }
    }
}

impl Default for Meter {
    fn default() -> Self {
        Self::new()
    }
}

impl Observer for Meter {
    #[inline]
    fn query_begins(&mut self) {
        self.pointer = board::stack_pointer();
        self.begun = board::now();
    }

    #[inline]
    fn query_ends(&mut self) {
        let ticks = board::elapsed(self.begun, board::now()).saturating_sub(self.overhead);
        self.last = ticks;
        self.queries += 1;
        self.min = self.min.min(ticks);
        self.max = self.max.max(ticks);
        self.sum += u64::from(ticks);
    }
}

impl Recorder for Meter {
    #[inline(always)]
    fn opening_begins(&mut self) {
        self.pointer = board::stack_pointer();
        stack::paint();
    }

    fn begins(&mut self, memory: usize) {
        let opening = self.pointer.saturating_sub(stack::lowest());
        println!("opening {opening}");
        println!("scratch {memory}");
    }

    fn kind_begins(&mut self, _kind: Kind) {
        *self = Self::new();
        stack::paint();
    }

    fn block(&mut self, kind: Kind, index: u32, hash: u64) {
        self.block_of(kind.name(), index, hash);
    }

    fn kind_ends(&mut self, kind: Kind) {
        self.costs_of(kind.name());
    }
}
