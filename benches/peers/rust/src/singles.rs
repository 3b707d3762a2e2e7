//! Kernels of one state.

use std::ffi::CStr;
use std::mem::transmute;

use ulna::nalgebra::SVector;
use ulna::{Arm, Method};

use crate::Subject;
use crate::layout;

/// Returns its results one after the other, matrices by columns; for C, a function that is told where they go, by the
/// x86-64 calling convention. The value is then made where it belongs, as in `let value = …`, and not copied there.
pub(crate) type Kernel = unsafe extern "C" fn(*mut f64, *const f64);

/// In front of how many numbers of a state an argument stands.
macro_rules! place {
    ($n:ident q) => {
        0
    };
    ($n:ident qd) => {
        $n
    };
    ($n:ident qdd) => {
        2 * $n
    };
    ($n:ident tau) => {
        2 * $n
    };
    ($n:ident wrench) => {
        3 * $n
    };
}

pub(crate) use place;

/// Where a kernel's arguments are: q, q̇, and q̈ or the torques; behind these, for who wants it, a wrench.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(crate) struct Arguments(*const f64);

impl Arguments {
    /// # Safety
    /// There are as many numbers at `x` as the vectors reach that are asked for, for as long as this lives.
    pub(crate) unsafe fn at(x: *const f64) -> Self {
        Self(x)
    }

    /// The vector that starts so many numbers in.
    #[inline(always)]
    pub(crate) fn vector<const K: usize>(&self, start: usize) -> &SVector<f64, K> {
        // SAFETY: by the contract of `at`; a vector of fixed size is its components, contiguous.
        unsafe { &*self.0.add(start).cast() }
    }
}

macro_rules! define_kernels {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        /// A method's name, for C.
        pub(crate) fn name(method: Method) -> &'static CStr {
            let with_nul = match method {
                $(Method::$variant => concat!(stringify!($method), "\0"),)+
            };
            CStr::from_bytes_with_nul(with_nul.as_bytes()).unwrap_or(c"")
        }

        /// The kernel of a method of an arm.
        pub(crate) fn kernel<S: Subject<N>, const N: usize>(quantity: &[u8]) -> Option<Kernel> {
            $(if quantity == stringify!($method).as_bytes() {
                extern "C" fn returned<S: Subject<N>, const N: usize>(x: Arguments) -> $output {
                    S::arm().$method($(x.vector(place!(N $argument))),+)
                }
                unsafe extern "C" fn copied<S: Subject<N>, const N: usize>(out: *mut f64, x: *const f64) {
                    // SAFETY: the caller of a `Kernel` passes the arguments, and room for the result.
                    unsafe {
                        let x = Arguments::at(x);
                        layout::write(&S::arm().$method($(x.vector(place!(N $argument))),+), out);
                    }
                }
                type Returns<T> = extern "C" fn(Arguments) -> T;
                return Some(if size_of::<$output>() > 16 && layout::is_in_order::<$output>() {
                    // SAFETY: more than 16 bytes are returned where the first argument points. The caller of a `Kernel`
                    // passes the arguments and room for the result; whatever is made of numbers is aligned like a number.
                    unsafe { transmute::<Returns<$output>, Kernel>(returned::<S, N>) }
                } else {
                    // In registers, or in another order than the caller reads them.
                    copied::<S, N>
                });
            })+
            None
        }
    };
}

ulna::methods! { [N] define_kernels {} }
