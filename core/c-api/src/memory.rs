//! The caller's memory: the only module with `unsafe` blocks.
//!
//! A C function takes pointers. Here each kind of pointer is a type of its own, which only C can
//! make, because its field is private. Its methods check what can be checked: NULL, alignment, and
//! that a count of elements fits the address space. The rest is the contract of `meshsweep.h`: a
//! pointer that is neither NULL nor misaligned leads to as many elements as its function says,
//! nobody writes to them during the call, and memory that a call writes overlaps nothing else.

use core::mem::{ManuallyDrop, MaybeUninit, align_of, size_of};
use core::{ptr, slice};

use meshsweep_core::internal::bvh::{ErasedScene, ModelPath, MovingModel, RememberedPair};
use meshsweep_core::internal::hull::ErasedHull;
use meshsweep_core::{
    CoherentPair, CoherentQuery, CurveNeighbor, MovedVertex, Neighbor, NodePair, ScratchEntry,
};

use crate::error::Error;

/// A type of which all bits are a value.
///
/// # Safety
/// Any initialised bytes are a value of the type.
pub unsafe trait AnyBits: Copy {}

// SAFETY: integers and floats, and arrays of these.
unsafe impl AnyBits for u8 {}
// SAFETY: as above.
unsafe impl AnyBits for [f32; 3] {}
// SAFETY: floats.
unsafe impl AnyBits for [f32; 2] {}
// SAFETY: as above.
unsafe impl AnyBits for [u32; 2] {}
// SAFETY: six words.
unsafe impl AnyBits for Neighbor {}
// SAFETY: eight words.
unsafe impl AnyBits for CurveNeighbor {}
// SAFETY: two u16.
unsafe impl AnyBits for NodePair {}
// SAFETY: an f32 and a u32.
unsafe impl AnyBits for ScratchEntry {}
// SAFETY: three f32 and two u16.
unsafe impl AnyBits for MovedVertex {}

/// A pointer to elements that are read.
#[repr(transparent)]
#[derive(Debug)]
pub struct In<T>(*const T);

// Derived, these would ask the same of the elements.
impl<T> Copy for In<T> {}
impl<T> Clone for In<T> {
    fn clone(&self) -> Self {
        *self
    }
}

/// A pointer to elements that are written.
#[repr(transparent)]
#[derive(Debug)]
pub struct Out<T>(*mut T);

fn check<T>(start: *const T) -> Result<(), Error> {
    if start.is_null() {
        Err(Error::Null)
    } else if !start.is_aligned() {
        Err(Error::Alignment)
    } else {
        Ok(())
    }
}

/// Whether `count` elements can be a slice. `None`: there are none, and the pointer may be NULL.
fn check_slice<T>(start: *const T, count: usize) -> Result<Option<()>, Error> {
    if count == 0 {
        return Ok(None);
    }
    check(start)?;
    let bytes = count.checked_mul(size_of::<T>()).filter(|bytes| isize::try_from(*bytes).is_ok());
    bytes.map(|_| Some(())).ok_or(Error::Count)
}

impl<T: AnyBits> In<T> {
    /// A copy of the element.
    pub fn get(self) -> Result<T, Error> {
        check(self.0)?;
        // SAFETY: neither NULL nor misaligned, so by contract an element.
        Ok(unsafe { self.0.read() })
    }

    /// A copy of the element; `otherwise` if the pointer is NULL.
    pub fn get_or(self, otherwise: T) -> Result<T, Error> {
        if self.0.is_null() { Ok(otherwise) } else { self.get() }
    }

    /// As many elements, by contract as long as the caller uses the answer.
    pub fn slice(self, count: usize) -> Result<&'static [T], Error> {
        match check_slice(self.0, count)? {
            // SAFETY: neither NULL nor misaligned, so by contract `count` elements that nobody
            // writes to: the function's, or for a blob the model's life long.
            Some(()) => Ok(unsafe { slice::from_raw_parts(self.0, count) }),
            None => Ok(&[]),
        }
    }
}

impl<T: AnyBits> Out<T> {
    /// The element.
    pub fn one(&mut self) -> Result<&mut T, Error> {
        check(self.0)?;
        // SAFETY: neither NULL nor misaligned, so by contract an element that overlaps nothing
        // else. All bits are values of these types.
        Ok(unsafe { &mut *self.0 })
    }

    /// As many elements.
    pub fn slice(&mut self, count: usize) -> Result<&mut [T], Error> {
        match check_slice(self.0, count)? {
            // SAFETY: neither NULL nor misaligned, so by contract `count` elements that overlap
            // nothing else. All bits are values of these types.
            Some(()) => Ok(unsafe { slice::from_raw_parts_mut(self.0, count) }),
            None => Ok(&mut []),
        }
    }
}

impl<T: AnyBits> Out<T> {
    /// As many elements for what is begun with them, by contract as long as it is used.
    pub fn kept_slice(self, count: usize) -> Result<&'static mut [T], Error> {
        match check_slice(self.0, count)? {
            // SAFETY: neither NULL nor misaligned, so by contract `count` elements that overlap
            // nothing else, and that only the calls with what is begun read and write as long as it
            // is used. All bits are values of these types.
            Some(()) => Ok(unsafe { slice::from_raw_parts_mut(self.0, count) }),
            None => Ok(&mut []),
        }
    }
}

impl<T> Out<T> {
    /// Writes what `answer` computes. After an error it writes all zeros.
    pub fn answer(self, answer: impl FnOnce() -> Result<T, Error>) -> i32
    where
        T: Default,
    {
        if let Err(error) = check(self.0) {
            return error.code();
        }
        let (value, code) = match answer() {
            Ok(value) => (value, 0),
            Err(error) => (T::default(), error.code()),
        };
        // SAFETY: neither NULL nor misaligned, so by contract an element.
        unsafe { self.0.write(value) };
        code
    }

    /// Writes element `index` of `count`.
    pub fn set(&mut self, count: usize, index: usize, value: T) -> Result<(), Error> {
        if check_slice(self.0, count)?.is_some() && index < count {
            // SAFETY: neither NULL nor misaligned, so by contract `count` elements.
            unsafe { self.0.add(index).write(value) };
        }
        Ok(())
    }

    /// The same memory as a search holds it. Read an element before it is written as the other.
    pub fn held<H: AnyBits>(&self) -> Out<H> {
        const { assert!(size_of::<T>() == size_of::<H>() && align_of::<T>() == align_of::<H>()) }
        Out(self.0.cast())
    }
}

/// A view of an opened structure.
pub trait View: Copy {
    /// The first word of its storage, by which a storage that was not opened is noticed.
    const TAG: usize;
}

/// Contents of a storage.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Opened<T: Copy> {
    tag: usize,
    view: MaybeUninit<T>,
}

/// The caller's memory for a view: a fixed number of words.
#[repr(C)]
#[allow(missing_debug_implementations, reason = "which field holds is known at run time")]
pub union Storage<T: Copy, const WORDS: usize> {
    opened: Opened<T>,
    words: [usize; WORDS],
}

impl<T: View, const WORDS: usize> Storage<T, WORDS> {
    /// The storage is as large as the header says, and the view fits.
    pub const FITS: () = assert!(
        size_of::<Self>() == WORDS * size_of::<usize>() && align_of::<Self>() == size_of::<usize>()
    );
}

impl<T: View, const WORDS: usize> In<Storage<T, WORDS>> {
    /// The view that an open function left in the storage.
    pub fn view(&self) -> Result<&T, Error> {
        let () = Storage::<T, WORDS>::FITS;
        check(self.0)?;
        // SAFETY: neither NULL nor misaligned, so by contract a storage. Its first word is always
        // some integer.
        let tag = unsafe { (&raw const (*self.0).opened.tag).read() };
        if tag != T::TAG {
            return Err(Error::NotOpened);
        }
        // SAFETY: only an open function writes the tag, with the view.
        Ok(unsafe { (*self.0).opened.view.assume_init_ref() })
    }
}

impl<T: View, const WORDS: usize> Out<Storage<T, WORDS>> {
    /// Leaves a view in the storage. After an error the storage is not opened.
    pub fn open(self, view: impl FnOnce() -> Result<T, Error>) -> i32 {
        let () = Storage::<T, WORDS>::FITS;
        if let Err(error) = check(self.0) {
            return error.code();
        }
        let (tag, view, code) = match view() {
            Ok(view) => (T::TAG, MaybeUninit::new(view), 0),
            Err(error) => (0, MaybeUninit::uninit(), error.code()),
        };
        // SAFETY: neither NULL nor misaligned, so by contract a storage, which has room.
        unsafe { (&raw mut (*self.0).opened).write(Opened { tag, view }) };
        code
    }
}

/// What a question keeps between calls.
pub trait Keeps {
    /// The first word of its memory in use.
    const TAG: usize;

    /// Nothing is kept yet.
    fn new() -> Self;
}

/// The caller's memory for what is kept: all zeros, or begun.
#[repr(C)]
#[allow(missing_debug_implementations, reason = "which field holds is known at run time")]
pub union Kept<T, W: Copy> {
    begun: ManuallyDrop<Begun<T>>,
    words: W,
}

/// Contents of such memory.
#[repr(C)]
#[allow(missing_debug_implementations, reason = "which field holds is known at run time")]
pub struct Begun<T> {
    tag: usize,
    state: T,
}

impl<T, W: Copy> Kept<T, W> {
    /// The memory is as large as the header says, and what is kept fits.
    pub const FITS: () =
        assert!(size_of::<Self>() == size_of::<W>() && align_of::<Self>() == align_of::<W>());
}

/// Writes a new state. A function of its own: a copy of the state lies on its stack, which then is
/// not below a question.
///
/// # Safety
/// The pointer leads to room for the state. What lies there needs no drop.
#[cold]
#[inline(never)]
unsafe fn begin<T: Keeps>(begun: *mut Begun<T>) {
    // SAFETY: the caller's.
    unsafe { begun.write(Begun { tag: T::TAG, state: T::new() }) };
}

impl<T: Keeps, W: Copy> Out<Kept<T, W>> {
    /// What the memory keeps. It is new if the memory is all zeros.
    pub fn kept(&mut self) -> Result<&mut T, Error> {
        let () = Kept::<T, W>::FITS;
        check(self.0)?;
        // SAFETY: neither NULL nor misaligned, so by contract such memory. Its first word is always
        // some integer.
        let begun = unsafe { &raw mut (*self.0).begun }.cast::<Begun<T>>();
        // SAFETY: as above.
        if unsafe { (&raw const (*begun).tag).read() } != T::TAG {
            // SAFETY: the memory has room.
            unsafe { begin(begun) };
        }
        // SAFETY: the tag is only written with a state.
        Ok(unsafe { &mut (*begun).state })
    }
}

/// What a function begins from its arguments, and other functions ask.
pub trait Begins {
    /// The first word of its memory in use.
    const TAG: usize;
}

impl<T: Begins, W: Copy> Out<Kept<T, W>> {
    /// Leaves a state in the memory. After an error the memory holds none.
    pub fn begin(self, state: impl FnOnce() -> Result<T, Error>) -> i32 {
        let () = Kept::<T, W>::FITS;
        if let Err(error) = check(self.0) {
            return error.code();
        }
        // SAFETY: neither NULL nor misaligned, so by contract such memory.
        let begun = unsafe { &raw mut (*self.0).begun }.cast::<Begun<T>>();
        // SAFETY: the memory has room.
        unsafe { (&raw mut (*begun).tag).write(0) };
        match state() {
            Ok(state) => {
                // SAFETY: the memory has room. What lies there needs no drop: it owns no memory.
                unsafe { begun.write(Begun { tag: T::TAG, state }) };
                0
            }
            Err(error) => error.code(),
        }
    }

    /// The state that a function began.
    pub fn begun(&mut self) -> Result<&mut T, Error> {
        let () = Kept::<T, W>::FITS;
        check(self.0)?;
        // SAFETY: neither NULL nor misaligned, so by contract such memory. Its first word is always
        // some integer.
        let begun = unsafe { &raw mut (*self.0).begun }.cast::<Begun<T>>();
        // SAFETY: as above.
        if unsafe { (&raw const (*begun).tag).read() } != T::TAG {
            return Err(Error::NotOpened);
        }
        // SAFETY: the tag is only written with a state.
        Ok(unsafe { &mut (*begun).state })
    }
}

/// Entries of a coherent query: enough for steps of a thousandth of the model.
pub const COHERENT_ENTRIES: usize = 128;

/// Words of `msw_coherent`.
pub const COHERENT_WORDS: usize = if cfg!(target_pointer_width = "64") { 256 } else { 480 };

/// `msw_coherent`: what a coherent query keeps between calls.
pub type CoherentStorage = Kept<CoherentQuery<'static, COHERENT_ENTRIES>, [usize; COHERENT_WORDS]>;

impl Keeps for CoherentQuery<'static, COHERENT_ENTRIES> {
    const TAG: usize = 0x6d73_7704;

    fn new() -> Self {
        CoherentQuery::new()
    }
}

/// Groups of a coherent pair.
pub const PAIR_GROUPS: usize = 256;

/// Words of eight bytes of `msw_coherent_pair`: one path is in f64.
pub const PAIR_WORDS: usize = 664;

/// `msw_coherent_pair`: what questions about a pair keep between calls.
pub type PairStorage = Kept<CoherentPair<'static, PAIR_GROUPS>, [u64; PAIR_WORDS]>;

impl Keeps for CoherentPair<'static, PAIR_GROUPS> {
    const TAG: usize = 0x6d73_7705;

    fn new() -> Self {
        CoherentPair::new()
    }
}

/// A word of a scene's memory.
#[repr(transparent)]
#[derive(Clone, Copy, Debug)]
pub struct SceneEntry(usize);

/// Entries of a scene before those of its models.
pub const SCENE_ENTRIES: usize = 5;

/// Entries of a model of a scene.
pub const SCENE_MODEL_ENTRIES: usize = if cfg!(target_pointer_width = "64") { 56 } else { 88 };

/// The first word of a scene's memory in use.
const SCENE_TAG: usize = 0x6d73_7706;

/// The beginning of a scene's memory. Models, their paths and the pairs follow.
#[repr(C)]
struct SceneHead {
    tag: usize,
    last_witness: usize,
    models: u32,
    pairs: u32,
    questions: u32,
}

const WORD: usize = size_of::<usize>();

const _: () = assert!(
    size_of::<SceneHead>() <= SCENE_ENTRIES * WORD
        && size_of::<MovingModel<'_>>() + size_of::<ModelPath>() <= SCENE_MODEL_ENTRIES * WORD
        && size_of::<RememberedPair>() == 24
        && align_of::<SceneHead>() == align_of::<SceneEntry>()
        && align_of::<MovingModel<'_>>() == align_of::<SceneEntry>()
        && align_of::<RememberedPair>() == align_of::<f32>()
);

/// Entries of a scene, or `None` if memory has no such number: `MSW_SCENE_ENTRIES`.
pub const fn scene_entries(models: usize, pairs: usize) -> Option<usize> {
    let (Some(models), Some(pairs)) =
        (models.checked_mul(SCENE_MODEL_ENTRIES), pairs.checked_mul(size_of::<RememberedPair>()))
    else {
        return None;
    };
    let Some(entries) = models.checked_add(pairs.div_ceil(WORD)) else { return None };
    entries.checked_add(SCENE_ENTRIES)
}

/// Where the parts of a scene are.
#[derive(Clone, Copy)]
struct SceneParts {
    head: *mut SceneHead,
    models: *mut MovingModel<'static>,
    paths: *mut ModelPath,
    pairs: *mut RememberedPair,
}

impl Out<SceneEntry> {
    /// The parts of a scene of so many models.
    const fn parts(&self, models: usize) -> SceneParts {
        let bytes = self.0.cast::<u8>();
        let first = bytes.wrapping_add(SCENE_ENTRIES * WORD);
        let paths = first.wrapping_add(models * size_of::<MovingModel<'_>>());
        SceneParts {
            head: self.0.cast(),
            models: first.cast(),
            paths: paths.cast(),
            pairs: paths.wrapping_add(models * size_of::<ModelPath>()).cast(),
        }
    }

    /// Begins a scene in `count` entries. After an error the memory holds none, whatever the count.
    pub fn begin_scene(
        &mut self,
        count: usize,
        [models, pairs]: [usize; 2],
        model: impl Fn(usize) -> Result<MovingModel<'static>, Error>,
        pair: impl Fn(usize) -> Result<RememberedPair, Error>,
    ) -> Result<(), Error> {
        check(self.0)?;
        if count > 0 {
            // SAFETY: neither NULL nor misaligned, so by contract an entry.
            unsafe { self.0.write(SceneEntry(0)) };
        }
        check_slice(self.0, count)?.ok_or(Error::Memory)?;
        let [Ok(model_count), Ok(pair_count)] = [models, pairs].map(u32::try_from) else {
            return Err(Error::Count);
        };
        if scene_entries(models, pairs).is_none_or(|needed| needed > count) {
            return Err(Error::Memory);
        }
        let parts = self.parts(models);
        for index in 0..models {
            let model = model(index)?;
            // SAFETY: the entries have room for all parts, as the assertion above says.
            unsafe { parts.models.add(index).write(model) };
            // SAFETY: as above.
            unsafe { parts.paths.add(index).write(ModelPath::NONE) };
        }
        for index in 0..pairs {
            let pair = pair(index)?;
            // SAFETY: as above.
            unsafe { parts.pairs.add(index).write(pair) };
        }
        let head = SceneHead {
            tag: SCENE_TAG,
            last_witness: 0,
            models: model_count,
            pairs: pair_count,
            questions: 0,
        };
        // SAFETY: as above.
        unsafe { parts.head.write(head) };
        Ok(())
    }

    /// The scene that the memory holds.
    pub fn scene(&mut self) -> Result<ErasedScene<'_, 'static>, Error> {
        check(self.0)?;
        // SAFETY: neither NULL nor misaligned, so by contract an entry.
        if unsafe { self.0.read() }.0 != SCENE_TAG {
            return Err(Error::NotOpened);
        }
        // SAFETY: only `begin_scene` writes the tag, with the head.
        let head = unsafe { &mut *self.0.cast::<SceneHead>() };
        let (models, pairs) = (head.models as usize, head.pairs as usize);
        let parts = self.parts(models);
        // SAFETY: with the head `begin_scene` wrote as many models, paths and pairs, which do not
        // overlap.
        let (models, paths, pairs) = unsafe {
            (
                slice::from_raw_parts_mut(parts.models, models),
                slice::from_raw_parts_mut(parts.paths, models),
                slice::from_raw_parts_mut(parts.pairs, pairs),
            )
        };
        let SceneHead { questions, last_witness, .. } = head;
        Ok(ErasedScene { models, paths, pairs, questions, last_witness })
    }
}

/// Sixteen bytes of a refined hull's memory.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct RefinedEntry {
    words: [usize; 16 / size_of::<usize>()],
}

/// Entries before those of splits.
pub const REFINED_ENTRIES: usize = 2;

/// Bytes before the refined hull, which hold the number of entries.
const BEFORE: usize = 8;

const _: () = assert!(
    size_of::<RefinedEntry>() == 16
        && BEFORE + size_of::<meshsweep_core::RefinedHull<'_, 0>>()
            <= REFINED_ENTRIES * size_of::<RefinedEntry>()
        && align_of::<meshsweep_core::RefinedHull<'_, 0>>() == align_of::<RefinedEntry>()
);

impl Out<RefinedEntry> {
    /// The refined hull in `count` entries. It is the base hull if all of them are 0. Memory that
    /// was first used with another count is refused.
    pub fn refined(&mut self, count: usize) -> Result<&mut ErasedHull<'static>, Error> {
        let splits = count.checked_sub(REFINED_ENTRIES).ok_or(Error::Memory)?;
        check_slice(self.0, count)?;
        // No more than core's own limit.
        let length = u32::try_from(count).ok().filter(|_| splits <= 1 << 24).ok_or(Error::Count)?;
        let counted = self.0.cast::<u32>();
        // SAFETY: neither NULL nor misaligned, so by contract the first of `count` entries.
        let before = unsafe { counted.read() };
        if before != 0 && before != length {
            return Err(Error::Memory);
        }
        // SAFETY: as above.
        unsafe { counted.write(length) };
        let hull = self.0.cast::<u8>().wrapping_add(BEFORE);
        // The length of the last field, which is the number of slots.
        let hull = ptr::slice_from_raw_parts_mut(hull.cast::<[u32; 4]>(), splits);
        // SAFETY: the entries have room for all but the slots (the assertion above) and for a slot
        // each behind. The alignment is that of a word. Any bits are a value: integers and floats.
        Ok(unsafe { &mut *(hull as *mut ErasedHull<'static>) })
    }
}
