//! ulna's methods behind C functions, so that one timer can call every peer in the same way.
//!
//! Arms and methods come from their tables: neither a new arm nor a new method is an edit here.

// Matrices and tuples go from Rust to Rust only.
#![allow(improper_ctypes_definitions)]

mod batches;
mod layout;
mod locks;
mod singles;

use std::ffi::{CStr, c_char};
use std::ptr;
use std::sync::LazyLock;

use ulna::{Arm, ArmBatch, Method, SerialChain};

use batches::BatchKernel;
use singles::Kernel;

/// An arm that a function without data can call.
trait Subject<const N: usize> {
    /// What it is.
    type Arm: Arm<N> + ArmBatch<N> + 'static;

    /// One such, with no payload.
    fn arm() -> &'static Self::Arm;
}

/// The generated arm of a type.
struct Generated<A>(A);

/// The generic path over the same arm.
struct Generic<A>(A);

macro_rules! finders {
    ($(($Arm:ident, $name:ident, $n:literal))*) => {
        $(
            impl Subject<$n> for Generated<ulna_generated::$Arm> {
                type Arm = ulna_generated::$Arm;

                #[inline(always)]
                fn arm() -> &'static Self::Arm {
                    static HELD: LazyLock<ulna_generated::$Arm> = LazyLock::new(Default::default);
                    if size_of::<Self::Arm>() == 0 {
                        // Nothing to hold, allocate or look for: not an instruction.
                        Box::leak(Box::default())
                    } else {
                        &HELD
                    }
                }
            }

            impl Subject<$n> for Generic<ulna_generated::$Arm> {
                type Arm = SerialChain<$n>;

                #[inline(always)]
                fn arm() -> &'static Self::Arm {
                    const { &ulna_generated::$Arm::CHAIN }
                }
            }
        )*

        fn generated(arm: &[u8], quantity: &[u8]) -> Option<Kernel> {
            $(if arm == stringify!($name).as_bytes() {
                return singles::kernel::<Generated<ulna_generated::$Arm>, $n>(quantity);
            })*
            None
        }

        fn batched(arm: &[u8], quantity: &[u8]) -> Option<BatchKernel> {
            $(if arm == stringify!($name).as_bytes() {
                return batches::kernel::<Generated<ulna_generated::$Arm>, $n>(quantity);
            })*
            None
        }

        fn generic(arm: &[u8], quantity: &[u8]) -> Option<Kernel> {
            $(if arm == stringify!($name).as_bytes() {
                return singles::kernel::<Generic<ulna_generated::$Arm>, $n>(quantity);
            })*
            None
        }

        fn by_pairs(arm: &[u8], quantity: &[u8]) -> Option<Kernel> {
            $(if arm == stringify!($name).as_bytes() {
                return locks::by_pairs::<Generated<ulna_generated::$Arm>, $n>(quantity);
            })*
            None
        }

        fn by_one_more(arm: &[u8], quantity: &[u8]) -> Option<Kernel> {
            $(if arm == stringify!($name).as_bytes() {
                return locks::by_one_more::<Generated<ulna_generated::$Arm>, $n>(quantity);
            })*
            None
        }
    };
}

ulna_generated::for_each_arm!(finders);

/// The name of a method of [`Arm`]: null from the first number on that none has.
#[unsafe(no_mangle)]
pub extern "C" fn quantity(number: usize) -> *const c_char {
    Method::ALL
        .get(number)
        .map_or(ptr::null(), |method| singles::name(*method).as_ptr())
}

macro_rules! export {
    ($(#[$doc:meta] $symbol:ident -> $Kernel:ty = $find:ident;)*) => {$(
        #[$doc]
        ///
        /// # Safety
        /// Both arguments are C strings.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $symbol(arm: *const c_char, quantity: *const c_char) -> Option<$Kernel> {
            // SAFETY: by contract.
            let (arm, quantity) = unsafe { (CStr::from_ptr(arm), CStr::from_ptr(quantity)) };
            $find(arm.to_bytes(), quantity.to_bytes())
        }
    )*};
}

export! {
    /// The generated kernel of a quantity, or null.
    kernel -> Kernel = generated;
    /// The batch kernel of a quantity, or null.
    batch_kernel -> BatchKernel = batched;
    /// The single kernel by the generic path, or null.
    generic_kernel -> Kernel = generic;
    /// All lock impacts by two inverse dynamics for each joint; null for any other quantity.
    pairs_kernel -> Kernel = by_pairs;
    /// All lock impacts by one inverse dynamics for each joint and one before; null for any other quantity.
    one_more_kernel -> Kernel = by_one_more;
}
