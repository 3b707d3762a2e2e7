//! What is integrated: the motion, and beside it the work and the impulses that must account for it.

use std::ops::{Add, Mul};

use nalgebra::SVector;

use super::dormand_prince::State;

/// The motion and its accounts, or their rates of change.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flow<const N: usize> {
    pub(super) q: SVector<f64, N>,
    pub(super) qd: SVector<f64, N>,
    /// What the joint-space momentum `(M + R) q̇` should have gained, N·m·s.
    pub(super) momentum: SVector<f64, N>,
    /// The brakes' part of it.
    pub(super) brake_impulse: SVector<f64, N>,
    pub(super) work: Work,
}

/// Work done on the arm, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// By the motors.
    pub motors: f64,
    /// By the brakes. Above 0 where a joint would stop sooner by itself, and its brake drags it along the profile.
    pub brakes: f64,
    /// By what the tool touches: minus the work of the tool's wrench on it.
    pub tool: f64,
    /// By gravity: minus the change of potential energy.
    pub gravity: f64,
    /// By the joints' friction: never above 0.
    pub friction: f64,
}

impl Work {
    /// All of it.
    pub fn total(&self) -> f64 {
        self.motors + self.brakes + self.tool + self.gravity + self.friction
    }

    /// The largest of the five, without its sign.
    pub(super) fn largest(&self) -> f64 {
        let Self {
            motors,
            brakes,
            tool,
            gravity,
            friction,
        } = *self;
        [motors, brakes, tool, gravity, friction]
            .into_iter()
            .fold(0.0, |largest, work| work.abs().max(largest))
    }
}

impl Add for Work {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            motors: self.motors + other.motors,
            brakes: self.brakes + other.brakes,
            tool: self.tool + other.tool,
            gravity: self.gravity + other.gravity,
            friction: self.friction + other.friction,
        }
    }
}

impl Mul<f64> for Work {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            motors: self.motors * factor,
            brakes: self.brakes * factor,
            tool: self.tool * factor,
            gravity: self.gravity * factor,
            friction: self.friction * factor,
        }
    }
}

impl<const N: usize> Flow<N> {
    pub(super) fn new(q: SVector<f64, N>, qd: SVector<f64, N>) -> Self {
        Self {
            q,
            qd,
            momentum: SVector::zeros(),
            brake_impulse: SVector::zeros(),
            work: Work::default(),
        }
    }

    fn entries(&self) -> impl Iterator<Item = f64> {
        let work = &self.work;
        [&self.q, &self.qd, &self.momentum, &self.brake_impulse]
            .into_iter()
            .flat_map(|vector| vector.iter().copied())
            .chain([work.motors, work.brakes, work.tool])
            .chain([work.gravity, work.friction])
    }
}

impl<const N: usize> Add for Flow<N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            q: self.q + other.q,
            qd: self.qd + other.qd,
            momentum: self.momentum + other.momentum,
            brake_impulse: self.brake_impulse + other.brake_impulse,
            work: self.work + other.work,
        }
    }
}

impl<const N: usize> Mul<f64> for Flow<N> {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            q: self.q * factor,
            qd: self.qd * factor,
            momentum: self.momentum * factor,
            brake_impulse: self.brake_impulse * factor,
            work: self.work * factor,
        }
    }
}

impl<const N: usize> State for Flow<N> {
    fn relative(&self, error: &Self) -> f64 {
        self.entries()
            .zip(error.entries())
            .map(|(value, error)| error.abs() / (1.0 + value.abs()))
            // Unlike f64::max, this keeps a NaN.
            .fold(0.0, |worst: f64, error| {
                if error <= worst || worst.is_nan() {
                    worst
                } else {
                    error
                }
            })
    }
}
