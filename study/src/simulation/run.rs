//! A run under way: from event to event, with samples on the way.

use std::ops::Range;

use nalgebra::{ComplexField, SVector, Vector6};

use super::dormand_prince::{Step, Stepper, Stop};
use super::flow::Flow;
use super::motion::{Command, Phase, Stage};
use super::peak::Peaks;
use super::{Control, Ending, Impact, Resolution, Sample, Simulation, ideal_lock};
use ulna::control::trajectory::Trajectory;
use ulna::{Arm, LockedJoints, Status};

pub(super) struct Run<'a, 's, P: ?Sized, A: ?Sized, T, W, const N: usize> {
    simulation: &'a Simulation<'s, P, A, T, W, N>,
    resolution: &'a Resolution,
    /// Behind a pointer, so that a run is compiled once, whoever looks on.
    observe: &'a mut dyn FnMut(&Sample<N>),
    /// The end of the run, s after the failure. All times of a run count from there: a short brake's are not rounded then
    /// as the time of day is.
    end: f64,
    pub(super) flow: Flow<N>,
    pub(super) status: Status,
    stepper: Stepper,
    /// What the motors hold between two control cycles.
    held: Option<Command<N>>,
    /// The number of the next cycle; number 0 is at the failure.
    next_cycle: f64,
    /// Known in part from the failure on, in full once `settled`.
    impact: Option<Impact<N>>,
    /// From the failure on.
    peaks: Peaks<N>,
    settled: bool,
}

impl<'a, 's, P, A, T, W, const N: usize> Run<'a, 's, P, A, T, W, N>
where
    P: Arm<N> + ?Sized,
    A: Arm<N> + ?Sized,
    T: Trajectory<N>,
    W: Fn(f64) -> Vector6<f64>,
{
    pub(super) fn new(
        simulation: &'a Simulation<'s, P, A, T, W, N>,
        resolution: &'a Resolution,
        observe: &'a mut dyn FnMut(&Sample<N>),
        flow: Flow<N>,
    ) -> Self {
        Self {
            simulation,
            resolution,
            observe,
            end: 0.0,
            flow,
            status: Status::Nominal,
            stepper: Stepper::new(resolution.tolerance, resolution.steps),
            held: None,
            next_cycle: 0.0,
            impact: None,
            peaks: Peaks::default(),
            settled: false,
        }
    }

    pub(super) fn impact(&self) -> Option<Impact<N>> {
        let impact = self.impact.filter(|_| self.settled)?;
        Some(Impact {
            peak_torque: self.peaks.torque,
            peak_brake_torque: self.peaks.brake,
            ..impact
        })
    }

    pub(super) fn steps(&self) -> u32 {
        self.stepper.taken
    }

    pub(super) fn through(&mut self, span: &Range<f64>) -> Ending {
        let failure = self.simulation.brake.failure.time;
        let start = span.start - failure;
        self.end = span.end - failure;
        if let Control::Every(period) = self.simulation.control {
            self.next_cycle = ComplexField::floor(start / period);
        }
        match self.phases(start) {
            Ok(()) => Ending::Complete,
            Err(ending) => ending,
        }
    }

    /// All phases; an `Err` as soon as one of them ends the run.
    fn phases(&mut self, start: f64) -> Result<(), Ending> {
        let brake = &self.simulation.brake;
        let (joints, duration, detection) = (brake.failure.joints, brake.duration, brake.detection);
        let none = LockedJoints::NONE;
        if joints.is_empty() {
            return self.phase(start, self.end, Stage::Free, none);
        }
        self.phase(start, 0.0, Stage::Free, none)?;
        self.fail()?;
        let braking = Stage::Braking(self.flow.qd);
        self.phase(0.0, duration.min(detection), braking, none)?;
        if detection < duration {
            self.phase(detection, duration, braking, joints)?;
            self.stand_still();
        } else {
            self.stand_still();
            self.phase(duration, detection, Stage::Locked, none)?;
        }
        let settled = duration.max(detection);
        self.settle(settled);
        self.phase(settled, self.end, Stage::Locked, joints)
    }

    /// From one event to the next; an `Err` if the run ends before.
    fn phase(
        &mut self,
        from: f64,
        to: f64,
        stage: Stage<N>,
        known: LockedJoints<N>,
    ) -> Result<(), Ending> {
        let stop = to.min(self.end);
        let length = stop - from;
        if length > 0.0 {
            let least = f64::from(self.resolution.samples_at_least.max(1));
            let samples = ComplexField::ceil(length / self.resolution.sample_period).max(least);
            self.stepper.restart(length / samples);
            let mut phase = Phase {
                stage,
                known,
                command: self.held,
            };
            let mut cycle = self.cycle_from(from, &mut phase);
            self.sample(from, &phase);
            let mut index = 1.0;
            let mut now = from;
            while now < stop {
                let sample = if index == samples {
                    stop
                } else {
                    from + length * (index / samples)
                };
                let next = sample.min(cycle);
                self.advance(now, next, &phase)?;
                now = next;
                // At an event the cycle belongs to the next phase.
                if now == cycle && now < stop {
                    cycle = self.cycle_from(now, &mut phase);
                }
                if now == sample {
                    self.sample(now, &phase);
                    index += 1.0;
                }
            }
        }
        if to > self.end {
            return Err(Ending::Complete);
        }
        Ok(())
    }

    /// Runs the control cycle that is due, if one is, and says when the next one is.
    fn cycle_from(&mut self, now: f64, phase: &mut Phase<N>) -> f64 {
        let Control::Every(period) = self.simulation.control else {
            return f64::INFINITY;
        };
        if self.next_cycle * period <= now {
            self.held = Some(self.simulation.command(now, &self.flow, phase.known));
            phase.command = self.held;
            self.next_cycle += 1.0;
        }
        self.next_cycle * period
    }

    fn advance(&mut self, from: f64, to: f64, phase: &Phase<N>) -> Result<(), Ending> {
        let simulation = self.simulation;
        let slope = |elapsed: f64, flow: &Flow<N>| simulation.instant(elapsed, flow, phase).slope;
        let failed = self.impact.is_some();
        let peaks = &mut self.peaks;
        let watch = |step: &Step<Flow<N>>| {
            if failed {
                let loads = |share: f64| {
                    let (elapsed, flow) = step.at(share);
                    simulation.instant(elapsed, &flow, phase).loads()
                };
                peaks.look(loads, matches!(phase.stage, Stage::Braking(_)));
            }
        };
        self.stepper
            .advance(&mut self.flow, from, to, slope, watch)
            .map_err(|stop| match stop {
                Stop::NotFinite => Ending::NotFinite,
                Stop::StepTooShort => Ending::StepTooShort,
            })
    }

    fn sample(&mut self, elapsed: f64, phase: &Phase<N>) {
        let sample = self.simulation.sample(elapsed, &self.flow, phase);
        self.status = self.status.max(sample.control.status);
        (self.observe)(&sample);
    }

    /// The brakes fall. Those that take no time have done their work at once.
    fn fail(&mut self) -> Result<(), Ending> {
        let simulation = self.simulation;
        let brake = &simulation.brake;
        let joints = brake.failure.joints;
        let time = brake.failure.time;
        let before = Phase {
            stage: Stage::Free,
            known: LockedJoints::NONE,
            command: None,
        };
        let torque = simulation.sample(0.0, &self.flow, &before).joint_torque();
        let (q, qd, rotors) = (&self.flow.q, &self.flow.qd, &simulation.reflected_inertia);
        let ideal = ideal_lock(simulation.plant, q, qd, joints, rotors).ok_or(Ending::NotFinite)?;

        let planned = simulation.trajectory.state(time);
        let wrench = (simulation.wrench)(time);
        let predicted = |locked| {
            simulation
                .controller
                .cycle(&planned, &wrench, locked)
                .torque
        };
        let planned_after = brake
            .failure
            .state(simulation.trajectory, time + brake.duration);
        self.impact = Some(Impact {
            ideal,
            // The first three are what there was before, until what there is afterwards is known.
            brake_impulse: self.flow.brake_impulse,
            rate_jump: self.flow.qd,
            torque_step: torque,
            planned_rate_jump: planned_after.qd - planned.qd,
            predicted_step: predicted(joints) - predicted(LockedJoints::NONE),
            // Filled in when all is over.
            peak_torque: SVector::zeros(),
            peak_brake_torque: SVector::zeros(),
        });

        if brake.duration == 0.0 {
            // While the rates jump the impulses do work at the mean of both rates.
            let mean = self.flow.qd + ideal.rate_jump * 0.5;
            self.flow.qd += ideal.rate_jump;
            self.flow.momentum += ideal.brake;
            self.flow.brake_impulse += ideal.brake;
            self.flow.work.brakes += ideal.brake.dot(&mean);
        }
        Ok(())
    }

    /// The braked joints have come to rest, up to rounding; from here on exactly.
    fn stand_still(&mut self) {
        self.flow.qd = self.simulation.brake.failure.joints.without(&self.flow.qd);
        if let Some(impact) = &mut self.impact {
            impact.brake_impulse = self.flow.brake_impulse - impact.brake_impulse;
            impact.rate_jump = self.flow.qd - impact.rate_jump;
        }
    }

    /// The brakes hold and the controller knows.
    fn settle(&mut self, elapsed: f64) {
        let phase = Phase {
            stage: Stage::Locked,
            known: self.simulation.brake.failure.joints,
            command: None,
        };
        let sample = self.simulation.sample(elapsed, &self.flow, &phase);
        if let Some(impact) = &mut self.impact {
            impact.torque_step = sample.joint_torque() - impact.torque_step;
        }
        self.settled = true;
    }
}
