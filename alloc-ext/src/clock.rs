//! The time, where the target has a clock.

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
pub(crate) use std::time::Instant;
#[cfg(all(target_family = "wasm", target_os = "unknown"))]
pub(crate) use without::Instant;

/// WebAssembly without a host's functions has no clock, and the one of std panics there.
#[cfg(all(target_family = "wasm", target_os = "unknown"))]
mod without {
    use std::ops::Add;
    use std::time::Duration;

    /// The start, and what was added to it: all times are 0, and no time limit passes.
    #[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
    pub(crate) struct Instant(Duration);

    impl Instant {
        pub const fn now() -> Self {
            Self(Duration::ZERO)
        }

        pub const fn elapsed(self) -> Duration {
            Duration::ZERO
        }

        pub fn checked_add(self, later: Duration) -> Option<Self> {
            self.0.checked_add(later).map(Self)
        }

        pub const fn saturating_duration_since(self, earlier: Self) -> Duration {
            self.0.saturating_sub(earlier.0)
        }
    }

    impl Add<Duration> for Instant {
        type Output = Self;

        fn add(self, later: Duration) -> Self {
            Self(self.0 + later)
        }
    }
}
