//! Time on a Cortex-M: SysTick counts the processor's clock, and interrupts 1,000 times a second.

use core::sync::atomic::{AtomicU32, Ordering::Relaxed};
use cortex_m::peripheral::{Peripherals, SYST, syst::SystClkSource};
use cortex_m_rt::exception;

/// Processor clock of mps2-an386. For your board write its own.
pub const CLOCK_HZ: u32 = 25_000_000;
/// Ticks of a millisecond.
const PERIOD: u32 = CLOCK_HZ / 1000;
/// In QEMU an instruction takes 1 ns, and a tick 40. On a board write 1: a tick is a cycle.
const PER_TICK: u32 = 40;

static PERIODS: AtomicU32 = AtomicU32::new(0);

#[exception]
fn SysTick() {
    PERIODS.store(periods().wrapping_add(1), Relaxed);
}

/// Starts the periods. Call it once.
pub fn start() {
    let mut timer = Peripherals::take().expect("called once").SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(PERIOD - 1);
    timer.clear_current();
    timer.enable_interrupt();
    timer.enable_counter();
}

/// Milliseconds since the start.
pub fn periods() -> u32 {
    PERIODS.load(Relaxed)
}

/// Sleeps until another period than this one. A pending interrupt ends the sleep although it is
/// masked, so none is missed between the comparison and the sleep.
#[allow(dead_code, reason = "only loops with a period wait for it")]
pub fn sleep_during(period: u32) {
    while periods() == period {
        cortex_m::interrupt::free(|_| {
            if periods() == period {
                cortex_m::asm::wfi();
            }
        });
    }
}

/// What a call returns, and the instructions that it took.
pub fn timed<T>(call: impl FnOnce() -> T) -> (T, u32) {
    let from = ticks();
    let value = call();
    (value, ticks().wrapping_sub(from) * PER_TICK)
}

fn ticks() -> u32 {
    loop {
        let (periods_before, left) = (periods(), SYST::get_current());
        if periods() == periods_before {
            // The interrupt comes at 0. The next tick has PERIOD - 1 left.
            return periods_before.wrapping_mul(PERIOD).wrapping_add((PERIOD - left) % PERIOD);
        }
    }
}
