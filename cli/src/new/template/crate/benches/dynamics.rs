//! How long the arm's methods take, generated and by the textbook's formulas.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use ulna::{Arm, Unrolled, proof};

use my_crate::{N, arm};

fn dynamics(criterion: &mut Criterion) {
    let (generated, textbook) = (arm(), arm().chain());
    let mut states = proof::states(&textbook);
    let state = states.next().unwrap_or_default();
    let (q, qd, qdd, tau) = (state.q, state.qd, state.qdd, state.tau);
    let ways: [(&str, &dyn Arm<N>); 2] = [("generated", &generated), ("textbook", &textbook)];
    for (way, arm) in ways {
        let mut group = criterion.benchmark_group(way);
        group.bench_function("forward_kinematics", |bencher| {
            bencher.iter(|| arm.forward_kinematics(black_box(&q)));
        });
        group.bench_function("geometric_jacobian", |bencher| {
            bencher.iter(|| arm.geometric_jacobian(black_box(&q)));
        });
        group.bench_function("mass_matrix", |bencher| {
            bencher.iter(|| arm.mass_matrix(black_box(&q)));
        });
        group.bench_function("inverse_dynamics", |bencher| {
            bencher.iter(|| arm.inverse_dynamics(black_box(&q), black_box(&qd), black_box(&qdd)));
        });
        group.bench_function("forward_dynamics", |bencher| {
            bencher.iter(|| arm.forward_dynamics(black_box(&q), black_box(&qd), black_box(&tau)));
        });
        group.finish();
    }
}

criterion_group!(benches, dynamics);
criterion_main!(benches);
