//! [`Arm`]: what every backend offers, generic or generated; and an arm as data.

mod angle;
#[doc(hidden)]
pub mod bounds;
pub(crate) mod coordinates;
mod description;
mod documentation;
mod drive;
pub(crate) mod method_set;
pub(crate) mod methods;
mod parameters;
pub(crate) mod payload;
pub(crate) mod quantity;
pub mod singular;
mod task;

use nalgebra::SVector;

pub use angle::Angle;
pub use coordinates::{PLAIN_LIMIT, PRISMATIC_LIMIT};
pub use description::{Joint, JointKind, Link, Placement};
pub use drive::{Friction, Limits, Motor};
pub use parameters::Parameter;
pub use payload::{Payload, PayloadError};
pub use task::{TaskRow, TaskRows};

macro_rules! define_arm {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        { kernel $($kernel:tt)+ }
        { batch $($batch:tt)+ }
        { error $($error:tt)+ }
        $({ default |$arm:ident| $default:expr })?
    )+) => {
        /// An arm of `N` joints: its kinematics, its dynamics, and their derivatives by the joint coordinates.
        ///
        /// SI units and radians; for a prismatic joint read metres for radians and newtons for newton metres.
        /// Twists and wrenches are linear first, `[v; ω]` and `[f; n]`, in world axes, at the tool point.
        /// `q` is measured from the table's configuration.
        ///
        /// For finite arguments of any size that a mechanism can have, no method returns NaN and none panics; for a `q` that is not finite,
        /// results are NaN where they depend on it. A prismatic joint farther out than [`PRISMATIC_LIMIT`]
        /// is read as if it stood there.
        pub trait Arm<const N: usize> {
            /// The rows of the Jacobian that make up the task of w_D.
            fn task(&self) -> TaskRows;

            /// Rated torque of each joint, N·m (N); infinite where the table states none.
            fn rated_torque(&self) -> SVector<f64, N>;

            $(
                define_arm! {
                    @method [$(#[$doc])*] $method($($argument),+) -> $output $({ |$arm| $default })?
                }
            )+
        }
    };
    (@method [$($doc:tt)*] $method:ident($($argument:ident),+) -> $output:ty) => {
        $($doc)*
        fn $method(&self, $($argument: &$crate::argument_type!([N] $argument)),+) -> $output;
    };
    (@method [$($doc:tt)*] $method:ident($($argument:ident),+) -> $output:ty { |$arm:ident| $default:expr }) => {
        $($doc)*
        fn $method(&self, $($argument: &$crate::argument_type!([N] $argument)),+) -> $output {
            let $arm = self;
            $default
        }
    };
}

crate::methods! { [N] define_arm {} }
