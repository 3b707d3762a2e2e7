//! A controller's loop, at 1 kHz: a plan, computed torques, and what to do when a joint locks on the way.
//!
//! `plant.rs` stands for the robot: put what talks to your drives and sensors in its place. `plan.rs` is the motion.

mod plan;
mod plant;

use plan::plan;
use plant::Plant;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{Arm, JointState, Recourse, SuppressionLaw, SuppressionLoop, Trajectory, Unrolled};

use my_crate::{N, arm};

/// s.
const PERIOD: f64 = 1e-3;
/// How long the brake of a failing joint takes, s.
const BRAKE: f64 = 0.01;
/// What the tool is to press with, `[f; n]`, N and N m: nothing.
const WRENCH: Vector6<f64> = Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
/// How far that may be bent when a joint locks, for the sake of the other joints, N.
const FORCE_BUDGET: f64 = 5.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arm = arm();
    let plan = plan(&arm, &arm.chain())?;
    let duration = plan.duration();
    // Of the feedback, rad/s: an error e falls as (1 + g t) exp(-g t) e.
    let gain = 20.0 / duration;
    // An arm that has more joints than its task needs loses one while it slows down.
    let mut failure = (N > arm.task().len()).then_some((N / 2, 0.85 * duration));

    // Passes the computed torque through, within the rated ones. At a lock, it goes on with the torque nearest to the last one.
    // `SuppressionLaw::OnLine(ulna::OnLine::equal())` in the place of the first `None` prepares for locks beforehand.
    let mut suppression = SuppressionLoop::new(&arm, SuppressionLaw::None, SuppressionLaw::None)
        .with_recourse(Recourse::Nearest {
            force_budget: FORCE_BUDGET,
        })
        .with_ramp(0.1 * duration);
    // The arm starts beside its plan by a hundredth of the way.
    let travel = plan.state(duration).q - plan.state(0.0).q;
    let mut plant = Plant::new(&arm, plan.state(0.0).q - travel * 0.01);
    let mut last = SVector::<f64, N>::zeros();

    println!("joints: {N}, along the plan within {duration} s");
    println!("time, s  off plan, rad or m  torque, N m or N  status");
    let cycles = (1.25 * duration / PERIOD).round() as u32;
    for cycle in 0..=cycles {
        let time = PERIOD * f64::from(cycle);
        if let Some((joint, _)) = failure.take_if(|(_, at)| time >= *at) {
            plant.close_brake(joint, BRAKE);
        }

        // What the sensors and the monitor of the brakes say.
        let (q, qd, locked) = (plant.q, plant.qd, plant.locked());
        let planned = locked.hold(&plan.state(time));
        let error = locked.without(&(planned.q - q));
        let qdd = planned.qdd + (planned.qd - qd) * (2.0 * gain) + error * (gain * gain);
        let result = suppression.cycle(time, &JointState { q, qd, qdd }, &WRENCH, locked);
        let torque = result.control.torque;

        for joint in result.newly_locked.iter() {
            let step = |torque: &SVector<f64, N>| locked.without(&(torque - last)).norm();
            println!(
                "{time:7.3}  joint {} has locked: the other torques step by {:.3}, without suppression by {:.3}",
                joint + 1,
                step(&torque),
                step(&result.control.planned),
            );
        }
        if cycle % (cycles / 10) == 0 {
            let (error, largest) = (error.amax(), torque.amax());
            let status = result.control.status;
            println!("{time:7.3}  {error:19.2e}  {largest:16.3}  {status:?}");
        }
        last = torque;
        plant.advance(&torque, PERIOD);
    }
    Ok(())
}
