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

/// The 3N numbers that every kernel reads.
#[repr(C)]
pub(crate) struct Arguments<const N: usize> {
    pub(crate) q: SVector<f64, N>,
    pub(crate) qd: SVector<f64, N>,
    /// q̈, or the torques.
    pub(crate) last: SVector<f64, N>,
}

macro_rules! argument {
    ($x:ident q) => {
        &$x.q
    };
    ($x:ident qd) => {
        &$x.qd
    };
    ($x:ident qdd) => {
        &$x.last
    };
    ($x:ident tau) => {
        &$x.last
    };
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
                extern "C" fn returned<S: Subject<N>, const N: usize>(x: &Arguments<N>) -> $output {
                    S::ARM.$method($(argument!(x $argument)),+)
                }
                unsafe extern "C" fn copied<S: Subject<N>, const N: usize>(out: *mut f64, x: *const f64) {
                    // SAFETY: the caller of a `Kernel` passes 3N numbers, and room for the result.
                    unsafe {
                        let x = &*x.cast::<Arguments<N>>();
                        layout::write(&S::ARM.$method($(argument!(x $argument)),+), out);
                    }
                }
                type Returns<T, const N: usize> = extern "C" fn(&Arguments<N>) -> T;
                return Some(if size_of::<$output>() > 16 && layout::is_in_order::<$output>() {
                    // SAFETY: more than 16 bytes are returned where the first argument points. The caller of a `Kernel`
                    // passes 3N numbers and room for the result; vectors of fixed size are their components, contiguous,
                    // and whatever is made of numbers is aligned like a number.
                    unsafe { transmute::<Returns<$output, N>, Kernel>(returned::<S, N>) }
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
