//! How large a rounding error may be at a state: what each quantity's terms amount to there, and how strongly w_D reacts.

use nalgebra::{SMatrix, SVector, Vector3};

use crate::arm::bounds::{carried_by_links, carried_inertia};
use crate::generic::{ThinQr, factor, task_columns};
use crate::{Arm, JointKind, Real, SerialChain, TaskRow};

/// The sizes that errors at a state are relative to.
pub(super) struct Scale<const N: usize> {
    /// The chain's length, m: rows of v of J and ∂J are measured by it.
    pub(super) length: f64,
    /// Greatest distance of the tool from the world's origin, m.
    pub(super) position: f64,
    /// √ of each joint's largest possible entry of M: the entry (i, j) is measured by the product of two.
    pub(super) inertia: SVector<f64, N>,
    /// Likewise where every prismatic joint is out by the chain's length more: what a difference of M's over that length is measured by.
    pub(super) inertia_ahead: SVector<f64, N>,
    /// The same two without rotors: M's changes are measured by them, for a rotor's inertia stays as it is.
    pub(super) links: SVector<f64, N>,
    pub(super) links_ahead: SVector<f64, N>,
    /// What the joints' rotors add to M.
    rotors: SVector<f64, N>,
    gravity: f64,
}

impl<const N: usize> Scale<N> {
    pub(super) fn new(chain: &SerialChain<N>, q: &SVector<f64, N>) -> Self {
        let coordinates = crate::arm::coordinates::coordinates(chain, &q.data.0[0]);
        let length = chain.length(&coordinates);
        let joints = &chain.joints;
        let here = |joint: usize| coordinates[joint];
        let ahead = |joint: usize| coordinates[joint].abs() + length;
        let roots = |size: &dyn Fn(usize) -> f64| SVector::from_fn(|i, _| Real::sqrt(size(i)));
        let mass: f64 = chain.joints.iter().map(|joint| joint.link.mass).sum();
        Self {
            length,
            position: length + Vector3::from(chain.base.translation).norm(),
            inertia: roots(&|i| carried_inertia(joints, i, here)),
            inertia_ahead: roots(&|i| carried_inertia(joints, i, ahead)),
            links: roots(&|i| carried_by_links(joints, i, here)),
            links_ahead: roots(&|i| carried_by_links(joints, i, ahead)),
            rotors: chain.reflected_inertias(),
            gravity: Vector3::from(chain.gravity).norm() * Real::sqrt(mass),
        }
    }

    /// The first-order condition number of w_D: its relative change, at worst, where the entries of J and M change by
    /// ε times the sizes above, is ε times this. 0 where w_D is 0, and nothing else is right.
    ///
    /// Σ |W_rj| s_r + Σ |(HᵀW)_ij| m_i m_j, s the sizes of J's entries and m m that of M's:
    /// δ ln w_D = ⟨W, δJ⟩ − ⟨HᵀW, δM⟩, with H = JM⁻¹ and W = (H†)ᵀM⁻¹.
    pub(super) fn condition(&self, reference: &dyn Arm<N>, q: &SVector<f64, N>) -> f64 {
        if reference.dynamic_manipulability(q) == 0.0 {
            return 0.0;
        }
        let task = reference.task();
        let jacobian = reference.geometric_jacobian(q);
        let mass = factor(reference.mass_matrix(q));
        let h = mass.solve(&task_columns(task, &jacobian));
        let w = mass.solve(&ThinQr::new(h, task.len()).duals());
        let mut condition = 0.0;
        for (column, row) in task.iter().enumerate() {
            let size = if row < TaskRow::Rx { self.length } else { 1.0 };
            condition += w.column(column).iter().map(|w| w.abs()).sum::<f64>() * size;
        }
        let outer = h * w.transpose();
        for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
            condition += outer[(i, j)].abs() * self.inertia[i] * self.inertia[j];
        }
        condition
    }

    /// What the terms of each joint's torque may amount to, N·m (N), in the motion `(q̇, q̈)`.
    pub(super) fn torque(&self, qd: &SVector<f64, N>, qdd: &SVector<f64, N>) -> SVector<f64, N> {
        self.torque_with(&self.links, qd, qdd) + self.rotors.component_mul(&qdd.abs())
    }

    /// Likewise of its derivative by q_j, times that joint's [unit](Self::unit).
    pub(super) fn torque_by_position(
        &self,
        chain: &SerialChain<N>,
        j: usize,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        self.torque_with(self.links_beside(chain, j), qd, qdd)
    }

    /// Likewise of its derivative by any q̇_j.
    pub(super) fn torque_by_velocity(&self, qd: &SVector<f64, N>) -> SVector<f64, N> {
        let speed: f64 = qd.iter().map(|x| x.abs()).sum();
        self.links * (2.0 * self.links.amax() * speed)
    }

    /// The sizes of M's entries, where a derivative by q_j is taken.
    pub(super) fn inertia_beside(&self, chain: &SerialChain<N>, j: usize) -> &SVector<f64, N> {
        match chain.joints[j].kind {
            JointKind::Revolute => &self.inertia,
            JointKind::Prismatic => &self.inertia_ahead,
        }
    }

    /// Those of what of M changes.
    pub(super) fn links_beside(&self, chain: &SerialChain<N>, j: usize) -> &SVector<f64, N> {
        match chain.joints[j].kind {
            JointKind::Revolute => &self.links,
            JointKind::Prismatic => &self.links_ahead,
        }
    }

    /// Of the links' torques.
    fn torque_with(
        &self,
        links: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let speed: f64 = qd.iter().map(|x| x.abs()).sum();
        let accelerated: f64 = links.iter().zip(qdd).map(|(m, x)| m * x.abs()).sum();
        let turned = links.amax() * speed * speed;
        links * (accelerated + turned + self.gravity)
    }

    /// What the terms of each joint's impact torque may amount to, N·m (N), if `joint` locks in the motion `(q̇, q̈)`:
    /// those of [`torque`](Self::torque) that have its rate or its acceleration in them.
    pub(super) fn impact(
        &self,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
        joint: usize,
    ) -> SVector<f64, N> {
        let speed: f64 = qd.iter().map(|x| x.abs()).sum();
        let accelerated = self.links[joint] * qdd[joint].abs();
        let turned = self.links.amax() * 2.0 * speed * qd[joint].abs();
        let mut sizes = self.links * (accelerated + turned);
        sizes[joint] += self.rotors[joint] * qdd[joint].abs();
        sizes
    }

    /// The unit of ∂/∂q_i: 1 for an angle, the chain's length for an offset.
    pub(super) fn unit(&self, chain: &SerialChain<N>, joint: usize) -> f64 {
        match chain.joints[joint].kind {
            JointKind::Revolute => 1.0,
            JointKind::Prismatic => self.length,
        }
    }

    /// The largest of a 6×N matrix's entries, those of v relative to the length.
    pub(super) fn twists(&self, difference: &SMatrix<f64, 6, N>) -> f64 {
        let mut largest = 0.0;
        for (index, x) in difference.iter().enumerate() {
            let size = if index % 6 < 3 { self.length } else { 1.0 };
            largest = super::worse(largest, x.abs() / size);
        }
        largest
    }

    /// The largest of an N×N matrix's entries, relative to M's sizes, or to `sizes` of their own.
    pub(super) fn masses(sizes: &SVector<f64, N>, difference: &SMatrix<f64, N, N>) -> f64 {
        let mut largest = 0.0;
        for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
            let size = sizes[i] * sizes[j];
            largest = super::worse(largest, difference[(i, j)].abs() / size);
        }
        largest
    }

    /// The inverse dynamics' error: the worst joint's, relative to what its torque is made of.
    pub(super) fn torques(sizes: &SVector<f64, N>, difference: &SVector<f64, N>) -> f64 {
        let pairs = difference.iter().zip(sizes);
        pairs.fold(0.0, |worst, (x, size)| {
            super::worse(worst, if *x == 0.0 { 0.0 } else { x.abs() / size })
        })
    }
}
