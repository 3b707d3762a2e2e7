//! Where results of methods have their numbers.

use std::ptr;

use ulna::internal::Quantity;

/// Whether a value is its numbers alone, contiguous, part after part: not so for a tuple that the compiler reordered.
pub(crate) fn is_in_order<Q: Quantity>() -> bool {
    let value = Q::zero();
    let mut next = (&raw const value).cast::<f64>();
    let in_order = (0..Q::PARTS).all(|part| {
        let numbers = value.part(part);
        let here = ptr::eq(numbers.as_ptr(), next);
        next = next.wrapping_add(numbers.len());
        here
    });
    in_order && value.numbers().count() * size_of::<f64>() == size_of::<Q>()
}

/// Writes the numbers of a value, part after part.
///
/// # Safety
/// There is room for them at `out`.
#[inline(always)]
pub(crate) unsafe fn write<Q: Quantity>(value: &Q, mut out: *mut f64) {
    for part in 0..Q::PARTS {
        let numbers = value.part(part);
        // SAFETY: by contract; the value was made before, elsewhere.
        unsafe {
            ptr::copy_nonoverlapping(numbers.as_ptr(), out, numbers.len());
            out = out.add(numbers.len());
        }
    }
}
