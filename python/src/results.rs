//! [`Results`]: arrays that are made, or that were given as `out`, and what is run into them.

use numpy::ndarray::{ArrayD, ArrayViewMutD, IxDyn, ShapeBuilder as _};
use numpy::prelude::*;
use numpy::{PyArrayDyn, PyReadwriteArrayDyn};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arguments::{Arguments, is_in_rows, shape_text};
use crate::parts::{Part, parts};
use crate::run::{Layout, Target, Work};

/// What shape the arrays of a method's parts have.
struct Shapes<'a> {
    parts: &'a [Part],
    batch: &'a [usize],
    joints: usize,
}

impl Shapes<'_> {
    fn of(&self, part: &Part) -> Vec<usize> {
        [self.batch, &part.shape(self.joints)].concat()
    }

    fn numbers(&self, part: &Part) -> usize {
        self.batch.iter().product::<usize>() * part.in_array(self.joints)
    }
}

/// Runs `work` without Python's lock, into new arrays or into `out`.
pub(crate) fn run<'py>(
    py: Python<'py>,
    work: &Work<'_>,
    arguments: &Arguments<'_>,
    out: Option<&Bound<'py, PyAny>>,
    threads: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let shapes = Shapes {
        parts: parts(work.method),
        batch: &arguments.batch,
        joints: work.backend.joints(),
    };
    match out {
        None => run_new(py, work, &shapes, threads),
        Some(out) => run_into(py, work, &shapes, out, threads),
    }
}

/// New arrays: matrices stand in them by columns, as they are computed.
fn run_new<'py>(
    py: Python<'py>,
    work: &Work<'_>,
    shapes: &Shapes<'_>,
    threads: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let mut numbers: Vec<Vec<f64>> = shapes
        .parts
        .iter()
        .map(|part| vec![0.0; shapes.numbers(part)])
        .collect();
    py.detach(|| {
        let target = match (shapes.parts, &mut *numbers) {
            ([part], [numbers]) if part.computed(1) == part.in_array(1) => Target::Whole(numbers),
            (_, several) => Target::Parts(
                several
                    .iter_mut()
                    .map(|numbers| (numbers.as_mut_slice(), Layout::Columns))
                    .collect(),
            ),
        };
        work.run(target, threads)
    })?;
    let arrays = shapes.parts.iter().zip(numbers);
    let arrays = arrays.map(|(part, numbers)| array(py, part, shapes.of(part), numbers));
    let mut arrays: Vec<Bound<'py, PyAny>> = arrays.collect::<PyResult<_>>()?;
    match arrays.len() {
        1 => Ok(arrays.remove(0)),
        _ => Ok(PyTuple::new(py, arrays)?.into_any()),
    }
}

/// An array of numbers as they are computed, without a copy; a number alone as NumPy's own kind of number.
fn array<'py>(
    py: Python<'py>,
    part: &Part,
    shape: Vec<usize>,
    numbers: Vec<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let mut strides = vec![1; shape.len()];
    for axis in (1..shape.len()).rev() {
        strides[axis - 1] = strides[axis] * shape[axis];
    }
    if let ([.., row, column], [.., rows, _], true) = (&mut *strides, &*shape, part.is_matrix()) {
        (*row, *column) = (1, *rows);
    }
    let is_number = shape.is_empty();
    let array = if numbers.is_empty() {
        ArrayD::zeros(shape)
    } else {
        ArrayD::from_shape_vec(IxDyn(&shape).strides(IxDyn(&strides)), numbers)
            .map_err(|error| PyValueError::new_err(error.to_string()))?
    };
    let array = PyArrayDyn::from_owned_array(py, array).into_any();
    match is_number {
        true => array.get_item(PyTuple::empty(py)),
        false => Ok(array),
    }
}

/// An array that was given, with numbers that go there in the end if they cannot go there at once.
struct Given<'py> {
    array: PyReadwriteArrayDyn<'py, f64>,
    layout: Layout,
    aside: Option<Vec<f64>>,
}

fn run_into<'py>(
    py: Python<'py>,
    work: &Work<'_>,
    shapes: &Shapes<'_>,
    out: &Bound<'py, PyAny>,
    threads: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let objects = match shapes.parts {
        [_] => vec![out.clone()],
        several => several_of(out, several.len())?,
    };
    let given = shapes.parts.iter().zip(&objects).enumerate();
    let given = given.map(|(place, (part, object))| {
        let name = match shapes.parts {
            [_] => "out".to_owned(),
            _ => format!("out[{place}]"),
        };
        Given::read(&name, part, shapes, object)
    });
    let mut given: Vec<Given<'py>> = given.collect::<PyResult<_>>()?;
    let mut targets = Vec::new();
    for given in &mut given {
        targets.push(given.target()?);
    }
    let mut whole = Vec::new();
    py.detach(|| {
        let target = match (shapes.parts, &mut *targets) {
            ([part], [(_, Layout::Columns)]) if part.computed(1) == part.in_array(1) => {
                whole.extend(targets.pop());
                whole.pop().map_or_else(
                    || Target::Parts(Vec::new()),
                    |(numbers, _)| Target::Whole(numbers),
                )
            }
            _ => Target::Parts(targets),
        };
        work.run(target, threads)
    })?;
    for (part, given) in shapes.parts.iter().zip(&mut given) {
        given.finish(part, shapes)?;
    }
    Ok(out.clone())
}

/// As many arrays as a result has parts.
fn several_of<'py>(out: &Bound<'py, PyAny>, parts: usize) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let wrong = |found: String| {
        PyTypeError::new_err(format!(
            "out: expected a tuple of {parts} arrays, found {found}"
        ))
    };
    let Ok(tuple) = out.cast::<PyTuple>() else {
        return Err(wrong(out.get_type().to_string()));
    };
    if tuple.len() != parts {
        return Err(wrong(format!("one of {}", tuple.len())));
    }
    Ok(tuple.iter().collect())
}

impl<'py> Given<'py> {
    fn read(
        name: &str,
        part: &Part,
        shapes: &Shapes<'_>,
        object: &Bound<'py, PyAny>,
    ) -> PyResult<Self> {
        let Ok(array) = object.cast::<PyArrayDyn<f64>>() else {
            let found = match object.getattr("dtype") {
                Ok(dtype) => format!("an array of {dtype}"),
                Err(_) => object.get_type().to_string(),
            };
            return Err(PyTypeError::new_err(format!(
                "{name}: expected an array of float64, found {found}"
            )));
        };
        let expected = shapes.of(part);
        if array.shape() != expected {
            return Err(PyValueError::new_err(format!(
                "{name}: expected shape {}, found {}",
                shape_text(&expected),
                shape_text(array.shape())
            )));
        }
        if !array.data().is_aligned() {
            return Err(PyValueError::new_err(format!(
                "{name}: its numbers do not stand where doubles may"
            )));
        }
        let written = array.try_readwrite().map_err(|_| {
            PyValueError::new_err(format!(
                "{name}: cannot be written to: it is read-only, or shares memory with an argument or another array of `out`"
            ))
        });
        let by_columns = part.is_matrix() && is_by_columns(array)?;
        let layout = match part.is_matrix() && !by_columns {
            true => Layout::Rows,
            false => Layout::Columns,
        };
        let at_once = by_columns || is_in_rows(array);
        Ok(Self {
            array: written?,
            layout,
            aside: (!at_once).then(|| vec![0.0; shapes.numbers(part)]),
        })
    }

    /// Where its numbers are computed to.
    fn target(&mut self) -> PyResult<(&mut [f64], Layout)> {
        let layout = self.layout;
        if let Some(aside) = &mut self.aside {
            return Ok((aside, Layout::Rows));
        }
        if layout == Layout::Rows {
            return Ok((self.array.as_slice_mut()?, layout));
        }
        // In memory order: it is contiguous, by columns.
        let numbers = self.array.as_array_mut();
        let numbers = numbers.into_slice_memory_order();
        let gone = || PyValueError::new_err("out: not contiguous");
        Ok((numbers.ok_or_else(gone)?, layout))
    }

    /// What was put aside is laid down.
    fn finish(&mut self, part: &Part, shapes: &Shapes<'_>) -> PyResult<()> {
        if let Some(aside) = self.aside.take() {
            let computed = ArrayD::from_shape_vec(IxDyn(&shapes.of(part)), aside)
                .map_err(|error| PyValueError::new_err(error.to_string()))?;
            let mut array: ArrayViewMutD<'_, f64> = self.array.as_array_mut();
            array.assign(&computed);
        }
        Ok(())
    }
}

/// Whether its matrices stand in memory one after another, each by columns.
fn is_by_columns(array: &Bound<'_, PyArrayDyn<f64>>) -> PyResult<bool> {
    let axes = array.ndim();
    let swapped = array.call_method1("swapaxes", (axes - 1, axes - 2))?;
    Ok(swapped.cast_into::<PyArrayDyn<f64>>()?.is_c_contiguous())
}
