//! The controller of a real loop: transitions, limits, and what it remembers.

use ulna::control::compensation::{FreeTorque, TaskPose};
use ulna::control::suppression::ScheduleError;
use ulna::nalgebra::{DMatrix, DVector, SVector, Vector6};
use ulna::{
    Arm, Compensation, Controller, JointState, LockedJoints, LoopCycle, OnLine, Projector,
    Recourse, Schedule, Status, SuppressionLaw, SuppressionLoop, Trajectory, Weighting,
};
use ulna_generated::Ssrms;

use crate::arms::{failure, paper_force, paper_like_motion};

const NONE: LockedJoints<7> = LockedJoints::NONE;
const PERIOD: f64 = 0.01;

type Loop<'a> = SuppressionLoop<'a, Ssrms, 7>;

fn locked(joints: &[usize]) -> LockedJoints<7> {
    LockedJoints::new(joints).unwrap()
}

fn unlimited<'a>(before: SuppressionLaw<'a, 7>, after: SuppressionLaw<'a, 7>) -> Loop<'a> {
    SuppressionLoop::new(&Ssrms, before, after).with_rated_torque(SVector::repeat(f64::INFINITY))
}

fn on_line() -> Loop<'static> {
    SuppressionLoop::on_line(&Ssrms, OnLine::equal())
        .with_rated_torque(SVector::repeat(f64::INFINITY))
}

/// Joint 2 known to lock.
fn known() -> OnLine<7> {
    OnLine {
        weights: SVector::from([0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
        weighting: Weighting::Absolute,
        damping: 0.0,
        force_budget: 0.0,
    }
}

/// The arm's motion if `joints` stop at `time`.
fn state(joints: &[usize], time: f64, now: f64) -> JointState<7> {
    failure(joints, time).state(&paper_like_motion(), now)
}

/// The norm of what of `torque` the locked arm's null space leaves no choice about: `J'†J' torque`, by singular values.
fn without_choice(state: &JointState<7>, locked: LockedJoints<7>, torque: &SVector<f64, 7>) -> f64 {
    let jacobian = locked.reduce_jacobian(&Ssrms.geometric_jacobian(&state.q));
    let jacobian = DMatrix::from_fn(3, 7, |i, j| jacobian[(i, j)]);
    let inverse = jacobian.clone().pseudo_inverse(1e-9).unwrap();
    let torque = DVector::from_column_slice(locked.without(torque).as_slice());
    (inverse * (jacobian * torque)).norm()
}

/// Cycles up to and with the one at `until`, joint 2 stopping at 10 s, the lock told `late` cycles after.
fn run(suppression: &mut Loop<'_>, from: i32, until: i32, late: i32) -> Vec<LoopCycle<7>> {
    (from..=until)
        .map(|i| {
            let time = PERIOD * f64::from(i);
            let told = if i < 1000 + late { NONE } else { locked(&[1]) };
            suppression.cycle(time, &state(&[1], 10.0, time), &paper_force(), told)
        })
        .collect()
}

#[test]
fn at_a_lock_the_healthy_torques_step_by_what_leaves_no_choice() {
    let lock = locked(&[1]);
    let here = state(&[1], 10.0, 10.0);
    let mut saved = 0.0_f64;
    for law in [
        SuppressionLaw::None,
        SuppressionLaw::OnLine(OnLine::equal()),
        SuppressionLaw::Coefficients(Compensation::Projected(SVector::repeat(2e6))),
    ] {
        for late in [0, 7] {
            for after in [SuppressionLaw::None, law] {
                let mut bumpless =
                    unlimited(law, after).with_recourse(Recourse::Nearest { force_budget: 0.0 });
                let cycles = run(&mut bumpless, 990, 1000 + late, late);
                let [.., last, now] = &cycles[..] else {
                    panic!("no cycles");
                };
                let step = lock.without(&(now.control.torque - last.control.torque));
                let time = 10.0 + PERIOD * f64::from(late);
                let here = state(&[1], 10.0, time);
                let planned = now.control.planned - last.control.torque;
                let expected = without_choice(&here, lock, &planned);
                assert!((step.norm() - expected).abs() < 1e-9, "{}", step.norm());
                assert_eq!(now.newly_locked, lock);
                assert_eq!(now.ramp, 1.0);
                assert!(now.control.force_error.norm() < 1e-9);
                // Which is less than what the same laws leave without it.
                let cycles = run(&mut unlimited(law, after), 990, 1000 + late, late);
                let [.., last, now] = &cycles[..] else {
                    panic!("no cycles");
                };
                let plain = lock.without(&(now.control.torque - last.control.torque));
                assert!(step.norm() < plain.norm() + 1e-9);
                saved = saved.max(plain.norm() - step.norm());
            }
        }
    }
    assert!(saved > 0.5, "{saved}");
    // A budget without end leaves no step at all; one of 2 N is kept, and takes some of it.
    let mut steps = Vec::new();
    for force_budget in [0.0, 2.0, f64::INFINITY] {
        let recourse = Recourse::Nearest { force_budget };
        let mut bumpless = on_line().with_recourse(recourse);
        let cycles = run(&mut bumpless, 999, 1000, 0);
        let step = cycles[1].control.torque - cycles[0].control.torque;
        steps.push(lock.without(&step).norm());
        assert!(cycles[1].control.force_error.norm() <= force_budget + 1e-9);
    }
    assert!(steps[1] < steps[0] - 1.0 && steps[2] < 1e-9, "{steps:?}");
    // A joint that is known to lock: the force-exact optimum of the whole problem.
    let mut bumpless = unlimited(SuppressionLaw::OnLine(known()), SuppressionLaw::None)
        .with_recourse(Recourse::Nearest { force_budget: 0.0 });
    let moving = paper_like_motion().state(10.0);
    let before = bumpless.cycle(10.0, &moving, &paper_force(), NONE);
    let after = bumpless.cycle(10.0, &here, &paper_force(), lock);
    let step = lock.without(&(after.control.torque - before.control.torque));
    assert!((step.norm() - 6.59).abs() < 0.01, "{}", step.norm());
}

#[test]
fn the_ramp_ends_exactly_at_the_law() {
    let mut ramped = on_line().with_ramp(0.5);
    let mut plain = on_line().with_recourse(Recourse::None);
    let ramped = run(&mut ramped, 995, 1060, 0);
    let plain = run(&mut plain, 995, 1060, 0);
    let mut last = 1.0;
    for (i, (ramped, plain)) in ramped.iter().zip(&plain).enumerate() {
        if (5..55).contains(&i) {
            assert!(ramped.ramp <= last && ramped.ramp > 0.0);
            last = ramped.ramp;
            assert!(ramped.control.force_error.norm() < 1e-9);
        } else {
            assert_eq!(ramped.ramp, 0.0);
            assert_eq!(ramped.control, plain.control, "cycle {i}");
        }
    }
    // Smooth: no cycle within the ramp changes U by more than the ramp's steepest part, 15/8 of its mean.
    let anchored = ramped[5].control.compensation - plain[5].control.compensation;
    for i in 6..60 {
        let left = |i: usize| ramped[i].control.compensation - plain[i].control.compensation;
        let change = (left(i) - left(i - 1)).norm();
        assert!(change < 1.1 * 1.875 * anchored.norm() * PERIOD / 0.5);
    }
    // Without a ramp there is no anchor.
    let mut none = on_line().with_ramp(0.0);
    assert_eq!(run(&mut none, 995, 1060, 0), plain);
}

fn laws<'a>(z: &'a [SVector<f64, 7>], f: &'a [Vector6<f64>]) -> [SuppressionLaw<'a, 7>; 5] {
    let schedule = Schedule::new(9.0, 0.7, z).unwrap();
    let coefficients = SVector::from([2e7, -3e7, 1e7, 1e7, 5e6, 3e6, 0.0]);
    [
        SuppressionLaw::None,
        SuppressionLaw::Coefficients(Compensation::PerJoint(coefficients)),
        SuppressionLaw::Coefficients(Compensation::Projected(coefficients)),
        SuppressionLaw::Schedule(schedule.with_wrenches(f).unwrap()),
        SuppressionLaw::OnLine(OnLine::equal()),
    ]
}

fn samples() -> ([SVector<f64, 7>; 4], [Vector6<f64>; 4]) {
    let z = [1.0, -0.5, 0.3, 0.8].map(|x| SVector::from_fn(|i, _| x * (30.0 - 9.0 * i as f64)));
    let f = [0.5, 1.0, -1.0, 0.0].map(|x| Vector6::new(x, 2.0 * x, -x, 0.0, 0.0, 0.0));
    (z, f)
}

#[test]
fn a_switch_of_laws_is_bumpless_and_ends_at_the_new_one() {
    let (z, f) = samples();
    for from in laws(&z, &f) {
        for to in laws(&z, &f) {
            for told in [NONE, locked(&[1])] {
                let cycle = |suppression: &mut Loop<'_>, i: i32| {
                    let time = 9.5 + PERIOD * f64::from(i);
                    let state = told.hold(&paper_like_motion().state(time));
                    suppression.cycle(time, &state, &paper_force(), told)
                };
                let mut switching = unlimited(from, from).with_ramp(0.3);
                let mut stays = switching;
                let before = cycle(&mut switching, 0).control.compensation;
                switching.switch(to);
                let mut last = cycle(&mut switching, 1).control.compensation;
                // Of the first cycle's change nothing is the switch's: U is carried along.
                let drift = {
                    cycle(&mut stays, 0);
                    cycle(&mut stays, 1).control.compensation - before
                };
                let bump = (last - before).amax();
                assert!(
                    bump < 2.0 * drift.amax().max(0.1),
                    "{from:?} {to:?}: {bump}"
                );
                let mut new = unlimited(to, to);
                let distance = (last - cycle(&mut new, 1).control.compensation).amax();
                for i in 2..=31 {
                    let now = cycle(&mut switching, i);
                    let new = cycle(&mut new, i);
                    let change = (now.control.compensation - last).amax();
                    assert!(change < 1.5 * 1.875 * distance / 30.0 + 2.0, "{change}");
                    last = now.control.compensation;
                    if i == 31 {
                        assert_eq!(now, new);
                    }
                }
            }
        }
    }
}

/// Numbers of a run without a pattern, the same at each run (Lehmer).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }
}

#[test]
fn rate_limits_and_rated_torques_hold_in_every_cycle() {
    let (z, f) = samples();
    let motion = paper_like_motion();
    let mut random = Random(7);
    let (mut held_back, mut cut, mut transitions) = (0, 0, 0);
    for rated in [f64::INFINITY, 420.0] {
        for _ in 0..8 {
            let laws = laws(&z, &f);
            let pick = |random: &mut Random| laws[random.below(5) as usize];
            let rate = SVector::<f64, 7>::repeat(150.0);
            let mut suppression = unlimited(pick(&mut random), pick(&mut random))
                .with_recourse(Recourse::Nearest { force_budget: 1.0 })
                .with_ramp(0.2)
                .with_rated_torque(SVector::repeat(rated))
                .with_rate_limit(rate);
            let start = random.below(15_000) as f64 * 1e-3 + 2.0;
            let mut joints = Vec::new();
            let mut last: Option<LoopCycle<7>> = None;
            for i in 0..400 {
                let time = start + 1e-3 * f64::from(i);
                match random.below(100) {
                    0 => suppression.switch(pick(&mut random)),
                    1 if joints.len() < 2 => joints.push(random.below(7) as usize),
                    2 => drop(joints.pop()),
                    _ => {}
                }
                let told = locked(&joints);
                let now = suppression.cycle(time, &motion.state(time), &paper_force(), told);
                for joint in told.healthy() {
                    assert!(now.control.torque[joint].abs() <= rated * (1.0 + 1e-12));
                }
                held_back += i32::from(now.rate_limited);
                cut += i32::from(now.control.status >= Status::Saturated);
                let transition = now.newly_locked != NONE || now.freed != NONE;
                transitions += i32::from(transition);
                if let Some(last) = last
                    && !transition
                    && rated == f64::INFINITY
                {
                    let change = now.control.compensation - last.control.compensation;
                    let over = (change.abs() - rate * 1e-3).max();
                    assert!(over < 1e-9, "{over}");
                }
                last = Some(now);
            }
        }
    }
    assert!(
        held_back > 500 && cut > 100 && transitions > 20,
        "{held_back} {cut} {transitions}"
    );
}

#[test]
fn held_back_a_law_that_keeps_the_force_keeps_it() {
    let mut slow = on_line().with_rate_limit(SVector::repeat(20.0));
    // At rest there is nothing to prepare for; it starts from there.
    slow.cycle(
        4.99,
        &JointState::at_rest(paper_like_motion().state(5.0).q),
        &paper_force(),
        NONE,
    );
    let (mut limited, mut arrived) = (0, false);
    for i in 500..900 {
        let time = PERIOD * f64::from(i);
        let cycle = slow.cycle(time, &paper_like_motion().state(time), &paper_force(), NONE);
        assert!(cycle.control.force_error.norm() < 1e-9);
        limited += i32::from(cycle.rate_limited);
        arrived |= !cycle.rate_limited;
    }
    assert!(limited > 50 && arrived, "{limited}");
}

/// The cycle that takes a lock is exempt from the rate limit, and none after it.
#[test]
fn a_lock_is_taken_at_once_whatever_the_rate_limit() {
    let mut slow = on_line()
        .with_rate_limit(SVector::repeat(20.0))
        .with_ramp(0.2);
    let cycles = run(&mut slow, 990, 1100, 0);
    let (last, now) = (&cycles[9], &cycles[10]);
    let lock = locked(&[1]);
    let step = lock.without(&(now.control.torque - last.control.torque));
    let planned = now.control.planned - last.control.torque;
    let expected = without_choice(&state(&[1], 10.0, 10.0), lock, &planned);
    assert!((step.norm() - expected).abs() < 1e-9 && !now.rate_limited);
    let jump = now.control.compensation - last.control.compensation;
    assert!(jump.amax() > 20.0 * PERIOD);
    assert!(cycles[11..].iter().any(|cycle| cycle.rate_limited));
}

/// What the cut of an overloaded plan bends is no compensation to go on from.
#[test]
fn after_an_overload_the_force_is_kept_again_at_once() {
    let motion = paper_like_motion();
    let mut slow = on_line()
        .with_rated_torque(SVector::repeat(300.0))
        .with_rate_limit(SVector::repeat(5.0));
    let (mut overloaded, mut after) = (0, 0);
    for i in 0..400 {
        let time = 0.05 * f64::from(i);
        let cycle = slow.cycle(time, &motion.state(time), &paper_force(), NONE);
        if cycle.control.status == Status::Overloaded {
            overloaded += 1;
        } else {
            assert!(cycle.control.force_error.norm() < 1e-9);
            after += i32::from(overloaded > 0 && cycle.rate_limited);
        }
    }
    assert!(overloaded > 0 && after > 0, "{overloaded} {after}");
}

#[test]
fn joints_may_lock_one_after_another_and_be_freed() {
    let motion = paper_like_motion();
    let mut suppression = on_line().with_ramp(0.3);
    let told = |i: i32| match i {
        ..20 => NONE,
        20..35 => locked(&[1]),
        35..90 => locked(&[1, 3]), // while the first ramp still goes
        _ => locked(&[3]),
    };
    let mut last: Option<LoopCycle<7>> = None;
    for i in 0..150 {
        let time = 9.5 + PERIOD * f64::from(i);
        let now = suppression.cycle(time, &motion.state(time), &paper_force(), told(i));
        assert!(now.control.force_error.norm() < 1e-9);
        for joint in told(i).iter() {
            assert_eq!(now.control.compensation[joint], 0.0);
        }
        let expected = match i {
            20 => (locked(&[1]), NONE),
            35 => (locked(&[3]), NONE),
            90 => (NONE, locked(&[1])),
            _ => (NONE, NONE),
        };
        assert_eq!((now.newly_locked, now.freed), expected);
        if let Some(last) = last {
            let both = locked(&[1, 3]);
            let step = now.control.torque - last.control.torque;
            if i == 20 || i == 35 {
                assert_eq!(now.ramp, 1.0);
                let planned = now.control.planned - last.control.torque;
                let expected = without_choice(&motion.state(time), told(i), &planned);
                let found = told(i).without(&step).norm();
                assert!((found - expected).abs() < 1e-9);
            } else if i == 90 {
                // The freed joint starts at its plan; the others are as near to where they were as can be.
                assert_eq!(now.ramp, 1.0);
                let planned = now.control.planned - last.control.planned;
                assert!(both.without(&step).norm() < both.without(&planned).norm() + 1.0);
            }
        }
        last = Some(now);
    }
    assert_eq!(last.unwrap().ramp, 0.0);
}

#[test]
fn rated_torques_cut_each_law_in_its_own_way() {
    let motion = paper_like_motion();
    let (z, f) = samples();
    let free = unlimited(SuppressionLaw::None, SuppressionLaw::None).cycle(
        10.0,
        &motion.state(10.0),
        &paper_force(),
        NONE,
    );
    for law in laws(&z, &f) {
        let first = |rated| {
            unlimited(law, law).with_rated_torque(rated).cycle(
                10.0,
                &motion.state(10.0),
                &paper_force(),
                NONE,
            )
        };
        let whole = first(SVector::repeat(f64::INFINITY)).control;
        let cut = first(free.control.planned.abs().add_scalar(2.0)).control;
        if law == SuppressionLaw::None {
            assert_eq!(cut.status, Status::Nominal);
            continue;
        }
        assert_eq!(cut.status, Status::Saturated, "{law:?}");
        assert!(cut.margins.min() > -1e-9);
        if law.keeps_force() {
            let scale = cut.compensation.norm() / whole.compensation.norm();
            assert!((cut.compensation - whole.compensation * scale).amax() < 1e-9);
        }
        let mut weak = free.control.planned.abs().add_scalar(2.0);
        weak[3] -= 10.0;
        let overloaded = first(weak).control;
        assert_eq!(overloaded.status, Status::Overloaded);
        assert!(overloaded.margins.min() >= 0.0);
    }
}

#[test]
fn a_broken_cycle_gives_nothing_and_the_next_one_goes_on() {
    let motion = paper_like_motion();
    let cycle = |suppression: &mut Loop<'_>, i: i32, told| {
        let time = 9.5 + PERIOD * f64::from(i);
        suppression.cycle(time, &motion.state(time), &paper_force(), told)
    };
    let (mut broken, mut whole) = (on_line(), on_line());
    for suppression in [&mut broken, &mut whole] {
        cycle(suppression, 0, NONE);
        cycle(suppression, 1, locked(&[1]));
    }
    let mut bad = motion.state(9.52);
    bad.q[2] = f64::NAN;
    let huge = JointState {
        qd: SVector::repeat(1e200),
        ..motion.state(9.52)
    };
    let good = motion.state(9.52);
    for (time, state, wrench) in [
        (9.52, bad, paper_force()),
        (9.52, huge, paper_force()),
        (f64::NAN, good, paper_force()),
        (9.52, good, Vector6::repeat(f64::INFINITY)),
    ] {
        let nothing = broken.cycle(time, &state, &wrench, locked(&[1, 3]));
        assert_eq!(nothing.control.status, Status::NotFinite);
        assert_eq!(nothing.control.torque, SVector::<f64, 7>::zeros());
        assert_eq!(nothing.newly_locked, locked(&[3]));
    }
    for i in 3..6 {
        let told = locked(&[1, 3]);
        let (a, b) = (cycle(&mut broken, i, told), cycle(&mut whole, i, told));
        assert_eq!(a, b);
        assert_eq!(a.newly_locked != NONE, i == 3);
    }
    // Forgetting is starting anew.
    broken.reset();
    assert_eq!(cycle(&mut broken, 6, NONE), cycle(&mut on_line(), 6, NONE));
}

/// Without a recourse and limits it is what the controller without a memory does.
#[test]
fn it_agrees_with_the_controller() {
    let (z, f) = samples();
    let free = FreeTorque {
        torque: z[0],
        wrench: f[1],
    };
    let k = SVector::from([2e7, -3e7, 1e7, 1e7, 5e6, 3e6, 0.0]);
    for compensation in [
        Compensation::PerJoint(k),
        Compensation::Projected(k),
        Compensation::Optimal {
            before: free,
            after: free,
        },
    ] {
        let law = SuppressionLaw::Coefficients(compensation);
        for rated in [f64::INFINITY, 300.0] {
            let rated = SVector::repeat(rated);
            let mut suppression = unlimited(law, law).with_rated_torque(rated);
            let controller = Controller::new(&Ssrms, compensation).with_rated_torque(rated);
            for i in 0..20 {
                let time = f64::from(i);
                let state = paper_like_motion().state(time);
                let told = if i < 8 { NONE } else { locked(&[2]) };
                assert_eq!(
                    suppression
                        .cycle(time, &state, &paper_force(), told)
                        .control,
                    controller.cycle(&state, &paper_force(), told)
                );
            }
        }
    }
}

#[test]
fn a_schedule_is_followed_wherever_the_arm_is() {
    let (z, f) = samples();
    let schedule = Schedule::new(2.0, 0.5, &z).unwrap();
    assert_eq!(schedule.at(-1e300).torque, z[0]);
    assert_eq!(schedule.at(2.5).torque, z[1]);
    assert_eq!(schedule.at(1e300).torque, z[3]);
    assert_eq!(schedule.at(2.5).wrench, Vector6::zeros());
    let quarter = z[1] * 0.75 + z[2] * 0.25;
    assert!((schedule.at(2.625).torque - quarter).amax() < 1e-12);
    let schedule = schedule.with_wrenches(&f).unwrap();
    let mut suppression = unlimited(
        SuppressionLaw::Schedule(schedule),
        SuppressionLaw::Schedule(schedule),
    );
    for i in 0..40 {
        let time = 1.5 + 0.1 * f64::from(i);
        let state = paper_like_motion().state(time);
        for told in [NONE, locked(&[4])] {
            let cycle = suppression
                .cycle(time, &state, &paper_force(), told)
                .control;
            let expected = schedule.at(time);
            assert!((cycle.force_error - expected.wrench).amax() < 1e-9);
            let pose = TaskPose::new(&Ssrms, &state.q, told, Projector::Static);
            let u = pose.project(&expected.torque) + pose.static_torque(&expected.wrench);
            assert!((cycle.compensation - u).amax() < 1e-9);
        }
    }
    let new = |start, period, z| Schedule::<7>::new(start, period, z).unwrap_err();
    assert_eq!(new(0.0, 1.0, &[]), ScheduleError::Empty);
    for (start, period) in [(f64::NAN, 1.0), (0.0, 0.0), (0.0, -1.0), (0.0, f64::NAN)] {
        assert!(matches!(new(start, period, &z), ScheduleError::Time { .. }));
    }
    let broken = [z[0], SVector::repeat(f64::NAN)];
    assert_eq!(new(0.0, 1.0, &broken), ScheduleError::NotFinite(1));
    let error = schedule.with_wrenches(&f[..3]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a schedule needs a wrench for each of its 4 torques, not 3"
    );
}

/// On the singular set U is 0, whatever is remembered.
#[test]
fn through_a_singular_pose_it_stays_bounded() {
    let mut arm = crate::arms::ssrms();
    for joint in &mut arm.joints {
        joint.d = 0.0;
    }
    for rate in [f64::INFINITY, 100.0, 0.1] {
        let mut suppression = SuppressionLoop::on_line(&arm, OnLine::equal())
            .with_rated_torque(SVector::repeat(f64::INFINITY))
            .with_rate_limit(SVector::repeat(rate));
        for i in -20..=20 {
            let time = PERIOD * f64::from(i);
            let state = JointState {
                q: SVector::from([0.3, -0.8, 0.4, 0.1 * time, 0.7, 0.9, -0.2]),
                qd: SVector::repeat(0.1),
                qdd: SVector::repeat(0.02),
            };
            let told = LockedJoints::new(if i < -10 { &[] } else { &[0] }).unwrap();
            let cycle = suppression
                .cycle(time, &state, &paper_force(), told)
                .control;
            assert!(cycle.compensation.amax() < 50.0, "{}", cycle.compensation);
            if i == 0 {
                assert_eq!(cycle.compensation, SVector::<f64, 7>::zeros());
            }
        }
    }
}
