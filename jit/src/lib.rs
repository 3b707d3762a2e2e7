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
