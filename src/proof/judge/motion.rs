//! Rules for links, rates and energies.

use nalgebra::{IsometryMatrix3, SVector, Vector3, Vector6};

use super::{Judge, Square, Twists, Verdict, rounded};
use crate::proof::{relative, worse};

impl<const N: usize> Judge<'_, N> {
    pub(in crate::proof) fn poses(
        &self,
        found: [IsometryMatrix3<f64>; N],
        expected: impl FnOnce() -> [IsometryMatrix3<f64>; N],
    ) -> Verdict {
        let expected = expected();
        let pairs = found.iter().zip(&expected);
        rounded::<N>(pairs.map(|(a, b)| self.apart(a, b)).fold(0.0, worse))
    }

    pub(in crate::proof) fn twists_of_links(
        &self,
        found: [Twists<N>; N],
        expected: impl FnOnce() -> [Twists<N>; N],
    ) -> Verdict {
        let expected = expected();
        let error = |i: usize| self.scale.twists(&(found[i] - expected[i]));
        rounded::<N>((0..N).map(error).fold(0.0, worse))
    }

    /// A mean of points none of which is farther out than the chain is long and its own link's centroid besides.
    pub(in crate::proof) fn centroid(
        &self,
        found: Vector3<f64>,
        expected: impl FnOnce() -> Vector3<f64>,
    ) -> Verdict {
        let difference = found - expected();
        rounded::<N>(relative(difference.amax(), self.farthest()))
    }

    /// What J can change by at these rates: each joint turns, or moves, the twists by their own size.
    pub(in crate::proof) fn twist_rates(
        &self,
        found: Twists<N>,
        expected: impl FnOnce() -> Twists<N>,
    ) -> Verdict {
        let error = self.scale.twists(&(found - expected()));
        rounded::<N>(relative(error, self.speed()))
    }

    /// J̇ takes the rates once more.
    pub(in crate::proof) fn twist_of_rates(
        &self,
        found: Vector6<f64>,
        expected: impl FnOnce() -> Vector6<f64>,
    ) -> Verdict {
        let difference = found - expected();
        let linear = difference.fixed_rows::<3>(0).amax() / self.scale.length;
        let angular = difference.fixed_rows::<3>(3).amax();
        let speed = self.speed();
        rounded::<N>(relative(worse(linear, angular), speed * speed))
    }

    /// Christoffel's symbols with M's sizes, over the unit of a coordinate, in the place of M's derivatives.
    pub(in crate::proof) fn masses_at_rates(
        &self,
        found: Square<N>,
        expected: impl FnOnce() -> Square<N>,
    ) -> Verdict {
        let sizes = &self.scale.links_ahead;
        let (speed, momentum) = (self.speed(), sizes.dot(&self.state.qd.abs()));
        let difference = found - expected();
        let entries = (0..N).flat_map(|i| (0..N).map(move |j| (i, j)));
        let errors = entries.map(|(i, j)| {
            let crossed = sizes[i] / self.unit(j) + sizes[j] / self.unit(i);
            let size = 0.5 * (sizes[i] * sizes[j] * speed + crossed * momentum);
            relative(difference[(i, j)], size)
        });
        rounded::<N>(errors.fold(0.0, worse))
    }

    /// M's sizes in the place of M.
    pub(in crate::proof) fn energy_of_motion(
        &self,
        found: f64,
        expected: impl FnOnce() -> f64,
    ) -> Verdict {
        let momentum = self.scale.inertia.dot(&self.state.qd.abs());
        rounded::<N>(relative(found - expected(), 0.5 * momentum * momentum))
    }

    /// All mass as far out as it can be.
    pub(in crate::proof) fn energy_of_position(
        &self,
        found: f64,
        expected: impl FnOnce() -> f64,
    ) -> Verdict {
        let masses = self.chain.joints.iter().map(|joint| joint.link.mass);
        let weight = Vector3::from(self.chain.gravity).norm() * masses.sum::<f64>();
        rounded::<N>(relative(found - expected(), weight * self.farthest()))
    }

    /// Σ |q̇_i|, those of prismatic joints in lengths of the chain.
    fn speed(&self) -> f64 {
        let rates = SVector::<f64, N>::from_fn(|i, _| self.state.qd[i] / self.unit(i));
        rates.abs().sum()
    }

    /// How far from the world's origin a link's centroid may be, m.
    fn farthest(&self) -> f64 {
        let links = self.chain.joints.iter().map(|joint| &joint.link);
        let out = links.map(|link| Vector3::from(link.com).norm());
        self.scale.position + out.fold(0.0, worse)
    }
}
