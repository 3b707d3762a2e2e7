//! [`Arguments`]: arrays as they were given, read, checked and broadcast against each other.

use numpy::prelude::*;
use numpy::{PyArrayDyn, PyReadonlyArrayDyn};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use ulna::{Argument, Method};

use crate::run::Numbers;

/// The arguments of a method, for one state or for a batch.
pub(crate) struct Arguments<'py> {
    /// The axes before the last of every array.
    pub(crate) batch: Vec<usize>,
    read: Vec<Read<'py>>,
}

/// An array in rows, of doubles where doubles may stand, lent by Python as long as this lives.
struct Read<'py> {
    array: PyReadonlyArrayDyn<'py, f64>,
    /// Whether its one state is that of the whole batch.
    is_one: bool,
}

impl<'py> Arguments<'py> {
    /// Reads `given` as the arguments of `method`.
    pub(crate) fn read(
        method: Method,
        joints: usize,
        given: &Bound<'py, PyTuple>,
    ) -> PyResult<Self> {
        let expected = method.arguments();
        if given.len() != expected.len() {
            return Err(PyTypeError::new_err(format!(
                "{method}: {} arguments given, {} taken",
                given.len(),
                expected.len()
            )));
        }
        let pairs = expected.iter().zip(given);
        let arrays: Vec<_> = pairs
            .map(|(argument, object)| in_rows(*argument, joints, &object))
            .collect::<PyResult<_>>()?;
        let batch = broadcast(expected, &arrays)?;
        let states: usize = batch.iter().product();
        let read = arrays.into_iter().map(|array| {
            let own = leading(&array);
            let is_one = own.iter().product::<usize>() == 1 && states != 1;
            let array = if is_one || own.iter().product::<usize>() == states {
                array
            } else {
                repeated(&array, &batch)?
            };
            let array = lent(&array)?;
            Ok(Read { array, is_one })
        });
        let read = read.collect::<PyResult<_>>()?;
        Ok(Self { batch, read })
    }

    /// How many states they are of.
    pub(crate) fn states(&self) -> usize {
        self.batch.iter().product()
    }

    /// Their numbers, in the method's order.
    pub(crate) fn numbers(&self) -> PyResult<Vec<Numbers<'_>>> {
        self.read.iter().map(Read::numbers).collect()
    }
}

impl Read<'_> {
    fn numbers(&self) -> PyResult<Numbers<'_>> {
        let numbers = self.array.as_slice()?;
        Ok(match self.is_one {
            true => Numbers::OfAll(numbers),
            false => Numbers::OfEach(numbers),
        })
    }
}

/// The array itself if it is one of doubles in rows; else a copy that is.
fn in_rows<'py>(
    argument: Argument,
    joints: usize,
    object: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let as_it_is = object.cast::<PyArrayDyn<f64>>().ok();
    let array = match as_it_is.filter(|array| is_in_rows(array)) {
        Some(array) => array.clone(),
        None => copied(argument, object)?,
    };
    let length = argument.length(joints);
    if array.shape().last() != Some(&length) {
        let name = argument.name();
        return Err(PyValueError::new_err(format!(
            "{name}: expected shape ({length},) or (..., {length}), found {}",
            shape_text(array.shape())
        )));
    }
    Ok(array)
}

/// Whether its numbers stand one after another, where doubles may.
pub(crate) fn is_in_rows(array: &Bound<'_, PyArrayDyn<f64>>) -> bool {
    array.is_c_contiguous() && array.data().is_aligned()
}

/// Whatever NumPy makes numbers of, if they are no others as doubles.
fn copied<'py>(
    argument: Argument,
    object: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let py = object.py();
    let name = argument.name();
    let numpy = py.import("numpy")?;
    let array = numpy
        .call_method1("asarray", (object,))
        .map_err(|error| PyValueError::new_err(format!("{name}: {}", error.value(py))))?;
    let dtype = array.getattr("dtype")?;
    let casting = (&dtype, "float64", "same_kind");
    if !numpy.call_method1("can_cast", casting)?.extract::<bool>()? {
        return Err(PyTypeError::new_err(format!(
            "{name}: expected numbers that float64 can hold, found an array of {dtype}"
        )));
    }
    // A number alone would become an array of one.
    if array.getattr("ndim")?.extract::<usize>()? == 0 {
        return Err(PyValueError::new_err(format!(
            "{name}: expected an array, found a single number"
        )));
    }
    let wanted = PyDict::new(py);
    wanted.set_item("dtype", "float64")?;
    wanted.set_item("requirements", ("C", "A"))?;
    let array = numpy.call_method("require", (array,), Some(&wanted))?;
    Ok(array.cast_into::<PyArrayDyn<f64>>()?)
}

/// The shape that all arrays before their last axis have or are repeated to.
fn broadcast(expected: &[Argument], arrays: &[Bound<'_, PyArrayDyn<f64>>]) -> PyResult<Vec<usize>> {
    let axes = arrays.iter().map(|array| leading(array).len()).max();
    let mut batch = vec![1; axes.unwrap_or(0)];
    for array in arrays {
        let own = leading(array);
        let first = batch.len() - own.len();
        for (common, own) in batch[first..].iter_mut().zip(own) {
            match (*common, *own) {
                (_, 1) => {}
                (1, own) => *common = own,
                (common, own) if common == own => {}
                _ => return Err(mismatch(expected, arrays)),
            }
        }
    }
    Ok(batch)
}

fn mismatch(expected: &[Argument], arrays: &[Bound<'_, PyArrayDyn<f64>>]) -> PyErr {
    let names: Vec<&str> = expected.iter().map(|argument| argument.name()).collect();
    let shapes: Vec<String> = arrays.iter().map(|it| shape_text(it.shape())).collect();
    PyValueError::new_err(format!(
        "{}: the shapes {} cannot be broadcast together but for the last axis",
        names.join(", "),
        shapes.join(", ")
    ))
}

/// The axes before the last.
fn leading<'a>(array: &'a Bound<'_, PyArrayDyn<f64>>) -> &'a [usize] {
    array
        .shape()
        .split_last()
        .map_or(&[], |(_, leading)| leading)
}

/// The array repeated along the axes of `batch`, in rows.
fn repeated<'py>(
    array: &Bound<'py, PyArrayDyn<f64>>,
    batch: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let numpy = array.py().import("numpy")?;
    let length = array.shape().last().copied();
    let shape = batch.iter().copied().chain(length);
    let shape = PyTuple::new(array.py(), shape.collect::<Vec<_>>())?;
    let view = numpy.call_method1("broadcast_to", (array, shape))?;
    let rows = numpy.call_method1("ascontiguousarray", (view,))?;
    Ok(rows.cast_into::<PyArrayDyn<f64>>()?)
}

/// The array as something that nobody writes to meanwhile.
fn lent<'py>(array: &Bound<'py, PyArrayDyn<f64>>) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    let lent = array.try_readonly();
    lent.map_err(|_| PyValueError::new_err("an argument is being written to by another call"))
}

/// A shape as Python writes it.
pub(crate) fn shape_text(shape: &[usize]) -> String {
    let lengths: Vec<String> = shape.iter().map(ToString::to_string).collect();
    match &*lengths {
        [only] => format!("({only},)"),
        several => format!("({})", several.join(", ")),
    }
}
