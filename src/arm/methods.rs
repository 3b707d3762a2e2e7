//! The table of methods: what [`Arm`](crate::Arm) computes, a row each.
//!
//! Everything that repeats over methods follows from it: the traits [`Arm`](crate::Arm), [`Unrolled`](crate::Unrolled) and
//! [`ArmBatch`](crate::ArmBatch), what makes an arm of kernels, the comparison in [`proof`](crate::proof), the generator's
//! interpreter, the counts, the benches, and the tests that run through all methods.
//!
//! A new method is a row here; its textbook formula in `generic`; its formula for few operations in `ulna_codegen::formulate`,
//! which does not compile without one; and numbers from outside in the tests. A kind of quantity that none of the
//! others is compared like needs a rule in [`proof`](crate::proof) besides.

/// Hands the table to a macro: `methods! { [N] callback! {context} }` becomes `callback! { [context] rows }`.
/// `N` is what stands for the number of joints in the rows' types: a parameter's name or a number.
///
/// A row is
///
/// ```text
/// /// What the method returns, with equation, shape and units.
/// Variant = method(arguments) -> type
/// { kernel "What the generated function returns." name -> type on scalars R, zero from part }
/// { batch name from width }
/// { error rule }
/// { default |arm| expression }
/// ```
///
/// - An argument is one of those of [`Argument`].
/// - A kernel's matrix is an array of its columns. `zero from k`, for methods of a task: the kernel returns det(JJᵀ) over the
///   task's rows after all else, and where [that counts as 0](crate::arm::singular) the parts of the result from k on are 0.
/// - A batch runs in lanes where a register holds `width` doubles or more: measured, see [`ArmBatch`](crate::ArmBatch).
/// - The rule tells how large an error may be; it is a method of the judge in [`proof`](crate::proof).
/// - The default, which most rows have not, makes the result of other methods'.
#[doc(hidden)]
#[macro_export]
macro_rules! methods {
    ([$n:tt] $callback:path { $($context:tt)* }) => {
        $callback! {
            [$($context)*]

            /// Pose of the tool, `world_from_tool`.
            ForwardKinematics = forward_kinematics(q) -> $crate::nalgebra::IsometryMatrix3<f64>
            { kernel "`world_from_tool`: the rotation's columns, and the translation in m."
              forward_kinematics_kernel -> ([[R; 3]; 3], [R; 3]) }
            { batch forward_kinematics_batch from 2 }
            { error pose }

            /// Where the links are: `world_from_link_i`, one pose for each link, base first; frame i is that of modified DH, whose z is joint i's axis.
            LinkPoses = link_poses(q) -> [$crate::nalgebra::IsometryMatrix3<f64>; $n]
            { kernel "`world_from_link_i` for each i: the rotation's columns, then the translation in m."
              link_poses_kernel -> [[[R; 3]; 4]; $n] }
            { batch link_poses_batch from 4 }
            { error poses }

            /// Geometric Jacobian J, 6×N: `[v; ω] = J q̇`. All six rows, whatever the task.
            GeometricJacobian = geometric_jacobian(q) -> $crate::nalgebra::SMatrix<f64, 6, $n>
            { kernel "Geometric Jacobian, 6×N: columns `[v; ω]` in world axes, at the tool point."
              geometric_jacobian_kernel -> [[R; 6]; $n] }
            { batch geometric_jacobian_batch from 2 }
            { error twists }

            /// Geometric Jacobian of each link at the origin of its frame, 6×N in world axes: `[v_i; ω_i] = J_i q̇`. Columns of joints beyond the link are 0.
            LinkJacobians = link_jacobians(q) -> [$crate::nalgebra::SMatrix<f64, 6, $n>; $n]
            { kernel "Geometric Jacobian of link i at its frame's origin, 6×N for each i: columns `[v; ω]` in world axes."
              link_jacobians_kernel -> [[[R; 6]; $n]; $n] }
            { batch link_jacobians_batch from 4 }
            { error twists_of_links }

            /// ∂J/∂q_i, one 6×N matrix for each i.
            JacobianDerivatives = jacobian_derivatives(q) -> [$crate::nalgebra::SMatrix<f64, 6, $n>; $n]
            { kernel "∂J/∂q_i, 6×N for each i: columns `[v; ω]` in world axes, at the tool point."
              jacobian_derivatives_kernel -> [[[R; 6]; $n]; $n] }
            { batch jacobian_derivatives_batch from 4 }
            { error twist_derivatives }

            /// J̇, 6×N: the rate of the geometric Jacobian while the joints move, at the tool point, which moves with them.
            JacobianRate = jacobian_rate(q, qd) -> $crate::nalgebra::SMatrix<f64, 6, $n>
            { kernel "J̇, 6×N: columns `[v̇; ω̇]` in world axes, at the tool point."
              jacobian_rate_kernel -> [[R; 6]; $n] }
            { batch jacobian_rate_batch from 2 }
            { error twist_rates }

            /// `J̇ q̇`: the tool's acceleration `[v̇; ω̇]` while the joints move at constant rates, m/s² and rad/s², world axes.
            BiasAcceleration = bias_acceleration(q, qd) -> $crate::nalgebra::Vector6<f64>
            { kernel "`J̇ q̇`: `[v̇; ω̇]` in world axes, at the tool point, m/s² and rad/s²."
              bias_acceleration_kernel -> [R; 6] }
            { batch bias_acceleration_batch from 2 }
            { error twist_of_rates }

            /// Centre of mass of all links, m, in world axes from the world's origin.
            CenterOfMass = center_of_mass(q) -> $crate::nalgebra::Vector3<f64>
            { kernel "Centre of mass of all links, m, in world axes from the world's origin."
              center_of_mass_kernel -> [R; 3] }
            { batch center_of_mass_batch from 2 }
            { error centroid }

            /// Mass matrix M of `τ = M q̈ + c(q, q̇) + g(q)`, N×N, full and symmetric, kg·m²: that of the links, and on its diagonal what the
            /// [rotors](crate::Motor) behind their gears add.
            MassMatrix = mass_matrix(q) -> $crate::nalgebra::SMatrix<f64, $n, $n>
            { kernel "Mass matrix, N×N, kg·m²."
              mass_matrix_kernel -> [[R; $n]; $n] }
            { batch mass_matrix_batch from 2 }
            { error masses }

            /// ∂M/∂q_i, one N×N matrix for each i.
            MassMatrixDerivatives = mass_matrix_derivatives(q) -> [$crate::nalgebra::SMatrix<f64, $n, $n>; $n]
            { kernel "∂M/∂q_i, N×N for each i, kg·m²/rad."
              mass_matrix_derivatives_kernel -> [[[R; $n]; $n]; $n] }
            { batch mass_matrix_derivatives_batch from 4 }
            { error mass_derivatives }

            /// Inverse mass matrix M⁻¹, N×N, full and symmetric, 1/(kg·m²): `q̈ = M⁻¹ τ` at rest and without gravity.
            InverseMassMatrix = inverse_mass_matrix(q) -> $crate::nalgebra::SMatrix<f64, $n, $n>
            { kernel "Inverse mass matrix, N×N, 1/(kg·m²)."
              inverse_mass_matrix_kernel -> [[R; $n]; $n] }
            { batch inverse_mass_matrix_batch from 2 }
            { error inverse_masses }

            /// Coriolis matrix C, N×N, of Christoffel's symbols, kg·m²/s: the bias force is `C q̇ + g`, and `Ṁ = C + Cᵀ`, so that
            /// `Ṁ − 2C` is skew-symmetric.
            CoriolisMatrix = coriolis_matrix(q, qd) -> $crate::nalgebra::SMatrix<f64, $n, $n>
            { kernel "Coriolis matrix of Christoffel's symbols, N×N, kg·m²/s."
              coriolis_matrix_kernel -> [[R; $n]; $n] }
            { batch coriolis_matrix_batch from 2 }
            { error masses_at_rates }

            /// Kinetic energy `½ q̇ᵀ M q̇`, J.
            KineticEnergy = kinetic_energy(q, qd) -> f64
            { kernel "Kinetic energy, J."
              kinetic_energy_kernel -> R }
            { batch kinetic_energy_batch from 2 }
            { error energy_of_motion }

            /// Potential energy `−Σ m_i gᵀ p_i` of the links in gravity, J; p_i are their centroids from the world's origin, where it is 0.
            PotentialEnergy = potential_energy(q) -> f64
            { kernel "Potential energy, J: 0 at the world's origin."
              potential_energy_kernel -> R }
            { batch potential_energy_batch from 2 }
            { error energy_of_position }

            /// Inverse dynamics τ = M q̈ + c(q, q̇) + g(q) + f(q̇), N·m, f the joints' friction; without a tool wrench.
            InverseDynamics = inverse_dynamics(q, qd, qdd) -> $crate::nalgebra::SVector<f64, $n>
            { kernel "Joint torques, N·m, for the accelerations `qdd`."
              inverse_dynamics_kernel -> [R; $n] }
            { batch inverse_dynamics_batch from 2 }
            { error torques }

            /// Inverse dynamics with a wrench: τ = M q̈ + c(q, q̇) + g(q) + f(q̇) − Jᵀ F, N·m.
            ///
            /// F = `[f; n]` is what the environment exerts on the tool, at the tool point, in world axes, N and N·m.
            InverseDynamicsWithWrench = inverse_dynamics_with_wrench(q, qd, qdd, wrench) -> $crate::nalgebra::SVector<f64, $n>
            { kernel "Joint torques, N·m, for the accelerations `qdd` under the wrench `[f; n]` on the tool, in world axes at the tool point."
              inverse_dynamics_with_wrench_kernel -> [R; $n] }
            { batch inverse_dynamics_with_wrench_batch from 2 }
            { error torques_with_wrench }

            /// Bias force c(q, q̇) + g(q): the inverse dynamics at q̈ = 0, without friction.
            BiasForce = bias_force(q, qd) -> $crate::nalgebra::SVector<f64, $n>
            { kernel "Joint torques, N·m, at zero acceleration."
              bias_force_kernel -> [R; $n] }
            { batch bias_force_batch from 2 }
            { error torques_unaccelerated }

            /// Gravity torque g(q): the inverse dynamics at q̇ = 0, q̈ = 0.
            GravityTorque = gravity_torque(q) -> $crate::nalgebra::SVector<f64, $n>
            { kernel "Joint torques, N·m, at rest."
              gravity_torque_kernel -> [R; $n] }
            { batch gravity_torque_batch from 2 }
            { error torques_at_rest }

            /// Friction torque f(q̇), N·m: `viscous · q̇_i + coulomb · q̇_i / √(q̇_i² + smoothing²)` of each joint's [`Friction`](crate::Friction).
            ///
            /// Inverse and forward dynamics have it in them, and nothing else has.
            FrictionTorque = friction_torque(qd) -> $crate::nalgebra::SVector<f64, $n>
            { kernel "Joint torques, N·m, that friction takes at the rates `qd`."
              friction_torque_kernel -> [R; $n] }
            { batch friction_torque_batch from 2 }
            { error frictions }

            /// Forward dynamics q̈ = M⁻¹(τ − c(q, q̇) − g(q) − f(q̇)), f the joints' friction; without a tool wrench.
            ForwardDynamics = forward_dynamics(q, qd, tau) -> $crate::nalgebra::SVector<f64, $n>
            { kernel "Joint accelerations, rad/s², under the torques `tau`."
              forward_dynamics_kernel -> [R; $n] }
            { batch forward_dynamics_batch from 2 }
            { error accelerations }

            /// Forward dynamics with a wrench: q̈ = M⁻¹(τ + Jᵀ F − c(q, q̇) − g(q) − f(q̇)).
            ///
            /// F = `[f; n]` is what the environment exerts on the tool, at the tool point, in world axes, N and N·m.
            ForwardDynamicsWithWrench = forward_dynamics_with_wrench(q, qd, tau, wrench) -> $crate::nalgebra::SVector<f64, $n>
            { kernel "Joint accelerations, rad/s², under the torques `tau` and the wrench `[f; n]` on the tool, in world axes at the tool point."
              forward_dynamics_with_wrench_kernel -> [R; $n] }
            { batch forward_dynamics_with_wrench_batch from 2 }
            { error accelerations_with_wrench }

            /// ∂τ/∂q and ∂τ/∂q̇ of the inverse dynamics, N×N each, N·m/rad and N·m·s/rad: entry (i, j) is ∂τ_i/∂q_j. ∂τ/∂q̈ is M.
            InverseDynamicsDerivatives = inverse_dynamics_derivatives(q, qd, qdd)
                -> ($crate::nalgebra::SMatrix<f64, $n, $n>, $crate::nalgebra::SMatrix<f64, $n, $n>)
            { kernel "∂τ/∂q and ∂τ/∂q̇, N×N, N·m/rad and N·m·s/rad, for the accelerations `qdd`: column j of each is the derivative by joint j."
              inverse_dynamics_derivatives_kernel -> ([[R; $n]; $n], [[R; $n]; $n]) }
            { batch inverse_dynamics_derivatives_batch from 2 }
            { error torque_derivatives }

            /// ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ of the forward dynamics, N×N each: entry (i, j) is ∂q̈_i/∂q_j. The last is M⁻¹,
            /// the others are −M⁻¹ ∂τ/∂q and −M⁻¹ ∂τ/∂q̇ at q̈ = FD(q, q̇, τ) (Carpentier and Mansard, RSS 2018).
            ForwardDynamicsDerivatives = forward_dynamics_derivatives(q, qd, tau)
                -> ($crate::nalgebra::SMatrix<f64, $n, $n>, $crate::nalgebra::SMatrix<f64, $n, $n>, $crate::nalgebra::SMatrix<f64, $n, $n>)
            { kernel "∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ, N×N, 1/s², 1/s and 1/(kg·m²), under the torques `tau`: column j of each is the derivative by joint j."
              forward_dynamics_derivatives_kernel -> ([[R; $n]; $n], [[R; $n]; $n], [[R; $n]; $n]) }
            { batch forward_dynamics_derivatives_batch from 2 }
            { error acceleration_derivatives }

            /// Regressor Y of the inverse dynamics: `τ = Σ_i Y_i π_i`, an N×10 block for each link i, π_i its inertial
            /// [parameters](crate::Parameter) about the origin of its frame (modified DH): m, m·c (x, y, z), then the inertia xx, xy, xz, yy, yz, zz.
            ///
            /// Links alone: what motors, friction or a payload add to the torque is no part of Y π. Block i is 0 in rows j > i,
            /// and no block depends on any link's parameters. (Atkeson, An and Hollerbach 1986; Khalil and Dombre, section 9.3.)
            Regressor = regressor(q, qd, qdd) -> [$crate::nalgebra::SMatrix<f64, $n, 10>; $n]
            { kernel "Regressor, N×10 for each link: torques, N·m, of its unit parameters m, m·c (x, y, z), I (xx, xy, xz, yy, yz, zz)."
              regressor_kernel -> [[[R; $n]; 10]; $n] }
            { batch regressor_batch from 4 }
            { error regressor }

            /// The columns of the base (minimal) parameters as they are in [`Arm::regressor`](crate::Arm::regressor), and 0 in all others:
            /// as many columns as Y stacked over all motions has independent ones.
            ///
            /// A base parameter is a standard parameter with multiples of others grouped into it, so its column is that of Y.
            /// Which parameters they are follows from the arm's geometry and gravity ([`Parameter::BASE_ORDER`](crate::Parameter::BASE_ORDER) tells the choice);
            /// generated types list them as `BASE_PARAMETERS`, and `ulna cost --base-parameters` prints what is grouped into each.
            /// (Gautier and Khalil 1990; Gautier 1991.)
            BaseRegressor = base_regressor(q, qd, qdd) -> [$crate::nalgebra::SMatrix<f64, $n, 10>; $n]
            { kernel "The regressor's columns of base parameters, N×10 for each link; all others are 0."
              base_regressor_kernel -> [[[R; $n]; 10]; $n] }
            { batch base_regressor_batch from 4 }
            { error base_regressor }

            /// Joint impact torques Δτ of a lock, N·m, before minus after (Eq. 1–12): column k holds those of all joints
            /// if joint k alone stopped dead now, `Δτ = τ(q, q̇, q̈) − τ(q, q̇ − q̇_k e_k, q̈ − q̈_k e_k)` with τ the inverse dynamics.
            ///
            /// N×N, without a change of the tool wrench. The column of a joint at rest is exactly 0. Of any set of joints that lock at once
            /// it is [`impact_torque`](crate::control::failure::impact_torque) that knows.
            LockImpacts = lock_impacts(q, qd, qdd) -> $crate::nalgebra::SMatrix<f64, $n, $n>
            { kernel "Joint impact torques, N×N, N·m: column k if joint k locks, before minus after."
              lock_impacts_kernel -> [[R; $n]; $n] }
            { batch lock_impacts_batch from 2 }
            { error lock_impacts }

            /// Dynamic manipulability `w_D = √det((JM⁻¹)(JM⁻¹)ᵀ)` over the task's rows of J (Eq. 15).
            DynamicManipulability = dynamic_manipulability(q) -> f64
            { kernel "w_D over the task's rows of J (Eq. 15), and det(JJᵀ) over them."
              dynamic_manipulability_kernel -> (R, R), zero from 0 }
            { batch dynamic_manipulability_batch from 2 }
            { error manipulability }

            /// w_D and its gradient ∇w_D (Eq. 22–27).
            ///
            /// Where w_D is 0, Eq. 23 has no value; the gradient returned there is the zero vector. [`crate::arm::singular`] says where that is.
            DynamicManipulabilityGradient = dynamic_manipulability_gradient(q) -> (f64, $crate::nalgebra::SVector<f64, $n>)
            { kernel "w_D, ∇w_D (Eq. 22–27), and det(JJᵀ) over the task's rows."
              dynamic_manipulability_gradient_kernel -> (R, [R; $n], R), zero from 0 }
            { batch dynamic_manipulability_gradient_batch from 2 }
            { error gradient }

            /// Kinematic manipulability `w = √det(JJᵀ)` over the task's rows of J and its gradient ∇w (Yoshikawa 1985).
            ///
            /// Where the task is [singular](crate::arm::singular), w is 0 and the gradient returned is the zero vector.
            ManipulabilityGradient = manipulability_gradient(q) -> (f64, $crate::nalgebra::SVector<f64, $n>)
            { kernel "w = √det(JJᵀ) over the task's rows, ∇w, and det(JJᵀ)."
              manipulability_gradient_kernel -> (R, [R; $n], R), zero from 0 }
            { batch manipulability_gradient_batch from 2 }
            { error kinematic_gradient }

            /// Task-space inertia `Λ = (J M⁻¹ Jᵀ)⁻¹` over the task's rows (Khatib 1987), kg for rows of v and kg·m² for rows of ω.
            ///
            /// Rows and columns outside the task are 0. Where the task is [singular](crate::arm::singular), all of it is.
            TaskSpaceInertia = task_space_inertia(q) -> $crate::nalgebra::Matrix6<f64>
            { kernel "Λ, 6×6, kg to kg·m², 0 outside the task's rows and columns, and det(JJᵀ) over the task's rows."
              task_space_inertia_kernel -> ([[R; 6]; 6], R), zero from 0 }
            { batch task_space_inertia_batch from 2 }
            { error task_inertia }

            /// Dynamically consistent inverse `J̄ = M⁻¹ Jᵀ Λ` of the task's rows of J (Khatib 1987), N×6: of all joint motions with a given
            /// tool velocity, the one of least kinetic energy; `J̄ᵀ` takes joint torques to the tool force that they make.
            ///
            /// Columns outside the task are 0. Where the task is [singular](crate::arm::singular), all of it is.
            DynamicallyConsistentInverse = dynamically_consistent_inverse(q) -> $crate::nalgebra::SMatrix<f64, $n, 6>
            { kernel "J̄, N×6, 0 outside the task's columns, and det(JJᵀ) over the task's rows."
              dynamically_consistent_inverse_kernel -> ([[R; $n]; 6], R), zero from 0 }
            { batch dynamically_consistent_inverse_batch from 2 }
            { error task_inverse }

            /// M and all ∂M/∂q_i in one call.
            MassMatrixAndDerivatives = mass_matrix_and_derivatives(q)
                -> ($crate::nalgebra::SMatrix<f64, $n, $n>, [$crate::nalgebra::SMatrix<f64, $n, $n>; $n])
            { kernel "Mass matrix, N×N, kg·m², and ∂M/∂q_i, N×N for each i, kg·m²/rad."
              mass_matrix_and_derivatives_kernel -> ([[R; $n]; $n], [[[R; $n]; $n]; $n]) }
            { batch mass_matrix_and_derivatives_batch from 4 }
            { error masses_and_derivatives }
            { default |arm| (arm.mass_matrix(q), arm.mass_matrix_derivatives(q)) }

            /// J (six rows), w_D and ∇w_D in one call: what a cycle of the suppression controller needs.
            JacobianAndGradient = jacobian_and_gradient(q)
                -> ($crate::nalgebra::SMatrix<f64, 6, $n>, f64, $crate::nalgebra::SVector<f64, $n>)
            { kernel "Geometric Jacobian, w_D, ∇w_D, and det(JJᵀ) over the task's rows."
              jacobian_and_gradient_kernel -> ([[R; 6]; $n], R, [R; $n], R), zero from 1 }
            { batch jacobian_and_gradient_batch from 2 }
            { error twists_and_gradient }
            { default |arm| {
                let (w, gradient) = arm.dynamic_manipulability_gradient(q);
                (arm.geometric_jacobian(q), w, gradient)
            } }
        }
    };
}

/// An argument of a method: a vector of N numbers, one for each joint, but for the wrench.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Argument {
    /// Joint coordinates, rad (m).
    Q,
    /// Their rates, rad/s (m/s).
    Qd,
    /// Their accelerations, rad/s² (m/s²).
    Qdd,
    /// Joint torques, N·m (N).
    Tau,
    /// Wrench `[f; n]` on the tool, N and N·m: six numbers.
    Wrench,
}

impl Argument {
    /// Every argument that there is.
    pub const ALL: [Self; 5] = [Self::Q, Self::Qd, Self::Qdd, Self::Tau, Self::Wrench];

    /// How many numbers it has, of an arm of `joints` joints.
    pub const fn length(self, joints: usize) -> usize {
        match self {
            Self::Q | Self::Qd | Self::Qdd | Self::Tau => joints,
            Self::Wrench => 6,
        }
    }

    /// What it is called: `q`, `qd`, `qdd`, `tau`, `wrench`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Q => "q",
            Self::Qd => "qd",
            Self::Qdd => "qdd",
            Self::Tau => "tau",
            Self::Wrench => "wrench",
        }
    }
}

macro_rules! argument {
    (q) => {
        Argument::Q
    };
    (qd) => {
        Argument::Qd
    };
    (qdd) => {
        Argument::Qdd
    };
    (tau) => {
        Argument::Tau
    };
    (wrench) => {
        Argument::Wrench
    };
}

/// The type of a row's argument: `argument_type!([N] q)` as methods of [`Arm`](crate::Arm) take it, `argument_type!([R; N] q)` as kernels do.
#[doc(hidden)]
#[macro_export]
macro_rules! argument_type {
    ([$n:tt] wrench) => {
        $crate::nalgebra::Vector6<f64>
    };
    ([$n:tt] $argument:ident) => {
        $crate::nalgebra::SVector<f64, $n>
    };
    ([$scalar:ty; $n:tt] wrench) => {
        [$scalar; 6]
    };
    ([$scalar:ty; $n:tt] $argument:ident) => {
        [$scalar; $n]
    };
}

macro_rules! define_method {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        { kernel $returns:literal $kernel:ident -> $returned:ty $(, zero from $zero:literal)? }
        $({ $($rest:tt)* })*
    )+) => {
        /// A method of [`Arm`](crate::Arm) that computes something.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Method {
            $(
                #[doc = concat!("[`Arm::", stringify!($method), "`](crate::Arm::", stringify!($method), ").")]
                $variant,
            )+
        }

        impl Method {
            /// Every method, in the order of the trait.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Its name in the trait [`Arm`](crate::Arm).
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($method),)+
                }
            }

            /// Its arguments, in order.
            pub const fn arguments(self) -> &'static [Argument] {
                match self {
                    $(Self::$variant => &[$(argument!($argument)),+],)+
                }
            }

            /// The name of its kernel in the trait [`Unrolled`](crate::Unrolled).
            pub const fn kernel(self) -> &'static str {
                match self {
                    $(Self::$variant => stringify!($kernel),)+
                }
            }

            /// What its kernel returns, in a sentence.
            pub const fn returns(self) -> &'static str {
                match self {
                    $(Self::$variant => $returns,)+
                }
            }

            /// The first part of its result that is 0 where the task is singular; none for what has no w_D in it.
            pub const fn zero_where_singular(self) -> Option<usize> {
                match self {
                    $(Self::$variant => first_of!([$($zero)?]),)+
                }
            }
        }
    };
}

macro_rules! first_of {
    ([]) => {
        None
    };
    ([$first:literal]) => {
        Some($first)
    };
}

crate::methods! { [N] define_method {} }

impl core::fmt::Display for Method {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.pad(self.name())
    }
}
