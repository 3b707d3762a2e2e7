//! [`Arm`]: an arm of a table or a description, as the package's class `Arm` holds it.

use std::sync::{Arc, OnceLock};

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use ulna::{JointKind, Method, Payload, PayloadError, Placement, TaskRow};
use ulna_codegen::{Abi, Generator, Precision};
use ulna_experiments::{Subject, by_table};
use ulna_jit::AnyJit;
use ulna_table::Model;

use crate::arguments::Arguments;
use crate::errors::ExperimentError;
use crate::run::Work;
use crate::{reports, results, threads};

/// The native half of `ulna.Arm`.
#[pyclass(frozen, module = "ulna._ulna")]
pub(crate) struct Arm {
    model: Arc<Model>,
    text: String,
    source: String,
    notes: Vec<String>,
    payload: Option<Payload>,
    /// Made when a method is called for the first time.
    backend: OnceLock<AnyJit>,
    /// Made for the first experiment.
    subject: OnceLock<Arc<dyn Subject>>,
}

impl Arm {
    pub(crate) fn new(model: Model, text: String, source: String, notes: Vec<String>) -> Self {
        Self {
            model: Arc::new(model),
            text,
            source,
            notes,
            payload: None,
            backend: OnceLock::new(),
            subject: OnceLock::new(),
        }
    }

    pub(crate) fn model(&self) -> &Model {
        &self.model
    }

    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    pub(crate) fn source(&self) -> &str {
        &self.source
    }

    fn backend(&self, py: Python<'_>) -> PyResult<&AnyJit> {
        if let Some(backend) = self.backend.get() {
            return Ok(backend);
        }
        let compiled = py
            .detach(|| AnyJit::compile(&self.model))
            .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        // Another thread may have been as quick; what it has made is the same.
        Ok(self.backend.get_or_init(|| compiled))
    }

    /// The arm for experiments.
    ///
    /// # Errors
    /// More joints than experiments are compiled for; or a payload, which none of them knows.
    pub(crate) fn subject(&self, py: Python<'_>) -> PyResult<Arc<dyn Subject>> {
        if let Some(subject) = self.subject.get() {
            return Ok(Arc::clone(subject));
        }
        if self.payload.is_some() {
            return Err(ExperimentError::new_err(format!(
                "experiments are made with `{}` as its table has it, without a payload at run time: write the body into its last link",
                self.name()
            )));
        }
        let made = py
            .detach(|| by_table(&self.model))
            .map_err(|error| ExperimentError::new_err(error.to_string()))?;
        let subject = Arc::from(made.subject);
        Ok(Arc::clone(self.subject.get_or_init(|| subject)))
    }
}

#[pymethods]
impl Arm {
    #[getter]
    fn name(&self) -> &str {
        self.model.name()
    }

    #[getter]
    fn n(&self) -> usize {
        self.model.joints().len()
    }

    #[getter]
    fn joint_names(&self) -> Vec<String> {
        self.model.joint_names().to_vec()
    }

    #[getter]
    fn joint_kinds(&self) -> Vec<&'static str> {
        let joints = self.model.joints().iter();
        let kinds = joints.map(|joint| match joint.kind {
            JointKind::Revolute => "revolute",
            JointKind::Prismatic => "prismatic",
        });
        kinds.collect()
    }

    /// Lower, upper, velocity.
    #[getter]
    fn limits(&self) -> [Vec<f64>; 3] {
        let of = |number: fn(&ulna::Limits) -> f64| {
            let joints = self.model.joints().iter();
            joints.map(|joint| number(&joint.limits)).collect()
        };
        [of(|it| it.lower), of(|it| it.upper), of(|it| it.velocity)]
    }

    #[getter]
    fn rated_torque(&self) -> Vec<f64> {
        let joints = self.model.joints().iter();
        joints
            .map(|joint| joint.rated_torque.unwrap_or(f64::INFINITY))
            .collect()
    }

    #[getter]
    fn gravity(&self) -> [f64; 3] {
        self.model.gravity()
    }

    #[getter]
    fn task(&self) -> Vec<&'static str> {
        self.model.task().iter().map(TaskRow::name).collect()
    }

    /// `world_from_base` and `frame_N_from_tool`.
    #[getter]
    fn ends(&self) -> [[[f64; 4]; 4]; 2] {
        [self.model.base(), self.model.tool()].map(homogeneous)
    }

    #[getter]
    fn table(&self) -> &str {
        &self.text
    }

    #[getter]
    fn file(&self) -> &str {
        &self.source
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    #[getter]
    fn takes_payload(&self) -> bool {
        self.model.has_payload()
    }

    /// Mass, centroid and inertia.
    #[getter]
    fn payload(&self) -> Option<(f64, [f64; 3], [[f64; 3]; 3])> {
        let payload = self.payload.as_ref()?;
        Some((payload.mass(), payload.com(), payload.inertia()))
    }

    fn carrying(
        &self,
        py: Python<'_>,
        mass: f64,
        com: [f64; 3],
        inertia: [[f64; 3]; 3],
    ) -> PyResult<Self> {
        let refused = |error: PayloadError| PyValueError::new_err(error.to_string());
        let payload = Payload::new(mass, com, inertia).map_err(refused)?;
        let carrying = self.backend(py)?.carrying(&payload).map_err(refused)?;
        Ok(Self {
            model: Arc::clone(&self.model),
            text: self.text.clone(),
            source: self.source.clone(),
            notes: self.notes.clone(),
            backend: carrying.into(),
            subject: OnceLock::new(),
            payload: Some(payload),
        })
    }

    #[pyo3(signature = (method, arguments, out, threads))]
    fn call<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        arguments: &Bound<'py, PyTuple>,
        out: Option<&Bound<'py, PyAny>>,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let method = named(method)?;
        let backend = self.backend(py)?;
        let arguments = Arguments::read(method, backend.joints(), arguments)?;
        let work = Work {
            backend,
            method,
            arguments: arguments.numbers()?,
            states: arguments.states(),
        };
        results::run(py, &work, &arguments, out, threads::resolved(threads))
    }

    /// Rust, of all methods or of some.
    fn generate_rust(&self, py: Python<'_>, methods: Option<Vec<String>>) -> PyResult<String> {
        let generator = generator(methods)?;
        Ok(py.detach(|| generator.generate(&self.model, &self.source).source()))
    }

    /// C, of all methods or of some: the header and the source file.
    fn generate_c(
        &self,
        py: Python<'_>,
        methods: Option<Vec<String>>,
        options: COptions,
    ) -> PyResult<(String, String)> {
        let generator = generator(methods)?;
        let options = options.checked()?;
        let c = py.detach(|| generator.generate_c(&self.model, &self.source, options));
        Ok((c.header().to_owned(), c.source().to_owned()))
    }

    fn cost<'py>(
        &self,
        py: Python<'py>,
        methods: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let generator = generator(methods)?;
        let compiled = py.detach(|| generator.compile(&self.model));
        reports::cost(py, &self.model, &compiled)
    }

    fn verify<'py>(
        &self,
        py: Python<'py>,
        samples: usize,
        methods: Option<Vec<String>>,
    ) -> PyResult<Vec<reports::Report>> {
        let generator = generator(methods)?;
        py.detach(|| reports::verify(&self.model, generator, samples))
    }
}

/// How C is written.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct COptions {
    float: bool,
    casadi: bool,
    function_length: usize,
}

impl COptions {
    fn checked(self) -> PyResult<ulna_codegen::COptions> {
        let shortest = ulna_codegen::COptions::SHORTEST;
        if self.function_length < shortest {
            return Err(PyValueError::new_err(format!(
                "function_length: expected {shortest} or more, found {}",
                self.function_length
            )));
        }
        let options = ulna_codegen::COptions::new().function_length(self.function_length);
        let options = match self.float {
            true => options.precision(Precision::Float),
            false => options,
        };
        Ok(match self.casadi {
            true => options.abi(Abi::Casadi),
            false => options,
        })
    }
}

/// What generates those methods, or all.
fn generator(methods: Option<Vec<String>>) -> PyResult<Generator> {
    let Some(names) = methods else {
        return Ok(Generator::new());
    };
    let methods: Vec<Method> = names
        .iter()
        .map(|name| named(name))
        .collect::<PyResult<_>>()?;
    Ok(Generator::new().methods(&methods))
}

fn named(name: &str) -> PyResult<Method> {
    Generator::method(name).map_err(|error| PyValueError::new_err(error.to_string()))
}

fn homogeneous(placement: &Placement) -> [[f64; 4]; 4] {
    let Placement {
        rotation,
        translation,
    } = placement;
    let row = |i: usize| {
        let [x, y, z] = rotation[i];
        [x, y, z, translation[i]]
    };
    [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
}
