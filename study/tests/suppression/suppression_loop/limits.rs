//! Rate limits and rated torques, in every cycle.

use ulna::nalgebra::SVector;
use ulna::{JointState, LoopCycle, Recourse, Status, SuppressionLaw, Trajectory};

use super::{NONE, PERIOD, laws, locked, on_line, run, samples, state, unlimited, without_choice};
use crate::arms::{paper_force, paper_like_motion};

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
