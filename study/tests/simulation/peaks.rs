//! Peaks are those of the continuous motion: what samples, however fine, tend to.

use ulna::nalgebra::SVector;
use ulna_study::simulation::{Brake, BrakeProfile, Control, Feedback, Impact, Resolution};

use crate::{
    Compensation, Failing, cancelling, lock, oblique, oblique_motion, ssrms, ssrms_motion,
};

/// The peaks of the run, and the largest torques and brake torques in samples so far apart.
fn peaks<A: ulna::Arm<N>, const N: usize>(
    simulation: &Failing<'_, A, N>,
    after: f64,
    sample_period: f64,
) -> (Impact<N>, [SVector<f64, N>; 2]) {
    let resolution = Resolution {
        sample_period,
        ..Resolution::default()
    };
    let mut largest = [SVector::<f64, N>::zeros(); 2];
    let time = simulation.brake.failure.time;
    let mut failed = false;
    let outcome = simulation
        .run(time - 0.05..time + after, &resolution, |sample| {
            // Of the two samples at the failure the second counts.
            if sample.elapsed > 0.0 || failed {
                let braking = sample.elapsed <= simulation.brake.duration;
                let brake = if braking {
                    sample.brake
                } else {
                    SVector::zeros()
                };
                largest[0] = largest[0].sup(&sample.joint_torque().abs());
                largest[1] = largest[1].sup(&brake.abs());
            }
            failed = failed || sample.elapsed == 0.0;
        })
        .unwrap();
    (outcome.impact.unwrap(), largest)
}

/// Samples can only be below, and fine ones by next to nothing; coarse ones are not where the peaks come from.
fn assert_peaks<A: ulna::Arm<N>, const N: usize>(
    simulation: &Failing<'_, A, N>,
    after: f64,
    what: &str,
) {
    let (fine, sampled) = peaks(simulation, after, 2e-4);
    let (coarse, _) = peaks(simulation, after, 1.0);
    for (found, sampled) in [
        (fine.peak_torque, sampled[0]),
        (fine.peak_brake_torque, sampled[1]),
    ] {
        for joint in 0..N {
            let (found, sampled) = (found[joint], sampled[joint]);
            assert!(
                found >= sampled * (1.0 - 1e-9) && found <= sampled * (1.0 + 2e-4) + 1e-7,
                "{what}, joint {joint}: {found} {sampled}"
            );
        }
    }
    for (fine, coarse) in [
        (fine.peak_torque, coarse.peak_torque),
        (fine.peak_brake_torque, coarse.peak_brake_torque),
    ] {
        for joint in 0..N {
            let off = (fine[joint] - coarse[joint]).abs();
            assert!(
                off <= 1e-6 * fine[joint] + 1e-7,
                "{what}, joint {joint}: {} {}",
                fine[joint],
                coarse[joint]
            );
        }
    }
}

/// Under sampled control torques jump at the cycles, which no sample needs to meet.
#[test]
fn peaks_under_a_sampled_control() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, Compensation::none(), 0.1);
    simulation.feedback = Feedback::critical(5.0);
    simulation.control = Control::Every(0.013);
    simulation.reflected_inertia = SVector::repeat(200.0);
    assert_peaks(&simulation, 0.2, "constant brake");
    simulation.brake.profile = BrakeProfile::Smooth;
    simulation.brake.detection = 0.03;
    assert_peaks(&simulation, 0.2, "smooth brake");
}

/// A smooth brake's torque is largest in between, and nothing jumps there.
#[test]
fn peaks_under_a_continuous_control() {
    let motion = oblique_motion();
    let mut simulation = oblique(&motion, 1, 0.2);
    simulation.brake.profile = BrakeProfile::Smooth;
    assert_peaks(&simulation, 0.6, "oblique arm");
    let ssrms_motion = ssrms_motion();
    let mut simulation = ssrms(&ssrms_motion, cancelling(), 0.1);
    simulation.brake = Brake {
        profile: BrakeProfile::Smooth,
        ..Brake::new(lock(&[1], 10.0), 0.1)
    };
    assert_peaks(&simulation, 0.15, "SSRMS");
}

/// Another program's maximum of the same lock, where samples every 10 ms read 1449.06 N m.
#[test]
fn the_peak_of_the_paper_like_lock_is_the_continuous_one() {
    let motion = ssrms_motion();
    let mut simulation = ssrms(&motion, Compensation::none(), 0.1);
    simulation.feedback = Feedback::critical(5.0);
    simulation.control = Control::Every(0.01);
    let (impact, sampled) = peaks(&simulation, 0.85, 0.01);
    assert!(
        (impact.peak_torque[1] - 1451.83).abs() < 0.01,
        "{}",
        impact.peak_torque[1]
    );
    assert!(sampled[0][1] < 1450.0, "{}", sampled[0][1]);
}
