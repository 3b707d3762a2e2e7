//! From a [`Model`], whose number of joints is known at run time, to a [`SerialChain`], whose number is a type's.

use ulna::{Joint, SerialChain};

use crate::Model;

/// The model has another number of joints than the chain's type.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("arm `{arm}` has {joints} joints, not {expected}: write SerialChain::<{joints}>")]
pub struct JointCountError {
    /// The arm's name.
    pub arm: String,
    /// The joints of the model.
    pub joints: usize,
    /// The joints of the type, `N`.
    pub expected: usize,
}

impl<const N: usize> TryFrom<&Model> for SerialChain<N> {
    type Error = JointCountError;

    fn try_from(model: &Model) -> Result<Self, JointCountError> {
        let joints = model.joints();
        let joints = <[Joint; N]>::try_from(joints).map_err(|_| JointCountError {
            arm: model.name().to_owned(),
            joints: joints.len(),
            expected: N,
        })?;
        Ok(Self {
            joints,
            base: *model.base(),
            tool: *model.tool(),
            gravity: model.gravity(),
            task: model.task(),
        })
    }
}
