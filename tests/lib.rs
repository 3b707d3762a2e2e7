//! The README's examples are tests; what else is tested stands beside this file.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
