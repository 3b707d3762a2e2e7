//! What the bench of growth asks of a compiled arm: [`run`] is the `main` of the crates that it makes.

use std::env;
use std::hint::black_box;
use std::process::ExitCode;
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

use ulna::internal::call;
use ulna::proof::{self, State};
use ulna::{Arm, Method, SerialChain};

/// So many states in turn, that no branch is learnt by heart.
const STATES: usize = 64;
/// The median of so many times counts.
const SAMPLES: usize = 51;
/// How long a sample takes at least.
const SAMPLE: Duration = Duration::from_millis(2);

type Call<A, const N: usize> = fn(&A, &State<N>);

/// `time METHOD` prints nanoseconds a call; `stack METHOD KIB` calls it once on a stack of that size, and dies where that is
/// too small; `prove` compares all methods with the textbook.
pub fn run<A: Arm<N> + Sync, const N: usize>(arm: &A, chain: &SerialChain<N>) -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments.as_slice() {
        ["prove"] => Some(prove(arm, chain)),
        ["time", name] => method(name).map(|method| time(arm, chain, method)),
        ["stack", name, kib] => method(name)
            .zip(kib.parse().ok())
            .map(|(method, kib)| call_on_stack(arm, chain, method, kib)),
        _ => None,
    };
    done.unwrap_or_else(|| {
        eprintln!("prove, time METHOD or stack METHOD KIB, not {arguments:?}");
        ExitCode::from(2)
    })
}

fn method<A: Arm<N>, const N: usize>(name: &str) -> Option<Call<A, N>> {
    let method = Method::ALL.iter().find(|method| method.name() == name)?;
    Some(call(*method))
}

fn prove<A: Arm<N>, const N: usize>(arm: &A, chain: &SerialChain<N>) -> ExitCode {
    let report = proof::compare(arm, chain, proof::states(chain).take(5));
    println!("{report}");
    ExitCode::from(u8::from(!report.passes()))
}

fn time<A: Arm<N>, const N: usize>(
    arm: &A,
    chain: &SerialChain<N>,
    method: Call<A, N>,
) -> ExitCode {
    let states: Vec<State<N>> = proof::states(chain).take(STATES).collect();
    let passes = |passes: u32| {
        let start = Instant::now();
        for _ in 0..passes {
            for state in &states {
                method(arm, black_box(state));
            }
        }
        start.elapsed()
    };
    let mut enough = 1;
    while passes(enough) < SAMPLE {
        enough *= 2;
    }
    let mut samples: Vec<Duration> = (0..SAMPLES).map(|_| passes(enough)).collect();
    samples.sort_unstable();
    let calls = f64::from(enough) * STATES as f64;
    println!("{}", samples[SAMPLES / 2].as_secs_f64() * 1e9 / calls);
    ExitCode::SUCCESS
}

fn call_on_stack<A: Arm<N> + Sync, const N: usize>(
    arm: &A,
    chain: &SerialChain<N>,
    method: Call<A, N>,
    kib: usize,
) -> ExitCode {
    let called = thread::scope(|scope| {
        let call = || proof::states(chain).take(1).for_each(|s| method(arm, &s));
        let thread = thread::Builder::new().stack_size(kib << 10);
        thread.spawn_scoped(scope, call).map(ScopedJoinHandle::join)
    });
    ExitCode::from(u8::from(!matches!(called, Ok(Ok(())))))
}
