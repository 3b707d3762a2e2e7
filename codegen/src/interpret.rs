//! The generated programs, run as they are without a compiler: `ulna verify` proves a table's code this way.

use std::marker::PhantomData;

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, SMatrix, SVector, Translation3};
use ulna::arm::coordinates::coordinates;
use ulna::{Arm, SerialChain, TaskRows};
use ulna_table::Model;

use crate::Method;
use crate::accuracy::{Conditioned, Scalar, read};
use crate::double_double::DoubleDouble;

/// An arm that evaluates its programs step by step, on the scalars `R`; results are rounded to `f64`.
#[derive(Debug)]
pub struct Interpreter<const N: usize, R = f64> {
    chain: SerialChain<N>,
    methods: Vec<Method>,
    conditioned: Option<Conditioned>,
    scalar: PhantomData<R>,
}

/// An arm without rounding errors but those of its results: its programs run in [`DoubleDouble`].
pub type Exact<const N: usize> = Interpreter<N, DoubleDouble>;

/// What the programs' arguments are read from.
struct Arguments<const N: usize> {
    q: SVector<f64, N>,
    qd: SVector<f64, N>,
    qdd: SVector<f64, N>,
    tau: SVector<f64, N>,
}

impl<const N: usize, R: Scalar> Interpreter<N, R> {
    /// The arm of `model`.
    ///
    /// # Errors
    /// When the model has another number of joints than `N`.
    pub fn new(model: &Model) -> Result<Self, ulna_table::JointCountError> {
        let chain = SerialChain::try_from(model)?;
        let crate::Compiled {
            methods,
            conditioned,
            ..
        } = crate::compile(model);
        Ok(Self {
            chain,
            methods,
            conditioned,
            scalar: PhantomData,
        })
    }

    /// The factor of ε and of the condition number that bounds the errors of w_D and ∇w_D, as the generated file states it.
    pub fn stated_factor(&self) -> Option<f64> {
        self.conditioned.map(|conditioned| conditioned.factor)
    }

    /// The results of a method, each output as a row of numbers.
    fn run(&self, method: &str, arguments: &Arguments<N>) -> Vec<Vec<f64>> {
        let Some(Method { program, .. }) = self.methods.iter().find(|m| m.name == method) else {
            return Vec::new();
        };
        let Arguments { q, qd, qdd, tau } = arguments;
        let others = [qd, qdd, tau].map(SVector::as_slice);
        let mut all = program
            .evaluate(R::number, |input, angles| {
                read::<R>(input, angles, q.as_slice(), others)
            })
            .into_iter()
            .map(R::to_f64);
        let lengths = program.outputs.iter().map(|output| output.elements.len());
        lengths
            .map(|length| all.by_ref().take(length).collect())
            .collect()
    }

    fn at(&self, q: &SVector<f64, N>) -> Arguments<N> {
        Arguments {
            q: R::coordinates(&self.chain, q),
            qd: SVector::zeros(),
            qdd: SVector::zeros(),
            tau: SVector::zeros(),
        }
    }
}

fn matrices<const R: usize, const C: usize, const K: usize>(
    elements: &[f64],
) -> [SMatrix<f64, R, C>; K] {
    std::array::from_fn(|k| SMatrix::from_column_slice(&elements[k * R * C..(k + 1) * R * C]))
}

impl<const N: usize, R: Scalar> Interpreter<N, R> {
    /// w_D and ∇w_D, from the outputs `value`, `gradient` and `volume`.
    fn settled(&self, q: &SVector<f64, N>, outputs: &[Vec<f64>]) -> (f64, SVector<f64, N>) {
        if self.is_singular(q, &outputs[2]) {
            (0.0, SVector::zeros())
        } else {
            (outputs[0][0], SVector::from_column_slice(&outputs[1]))
        }
    }

    fn is_singular(&self, q: &SVector<f64, N>, volume: &[f64]) -> bool {
        let q = coordinates(&self.chain, &q.data.0[0]);
        self.chain.is_singular(&q, volume[0])
    }
}

impl<const N: usize, R: Scalar> Arm<N> for Interpreter<N, R> {
    fn task(&self) -> TaskRows {
        self.chain.task
    }

    fn rated_torque(&self) -> SVector<f64, N> {
        self.chain.rated_torque()
    }

    fn forward_kinematics(&self, q: &SVector<f64, N>) -> IsometryMatrix3<f64> {
        let outputs = self.run("forward_kinematics", &self.at(q));
        IsometryMatrix3::from_parts(
            Translation3::new(outputs[1][0], outputs[1][1], outputs[1][2]),
            Rotation3::from_matrix_unchecked(Matrix3::from_column_slice(&outputs[0])),
        )
    }

    fn geometric_jacobian(&self, q: &SVector<f64, N>) -> SMatrix<f64, 6, N> {
        SMatrix::from_column_slice(&self.run("geometric_jacobian", &self.at(q))[0])
    }

    fn jacobian_derivatives(&self, q: &SVector<f64, N>) -> [SMatrix<f64, 6, N>; N] {
        matrices(&self.run("jacobian_derivatives", &self.at(q))[0])
    }

    fn mass_matrix(&self, q: &SVector<f64, N>) -> SMatrix<f64, N, N> {
        SMatrix::from_column_slice(&self.run("mass_matrix", &self.at(q))[0])
    }

    fn mass_matrix_derivatives(&self, q: &SVector<f64, N>) -> [SMatrix<f64, N, N>; N] {
        matrices(&self.run("mass_matrix_derivatives", &self.at(q))[0])
    }

    fn dynamic_manipulability(&self, q: &SVector<f64, N>) -> f64 {
        let outputs = self.run("dynamic_manipulability", &self.at(q));
        if self.is_singular(q, &outputs[1]) {
            0.0
        } else {
            outputs[0][0]
        }
    }

    fn dynamic_manipulability_gradient(&self, q: &SVector<f64, N>) -> (f64, SVector<f64, N>) {
        self.settled(q, &self.run("dynamic_manipulability_gradient", &self.at(q)))
    }

    fn inverse_dynamics(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        qdd: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let (qd, qdd) = (*qd, *qdd);
        let arguments = Arguments {
            qd,
            qdd,
            ..self.at(q)
        };
        SVector::from_column_slice(&self.run("inverse_dynamics", &arguments)[0])
    }

    fn bias_force(&self, q: &SVector<f64, N>, qd: &SVector<f64, N>) -> SVector<f64, N> {
        let arguments = Arguments {
            qd: *qd,
            ..self.at(q)
        };
        SVector::from_column_slice(&self.run("bias_force", &arguments)[0])
    }

    fn gravity_torque(&self, q: &SVector<f64, N>) -> SVector<f64, N> {
        SVector::from_column_slice(&self.run("gravity_torque", &self.at(q))[0])
    }

    fn forward_dynamics(
        &self,
        q: &SVector<f64, N>,
        qd: &SVector<f64, N>,
        tau: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        let (qd, tau) = (*qd, *tau);
        let arguments = Arguments {
            qd,
            tau,
            ..self.at(q)
        };
        SVector::from_column_slice(&self.run("forward_dynamics", &arguments)[0])
    }

    fn mass_matrix_and_derivatives(
        &self,
        q: &SVector<f64, N>,
    ) -> (SMatrix<f64, N, N>, [SMatrix<f64, N, N>; N]) {
        let outputs = self.run("mass_matrix_and_derivatives", &self.at(q));
        (
            SMatrix::from_column_slice(&outputs[0]),
            matrices(&outputs[1]),
        )
    }

    fn jacobian_and_gradient(
        &self,
        q: &SVector<f64, N>,
    ) -> (SMatrix<f64, 6, N>, f64, SVector<f64, N>) {
        let outputs = self.run("jacobian_and_gradient", &self.at(q));
        let (w, gradient) = self.settled(q, &outputs[1..]);
        (SMatrix::from_column_slice(&outputs[0]), w, gradient)
    }
}
