//! What the table of methods says in words, for whoever prints it: the docs of generated code.

use super::methods::{Argument, Method};

macro_rules! define_documentation {
    ([] $(
        $(#[doc = $doc:literal])*
        $variant:ident = $method:ident $arguments:tt -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        impl Method {
            /// What it computes, with equation, shape and units, in lines: its docs in the trait [`Arm`](crate::Arm).
            pub const fn documentation(self) -> &'static [&'static str] {
                match self {
                    $(Self::$variant => &[$($doc),*],)+
                }
            }
        }
    };
}

crate::methods! { [N] define_documentation {} }

impl Argument {
    /// What it is, with its units.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Q => "joint coordinates, rad (prismatic: m)",
            Self::Qd => "joint rates, rad/s (m/s)",
            Self::Qdd => "joint accelerations, rad/s² (m/s²)",
            Self::Tau => "joint torques, N·m (N)",
            Self::Wrench => "wrench on the tool, `[f; n]`, N and N·m",
        }
    }
}
