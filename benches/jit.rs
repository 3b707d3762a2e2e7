//! Machine code made at run time: how long it takes to have it, and how long a call takes beside the compiler's code, the
//! interpreter and the textbook.
//!
//! `cargo bench --bench jit`. Turns of all sides alternate, so that a machine that others use is as slow for each.

use std::error::Error;
use std::time::{Duration, Instant};

use ulna::internal::call;
use ulna::internal::random::SplitMix64;
use ulna::proof::{State, states};
use ulna::{
    Angle, Arm, Friction, Joint, JointKind, Limits, Link, Method, Motor, Placement, TaskRow,
    TaskRows,
};
use ulna_codegen::{Generator, Interpreter};
use ulna_generated::Ssrms;
use ulna_jit::{AnyJit, Jit};
use ulna_table::{Convention, Description, Model};

/// What is timed.
const METHODS: [Method; 4] = [
    Method::DynamicManipulabilityGradient,
    Method::MassMatrix,
    Method::InverseDynamics,
    Method::MassMatrixDerivatives,
];

/// So many states in turn, that no branch is learnt by heart.
const STATES: usize = 64;
/// Turns of each side.
const TURNS: usize = 61;
/// A turn lasts at least so long.
const TURN: Duration = Duration::from_micros(300);

/// Something that is called state after state.
struct Side<'a> {
    name: &'static str,
    turn: Box<dyn Fn(usize) + 'a>,
    repeats: usize,
    times: Vec<f64>,
}

impl<'a> Side<'a> {
    fn new(name: &'static str, turn: impl Fn(usize) + 'a) -> Self {
        let mut repeats = 1;
        let time = |repeats| {
            let start = Instant::now();
            turn(repeats);
            start.elapsed()
        };
        while time(repeats) < TURN {
            repeats *= 2;
        }
        Self {
            name,
            turn: Box::new(turn),
            repeats,
            times: Vec::new(),
        }
    }

    /// Of a method of an arm.
    fn of<A: Arm<N>, const N: usize>(
        name: &'static str,
        arm: &'a A,
        method: Method,
        states: &'a [State<N>],
    ) -> Self {
        let call = call(method);
        Self::new(name, move |repeats| {
            for _ in 0..repeats {
                for state in states {
                    call(arm, state);
                }
            }
        })
    }

    fn measure(&mut self) {
        let start = Instant::now();
        (self.turn)(self.repeats);
        let calls = (self.repeats * STATES) as f64;
        self.times.push(start.elapsed().as_secs_f64() * 1e9 / calls);
    }

    /// The least and the median time, ns.
    fn result(&mut self) -> (f64, f64) {
        self.times.sort_by(f64::total_cmp);
        (self.times[0], self.times[self.times.len() / 2])
    }
}

/// Prints what a call takes on each side: least and median.
fn compare(label: &str, mut sides: Vec<Side<'_>>) {
    for _ in 0..TURNS {
        sides.iter_mut().for_each(Side::measure);
    }
    print!("| {label} |");
    for side in &mut sides {
        let (least, median) = side.result();
        print!(" {} {least:.0} / {median:.0} |", side.name);
    }
    println!();
}

fn calls() -> Result<(), Box<dyn Error>> {
    let model = Model::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../arms/ssrms.toml"))?;
    let jit = Jit::<7>::compile(&model)?;
    let interpreter = Interpreter::<7>::new(&model)?;
    let chain = Ssrms::CHAIN;
    let states: Vec<State<7>> = states(&chain).take(STATES).collect();
    println!("Nanoseconds a call of ssrms, least / median of {TURNS} turns.\n");
    for method in METHODS {
        let sides = vec![
            Side::of("jit", &jit, method, &states),
            Side::of("rustc", &Ssrms, method, &states),
            Side::of("interpreter", &interpreter, method, &states),
            Side::of("generic", &chain, method, &states),
        ];
        compare(method.name(), sides);
    }
    println!();
    batches(&jit, &states);
    Ok(())
}

/// Nanoseconds a state of batches.
fn batches(jit: &Jit<7>, states: &[State<7>]) {
    use ulna::ArmBatch as _;
    use ulna::nalgebra::SVector;

    let q: Vec<SVector<f64, 7>> = states.iter().map(|state| state.q).collect();
    let numbers: Vec<f64> = q.iter().flat_map(|q| q.iter().copied()).collect();
    let method = Method::DynamicManipulabilityGradient;
    let length = jit.any().length(method);
    let sides = vec![
        Side::new("jit", |repeats| {
            let mut results = vec![0.0; STATES * length];
            for _ in 0..repeats {
                let called = jit.any().call_batch(method, &[&numbers], &mut results);
                std::hint::black_box((&called, &mut results));
            }
        }),
        Side::new("rustc", |repeats| {
            let mut results = vec![(0.0, SVector::zeros()); STATES];
            for _ in 0..repeats {
                let called = Ssrms.dynamic_manipulability_gradient_batch(&q, &mut results);
                std::hint::black_box((&called, &mut results));
            }
        }),
    ];
    compare("a batch of dynamic_manipulability_gradient", sides);
}

/// An arm without luck: oblique twists, full inertias, every sixth joint slides.
fn unlucky(joints: usize) -> Description {
    let mut random = SplitMix64::new(1);
    let mut between =
        |least: f64, most: f64| least + (most - least) * (random.symmetric() + 1.0) / 2.0;
    let joints = (1..=joints).map(|number| {
        let mass = between(1.0, 10.0);
        let joint_kind = if number % 6 == 0 {
            JointKind::Prismatic
        } else {
            JointKind::Revolute
        };
        Joint {
            kind: joint_kind,
            alpha: Angle::from_radians(between(0.2, 1.4)),
            a: between(0.05, 0.5),
            theta: Angle::from_radians(between(-3.0, 3.0)),
            d: between(0.05, 0.3),
            rated_torque: None,
            limits: Limits::NONE,
            motor: Motor::NONE,
            friction: Friction::NONE,
            link: Link {
                mass,
                com: [between(-0.2, 0.2), between(-0.2, 0.2), between(-0.2, 0.2)],
                inertia: [
                    [0.025, 0.005, -0.002],
                    [0.005, 0.02, 0.003],
                    [-0.002, 0.003, 0.015],
                ]
                .map(|row| row.map(|x| mass * x)),
            },
        }
    });
    Description {
        name: "unlucky".to_owned(),
        convention: Convention::Modified,
        gravity: [0.0, 0.0, -9.81],
        task: TaskRows::new(&[TaskRow::X, TaskRow::Y, TaskRow::Z]),
        base: Placement::IDENTITY,
        tool: Placement {
            translation: [0.03, -0.05, 0.1],
            ..Placement::IDENTITY
        },
        payload: false,
        joints: joints.collect(),
        joint_names: Vec::new(),
        allow: Vec::new(),
        accept_inertia: Vec::new(),
    }
}

/// Resident memory of this program, MiB, where the system tells.
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let kib: Option<f64> = line.and_then(|line| line.trim().trim_end_matches(" kB").parse().ok());
    kib.map_or(f64::NAN, |kib| kib / 1024.0)
}

fn to_callable() -> Result<(), Box<dyn Error>> {
    println!("\nMilliseconds from a model to machine code: programs, machine code; least of 5.\n");
    println!(
        "| arm | methods | programs | machine code | KiB of code | MiB more of memory |\n|---|---|---|---|---|---|"
    );
    let ssrms = Model::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../arms/ssrms.toml"))?;
    let arms = [
        ("ssrms, 7 joints", ssrms),
        ("15 joints", Model::new(&unlucky(15))?),
        ("30 joints", Model::new(&unlucky(30))?),
    ];
    for (name, model) in &arms {
        for methods in [&METHODS[..1], &METHODS[1..2], &METHODS[2..3], Method::ALL] {
            let mut least = [f64::INFINITY; 2];
            let (mut size, mut memory) = (0, 0.0);
            for _ in 0..if methods.len() > 1 { 2 } else { 5 } {
                let start = Instant::now();
                let compiled = Generator::new().methods(methods).compile(model);
                let programs = start.elapsed().as_secs_f64() * 1e3;
                let before = resident();
                let start = Instant::now();
                let jit = AnyJit::of(model, &compiled)?;
                let code = start.elapsed().as_secs_f64() * 1e3;
                memory = resident() - before;
                least = [least[0].min(programs), least[1].min(code)];
                size = jit.code_size() / 1024;
            }
            let label = match methods {
                [method] => method.name(),
                _ => "all",
            };
            println!(
                "| {name} | {label} | {:.1} | {:.1} | {size} | {memory:.1} |",
                least[0], least[1]
            );
        }
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let chosen: Vec<String> = std::env::args().skip(1).collect();
    if !chosen.iter().any(|it| it == "compile") {
        calls()?;
    }
    if !chosen.iter().any(|it| it == "calls") {
        to_callable()?;
    }
    Ok(())
}
