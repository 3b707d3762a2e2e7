//! What every implementation of [`Arm`] must do, whatever it is made of.
//!
//! A check takes the arm and its chain; the chain serves as the arm's description only
//! (kinds, lengths, masses, task), never for its formulas. A backend's module is one line:
//! `conformance!(arm, chain);`.

mod differences;
mod exponentials;

pub(crate) mod coriolis;
pub(crate) mod drives;
pub(crate) mod dynamics;
pub(crate) mod dynamics_derivatives;
pub(crate) mod kinematics;
pub(crate) mod lock;
pub(crate) mod manipulability;
pub(crate) mod mass_matrix;
pub(crate) mod motion;
pub(crate) mod regressor;
pub(crate) mod task_space;
pub(crate) mod totality;

use ulna::SerialChain;
use ulna::proof::{State, states};

/// One test for each check.
macro_rules! conformance {
    ($arm:expr, $chain:expr) => {
        crate::suite::conformance! { $arm, $chain;
            kinematics::jacobian_is_the_derivative_of_the_kinematics
            kinematics::jacobian_derivatives_agree_with_differences
            kinematics::kinematics_agree_with_exponentials
            kinematics::jacobian_derivatives_agree_with_dual_numbers
            mass_matrix::mass_matrix_is_symmetric_positive_definite
            mass_matrix::mass_matrix_does_not_depend_on_the_first_joint
            mass_matrix::mass_matrix_derivatives_agree_with_differences
            mass_matrix::mass_matrix_agrees_with_exponentials
            mass_matrix::mass_matrix_derivatives_agree_with_dual_numbers
            dynamics::mass_matrix_has_the_columns_of_inverse_dynamics
            dynamics::gravity_torque_is_the_slope_of_the_potential
            dynamics::velocity_products_follow_from_the_mass_matrix
            dynamics::energy_is_conserved
            dynamics::forward_dynamics_undo_inverse_dynamics
            dynamics::a_wrench_does_the_work_of_the_tool
            drives::rotors_add_to_the_diagonal_of_the_mass_matrix
            drives::friction_is_its_closed_form
            drives::friction_has_its_slope
            drives::nothing_else_sees_rotors_and_friction
            lock::lock_impacts_are_those_of_the_papers_recursion
            lock::lock_impacts_are_differences_of_inverse_dynamics
            lock::a_lock_of_a_joint_at_rest_changes_nothing
            lock::lock_impacts_have_the_parts_of_inverse_dynamics
            dynamics_derivatives::torque_derivatives_agree_with_differences
            dynamics_derivatives::torque_derivatives_agree_with_exponentials
            dynamics_derivatives::torque_derivatives_at_rest_are_those_of_the_mass_matrix_and_of_gravity
            dynamics_derivatives::torque_derivatives_by_rates_are_twice_the_coriolis_matrix
            dynamics_derivatives::acceleration_derivatives_agree_with_differences
            dynamics_derivatives::acceleration_derivatives_undo_torque_derivatives
            manipulability::manipulability_is_that_of_its_own_jacobian_and_mass_matrix
            manipulability::manipulability_gradient_agrees_with_differences
            manipulability::manipulability_agrees_with_dual_numbers
            manipulability::manipulability_ignores_a_turn_of_the_whole_task
            regressor::regressor_times_parameters_is_the_torque
            regressor::regressor_has_the_mass_matrix_in_it
            regressor::regressor_is_zero_below_its_link
            regressor::base_columns_are_those_of_the_regressor_and_are_independent
            regressor::base_columns_are_enough_for_every_torque
            coriolis::the_coriolis_matrix_makes_the_bias_force
            coriolis::the_coriolis_matrix_is_of_christoffels_symbols
            motion::the_last_link_carries_the_tool
            motion::link_jacobians_are_the_derivatives_of_link_poses
            motion::the_centre_of_mass_is_the_mean_of_the_links
            motion::rates_follow_from_the_jacobians_derivatives
            motion::torques_do_the_work_that_energy_gains
            task_space::task_space_inertia_undoes_the_mobility_of_the_tool
            task_space::kinematic_manipulability_is_that_of_its_own_jacobian
            totality::single_and_combined_methods_agree
            totality::any_finite_configuration_gives_numbers
            totality::a_full_turn_changes_nothing
        }
    };
    ($arm:expr, $chain:expr; $($about:ident::$check:ident)*) => {
        $(
            #[test]
            fn $check() {
                crate::suite::$about::$check(&$arm, &$chain);
            }
        )*
    };
}
pub(crate) use conformance;

fn at_states<const N: usize>(chain: &SerialChain<N>, check: impl FnMut(State<N>)) {
    states(chain).take(6).for_each(check);
}

/// Fails where two quantities differ by more than `tolerance` times the expected one's largest entry, or `scale` if that is larger.
#[track_caller]
fn near<'a>(
    actual: impl IntoIterator<Item = &'a f64>,
    expected: impl IntoIterator<Item = &'a f64>,
    scale: f64,
    tolerance: f64,
    what: &str,
) {
    let pairs: Vec<_> = actual.into_iter().zip(expected).collect();
    let largest = pairs.iter().fold(scale, |max, (_, e)| max.max(e.abs()));
    for (index, (actual, expected)) in pairs.into_iter().enumerate() {
        let error = (actual - expected).abs() / largest;
        assert!(
            error <= tolerance || actual == expected,
            "{what}, entry {index}: {actual:e} for {expected:e}, {error:.1e} of the largest"
        );
    }
}
