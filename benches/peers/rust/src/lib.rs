//! ulna's methods behind C functions, so that one timer can call every peer in the same way.

// Matrices and pairs go from Rust to Rust only.
#![allow(improper_ctypes_definitions)]

use std::ffi::{CStr, c_char};
use std::mem::{MaybeUninit, offset_of, transmute};
use std::slice;

use ulna::nalgebra::{SMatrix, SVector};
use ulna::{Arm, ArmBatch};

/// Returns its results one after the other, matrices by columns; for C, a function that is told where they go, by the
/// x86-64 calling convention. The value is then made where it belongs, as in `let value = …`, and not copied there.
type Kernel = unsafe extern "C" fn(*mut f64, *const f64);

/// A small value, made larger than what is returned in registers.
#[repr(C)]
struct Roomy<T> {
    value: T,
    room: [MaybeUninit<f64>; 2],
}

/// A kernel of one value: numbers alone, contiguous. It reads q, q̇ and q̈ (or τ) one after the other.
macro_rules! kernel {
    ($n:literal, $result:ty, |$q:ident, $qd:ident, $qdd:ident| $value:expr) => {{
        type Arguments = [SVector<f64, $n>; 3];
        extern "C" fn value([$q, $qd, $qdd]: &Arguments) -> $result {
            $value
        }
        extern "C" fn roomy(x: &Arguments) -> Roomy<$result> {
            Roomy {
                value: value(x),
                room: [MaybeUninit::uninit(); 2],
            }
        }
        type Direct = extern "C" fn(&Arguments) -> $result;
        type ByRoom = extern "C" fn(&Arguments) -> Roomy<$result>;
        // SAFETY: more than 16 bytes are returned where the first argument points. The caller of a `Kernel` passes
        // 3N numbers and room for the result; vectors of fixed size are their components, contiguous, and whatever
        // is made of numbers is aligned like a number.
        Some(unsafe {
            if size_of::<$result>() > 16 {
                transmute::<Direct, Kernel>(value)
            } else {
                transmute::<ByRoom, Kernel>(roomy)
            }
        })
    }};
}

/// The kernel of `$quantity` of the arm `$arm`.
macro_rules! quantity {
    ($arm:expr, $n:literal, $quantity:expr) => {
        match $quantity {
            b"geometric_jacobian" => kernel!($n, SMatrix<f64, 6, $n>, |q, _qd, _qdd| $arm.geometric_jacobian(q)),
            b"mass_matrix" => kernel!($n, SMatrix<f64, $n, $n>, |q, _qd, _qdd| $arm.mass_matrix(q)),
            b"mass_matrix_derivatives" => {
                kernel!($n, [SMatrix<f64, $n, $n>; $n], |q, _qd, _qdd| $arm.mass_matrix_derivatives(q))
            }
            b"dynamic_manipulability_gradient" => {
                // Written as it is; the value comes first.
                const {
                    assert!(offset_of!((f64, SVector<f64, $n>), 0) == 0);
                }
                kernel!($n, (f64, SVector<f64, $n>), |q, _qd, _qdd| $arm
                    .dynamic_manipulability_gradient(q))
            },
            b"inverse_dynamics" => kernel!($n, SVector<f64, $n>, |q, qd, qdd| $arm.inverse_dynamics(q, qd, qdd)),
            b"forward_dynamics" => kernel!($n, SVector<f64, $n>, |q, qd, tau| $arm.forward_dynamics(q, qd, tau)),
            _ => None,
        }
    };
}

/// Reads `count` vectors q, then as many of q̇, then of q̈ (or τ), and writes as many results.
type BatchKernel = unsafe extern "C" fn(*const f64, usize, *mut f64);

/// A batch kernel whose results are of type `$result`: numbers alone, contiguous.
macro_rules! batch {
    ($arm:expr, $n:literal, $result:ty, $method:ident($($argument:tt),+)) => {{
        unsafe extern "C" fn kernel(x: *const f64, count: usize, out: *mut f64) {
            let x = x.cast::<SVector<f64, $n>>();
            // SAFETY: the caller passes 3 * count vectors of N numbers, and room for `count` results.
            unsafe {
                let vectors = |i: usize| slice::from_raw_parts(x.add(i * count), count);
                let out = slice::from_raw_parts_mut(out.cast::<$result>(), count);
                let written = $arm.$method($(vectors($argument)),+, out);
                assert!(written.is_ok(), "all slices have `count` entries");
            }
        }
        Some(kernel as BatchKernel)
    }};
}

/// The batch kernel of `$quantity` of the arm `$arm`.
macro_rules! batch_quantity {
    ($arm:expr, $n:literal, $quantity:expr) => {
        match $quantity {
            b"geometric_jacobian" => {
                batch!($arm, $n, SMatrix<f64, 6, $n>, geometric_jacobian_batch(0))
            }
            b"mass_matrix" => batch!($arm, $n, SMatrix<f64, $n, $n>, mass_matrix_batch(0)),
            b"mass_matrix_derivatives" => {
                batch!($arm, $n, [SMatrix<f64, $n, $n>; $n], mass_matrix_derivatives_batch(0))
            }
            b"dynamic_manipulability_gradient" => {
                batch!($arm, $n, (f64, SVector<f64, $n>), dynamic_manipulability_gradient_batch(0))
            }
            b"inverse_dynamics" => {
                batch!($arm, $n, SVector<f64, $n>, inverse_dynamics_batch(0, 1, 2))
            }
            b"forward_dynamics" => {
                batch!($arm, $n, SVector<f64, $n>, forward_dynamics_batch(0, 1, 2))
            }
            _ => None,
        }
    };
}

macro_rules! finders {
    ($(($Arm:ident, $name:ident, $n:literal))*) => {
        fn generated(arm: &[u8], quantity: &[u8]) -> Option<Kernel> {
            $(if arm == stringify!($name).as_bytes() {
                return quantity!(ulna_generated::$Arm::default(), $n, quantity);
            })*
            None
        }

        fn batched(arm: &[u8], quantity: &[u8]) -> Option<BatchKernel> {
            $(if arm == stringify!($name).as_bytes() {
                return batch_quantity!(ulna_generated::$Arm::default(), $n, quantity);
            })*
            None
        }

        fn generic(arm: &[u8], quantity: &[u8]) -> Option<Kernel> {
            $(if arm == stringify!($name).as_bytes() {
                return quantity!(ulna_generated::$Arm::CHAIN, $n, quantity);
            })*
            None
        }
    };
}

ulna_generated::for_each_arm!(finders);

/// The generated kernel of a quantity, or null.
///
/// # Safety
/// Both arguments are C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn kernel(arm: *const c_char, quantity: *const c_char) -> Option<Kernel> {
    // SAFETY: by contract.
    let (arm, quantity) = unsafe { (CStr::from_ptr(arm), CStr::from_ptr(quantity)) };
    generated(arm.to_bytes(), quantity.to_bytes())
}

/// The batch kernel of a quantity, or null.
///
/// # Safety
/// Both arguments are C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn batch_kernel(
    arm: *const c_char,
    quantity: *const c_char,
) -> Option<BatchKernel> {
    // SAFETY: by contract.
    let (arm, quantity) = unsafe { (CStr::from_ptr(arm), CStr::from_ptr(quantity)) };
    batched(arm.to_bytes(), quantity.to_bytes())
}

/// The single kernel by the generic path.
///
/// # Safety
/// Both arguments are C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn generic_kernel(
    arm: *const c_char,
    quantity: *const c_char,
) -> Option<Kernel> {
    // SAFETY: by contract.
    let (arm, quantity) = unsafe { (CStr::from_ptr(arm), CStr::from_ptr(quantity)) };
    generic(arm.to_bytes(), quantity.to_bytes())
}
