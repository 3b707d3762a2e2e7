//! [`Experiment`]: a tool force and torque limits, and what stands beside its results.

use super::ToolForce;

/// A tool force and torque limits. Lists over joints have one entry for each joint of the scenario's arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    pub(super) section: String,
    pub(super) title: String,
    pub(super) force: ToolForce,
    pub(super) rated_torque: Option<Vec<f64>>,
    pub(super) step_time: f64,
    pub(super) references: Vec<Reference>,
    pub(super) figures: Vec<Figure>,
}

impl Experiment {
    /// Its number, such as the paper's "5.2": no two of a scenario are alike, and each can be part of a file's name.
    pub fn section(&self) -> &str {
        &self.section
    }

    /// A few words.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// What the tool exerts, and what a lock takes from it.
    pub fn force(&self) -> &ToolForce {
        &self.force
    }

    /// The rated torques to keep, N·m (N); `None` for no limit.
    pub fn rated_torque(&self) -> Option<&[f64]> {
        self.rated_torque.as_deref()
    }

    /// Δt of Eq. 18, s: from the last torque before the lock, at t_f, to the first after it. 0 is the limit of ever shorter ones.
    pub fn step_time(&self) -> f64 {
        self.step_time
    }

    /// Figures from elsewhere, to stand beside ours.
    pub fn references(&self) -> &[Reference] {
        &self.references
    }

    /// What to draw of it.
    pub fn figures(&self) -> &[Figure] {
        &self.figures
    }
}

/// A figure of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    pub(super) name: String,
    pub(super) kind: FigureKind,
}

impl Figure {
    /// What its files are called: `snake_case`, and no two of a scenario alike.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it shows.
    pub fn kind(&self) -> &FigureKind {
        &self.kind
    }
}

/// What a [`Figure`] shows.
#[derive(Clone, Debug, PartialEq)]
pub enum FigureKind {
    /// Torques over time, without and with suppression.
    Torque {
        /// Of these joints, counted from 0.
        joints: Vec<usize>,
        /// With the failure at this one of the failure times, s.
        time: f64,
    },
    /// The impact joint by joint, before and after, at every failure time, and the tool force over time if it varies.
    Impact,
}

/// Somebody else's figures for a failure time.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    pub(super) source: String,
    pub(super) time: f64,
    pub(super) failed_joints: Option<Vec<usize>>,
    pub(super) before: Vec<Option<f64>>,
    pub(super) after: Vec<Option<f64>>,
    pub(super) coefficients: Vec<Option<f64>>,
    pub(super) free_after: Vec<Option<f64>>,
    pub(super) decrease: Vec<Option<f64>>,
    pub(super) mean_room: Option<f64>,
}

impl Reference {
    /// Where they stand.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// The failure time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The joints that lock there, counted from 0, ascending; `None` where it is not said.
    pub fn failed_joints(&self) -> Option<&[usize]> {
        self.failed_joints.as_deref()
    }

    /// Impact torque without compensation, N·m (N), joint by joint; `None` where there is no figure.
    pub fn before(&self) -> &[Option<f64>] {
        &self.before
    }

    /// Impact torque with compensation, likewise.
    pub fn after(&self) -> &[Option<f64>] {
        &self.after
    }

    /// The coefficients k_d, likewise.
    pub fn coefficients(&self) -> &[Option<f64>] {
        &self.coefficients
    }

    /// Impact torque with the compensation that no rated torque limits, N·m (N), likewise.
    pub fn free_after(&self) -> &[Option<f64>] {
        &self.free_after
    }

    /// By how much the rated torques lower the compensation, %, likewise.
    pub fn decrease(&self) -> &[Option<f64>] {
        &self.decrease
    }

    /// What the motion leaves of the rated torques, on the mean over it and over the joints of the reference, N·m (N).
    pub fn mean_room(&self) -> Option<f64> {
        self.mean_room
    }
}
