//! Who looks at the clock.

/// Told when the core is called: what lies between the two is the core's alone, without placing the
/// query and folding the answer.
pub trait Clock {
    /// The core is about to be called.
    fn query_begins(&mut self) {}
    /// The core has answered.
    fn query_ends(&mut self) {}
}

/// Nobody looks at the clock.
impl Clock for () {}

impl<C: Clock> Clock for &mut C {
    fn query_begins(&mut self) {
        C::query_begins(self);
    }

    fn query_ends(&mut self) {
        C::query_ends(self);
    }
}
