//! The suppression controller: boundary conditions and compensated torque, Eq. 13–20.
//!
//! `τ = ID(q, q̇, q̈) + Jᵀ F_e + U`, with a compensation U that makes the torque before and after a lock alike.
//! `F_e` is the wrench that the tool exerts on its surroundings. J here is made of the task's rows.
//!
//! After joints have locked, their columns of J are 0 and so are their entries of ∇w_D (the text after Eq. 27):
//! w_D itself stays that of the whole arm, and a locked joint's motor gets no compensation.
//!
//! Rule near singular poses. With c the [`NullSpace::conditioning`] of the moving joints' J,
//! U is multiplied by `(c − SINGULAR) / (NEAR_SINGULAR − SINGULAR)`, at least 0 and at most 1. So U
//! stays continuous and bounded, and is 0 on the singular set, where w_D is 0 and Eq. 23 has no value.
//! [`Status::NearSingular`] says so wherever c is below [`NEAR_SINGULAR`].

use nalgebra::{Cholesky, SMatrix, SVector, Vector6};

use crate::failure::LockedJoints;
use crate::null_space::{NEAR_SINGULAR, NullSpace, SINGULAR};
use crate::trajectory::JointState;
use crate::{Arm, TaskRows};

/// A law of compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Law {
    /// Eq. 16: a coefficient for each joint's torque. Cancels any step; bends the tool force.
    PerJoint,
    /// Eq. 20: the coefficients inside the projector. Keeps the tool force; cancels only in part.
    Projected,
    /// Free torques in place of k_d ∇w_D, one before and one after the lock: the best that any compensation can do.
    Optimal,
}

/// A law with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Compensation<const N: usize> {
    /// [`Law::PerJoint`], `U_i = k_di (P ∇w_D)_i`: the diagonal of k_d.
    PerJoint(SVector<f64, N>),
    /// [`Law::Projected`], `U = P k_d ∇w_D`: the diagonal of k_d.
    Projected(SVector<f64, N>),
    /// [`Law::Optimal`], `U = P z + Jᵀ f`.
    Optimal {
        /// As long as no joint is locked.
        before: FreeTorque<N>,
        /// From the lock on.
        after: FreeTorque<N>,
    },
}

/// What [`Law::Optimal`] adds: `U = P z + Jᵀ f`. The static tool wrench is off by f, wherever the arm is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeTorque<const N: usize> {
    /// z, N·m (N), of which the part in the null space of J counts.
    pub torque: SVector<f64, N>,
    /// f, `[force; moment]`, world axes, N and N·m; 0 outside the task.
    pub wrench: Vector6<f64>,
}

impl<const N: usize> Compensation<N> {
    /// No compensation at all.
    pub fn none() -> Self {
        Self::PerJoint(SVector::zeros())
    }

    /// Which law it is.
    pub fn law(&self) -> Law {
        match self {
            Self::PerJoint(_) => Law::PerJoint,
            Self::Projected(_) => Law::Projected,
            Self::Optimal { .. } => Law::Optimal,
        }
    }
}

/// The projector P on the torques that leave the task alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projector {
    /// `I − J†J`: no static tool wrench. The paper's, since J̃ = (Jᵀ)† gives `I − J̃†J̃ = I − J†J`.
    #[default]
    Static,
    /// `I − Jᵀ J̄ᵀ`, `J̄ = M⁻¹ Jᵀ (J M⁻¹ Jᵀ)⁻¹`: no acceleration of the tool (Khatib 1987). Its static wrench is not 0.
    DynamicallyConsistent,
}

/// What a compensation is made of in one pose.
#[derive(Clone, Copy, Debug)]
pub struct TaskPose<const N: usize> {
    /// J, all six rows, all joints.
    pub jacobian: SMatrix<f64, 6, N>,
    /// ∇w_D of Eq. 22, the locked joints' entries 0.
    pub gradient: SVector<f64, N>,
    /// The moving joints' J, taken apart.
    pub null_space: NullSpace<N>,
    task: TaskRows,
    locked: LockedJoints<N>,
    projector: Projector,
    whitening: Option<Whitening<N>>,
    /// What U is multiplied by: 1 but near singular poses.
    fade: f64,
}

/// With M = L Lᵀ and Ĵ = J L⁻ᵀ, `I − Jᵀ J̄ᵀ = L (I − Ĵ†Ĵ) L⁻¹`.
#[derive(Clone, Copy, Debug)]
struct Whitening<const N: usize> {
    /// L.
    lower: SMatrix<f64, N, N>,
    /// Ĵ, taken apart.
    null_space: NullSpace<N>,
}

impl<const N: usize> Whitening<N> {
    /// `None` if rounding leaves M without a Cholesky factor, as only absurd arguments can.
    fn new(
        mass_matrix: SMatrix<f64, N, N>,
        jacobian: &SMatrix<f64, 6, N>,
        task: TaskRows,
    ) -> Option<Self> {
        let lower = Cholesky::new(mass_matrix)?.l();
        let whitened = lower.solve_lower_triangular(&jacobian.transpose())?;
        Some(Self {
            lower,
            null_space: NullSpace::new(&whitened.transpose(), task),
        })
    }

    fn project(&self, x: &SVector<f64, N>) -> Option<SVector<f64, N>> {
        let white = self.lower.solve_lower_triangular(x)?;
        Some(self.lower * self.null_space.project(&white))
    }
}

impl<const N: usize> TaskPose<N> {
    /// Looks at `arm` in `q` with `locked` joints.
    #[inline]
    pub fn new(
        arm: &impl Arm<N>,
        q: &SVector<f64, N>,
        locked: LockedJoints<N>,
        projector: Projector,
    ) -> Self {
        let (jacobian, _, gradient) = arm.jacobian_and_gradient(q);
        let task = arm.task();
        let reduced = locked.reduce_jacobian(&jacobian);
        let null_space = NullSpace::new(&reduced, task);
        let distance = (null_space.conditioning() - SINGULAR) / (NEAR_SINGULAR - SINGULAR);
        let whitening = match projector {
            Projector::Static => None,
            Projector::DynamicallyConsistent => Whitening::new(
                locked.reduce_mass_matrix(&arm.mass_matrix(q)),
                &reduced,
                task,
            ),
        };
        Self {
            jacobian,
            gradient: locked.without(&gradient),
            null_space,
            task,
            locked,
            projector,
            whitening,
            fade: distance.clamp(0.0, 1.0),
        }
    }

    /// The rows of J that make up the task.
    pub fn task(&self) -> TaskRows {
        self.task
    }

    /// P x for the moving joints, times the factor of the rule near singular poses.
    #[inline]
    pub fn project(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        let x = self.locked.without(x);
        let projected = match self.projector {
            Projector::Static => self.null_space.project(&x),
            Projector::DynamicallyConsistent => self
                .whitening
                .and_then(|whitening| whitening.project(&x))
                .unwrap_or_else(SVector::zeros),
        };
        projected * self.fade
    }

    /// Jᵀ f for the moving joints and the task's rows of f, times the factor of the rule near singular poses.
    #[inline]
    pub fn lift(&self, wrench: &Vector6<f64>) -> SVector<f64, N> {
        let mut of_task = Vector6::zeros();
        for row in self.task.iter() {
            of_task[row.index()] = wrench[row.index()];
        }
        let torque = self.jacobian.tr_mul(&of_task);
        self.locked.without(&torque) * self.fade
    }

    /// U of Eq. 16 or 20, or of the optimal law.
    #[inline]
    pub fn compensation(&self, compensation: &Compensation<N>) -> SVector<f64, N> {
        match compensation {
            Compensation::PerJoint(k) => self.project(&self.gradient).component_mul(k),
            Compensation::Projected(k) => self.project(&self.gradient.component_mul(k)),
            Compensation::Optimal { before, after } => {
                let free = if self.locked.is_empty() {
                    before
                } else {
                    after
                };
                self.project(&free.torque) + self.lift(&free.wrench)
            }
        }
    }
}

/// How a control cycle went; of several the worst, which comes last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// The whole compensation acts.
    Nominal,
    /// The compensation was cut down to keep Eq. 14.
    Saturated,
    /// The pose is near-singular: the compensation is faded out (the rule stands at the module's head).
    NearSingular,
    /// Motion and tool wrench alone ask for more than a rated torque, and the compensation does not cure it.
    /// The torque is cut to the rated one, and the tool wrench is not kept.
    Overloaded,
    /// An argument or a result is no finite number: torque and compensation are 0.
    NotFinite,
}

/// The two-sided Eq. 14 for the joints that are not locked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits<const N: usize> {
    pub(crate) rated_torque: SVector<f64, N>,
    pub(crate) locked: LockedJoints<N>,
}

/// What a torque may exceed the rated one by before it counts, relative: solvers keep limits to a tolerance.
const LIMIT_TOLERANCE: f64 = 1e-9;

impl<const N: usize> Limits<N> {
    /// The torques within the rated ones, and what had to be done for it.
    #[inline]
    pub(crate) fn cut(
        &self,
        planned: &SVector<f64, N>,
        compensation: &SVector<f64, N>,
        law: Law,
    ) -> (SVector<f64, N>, Status) {
        let exceeds = |torque: &SVector<f64, N>, i: usize| {
            torque[i].abs() > self.rated_torque[i] * (1.0 + LIMIT_TOLERANCE)
        };
        let wanted = planned + compensation;
        let mut status = Status::Nominal;
        for i in self.locked.healthy() {
            if exceeds(&wanted, i) {
                status = status.max(if exceeds(planned, i) {
                    Status::Overloaded
                } else {
                    Status::Saturated
                });
            }
        }
        let torque = match (status, law) {
            (Status::Nominal, _) | (_, Law::PerJoint) => wanted,
            (_, Law::Projected | Law::Optimal) => match self.scale(planned, compensation) {
                Some(scale) => {
                    status = Status::Saturated;
                    planned + compensation * scale
                }
                None => {
                    status = Status::Overloaded;
                    *planned
                }
            },
        };
        let within = SVector::from_fn(|i, _| {
            if self.locked.contains(i) {
                torque[i]
            } else {
                let rated = self.rated_torque[i];
                torque[i].max(-rated).min(rated)
            }
        });
        (within, status)
    }

    /// The largest s in 0 to 1 with `|planned + s compensation|` within the rated torques, if there is one.
    fn scale(&self, planned: &SVector<f64, N>, compensation: &SVector<f64, N>) -> Option<f64> {
        let (mut least, mut most) = (0.0_f64, 1.0_f64);
        for i in self.locked.healthy() {
            let (rated, planned, slope) = (self.rated_torque[i], planned[i], compensation[i]);
            if slope == 0.0 {
                if planned.abs() > rated {
                    return None;
                }
                continue;
            }
            let towards = rated.copysign(slope);
            least = least.max((-towards - planned) / slope);
            most = most.min((towards - planned) / slope);
        }
        (least <= most).then_some(most)
    }
}

/// What one control cycle gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle<const N: usize> {
    /// τ, N·m (N): what motors give, and for a locked joint what its brake bears.
    pub torque: SVector<f64, N>,
    /// `ID + Jᵀ F_e`: τ without compensation, N·m (N).
    pub planned: SVector<f64, N>,
    /// U as it acts, after all cuts: `torque − planned`, N·m (N).
    pub compensation: SVector<f64, N>,
    /// h of Eq. 13, `(Jᵀ)† U`: the static tool wrench realised minus the one asked for, N and N·m; 0 outside the task.
    pub force_error: Vector6<f64>,
    /// −g of Eq. 14, taken on both sides: `τ_rated − |τ|`, N·m (N).
    pub margins: SVector<f64, N>,
    /// [`NullSpace::conditioning`] of the moving joints' J, 0 to 1.
    pub conditioning: f64,
    /// How it went.
    pub status: Status,
}

/// The suppression controller of one arm: constant data, and a [`cycle`](Self::cycle) without allocation in bounded time.
#[derive(Clone, Copy, Debug)]
pub struct Controller<'a, A, const N: usize> {
    arm: &'a A,
    compensation: Compensation<N>,
    projector: Projector,
    rated_torque: SVector<f64, N>,
}

impl<'a, A: Arm<N>, const N: usize> Controller<'a, A, N> {
    /// A controller with the static projector and the arm's own rated torques.
    pub fn new(arm: &'a A, compensation: Compensation<N>) -> Self {
        Self {
            arm,
            compensation,
            projector: Projector::Static,
            rated_torque: arm.rated_torque(),
        }
    }

    /// The same with another projector.
    #[must_use]
    pub fn with_projector(mut self, projector: Projector) -> Self {
        self.projector = projector;
        self
    }

    /// The same with other rated torques, N·m (N). One that is negative or no number counts as 0.
    #[must_use]
    pub fn with_rated_torque(mut self, rated_torque: SVector<f64, N>) -> Self {
        self.rated_torque = rated_torque.map(|rated| rated.max(0.0));
        self
    }

    /// One control cycle: the torques for `state`, measured or planned, of an arm whose tool is to exert `wrench`
    /// (`[f; n]`, world axes, at the tool point) and whose `locked` joints stand still whatever `state` says.
    ///
    /// Where the compensation would break Eq. 14, [`Compensation::PerJoint`] is cut joint by joint, as its coefficients are;
    /// the other two are scaled as a whole, so that the tool force stays as it is, and left out if no scale will do.
    /// A locked joint's torque is its brake's and is never cut.
    #[inline]
    pub fn cycle(
        &self,
        state: &JointState<N>,
        wrench: &Vector6<f64>,
        locked: LockedJoints<N>,
    ) -> Cycle<N> {
        let state = locked.hold(state);
        let pose = TaskPose::new(self.arm, &state.q, locked, self.projector);
        let planned = self.arm.inverse_dynamics(&state.q, &state.qd, &state.qdd)
            + pose.jacobian.tr_mul(wrench);
        let conditioning = pose.null_space.conditioning();
        let limits = Limits {
            rated_torque: self.rated_torque,
            locked,
        };
        let wanted = pose.compensation(&self.compensation);
        let (torque, cut) = limits.cut(&planned, &wanted, self.compensation.law());
        let compensation = torque - planned;
        let force_error = pose.null_space.static_wrench(&compensation);
        let singular = if conditioning < NEAR_SINGULAR {
            Status::NearSingular
        } else {
            Status::Nominal
        };
        let finite = state.is_finite()
            && torque.iter().chain(&planned).all(|x| x.is_finite())
            && wrench.iter().chain(&force_error).all(|x| x.is_finite());
        if !finite {
            return self.nothing();
        }
        Cycle {
            torque,
            planned,
            compensation,
            force_error,
            margins: self.rated_torque - torque.abs(),
            conditioning,
            status: cut.max(singular),
        }
    }

    fn nothing(&self) -> Cycle<N> {
        Cycle {
            torque: SVector::zeros(),
            planned: SVector::zeros(),
            compensation: SVector::zeros(),
            force_error: Vector6::zeros(),
            margins: self.rated_torque,
            conditioning: 0.0,
            status: Status::NotFinite,
        }
    }
}
