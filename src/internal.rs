//! What generated code and the other crates of ulna need of this one, and users do not: it may change with any version.

pub use crate::arm::bounds;
pub use crate::arm::coordinates::{coordinate, coordinates, is_plain};
pub use crate::arm::payload::{Carried, admit, carry};
pub use crate::arm::quantity::Quantity;
pub use crate::kernels::real::Part;
pub use crate::kernels::scalar as methods;
pub use crate::kernels::simd::{EightSines, eight_sines};
pub use crate::proof::calls::{call, numbers};
pub use crate::proof::random;
