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
//! Batches run state by state. Milliseconds, on a machine that others used, too, from a model to programs, and from programs to
//! machine code:
//!
//! | | 7 joints (ssrms) | 15 joints | 30 joints |
//! |---|---|---|---|
//! | w_D and ∇w_D | 67 + 21 | 1,180 + 58 | 28,500 + 265 |
//! | mass matrix | 21 + 1.2 | 340 + 87 | 2,630 + 79 |
//! | inverse dynamics | 18 + 2.5 | 350 + 52 | 2,460 + 13 |
//!
//! Programs take most of it, their errors being measured meanwhile: name the methods that you call
//! ([`Generator::methods`](ulna_codegen::Generator::methods) and [`AnyJit::of`]). `benches/jit.rs` measures all this.
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
//! | | here | symjit | its own without sines | its batches of 4 lanes | without sines |
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
