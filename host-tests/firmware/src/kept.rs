//! A meter that keeps the ticks of each query in external RAM, for printing would take stack.

use meshsweep_suite::Observer;
use semihosting::println;

use crate::meter::Meter;
use crate::stack;

/// The external RAM of mps2-an385 and mps2-an386, and of mps2-an500: 16 MiB.
const EXTERNAL: usize = if cfg!(cortex_m7) { 0x6000_0000 } else { 0x2100_0000 };

/// Where the emulator puts the host's file: the first half.
const LOADED: *const u8 = EXTERNAL as *const u8;
const BYTES: usize = 8 << 20;

/// The second half has the ticks of each query: a query takes more than four bytes of the file.
const TICKS: *mut u32 = (EXTERNAL + BYTES) as *mut u32;

/// What the host wrote for this image, and what follows it.
#[must_use]
pub fn loaded() -> &'static [u8] {
    // SAFETY: memory that nothing writes.
    unsafe { core::slice::from_raw_parts(LOADED, BYTES) }
}

/// Counts, and keeps each count.
#[derive(Debug)]
pub struct Kept {
    meter: Meter,
    /// Queries of this name begin here.
    begun: usize,
    queries: usize,
}

impl Kept {
    /// Nothing is counted yet.
    #[must_use]
    pub fn new() -> Self {
        Self { meter: Meter::new(), begun: 0, queries: 0 }
    }

    /// Prints hash and costs of the queries since the last ones that were printed.
    pub fn print(&mut self, name: &str, hash: u64) {
        self.meter.block_of(name, 0, hash);
        self.meter.costs_of(name);
        for query in self.begun..self.queries {
            // SAFETY: written by a query.
            println!("each {}", unsafe { TICKS.add(query).read_volatile() });
        }
        (self.meter, self.begun) = (Meter::new(), self.queries);
    }
}

impl Default for Kept {
    fn default() -> Self {
        Self::new()
    }
}

impl Observer for Kept {
    #[inline]
    fn query_begins(&mut self) {
        if self.queries == self.begun {
            // Something else ran since the last paint.
            stack::paint();
        }
        self.meter.query_begins();
    }

    #[inline]
    fn query_ends(&mut self) {
        self.meter.query_ends();
        // SAFETY: within the second half.
        unsafe { TICKS.add(self.queries).write_volatile(self.meter.last()) };
        self.queries += 1;
    }
}
