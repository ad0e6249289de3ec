//! Three numbers or corners, each by itself.

/// `values.map(of)`, which at `opt-level = "s"` stays a loop over memory.
#[inline(always)]
pub fn each<T, U>([a, b, c]: [T; 3], of: impl Fn(T) -> U) -> [U; 3] {
    [of(a), of(b), of(c)]
}
