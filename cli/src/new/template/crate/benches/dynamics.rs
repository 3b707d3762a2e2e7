//! How long the arm's methods take, generated and by the textbook's formulas: medians, ns.

use std::hint::black_box;
use std::time::Instant;

use ulna::{Arm, Unrolled, proof};

use my_crate::{N, arm};

fn main() {
    let (generated, textbook) = (arm(), arm().chain());
    let mut states = proof::states(&textbook);
    let state = states.next().unwrap_or_default();
    let (q, qd, qdd, tau) = black_box((state.q, state.qd, state.qdd, state.tau));

    println!("{:28}{:>12}{:>12}", "ns", "generated", "textbook");
    let compare = |method: &str, call: &dyn Fn(&dyn Arm<N>)| {
        let [generated, textbook] =
            [&generated as &dyn Arm<N>, &textbook].map(|arm| median_time(|| call(black_box(arm))));
        println!("{method:28}{generated:12.0}{textbook:12.0}");
    };
    compare("forward_kinematics", &|arm| {
        black_box(arm.forward_kinematics(&q));
    });
    compare("geometric_jacobian", &|arm| {
        black_box(arm.geometric_jacobian(&q));
    });
    compare("mass_matrix", &|arm| {
        black_box(arm.mass_matrix(&q));
    });
    compare("inverse_dynamics", &|arm| {
        black_box(arm.inverse_dynamics(&q, &qd, &qdd));
    });
    compare("forward_dynamics", &|arm| {
        black_box(arm.forward_dynamics(&q, &qd, &tau));
    });
}

/// Of a call, ns: the median of many rounds. In a test, which `cargo bench` says it is not, one round shows that it runs.
fn median_time(call: impl Fn()) -> f64 {
    const CALLS: u32 = 1000;
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    let rounds = if is_bench { 101 } else { 1 };
    let mut times: Vec<f64> = (0..rounds)
        .map(|_| {
            let start = Instant::now();
            (0..CALLS).for_each(|_| call());
            start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[rounds / 2]
}
