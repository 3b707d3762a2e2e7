//! Transitions: locks, ramps and switches of laws.

use ulna::nalgebra::SVector;
use ulna::{Compensation, LoopCycle, OnLine, Recourse, SuppressionLaw, Trajectory};

use super::{
    Loop, NONE, PERIOD, known, laws, locked, on_line, run, samples, state, unlimited,
    without_choice,
};
use crate::arms::{paper_force, paper_like_motion};

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
