//! A hash table from small integer keys to the first item that had the key.
//!
//! Welding and duplicate search insert every item once and ask nothing else. Open addressing over
//! item numbers is several times faster for that than a general map, and the result depends on the
//! input only.

const EMPTY: u32 = u32::MAX;

/// Items by key; the keys stay with the caller.
pub(super) struct FirstSeen {
    slots: Vec<u32>,
    mask: usize,
}

impl FirstSeen {
    /// Room for `count` items.
    pub(super) fn new(count: usize) -> Self {
        let size = (count.max(4) * 2).next_power_of_two();
        Self { slots: vec![EMPTY; size], mask: size - 1 }
    }

    /// The item seen first with the same key as `item`, perhaps itself. `key_of` must give the key
    /// of any item seen.
    pub(super) fn insert(&mut self, item: u32, key_of: impl Fn(u32) -> [u32; 3]) -> u32 {
        let key = key_of(item);
        let mut slot = mix(key) & self.mask;
        loop {
            match self.slots[slot] {
                EMPTY => {
                    self.slots[slot] = item;
                    return item;
                }
                seen if key_of(seen) == key => return seen,
                _ => slot = (slot + 1) & self.mask,
            }
        }
    }
}

/// SplitMix64's finaliser over the key: neighbouring coordinates and indices must not fall into
/// neighbouring slots.
fn mix([a, b, c]: [u32; 3]) -> usize {
    let mut h =
        (u64::from(a) | u64::from(b) << 32) ^ u64::from(c).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    h = (h ^ (h >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    h = (h ^ (h >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (h ^ (h >> 31)) as usize
}
