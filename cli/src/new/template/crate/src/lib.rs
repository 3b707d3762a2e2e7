//! The arm of `arms/my_arm.toml`: `MyArm`, which implements `ulna::Arm` and `ulna::ArmBatch`, written by the build script.

/// How many joints it has.
pub const N: usize = MyArm::CHAIN.joints.len();

/// The arm. If its table asks for a payload at run time, it carries none yet.
pub fn arm() -> MyArm {
    Default::default()
}

// Last, because its own tests stand at its end.
include!(concat!(env!("OUT_DIR"), "/my_arm.rs"));
