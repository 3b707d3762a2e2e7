//! Batches against loops over single calls: every method of [`ArmBatch`], every arm of `arms/`.
//!
//! `cargo bench --bench batch`; `-- ssrms/` or `-- mass_matrix` picks an arm or a method. What is printed is time in a batch
//! divided by time in a loop, both into the same slice. They take turns, so that a machine whose speed drifts slows both
//! alike; the median of the rounds' ratios counts.

use std::hint::black_box;
use std::time::{Duration, Instant};

use ulna::ArmBatch;
use ulna::Instructions;
use ulna::internal::Quantity;
use ulna::nalgebra::SVector;
use ulna::proof::{State, states};

/// States in a batch.
const LENGTHS: [usize; 5] = [1, 3, 7, 8, 1024];

/// Turns of each contestant.
const ROUNDS: usize = 61;

/// A turn lasts so long, that the clock's steps do not matter.
const TURN: Duration = Duration::from_micros(60);

/// How long `work` takes, many times in a row.
fn time<T>(repeats: usize, work: impl Fn(&mut [T]), out: &mut [T]) -> f64 {
    let start = Instant::now();
    for _ in 0..repeats {
        work(out);
    }
    start.elapsed().as_secs_f64()
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// Seconds a repeat of `single`, and the median of the rounds' ratios.
fn compare<T>(batch: impl Fn(&mut [T]), single: impl Fn(&mut [T]), out: &mut [T]) -> (f64, f64) {
    let mut repeats = 1;
    while time(repeats, &single, out) < TURN.as_secs_f64() {
        repeats *= 2;
    }
    let mut round = |first: bool| {
        let before = first.then(|| time(repeats, &single, out));
        let batch = time(repeats, &batch, out);
        (before.unwrap_or_else(|| time(repeats, &single, out)), batch)
    };
    round(true);
    let rounds: Vec<(f64, f64)> = (0..ROUNDS).map(|i| round(i % 2 == 0)).collect();
    let times = rounds.iter().map(|(single, _)| *single).collect();
    let ratios = rounds
        .iter()
        .map(|(single, batch)| batch / single)
        .collect();
    (median(times) / repeats as f64, median(ratios))
}

/// Whether the command line asks for `name`: it does unless it asks for others.
fn is_wanted(name: &str) -> bool {
    let mut filters = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .peekable();
    filters.peek().is_none() || filters.any(|filter| name.contains(&filter))
}

fn column<const N: usize, const K: usize>(
    all: &[State<N>],
    of: fn(&State<N>) -> SVector<f64, K>,
) -> Vec<SVector<f64, K>> {
    all.iter().map(of).collect()
}

macro_rules! define_arm {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        { kernel $($kernel:tt)+ }
        { batch $batch:ident from $width:literal }
        $({ $($rest:tt)* })*
    )+) => {
        fn arm<A: ArmBatch<N>, const N: usize>(name: &str, arm: &A, all: &[State<N>]) {
            $({
                let name = format!("{name}/{}", stringify!($method));
                if is_wanted(&name) {
                    let mut cells = String::new();
                    let mut nanoseconds = 0.0;
                    for length in LENGTHS {
                        let all = &all[..length];
                        $(let $argument = column(all, |state| state.$argument);)+
                        let mut out = vec![<$output>::zero(); length];
                        let batch = |out: &mut [_]| {
                            let written = arm.$batch($(black_box(&$argument)),+, black_box(out));
                            assert!(written.is_ok());
                        };
                        let single = |out: &mut [_]| {
                            $(let $argument = black_box(&$argument[..]);)+
                            for (i, out) in black_box(out).iter_mut().enumerate() {
                                *out = arm.$method($(&$argument[i]),+);
                            }
                        };
                        let (seconds, ratio) = compare(batch, single, &mut out);
                        nanoseconds = seconds / length as f64 * 1e9;
                        cells += &format!("{ratio:>7.2}");
                    }
                    println!("{name:<48}{nanoseconds:>8.0}{cells}");
                }
            })+
        }
    };
}

ulna::methods! { [N] define_arm {} }

fn every_arm() {
    macro_rules! each {
        ($(($arm:ident, $name:ident, $joints:literal))*) => {
            $({
                let all: Vec<State<$joints>> = states(&ulna_generated::$arm::CHAIN).take(1024).collect();
                arm(stringify!($name), &ulna_generated::$arm::default(), &all);
            })*
        };
    }
    ulna_generated::for_each_arm!(each);
}

fn main() {
    let lengths: String = LENGTHS
        .iter()
        .map(|length| format!("{length:>7}"))
        .collect();
    let sets = [
        Instructions::Avx512,
        Instructions::Avx2,
        Instructions::Compiled,
    ];
    for set in sets
        .into_iter()
        .filter(|set| *set <= Instructions::of_machine())
    {
        set.limit();
        println!(
            "{:<48}{:>8}{lengths}",
            format!("{set:?}: batch / loop, states:"),
            "loop, ns"
        );
        every_arm();
    }
}
