//! All checks of one arm, gathered: a table that fails one of them is put through the others too.

use ulna::SerialChain;
use ulna::proof::{State, states};
use ulna_codegen::{Generated, Interpreter, generate};
use ulna_table::Model;

use super::arms::Arm;
use super::caught::caught;
use super::condition::{Conditions, conditions};
use super::is_located;
use super::judge::{Judgement, judge};
use super::record::Sample;
use super::totality::{methods_with_nan, special};

/// How many states each arm is judged at.
const STATES: usize = 3;
/// One arm in so many is generated a second time.
const AGAIN: usize = 4;

/// What became of a table.
pub(crate) enum Outcome {
    /// The model stage refuses it, and says where: nothing is expected of the generator.
    Refused,
    Examined(Examination),
}

/// What the checks found.
#[derive(Default)]
pub(crate) struct Examination {
    pub(crate) failures: Vec<Failure>,
    /// The judgement that is worst in what is allowed, and the conditions there.
    pub(crate) worst: Option<(Judgement, Conditions)>,
    /// As many as were asked for; none if there are no programs.
    pub(crate) samples: Vec<Sample>,
}

/// A check that failed.
#[derive(Clone, Debug)]
pub(crate) struct Failure {
    /// What stays the same while a table shrinks.
    pub(crate) kind: String,
    pub(crate) detail: String,
}

/// Puts `arm` through every check, and samples w_D at so many configurations.
pub(crate) fn examine(arm: &Arm, samples: usize) -> Outcome {
    macro_rules! dispatch {
        ($model:ident: $($joints:literal)+) => {
            match $model.joints().len() {
                $($joints => examine_model::<$joints>(arm, &$model, samples),)+
                joints => unreachable!("no strategy makes {joints} joints"),
            }
        };
    }
    match caught(|| Model::parse(&arm.table.to_string(), "random.toml")) {
        Ok(Ok(model)) => Outcome::Examined(dispatch!(model: 1 2 3 4 5 6 7)),
        Ok(Err(errors)) if is_located(&errors) => Outcome::Refused,
        Ok(Err(errors)) => {
            let mut examination = Examination::default();
            examination.fail("an error without a place", errors.to_string());
            Outcome::Examined(examination)
        }
        Err(panic) => {
            let mut examination = Examination::default();
            examination.fail(format!("the reader panics: {panic}"), "");
            Outcome::Examined(examination)
        }
    }
}

fn examine_model<const N: usize>(arm: &Arm, model: &Model, samples: usize) -> Examination {
    let mut examination = Examination::default();
    match caught(|| generate(model, "x.toml")) {
        Ok(code) => {
            let again = arm.first_state.is_multiple_of(AGAIN);
            examination.read(&code, N);
            if again && text(&generate(model, "x.toml")) != text(&code) {
                examination.fail("another source the second time", "");
            }
        }
        Err(panic) => {
            examination.fail(format!("the generator panics: {panic}"), "");
            return examination;
        }
    }
    let run = caught(|| {
        match (
            Interpreter::<N>::new(model),
            SerialChain::<N>::try_from(model),
        ) {
            (Ok(programs), Ok(chain)) => {
                let exact = programs.exact();
                examination.run(arm, &programs, &chain, &exact, samples);
            }
            (Err(error), _) | (_, Err(error)) => {
                examination.fail("another number of joints", error.to_string());
            }
        }
    });
    if let Err(panic) = run {
        examination.fail(format!("a method panics: {panic}"), "");
    }
    examination
}

fn text(code: &Generated) -> String {
    code.tokens().to_string()
}

impl Examination {
    fn fail(&mut self, kind: impl Into<String>, detail: impl Into<String>) {
        let (kind, detail) = (kind.into(), detail.into());
        if self.failures.iter().all(|failure| failure.kind != kind) {
            self.failures.push(Failure { kind, detail });
        }
    }

    /// The source is Rust, and its numbers are numbers.
    fn read(&mut self, code: &Generated, joints: usize) {
        let text = text(code);
        let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
        if let Some(word) = words.find(|word| ["inf", "NaN", "INFINITY", "NAN"].contains(word)) {
            self.fail(format!("the source has {word} in it"), "");
        }
        let parsed = match joints {
            // Formatting takes longer than all else, and does the same to an arm of any size.
            1..=2 => syn::parse_file(&code.source()),
            _ => syn::parse2(code.tokens().clone()),
        };
        if let Err(error) = parsed {
            self.fail("the source is no Rust", error.to_string());
        }
    }

    fn run<const N: usize>(
        &mut self,
        arm: &Arm,
        programs: &Interpreter<N>,
        chain: &SerialChain<N>,
        exact: &Interpreter<N>,
        samples: usize,
    ) {
        let all = || states(chain).skip(arm.first_state);
        for (index, state) in all().take(STATES).enumerate() {
            self.judge(programs, chain, exact, state);
            // Absurd coordinates need no more than one go.
            let states = if index == 0 {
                special(state)
            } else {
                vec![state]
            };
            for state in states {
                self.look_for_nan("the programs", programs, &state);
                self.look_for_nan("the textbook", chain, &state);
            }
        }
        self.samples = all()
            .take(samples)
            .map(|State { q, .. }| Sample::of(programs, chain, &q))
            .collect();
    }

    fn judge<const N: usize>(
        &mut self,
        programs: &Interpreter<N>,
        chain: &SerialChain<N>,
        exact: &Interpreter<N>,
        state: State<N>,
    ) {
        let conditions = conditions(chain, &state.q);
        for judgement in judge(programs, chain, exact, state) {
            let Judgement {
                ref method,
                error,
                allowed,
            } = judgement;
            if !judgement.passes() {
                let detail = format!(
                    "{error:.1e}, allowed {allowed:.0e}, condition of M {:.0e}, of J {:.0e}, at q = {:?}",
                    conditions.mass_matrix,
                    conditions.jacobian,
                    state.q.as_slice()
                );
                self.fail(method.clone(), detail);
            }
            let worst = self.worst.as_ref().map_or(0.0, |(worst, _)| worst.excess());
            if judgement.excess() > worst {
                self.worst = Some((judgement, conditions));
            }
        }
    }

    fn look_for_nan<const N: usize>(
        &mut self,
        whose: &str,
        arm: &impl ulna::Arm<N>,
        state: &State<N>,
    ) {
        for method in methods_with_nan(arm, state) {
            let detail = format!("at q = {:?}", state.q.as_slice());
            self.fail(format!("NaN in {whose}: {method}"), detail);
        }
    }
}
