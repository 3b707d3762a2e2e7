//! What a comparison found, method by method.

use core::fmt;

use crate::{Method, MethodSet};

/// How far a method of the candidate is from the reference's, at the state where it comes nearest to, or goes farthest beyond,
/// what is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The method of [`Arm`](crate::Arm).
    pub method: &'static str,
    /// The largest error of an entry, relative to what the terms that it is a sum of can amount to: the chain's length for
    /// positions and J's rows of v, what the joints carry for M and torques, w_D for w_D, w_D or the largest entry for ∇w_D.
    /// Forward dynamics is judged by what its accelerations need: the error is that of the torques. So are its derivatives, `M ∂q̈ + ∂τ`
    /// beside what ∂τ can amount to, and beside what it changes by where M⁻¹ makes an error of q̈ from the rounding of the torques.
    pub error: f64,
    /// What rounding alone may leave at that state: 8 (N + 4) ε, times the [condition](super::condition) number of w_D for w_D, and four times that for ∇w_D.
    pub tolerance: f64,
}

impl Deviation {
    pub(super) fn new(method: &'static str) -> Self {
        Self {
            method,
            error: 0.0,
            tolerance: 0.0,
        }
    }

    /// Whether the error is within the tolerance; a NaN is not.
    pub fn passes(&self) -> bool {
        self.error <= self.tolerance
    }

    /// Keeps the worse of this and another state's error.
    pub(super) fn add(&mut self, error: f64, tolerance: f64) {
        let excess = |error: f64, tolerance: f64| {
            if error == 0.0 { 0.0 } else { error / tolerance }
        };
        let (old, new) = (excess(self.error, self.tolerance), excess(error, tolerance));
        // NaN is never less, and stays.
        if !old.is_nan() && (new >= old || new.is_nan()) {
            (self.error, self.tolerance) = (error, tolerance);
        }
    }
}

/// The most lines that a report has: every method, and what an arm says of itself.
const LINES: usize = Method::ALL.len() + 2;

/// The outcome of a comparison: a line for each method of [`Arm`](crate::Arm). Prints as a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    states: usize,
    lines: [Deviation; LINES],
    used: usize,
}

impl Report {
    pub(super) fn new(methods: &[&'static str]) -> Self {
        let mut lines = [Deviation::new(""); LINES];
        for (line, method) in lines.iter_mut().zip(methods) {
            *line = Deviation::new(method);
        }
        Self {
            states: 0,
            lines,
            used: methods.len().min(LINES),
        }
    }

    /// Adds a state: an error and what is allowed for each line.
    pub(super) fn add(&mut self, verdicts: &[(f64, f64)]) {
        self.states += 1;
        for (line, (error, tolerance)) in self.lines.iter_mut().zip(verdicts) {
            line.add(*error, *tolerance);
        }
    }

    /// How many states were compared.
    pub fn states(&self) -> usize {
        self.states
    }

    /// The lines, in the trait's order.
    pub fn deviations(&self) -> &[Deviation] {
        &self.lines[..self.used]
    }

    /// The lines of `methods` alone, and of what an arm says of itself.
    #[must_use]
    pub fn of(mut self, methods: MethodSet) -> Self {
        let kept = |name: &str| Method::by_name(name).is_none_or(|m| methods.contains(m));
        let mut used = 0;
        for i in 0..self.used {
            if kept(self.lines[i].method) {
                self.lines[used] = self.lines[i];
                used += 1;
            }
        }
        self.used = used;
        self
    }

    /// This and a report on other states, of the same methods: as if it had gone on with those.
    #[must_use]
    pub fn and(mut self, later: &Self) -> Self {
        self.states += later.states;
        for (line, later) in self.lines.iter_mut().zip(later.deviations()) {
            line.add(later.error, later.tolerance);
        }
        self
    }

    /// Whether every method is within its tolerance, at one state at least.
    pub fn passes(&self) -> bool {
        self.states > 0 && self.deviations().iter().all(Deviation::passes)
    }
}

impl fmt::Display for Deviation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            method,
            error,
            tolerance,
        } = self;
        let verdict = if self.passes() { "ok" } else { "WRONG" };
        write!(f, "{method:34} {error:9.1e}  {tolerance:9.0e}   {verdict}")
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let states = self.states;
        writeln!(
            f,
            "{:34} {:>9}  {:>9}   ({states} states)",
            "method", "error", "allowed"
        )?;
        for deviation in self.deviations() {
            writeln!(f, "{deviation}")?;
        }
        Ok(())
    }
}
