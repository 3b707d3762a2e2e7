//! A control loop from the table to the plots: an arm of one's own, a plan, 1 kHz, and a joint that locks on the way.
//!
//! Joint 3 is braked in the middle of the motion; the loop is told of it some cycles later. The same run is made with different
//! suppression, and what the motors have to do in the cycle in which the lock is told stands side by side.
//! `cargo run --manifest-path examples/control_loop/Cargo.toml -- FOLDER` writes a CSV file and plots into FOLDER.

// `BenchArm`, compiled from `bench_arm.toml` by the build script.
include!(concat!(env!("OUT_DIR"), "/bench_arm.rs"));

mod plant;
mod report;
mod svg;

use plant::Plant;
use ulna::nalgebra::{SVector, Vector6};
use ulna::{
    Arm, JointLimits, JointState, LockedJoints, LoopCycle, OnLine, PointToPoint, Recourse,
    SuppressionLaw, SuppressionLoop, Trajectory, Weighting,
};

/// s.
const PERIOD: f64 = 1e-3;
const DURATION: f64 = 1.6;
/// When the brake of joint 3 closes, how long it takes, and how long the loop does not know, s.
const LOCK: f64 = 0.6;
const BRAKE: f64 = 0.01;
const DETECTION: f64 = 0.002;
/// Joint 3, counted from 0.
const JOINT: usize = 2;
/// Of the joints' feedback, rad/s.
const GAIN: f64 = 15.0;

/// What the loop knew, commanded and got in one cycle.
struct Sample {
    time: f64,
    /// Torque of the motors, feedback included, N m.
    torque: SVector<f64, 7>,
    cycle: LoopCycle<7>,
    /// How far the healthy joints are from the plan at most, rad.
    off_plan: f64,
}

/// One way of suppression, and its run.
struct Run {
    name: &'static str,
    samples: Vec<Sample>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args_os().nth(1).map(std::path::PathBuf::from);
    let arm = BenchArm;
    let start = SVector::from([-0.6, -0.5, 0.3, -2.1, 0.2, 1.7, 0.6]);
    let goal = SVector::from([0.7, 0.3, -0.5, -1.3, -0.3, 2.1, 0.6]);
    let plan = PointToPoint::new(start, goal, DURATION, 0.75, &JointLimits::none())?;

    let none = SuppressionLaw::None;
    let law = OnLine::equal();
    let nearest = |force_budget| Recourse::Nearest { force_budget };
    let on_line = SuppressionLoop::on_line(&arm, law);
    // A monitor says that joint 3 is the one to watch.
    let watched = SuppressionLoop::on_line(
        &arm,
        OnLine {
            weights: SVector::from_fn(|joint, _| f64::from(u8::from(joint == JOINT))),
            weighting: Weighting::Absolute,
            damping: 0.2,
            force_budget: 0.0,
        },
    );
    let ways = [
        ("none", SuppressionLoop::new(&arm, none, none)),
        (
            "recourse",
            SuppressionLoop::new(&arm, none, none).with_recourse(nearest(0.0)),
        ),
        ("on-line law, recourse", on_line),
        ("joint 3 watched", watched),
        ("the same, 5 N", watched.with_recourse(nearest(5.0))),
    ];
    let runs = ways.map(|(name, suppression)| Run {
        name,
        samples: run(&arm, &plan, suppression.with_ramp(0.3)),
    });

    print!("{}", report::table(&runs));
    if let Some(folder) = folder {
        report::write(&runs, &folder)?;
        println!("written: {}", folder.display());
    }
    Ok(())
}

/// The loop: plan, suppression and feedback, sensors and motors of a simulated arm.
fn run(
    arm: &BenchArm,
    plan: &impl Trajectory<7>,
    mut suppression: SuppressionLoop<'_, BenchArm, 7>,
) -> Vec<Sample> {
    // The tool presses down with 15 N.
    let wrench = Vector6::new(0.0, 0.0, -15.0, 0.0, 0.0, 0.0);
    let joint_3 = LockedJoints::new(&[JOINT]).unwrap_or(LockedJoints::NONE);
    let inertia = arm.mass_matrix(&plan.state(0.0).q).diagonal();
    let mut plant = Plant::new(arm, plan.state(0.0), wrench);
    let cycles = (DURATION / PERIOD).round() as u32;
    let mut samples = Vec::new();
    for i in 0..cycles {
        let time = PERIOD * f64::from(i);
        if plant.brake.is_none() && time >= LOCK {
            plant.close_brake(JOINT, BRAKE);
        }
        let known = time >= LOCK + BRAKE + DETECTION;
        let locked = if known { joint_3 } else { LockedJoints::NONE };

        // Where the arm should be: on its plan, but for the joint that is known to stand.
        let mut target = locked.hold(&plan.state(time));
        if known {
            target.q[JOINT] = plant.state.q[JOINT];
        }
        let cycle = suppression.cycle(time, &target, &wrench, locked);
        let torque = cycle.control.torque + feedback(&inertia, &target, &plant.state);

        samples.push(Sample {
            time,
            torque: joint_3.without(&torque),
            cycle,
            off_plan: joint_3.without(&(target.q - plant.state.q)).amax(),
        });
        plant.advance(&torque, PERIOD);
    }
    samples
}

/// Each joint by itself, critically damped for the `inertia` that it feels.
fn feedback(
    inertia: &SVector<f64, 7>,
    target: &JointState<7>,
    measured: &JointState<7>,
) -> SVector<f64, 7> {
    let acceleration =
        (target.q - measured.q) * (GAIN * GAIN) + (target.qd - measured.qd) * (2.0 * GAIN);
    inertia.component_mul(&acceleration)
}
