//! From lists to vectors whose length is a type's, and back.

use nalgebra::SVector;
use ulna::{JointState, LockedJoints};
use ulna_study::experiment::ExperimentError;

use crate::StateList;

/// One entry for each of `N` joints.
pub(crate) fn vector<const N: usize>(numbers: &[f64]) -> Result<SVector<f64, N>, ExperimentError> {
    let numbers = <[f64; N]>::try_from(numbers).map_err(|_| ExperimentError::Joints {
        experiment: numbers.len(),
        arm: N,
    })?;
    Ok(numbers.into())
}

/// The same; `otherwise` for each joint where there is no list.
pub(crate) fn vector_or<const N: usize>(
    numbers: Option<&[f64]>,
    otherwise: SVector<f64, N>,
) -> Result<SVector<f64, N>, ExperimentError> {
    numbers.map_or(Ok(otherwise), vector)
}

pub(crate) fn list<const N: usize>(vector: &SVector<f64, N>) -> Vec<f64> {
    vector.as_slice().to_vec()
}

pub(crate) fn state<const N: usize>(lists: &StateList) -> Result<JointState<N>, ExperimentError> {
    Ok(JointState {
        q: vector(&lists.q)?,
        qd: vector(&lists.qd)?,
        qdd: vector(&lists.qdd)?,
    })
}

/// Joints counted from 0.
pub(crate) fn locked<const N: usize>(joints: &[usize]) -> Result<LockedJoints<N>, ExperimentError> {
    LockedJoints::new(joints).ok_or_else(|| ExperimentError::Joint {
        joint: joints.iter().copied().max().unwrap_or(0),
        joints: N,
    })
}
