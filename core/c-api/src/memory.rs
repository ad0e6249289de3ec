//! The caller's memory: the only module with `unsafe` blocks.
//!
//! A C function takes pointers. Here each kind of pointer is a type of its own, which only C can
//! make, because its field is private. Its methods check what can be checked: NULL, alignment, and
//! that a count of elements fits the address space. The rest is the contract of `meshsweep.h`: a
//! pointer that is neither NULL nor misaligned leads to as many elements as its function says,
//! nobody writes to them during the call, and memory that a call writes overlaps nothing else.

use core::mem::{ManuallyDrop, MaybeUninit, align_of, size_of};
use core::ptr;

use meshsweep_core::internal::hull::ErasedHull;
use meshsweep_core::{CoherentQuery, Neighbor, ScratchEntry};

use crate::answer::NeighborC;
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
// SAFETY: as above.
unsafe impl AnyBits for [u32; 2] {}
// SAFETY: six words.
unsafe impl AnyBits for Neighbor {}
// SAFETY: an f32 and a u32.
unsafe impl AnyBits for ScratchEntry {}

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
            Some(()) => Ok(unsafe { core::slice::from_raw_parts(self.0, count) }),
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
            Some(()) => Ok(unsafe { core::slice::from_raw_parts_mut(self.0, count) }),
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
}

impl Out<NeighborC> {
    /// The same memory as a search holds it. Read an element before it is written as the other.
    pub fn held(&self) -> Out<Neighbor> {
        const { assert!(size_of::<NeighborC>() == size_of::<Neighbor>()) }
        const { assert!(align_of::<NeighborC>() == align_of::<Neighbor>()) }
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

/// Entries of a coherent query: enough for steps of a thousandth of the model.
pub const COHERENT_ENTRIES: usize = 128;

/// Words of `msw_coherent`.
pub const COHERENT_WORDS: usize = if cfg!(target_pointer_width = "64") { 256 } else { 480 };

/// `msw_coherent`: what a coherent query keeps between calls.
#[repr(C)]
#[allow(missing_debug_implementations, reason = "which field holds is known at run time")]
pub union CoherentStorage {
    kept: ManuallyDrop<KeptQuery>,
    words: [usize; COHERENT_WORDS],
}

#[repr(C)]
struct KeptQuery {
    tag: usize,
    query: CoherentQuery<'static, COHERENT_ENTRIES>,
}

const _: () = assert!(
    size_of::<CoherentStorage>() == COHERENT_WORDS * size_of::<usize>()
        && align_of::<CoherentStorage>() == align_of::<usize>()
);

/// The first word of a coherent query's memory in use.
const COHERENT_TAG: usize = 0x6d73_7704;

/// Writes a new query. A function of its own: a copy of the query lies on its stack, which then is
/// not below a question.
///
/// # Safety
/// The pointer leads to room for a query. What lies there needs no drop.
#[cold]
#[inline(never)]
unsafe fn begin(kept: *mut KeptQuery) {
    // SAFETY: the caller's.
    unsafe { kept.write(KeptQuery { tag: COHERENT_TAG, query: CoherentQuery::new() }) };
}

impl Out<CoherentStorage> {
    /// The query that the storage keeps. It is a new one if the memory is all zeros.
    pub fn kept(&mut self) -> Result<&mut CoherentQuery<'static, COHERENT_ENTRIES>, Error> {
        check(self.0)?;
        // SAFETY: neither NULL nor misaligned, so by contract a storage. Its first word is always
        // some integer.
        let kept = unsafe { &raw mut (*self.0).kept }.cast::<KeptQuery>();
        // SAFETY: as above.
        if unsafe { (&raw const (*kept).tag).read() } != COHERENT_TAG {
            // SAFETY: the storage has room.
            unsafe { begin(kept) };
        }
        // SAFETY: the tag is only written with a query.
        Ok(unsafe { &mut (*kept).query })
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
