//! [`Payload`]: a body that the tool holds, known when the arm moves and not before.

use nalgebra::{Matrix3, Vector3};

use super::bounds::{MOMENT_ROUNDING, Share, TRIANGLE_TOLERANCE};
use super::description::{Joint, Link, Placement};
use super::parameters::Parameter;
use crate::{Real, SerialChain};

/// A rigid body fixed to the tool: mass, centroid and inertia, in the tool's frame. One that exists is one that a body can have.
///
/// An arm whose table says `[payload] runtime = true` takes one between two calls; [`SerialChain::carrying`] is its textbook twin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Payload(Link);

/// Why a payload is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PayloadError {
    /// The mass is none.
    #[error("a payload of {0} kg: the mass must be from 0 to {max:e} kg", max = Payload::MAX_MASS)]
    Mass(f64),
    /// The centroid is too far from the tool, or is no point.
    #[error("a payload's centroid at {0:?} m from the tool: each coordinate must be within ±{max} m", max = Payload::MAX_DISTANCE)]
    Centroid([f64; 3]),
    /// The inertia tensor is not symmetric.
    #[error("a payload's inertia {0:?} kg m^2 is not symmetric")]
    Unsymmetric([[f64; 3]; 3]),
    /// No rigid body has such an inertia.
    #[error(
        "a payload's inertia with the principal moments {0:?} kg m^2 is not that of a rigid body about its centroid: \
         none may be negative, none beyond the sum of the other two or {max:e}, and without mass all are 0",
        max = Payload::MAX_MOMENT
    )]
    Inertia([f64; 3]),
    /// With it a link before the tool would be too light for double precision: less than 1e-13 of what its joint carries.
    #[error(
        "a payload so heavy that link {joint} would be lost in the rounding of what it carries"
    )]
    TooHeavy {
        /// The joint whose link it is, from 1.
        joint: usize,
    },
    /// The arm was not made for one.
    #[error(
        "this arm takes no payload at run time: write `runtime = true` into its table, under `[payload]`"
    )]
    NotAtRunTime,
}

impl Payload {
    /// No body at all.
    pub const NONE: Self = Self(Link {
        mass: 0.0,
        com: [0.0; 3],
        inertia: [[0.0; 3]; 3],
    });

    /// The heaviest, kg.
    pub const MAX_MASS: f64 = 1e6;
    /// The farthest that a coordinate of the centroid is from the tool, m.
    pub const MAX_DISTANCE: f64 = 100.0;
    /// The largest principal moment, kg·m².
    pub const MAX_MOMENT: f64 = 1e9;
    /// How many [`parameters`](Self::parameters) there are.
    pub const PARAMETERS: usize = Parameter::COUNT;

    /// A body of `mass` kg with its centroid at `com`, m, in the tool's frame; `inertia` is the tensor about the centroid
    /// in the tool's axes, kg·m². A point mass has an inertia of zeros.
    ///
    /// # Errors
    /// What no rigid body can have.
    pub fn new(mass: f64, com: [f64; 3], inertia: [[f64; 3]; 3]) -> Result<Self, PayloadError> {
        if !(0.0..=Self::MAX_MASS).contains(&mass) {
            return Err(PayloadError::Mass(mass));
        }
        if !com.iter().all(|x| x.abs() <= Self::MAX_DISTANCE) {
            return Err(PayloadError::Centroid(com));
        }
        let tensor = Matrix3::from_fn(|i, j| inertia[i][j]);
        if !tensor.iter().all(|x| x.abs() <= Self::MAX_MOMENT) {
            return Err(PayloadError::Inertia([
                inertia[0][0],
                inertia[1][1],
                inertia[2][2],
            ]));
        }
        if (tensor - tensor.transpose()).amax() > MOMENT_ROUNDING * tensor.amax() {
            return Err(PayloadError::Unsymmetric(inertia));
        }
        let moments = tensor.symmetric_eigenvalues();
        let (least, largest) = (moments.min(), moments.max());
        let middle = moments.sum() - least - largest;
        let is_rigid = least >= -MOMENT_ROUNDING * largest.abs()
            && least + middle >= largest * (1.0 - TRIANGLE_TOLERANCE);
        if !is_rigid || (mass == 0.0 && largest > 0.0) {
            return Err(PayloadError::Inertia([least, middle, largest]));
        }
        Ok(Self(Link { mass, com, inertia }))
    }

    /// A body for proofs, without any symmetry, as heavy as the chain's last link.
    pub(crate) fn example<const N: usize>(chain: &SerialChain<N>) -> Self {
        let mass = chain.joints.last().map_or(0.0, |joint| joint.link.mass);
        let per_mass = [
            [0.025, 0.005, -0.002],
            [0.005, 0.02, 0.003],
            [-0.002, 0.003, 0.015],
        ];
        Self(Link {
            mass,
            com: [0.1, -0.2, 0.3],
            inertia: per_mass.map(|row| row.map(|x| mass * x)),
        })
    }

    /// Its mass, kg.
    pub const fn mass(&self) -> f64 {
        self.0.mass
    }

    /// Its centroid in the tool's frame, m.
    pub const fn com(&self) -> [f64; 3] {
        self.0.com
    }

    /// Its inertia about the centroid in the tool's axes, kg·m².
    pub const fn inertia(&self) -> [[f64; 3]; 3] {
        self.0.inertia
    }

    /// The ten standard inertial parameters about the origin of the frame in which the tool stands at `tool`,
    /// in the order of [`Parameter::ALL`]: what the regressor of the last link multiplies.
    pub fn parameters(&self, tool: &Placement) -> [f64; Self::PARAMETERS] {
        self.seen_from(tool).parameters()
    }

    /// The same body in the frame in which the tool stands at `tool`.
    fn seen_from(&self, tool: &Placement) -> Link {
        let pose = tool.isometry();
        let rotation = pose.rotation.matrix();
        let Link { mass, com, inertia } = self.0;
        let com = rotation * Vector3::from(com) + pose.translation.vector;
        let tensor = Matrix3::from_fn(|i, j| inertia[i][j]);
        let tensor = rotation * tensor * rotation.transpose();
        Link {
            mass,
            com: com.into(),
            inertia: core::array::from_fn(|i| core::array::from_fn(|j| tensor[(i, j)])),
        }
    }
}

/// Nothing.
impl Default for Payload {
    fn default() -> Self {
        Self::NONE
    }
}

impl<const N: usize> SerialChain<N> {
    /// The chain with `payload` as a part of its last link: both as one body (Huygens and Steiner).
    #[must_use]
    pub fn carrying(&self, payload: &Payload) -> Self {
        let mut chain = *self;
        carry(&mut chain.joints, &chain.tool, payload);
        chain
    }

    /// Whether the chain can carry `payload` in double precision: what a table is refused for, it is refused for too.
    ///
    /// # Errors
    /// [`PayloadError::TooHeavy`].
    pub fn admit(&self, payload: &Payload) -> Result<(), PayloadError> {
        admit(&self.carrying(payload).joints)
    }
}

/// [`SerialChain::carrying`], for who knows the number of joints at run time.
pub fn carry(joints: &mut [Joint], tool: &Placement, payload: &Payload) {
    let Some(last) = joints.last_mut() else {
        return;
    };
    if payload.mass() == 0.0 {
        return;
    }
    let (own, other) = (last.link, payload.seen_from(tool));
    let mass = own.mass + other.mass;
    let apart = Vector3::from(other.com) - Vector3::from(own.com);
    let com = Vector3::from(own.com) + apart * (other.mass / mass);
    // Two bodies about their common centroid: the reduced mass at their distance.
    let reduced = own.mass * (other.mass / mass);
    let steiner =
        (Matrix3::identity() * apart.norm_squared() - apart * apart.transpose()) * reduced;
    last.link = Link {
        mass,
        com: com.into(),
        inertia: core::array::from_fn(|i| {
            core::array::from_fn(|j| own.inertia[i][j] + other.inertia[i][j] + steiner[(i, j)])
        }),
    };
}

/// [`SerialChain::admit`] of joints that [`carry`] the payload.
///
/// # Errors
/// As there.
pub fn admit(joints: &[Joint]) -> Result<(), PayloadError> {
    match (0..joints.len()).find(|index| !Share::of(joints, *index).is_enough()) {
        Some(index) => Err(PayloadError::TooHeavy { joint: index + 1 }),
        None => Ok(()),
    }
}

/// What a generated arm holds: its payload, as its kernels read it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Carried {
    payload: Payload,
    /// About the origin of the last link's frame.
    parameters: [f64; Payload::PARAMETERS],
}

impl Carried {
    /// `payload` on the arm of `chain`.
    ///
    /// # Errors
    /// [`SerialChain::admit`].
    pub fn new<const N: usize>(
        payload: Payload,
        chain: &SerialChain<N>,
    ) -> Result<Self, PayloadError> {
        chain.admit(&payload)?;
        Ok(Self {
            payload,
            parameters: payload.parameters(&chain.tool),
        })
    }

    /// The payload.
    pub const fn payload(&self) -> Payload {
        self.payload
    }

    /// Its parameters, in every lane.
    #[inline(always)]
    pub fn parameters<R: Real>(&self) -> [R; Payload::PARAMETERS] {
        self.parameters.map(R::of)
    }
}
