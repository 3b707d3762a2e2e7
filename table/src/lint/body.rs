//! [`Body`]: how a link's mass lies around its centroid.

use std::f64::consts::PI;

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use ulna::Link;

/// A link's mass, and how it lies: its second moments, of which the inertia tensor is made.
pub(super) struct Body {
    /// kg.
    pub(super) mass: f64,
    /// The centroid, m, in the link's frame.
    pub(super) com: Vector3<f64>,
    /// The second moments about the centroid, by the mass: the mean of r r^T, m^2. That of a uniform rod is its length squared / 12 along it.
    pub(super) spread: Matrix3<f64>,
    /// The principal ones, the least first, m^2; none below 0.
    pub(super) principal: [f64; 3],
    /// The direction in which the mass lies farthest apart.
    pub(super) longest_axis: Vector3<f64>,
}

impl Body {
    pub(super) fn of(link: &Link) -> Self {
        let inertia = Matrix3::from(link.inertia);
        // I = tr(S) 1 - S of the second moments S.
        let spread = (Matrix3::identity() * (0.5 * inertia.trace()) - inertia) / link.mass;
        let eigen = SymmetricEigen::new(spread);
        let mut order = [0, 1, 2];
        order.sort_by(|i, j| eigen.eigenvalues[*i].total_cmp(&eigen.eigenvalues[*j]));
        Self {
            mass: link.mass,
            com: Vector3::from(link.com),
            spread,
            principal: order.map(|i| eigen.eigenvalues[i].max(0.0)),
            longest_axis: eigen.eigenvectors.column(order[2]).into_owned(),
        }
    }

    /// How far the mass lies from the centroid along its longest axis, m (root mean square).
    pub(super) fn half_spread(&self) -> f64 {
        self.principal[2].sqrt()
    }

    /// The largest radius of gyration, sqrt(I / m), m.
    pub(super) fn gyration(&self) -> f64 {
        let [_, middle, largest] = self.principal;
        (middle + largest).sqrt()
    }

    /// How many times as long as thick it is, by its two longest axes.
    pub(super) fn slenderness(&self) -> f64 {
        let [_, middle, largest] = self.principal;
        (largest / middle).sqrt()
    }

    /// Half the length, m, of a uniform rod whose mass lies as far apart along `direction` (of length 1).
    pub(super) fn half_rod(&self, direction: Vector3<f64>) -> f64 {
        let along = direction.dot(&(self.spread * direction));
        (3.0 * along.max(0.0)).sqrt()
    }

    /// The least density, kg/m^3, that any body of these moments has somewhere: that of the ellipsoid which has them.
    pub(super) fn density(&self) -> f64 {
        // A uniform ellipsoid's second moments are its half-axes squared / 5.
        let axes = self.principal.map(|moment| (5.0 * moment).sqrt());
        self.mass / (4.0 / 3.0 * PI * axes.iter().product::<f64>())
    }
}
