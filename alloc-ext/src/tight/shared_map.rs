//! Maps that clones share. Searches on several threads begin with what all know, and each adds its
//! own.

use rustc_hash::FxHashMap;
use std::hash::Hash;
use std::sync::Arc;

/// A map whose clones share their entries. A clone does not see what another adds. Entries are only
/// looked up, so that their order does not show.
#[derive(Clone, Debug)]
pub(crate) struct SharedMap<K, V> {
    shared: Arc<FxHashMap<K, V>>,
    /// Entries of this clone alone.
    added: FxHashMap<K, V>,
}

impl<K, V> Default for SharedMap<K, V> {
    fn default() -> Self {
        Self { shared: Arc::default(), added: FxHashMap::default() }
    }
}

impl<K: Copy + Eq + Hash, V: Copy> SharedMap<K, V> {
    /// The entry of a key.
    pub fn get(&self, key: K) -> Option<V> {
        self.added.get(&key).or_else(|| self.shared.get(&key)).copied()
    }

    /// Adds an entry. All entries are forgotten before if there are `capacity`.
    pub fn insert(&mut self, key: K, value: V, capacity: usize) {
        if self.shared.len() + self.added.len() >= capacity {
            *self = Self::default();
        }
        match Arc::get_mut(&mut self.shared) {
            Some(shared) => shared.insert(key, value),
            None => self.added.insert(key, value),
        };
    }

    /// Takes out the entries of this clone alone.
    pub fn take_added(&mut self) -> FxHashMap<K, V> {
        std::mem::take(&mut self.added)
    }
}
