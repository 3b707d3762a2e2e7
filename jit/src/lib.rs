//! A robot arm's table as machine code in memory: the speed of generated code, without a compiler.
//!
//! - [`AnyJit`]: the number of joints known at run time; a method by its name, slices in, slices out.
//! - [`Jit`]: the same as an [`ulna::Arm`] of `N` joints.
//!
//! Both compute what generated code computes, to the last bit, wherever that fuses multiply-adds or does not.
//!
//! # How fast
//!
//! On one core of a Zen 4, arm ssrms, nanoseconds a call beside the same programs compiled by rustc with default flags:
//!
//! | | here | rustc | interpreter | textbook |
//! |---|---|---|---|---|
//! | w_D and ∇w_D | 353 | 256 | 12,900 | 35,300 |
//! | mass matrix | 63 | 42 | 1,540 | 860 |
//! | inverse dynamics | 80 | 62 | 2,940 | 440 |
//! | ∂M/∂q | 165 | 121 | 4,980 | 22,300 |
//!
//! Batches run state by state. Milliseconds of processor time from a model to a callable arm, and what of it makes programs:
//!
//! | | 7 joints (ssrms) | 15 joints | 30 joints |
//! |---|---|---|---|
//! | w_D and ∇w_D | 30, 16 | 310, 300 | 2,600, 2,600 |
//! | mass matrix | 1.2, 0.2 | 35, 1 | 30, 1 |
//! | inverse dynamics | 2.8, 0.2 | 20, 1 | 10, 1 |
//! | all 33 methods | 210, 38 | 950, 510 | 5,060, 3,930 |
//!
//! Machine code is made method by method on all cores. What is left of the programs is the choice among formulas, which is that of
//! generated code: ∇w_D in each frame, and in two orders of its rows. Name the methods that you call ([`AnyJit::compile_methods`]).
//! `benches/jit.rs` measures all this, `benches/jit.md` says more.
//!
//! # The code generator
//!
//! Cranelift, its code generator alone: neither its module layer nor its front end is needed for straight lines. Of its two ways to
//! give registers the careful one is taken for programs of up to 4,096 steps, the quick one beyond: ∇w_D of 15 joints in 58 ms
//! where the careful way takes 2.8 s. Version 0.127 is the newest for the `rust-version` of the workspace.
//!
//! The other candidate was symjit 2.28 (MIT, one author; Cranelift: Apache-2.0, many authors, used by wasmtime). The same programs of
//! ssrms, the least of 2,000 turns, its best settings, ns a call:
//!
//! | | here | symjit | without sines | in batches, by lanes | without sines |
//! |---|---|---|---|---|---|
//! | w_D and ∇w_D | 353 | 540 | 452 | 232 | 126 |
//! | mass matrix | 63 | 170 | 91 | 149 | 46 |
//!
//! Its tree takes 59 s of one core to build at the third level, Cranelift's 101 s at the first. It is quicker in batches, and slower call by call,
//! which is what a controller and a campaign do. It takes straight lines of thousands of steps well. Against it: which operations it fuses is its own
//! choice, so that results are not those of generated code to the bit; its calls are safe functions that do not check how long slices are; the
//! default settings are read from a file in the working directory.
//!
//! There are no features. x86-64 and AArch64 are meant; a machine that Cranelift does not know is an [`Error::Host`].

mod any;
mod arm;
mod code;
mod error;
mod host;
mod kernel;
mod shape;
mod translate;

pub use any::AnyJit;
pub use arm::Jit;
pub use error::{CallError, Error};
