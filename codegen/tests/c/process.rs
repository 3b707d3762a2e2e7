//! [`CArm`]: an arm that is a program in C, compiled for the test and asked through pipes.

use std::fmt::Write as _;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;

use nalgebra::SVector;
use ulna::internal::{Quantity, numbers};
use ulna::proof::State;
use ulna::{Argument, Arm, Method, Payload, SerialChain, TaskRows};
use ulna_codegen::{COptions, Compiled, GeneratedC};
use ulna_table::Model;

/// What every C file of ours is compiled with; each warning is an error. Sums of products are not fused, so that results do not depend
/// on the processor.
const FLAGS: [&str; 9] = [
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wshadow",
    "-Werror",
    "-O0",
    "-ffp-contract=off",
];

/// An arm whose methods run in another process.
pub(crate) struct CArm<const N: usize> {
    chain: SerialChain<N>,
    /// What it carries: mass, centroid, and the six numbers of its inertia.
    body: [f64; Payload::PARAMETERS],
    process: Mutex<Child>,
}

impl<const N: usize> CArm<N> {
    /// The programs `compiled` of `model`'s arm, printed with `options`, and compiled again.
    pub(crate) fn new(model: &Model, compiled: &Compiled, options: COptions) -> Self {
        let chain = SerialChain::try_from(model).unwrap_or_else(|error| panic!("{error}"));
        let generated = GeneratedC::of(model, "table", compiled, options);
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        for (name, text) in generated.files() {
            std::fs::write(path(&name), text).expect("written");
        }
        std::fs::write(path("main.c"), main_file(model, &chain)).expect("written");
        let source = format!("{}.c", model.name());
        compile(folder.path(), &[&source, "main.c"], "arm");
        let mut command = Command::new(path("arm"));
        let process = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        Self {
            chain,
            body: [0.0; Payload::PARAMETERS],
            process: Mutex::new(process.expect("the program runs")),
        }
    }

    /// Carries `payload` from now on.
    pub(crate) fn carry(&mut self, payload: &Payload) {
        let ([x, y, z], [[xx, xy, xz], [_, yy, yz], [.., zz]]) = (payload.com(), payload.inertia());
        self.body = [payload.mass(), x, y, z, xx, xy, xz, yy, yz, zz];
    }

    fn run<T: Quantity>(&self, method: Method, state: &State<N>) -> T {
        let number = Method::ALL.iter().position(|other| *other == method);
        #[expect(clippy::cast_precision_loss, reason = "methods are few")]
        let number = number.expect("a method") as f64;
        let arguments = [number].into_iter();
        let arguments = arguments
            .chain(state.q.iter().copied())
            .chain(state.qd.iter().copied());
        let arguments = arguments.chain(state.qdd.iter().copied());
        let arguments = arguments.chain(state.tau.iter().copied());
        let arguments = arguments
            .chain(state.wrench.iter().copied())
            .chain(self.body);
        let arguments: Vec<u8> = arguments.flat_map(f64::to_ne_bytes).collect();
        let mut result = T::zero();
        let mut process = self.process.lock().expect("no test has failed within");
        let stdin = process.stdin.as_mut().expect("a pipe");
        stdin.write_all(&arguments).expect("the program reads");
        stdin.flush().expect("the program reads");
        let stdout = process.stdout.as_mut().expect("a pipe");
        for part in 0..T::PARTS {
            for place in result.part_mut(part) {
                let mut bytes = [0; 8];
                stdout.read_exact(&mut bytes).expect("the program answers");
                *place = f64::from_ne_bytes(bytes);
            }
        }
        result
    }
}

/// The compiler that Rust links with.
pub(crate) fn compile(folder: &Path, sources: &[&str], output: &str) {
    let compiler = std::env::var_os("CC").unwrap_or_else(|| "cc".into());
    let mut command = Command::new(compiler);
    command.current_dir(folder).args(FLAGS).args(sources);
    let run = command
        .args(["-o", output, "-lm"])
        .output()
        .expect("a C compiler");
    let told = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success() && told.is_empty(), "{told}");
}

/// A program that answers each call on its input, a method's number and all arguments that there are, with the method's result.
fn main_file<const N: usize>(model: &Model, chain: &SerialChain<N>) -> String {
    let name = model.name();
    let arguments = Argument::ALL.map(|argument| (argument.name(), argument.length(N)));
    let arguments = arguments.into_iter().chain([("body", Payload::PARAMETERS)]);
    let (mut declared, mut read, mut place) = (String::new(), String::new(), 1);
    for (argument, length) in arguments {
        writeln!(declared, "    {name}_real {argument}[{length}];").unwrap();
        writeln!(
            read,
            "        for (i = 0; i < {length}; i++) {{ {argument}[i] = ({name}_real)in[{place} + i]; }}"
        )
        .unwrap();
        place += length;
    }
    let payload = if model.has_payload() {
        format!("{name}_payload(body, payload);")
    } else {
        "(void)payload[0]; (void)body[0];".to_owned()
    };
    let (mut cases, mut longest) = (String::new(), 1);
    for (number, method) in Method::ALL.iter().enumerate() {
        let mut length = 0;
        numbers(chain, *method, &State::default(), |_| length += 1);
        longest = longest.max(length);
        let arguments = method.arguments().iter().map(|argument| argument.name());
        let carried = model.has_payload().then_some("payload");
        let arguments: Vec<&str> = arguments.chain(carried).chain(["result"]).collect();
        writeln!(
            cases,
            "        case {number}: {name}_{method}({}); length = {length}; break;",
            arguments.join(", ")
        )
        .unwrap();
    }
    format!(
        "#include \"{name}.h\"\n#include <stdio.h>\n\nint main(void)\n{{\n    double in[{place}];\n    double out[{longest}];\n{declared}\
         \x20   {name}_real payload[10] = {{ 0 }};\n    {name}_real result[{longest}];\n    int i;\n    while (fread(in, sizeof in, 1, stdin) == 1)\n    {{\n        int length = 0;\n{read}\
         \x20       {payload}\n        switch ((int)in[0])\n        {{\n{cases}        default: break;\n        }}\n\
         \x20       for (i = 0; i < length; i++) {{ out[i] = (double)result[i]; }}\n\
         \x20       (void)fwrite(out, sizeof out[0], (size_t)length, stdout);\n        (void)fflush(stdout);\n    }}\n    return 0;\n}}\n"
    )
}

macro_rules! define_arm {
    ([] $(
        $(#[$doc:meta])*
        $variant:ident = $method:ident($($argument:ident),+) -> $output:ty
        $({ $($rest:tt)* })*
    )+) => {
        impl<const N: usize> Arm<N> for CArm<N> {
            fn task(&self) -> TaskRows {
                self.chain.task
            }

            fn rated_torque(&self) -> SVector<f64, N> {
                self.chain.rated_torque()
            }

            $(
                fn $method(&self, $($argument: &ulna::argument_type!([N] $argument)),+) -> $output {
                    let state = State { $($argument: *$argument,)+ ..State::default() };
                    self.run(Method::$variant, &state)
                }
            )+
        }
    };
}

ulna::methods! { [N] define_arm {} }
