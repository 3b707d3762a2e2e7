//! Machine code in memory, and the call of it: the only file with `unsafe` in it.
//!
//! # What makes it sound
//!
//! - The pages are written while they are writable and not executable, and made executable and read-only before there is a
//!   [`Code`]: `memmap2` has a type for each, and one becomes the other. They are unmapped when the [`Code`] is dropped, which
//!   the call borrows.
//! - The code is what [`translate`](crate::translate) made, which alone makes a [`Translated`]: a function without branches, that
//!   reads its arguments and writes its results at places within the lengths of its [`Layout`], and touches nothing else but
//!   its own stack, whose pages it probes. `translate` checks each place against the layout while it makes the code, whatever
//!   program it is given.
//! - It calls nothing but [`EightSines`], which does not panic, with a place on its stack that has room for sixteen numbers.
//! - The slices of a call are checked against the same layout. Results are borrowed mutably, one by one, so that
//!   nothing that is read is written.
#![allow(unsafe_code)]

use std::io;
use std::mem;

use memmap2::{Mmap, MmapMut};
use ulna::internal::{EightSines, eight_sines};

use crate::translate::Translated;

/// How long the slices are that the code reads and writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Of what it reads.
    pub(crate) inputs: Vec<usize>,
    /// Of what it writes.
    pub(crate) results: Vec<usize>,
}

/// The most slices that code reads, and that it writes: constants, the payload, four arguments; three parts and det(JJᵀ).
pub(crate) const MAX_INPUTS: usize = 6;
/// As [`MAX_INPUTS`].
pub(crate) const MAX_RESULTS: usize = 4;

/// The function that `translate` makes: pointers to its inputs, pointers to its results, and what it takes sines by.
type Function = unsafe extern "C" fn(*const *const f64, *const *mut f64, EightSines);

/// A function in memory.
#[derive(Debug)]
pub(crate) struct Code {
    /// The first byte of the pages.
    function: Function,
    sines: EightSines,
    pages: Mmap,
    layout: Layout,
}

impl Code {
    /// Puts what was made where it can be run.
    pub(crate) fn new(made: &Translated) -> io::Result<Self> {
        let Translated { bytes, layout, .. } = made;
        assert!(layout.inputs.len() <= MAX_INPUTS && layout.results.len() <= MAX_RESULTS);
        let mut pages = MmapMut::map_anon(bytes.len())?;
        pages.copy_from_slice(bytes);
        let pages = pages.make_exec()?;
        // SAFETY: the pages hold a function of this type, and stay where they are.
        let function = unsafe { mem::transmute::<*const u8, Function>(pages.as_ptr()) };
        Ok(Self {
            function,
            sines: eight_sines(),
            pages,
            layout: layout.clone(),
        })
    }

    /// What it reads and writes.
    pub(crate) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// How many bytes of memory it takes: whole pages are taken from the system.
    pub(crate) fn len(&self) -> usize {
        self.pages.len()
    }

    /// Runs it.
    ///
    /// # Panics
    /// When a slice is not as long as the layout says.
    #[inline(always)]
    pub(crate) fn run(&self, inputs: &[&[f64]], results: &mut [&mut [f64]]) {
        let (mut from, mut to) = (
            [std::ptr::null(); MAX_INPUTS],
            [std::ptr::null_mut(); MAX_RESULTS],
        );
        let Layout {
            inputs: read,
            results: written,
        } = &self.layout;
        assert!(inputs.len() == read.len() && results.len() == written.len());
        for ((pointer, slice), length) in from.iter_mut().zip(inputs).zip(read) {
            assert!(slice.len() == *length);
            *pointer = slice.as_ptr();
        }
        for ((pointer, slice), length) in to.iter_mut().zip(results).zip(written) {
            assert!(slice.len() == *length);
            *pointer = slice.as_mut_ptr();
        }
        // SAFETY: it reads and writes what the slices hold, and no more.
        unsafe { (self.function)(from.as_ptr(), to.as_ptr(), self.sines) }
    }
}
