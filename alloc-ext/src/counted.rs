//! A number with its noun, for messages and reports.

use std::fmt;

/// `1 face`, `2 faces`, `2 patches`, `3 entries`, `4 leaves`, `5 vertices`, `6 triboxes`. The noun
/// is given in the singular.
#[derive(Clone, Copy, Debug)]
pub struct Counted<T>(
    /// The number.
    pub T,
    /// The noun, singular.
    pub &'static str,
);

impl<T: Copy + TryInto<u64> + fmt::Display> fmt::Display for Counted<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Counted(count, noun) = *self;
        let is_one = count.try_into().is_ok_and(|count| count == 1);
        let endings =
            [("y", "ies"), ("f", "ves"), ("ex", "ices"), ("ox", "oxes"), ("ch", "ches"), ("", "s")];
        let plural = |(from, to)| Some((noun.strip_suffix(from)?, to));
        let (stem, ending) =
            endings.into_iter().find_map(plural).filter(|_| !is_one).unwrap_or((noun, ""));
        write!(f, "{count} {stem}{ending}")
    }
}

#[cfg(test)]
mod tests {
    use super::Counted;

    #[test]
    fn one_is_singular_and_all_else_is_plural() {
        let said = |count: usize| Counted(count, "face").to_string();
        assert_eq!([said(0), said(1), said(2)], ["0 faces", "1 face", "2 faces"]);
        assert_eq!(Counted(1u32, "stack entry").to_string(), "1 stack entry");
        assert_eq!(Counted(3u32, "stack entry").to_string(), "3 stack entries");
        assert_eq!(Counted(4u64, "leaf").to_string(), "4 leaves");
        assert_eq!(Counted(2u64, "patch").to_string(), "2 patches");
        assert_eq!(Counted(5u64, "vertex").to_string(), "5 vertices");
        assert_eq!(Counted(6u64, "tribox").to_string(), "6 triboxes");
    }
}
