//! One type for each kind of index, so that one cannot be passed for another.

macro_rules! index {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[cfg_attr(feature = "defmt", derive(defmt::Format))]
        pub struct $name(pub u32);

        impl $name {
            /// For addressing slices.
            #[inline(always)]
            pub fn usize(self) -> usize {
                self.0 as usize
            }
        }
    };
}

index! {
    /// A vertex of any level: base vertices first, then two for each split.
    VertIdx
}
index! {
    /// A vertex split, coarse to fine.
    SplitIdx
}
index! {
    /// A triangle of the surface: base triangles first, then those of each split.
    TriIdx
}
