//! [`Parameter`]: the inertial parameters of a link, in which the torque is linear.

use super::Link;

/// An inertial parameter of a link, about the origin of the link's frame.
///
/// The torque is linear in all links' parameters π: `τ = Y π`, Y being the [regressor](crate::Arm::regressor).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Parameter {
    /// Mass m, kg.
    Mass,
    /// First moment m c_x, kg·m.
    Mx,
    /// First moment m c_y, kg·m.
    My,
    /// First moment m c_z, kg·m.
    Mz,
    /// Entry xx of the inertia tensor about the origin, kg·m².
    Ixx,
    /// Entry xy, −∫ x y dm, kg·m²; it stands twice in the tensor and counts once here.
    Ixy,
    /// Entry xz, likewise.
    Ixz,
    /// Entry yy, kg·m².
    Iyy,
    /// Entry yz, likewise.
    Iyz,
    /// Entry zz, kg·m².
    Izz,
}

impl Parameter {
    /// How many a link has.
    pub const COUNT: usize = 10;

    /// All of them, in the order of the regressor's columns.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Mass,
        Self::Mx,
        Self::My,
        Self::Mz,
        Self::Ixx,
        Self::Ixy,
        Self::Ixz,
        Self::Iyy,
        Self::Iyz,
        Self::Izz,
    ];

    /// The order within a link in which base parameters are chosen: second moments before first ones before the mass,
    /// so that what is grouped has lengths and squares of lengths as its coefficients, and no quotients of them.
    ///
    /// A parameter is a base parameter if its column of Y depends on no columns before it, those of the links nearer to the base
    /// and, of its own link, those earlier in this order.
    pub const BASE_ORDER: [Self; Self::COUNT] = [
        Self::Ixx,
        Self::Ixy,
        Self::Ixz,
        Self::Iyy,
        Self::Iyz,
        Self::Izz,
        Self::Mx,
        Self::My,
        Self::Mz,
        Self::Mass,
    ];

    /// Its place among [all](Self::ALL): its column of the regressor's block.
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Its symbol: `m`, `mx`, `my`, `mz`, `Ixx`, `Ixy`, `Ixz`, `Iyy`, `Iyz`, `Izz`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mass => "m",
            Self::Mx => "mx",
            Self::My => "my",
            Self::Mz => "mz",
            Self::Ixx => "Ixx",
            Self::Ixy => "Ixy",
            Self::Ixz => "Ixz",
            Self::Iyy => "Iyy",
            Self::Iyz => "Iyz",
            Self::Izz => "Izz",
        }
    }

    /// The power of a length in its unit: 0 for the mass, 1 for first moments, 2 for the inertia.
    pub const fn degree(self) -> usize {
        match self {
            Self::Mass => 0,
            Self::Mx | Self::My | Self::Mz => 1,
            _ => 2,
        }
    }
}

impl Link {
    /// The link's inertial parameters, in the order of [`Parameter::ALL`]: kg, kg·m, kg·m², about the origin of the link's frame.
    pub fn parameters(&self) -> [f64; Parameter::COUNT] {
        let Self { mass, com, inertia } = *self;
        let [x, y, z] = com;
        // Huygens and Steiner.
        let moved = |row: usize, column: usize| {
            let product = com[row] * com[column];
            let square = if row == column {
                x * x + y * y + z * z
            } else {
                0.0
            };
            inertia[row][column] + mass * (square - product)
        };
        [
            mass,
            mass * x,
            mass * y,
            mass * z,
            moved(0, 0),
            moved(0, 1),
            moved(0, 2),
            moved(1, 1),
            moved(1, 2),
            moved(2, 2),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_is_at_its_place() {
        for (index, parameter) in Parameter::ALL.into_iter().enumerate() {
            assert_eq!(parameter.index(), index);
            assert!(Parameter::BASE_ORDER.contains(&parameter));
        }
    }

    #[test]
    fn a_point_mass_has_the_moments_of_its_place() {
        let point = Link {
            mass: 2.0,
            com: [1.0, 2.0, -3.0],
            inertia: [[0.0; 3]; 3],
        };
        let expected = [2.0, 2.0, 4.0, -6.0, 26.0, -4.0, 6.0, 20.0, 12.0, 10.0];
        assert_eq!(point.parameters(), expected);
    }
}
