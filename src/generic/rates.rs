//! What the tool does while the joints move at constant rates.

use nalgebra::{SMatrix, SVector};

use super::SerialChain;
use super::kinematics::JointInput;

impl<const N: usize> SerialChain<N> {
    /// `J̇ = Σ_i ∂J/∂q_i q̇_i`, the chain rule.
    pub(super) fn rate_of_jacobian(
        &self,
        inputs: &[JointInput; N],
        qd: &SVector<f64, N>,
    ) -> SMatrix<f64, 6, N> {
        let derivatives = self.derivatives(inputs, |shifted| self.tool_jacobian(shifted));
        let pairs = derivatives.iter().zip(qd);
        pairs.map(|(derivative, rate)| derivative * *rate).sum()
    }
}
