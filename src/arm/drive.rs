//! What is known of a joint beside its place and its link: how far and how fast it may go, its motor, its friction.

/// How far and how fast a joint may go; infinite where no limit is stated. Its largest effort is [`Joint::rated_torque`](crate::Joint::rated_torque).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Least coordinate q, rad (m).
    pub lower: f64,
    /// Largest coordinate q, rad (m).
    pub upper: f64,
    /// Largest |q̇|, rad/s (m/s).
    pub velocity: f64,
}

impl Limits {
    /// No limit.
    pub const NONE: Self = Self {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        velocity: f64::INFINITY,
    };

    /// What counts as rounding beyond a limit, rad (m).
    const ROUNDING: f64 = 1e-9;

    /// How far the coordinate `q` is beyond, rad (m): 0 within the limits, and up to rounding. One that is no number is beyond all.
    pub fn beyond(&self, q: f64) -> f64 {
        let beyond = if self.lower <= q && q <= self.upper {
            0.0
        } else if q > self.upper {
            q - self.upper
        } else if q < self.lower {
            self.lower - q
        } else {
            f64::INFINITY
        };
        if beyond > Self::ROUNDING { beyond } else { 0.0 }
    }
}

/// A joint's motor behind its gears, as far as its rotor resists acceleration.
///
/// The gears are rigid. Of the rotor's motion its spin about its own axis counts, and of that what the joint's own rate gives it:
/// `inertia · ratio²` is added to the joint's entry of M, and the gyroscopic effects of a spinning rotor that is carried about are neglected
/// (Siciliano 7.1.1; Featherstone, *Rigid Body Dynamics Algorithms*, section 9.6; Pinocchio's `armature`). The rotor's mass is a part
/// of the link that carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Inertia of the rotor, with all that turns with it, about its own axis, kg·m².
    pub inertia: f64,
    /// Turns of the rotor for one of the joint; rad/m for a prismatic joint.
    pub ratio: f64,
}

impl Motor {
    /// No rotor that counts.
    pub const NONE: Self = Self {
        inertia: 0.0,
        ratio: 1.0,
    };

    /// What the rotor adds to the joint's entry of M, kg·m² (kg for a prismatic joint): `inertia · ratio²`.
    pub const fn reflected_inertia(&self) -> f64 {
        self.inertia * self.ratio * self.ratio
    }
}

/// A joint's friction: viscous, and Coulomb's, smoothed where the joint turns back.
///
/// `viscous · q̇ + coulomb · q̇ / √(q̇² + smoothing²)`: [`Friction::torque`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Viscous coefficient, N·m·s/rad (N·s/m).
    pub viscous: f64,
    /// Coulomb's torque, N·m (N).
    pub coulomb: f64,
    /// The rate ε at which Coulomb's friction has reached 1/√2 of its size, rad/s (m/s); above 0.
    pub smoothing: f64,
}

impl Friction {
    /// None.
    pub const NONE: Self = Self {
        viscous: 0.0,
        coulomb: 0.0,
        smoothing: Self::SMOOTHING,
    };

    /// The smoothing of a table that does not say, rad/s (m/s): one part in a thousand of the rates at which arms work.
    pub const SMOOTHING: f64 = 1e-3;
}
