//! `Program` → text, in the languages that there are.
//!
//! What every language needs stands in [`plan`]: which steps get a name and which one, which are written where they are used, which
//! product of a sum is fused with it, how a long program is divided, what the docs say. A language is a module beside it, and knows
//! nothing but its own syntax.

pub(crate) mod c;
mod plan;
pub(crate) mod rust;

pub use plan::{Summand, fused_summands};
