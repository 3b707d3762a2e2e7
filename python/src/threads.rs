//! Threads: how many work on a batch, and the pools that they wait in.

use std::collections::BTreeMap;
use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::available_parallelism;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// For calls that do not say: 0 are all cores.
static DEFAULT: AtomicUsize = AtomicUsize::new(1);

/// By process and number of threads: threads are not there any more in a process that was forked.
static POOLS: Mutex<BTreeMap<(u32, usize), Arc<ThreadPool>>> = Mutex::new(BTreeMap::new());

/// Sets how many threads work on a batch where a call does not say: 1 at first, 0 for all cores.
#[pyfunction]
pub(crate) fn set_threads(threads: usize) {
    DEFAULT.store(threads, Ordering::Relaxed);
}

/// How many threads work on a batch where a call does not say.
#[pyfunction]
pub(crate) fn threads() -> usize {
    resolved(None)
}

/// What `threads` of a call comes to.
pub(crate) fn resolved(threads: Option<usize>) -> usize {
    match threads.unwrap_or_else(|| DEFAULT.load(Ordering::Relaxed)) {
        0 => available_parallelism().map_or(1, usize::from),
        threads => threads,
    }
}

/// A pool of so many threads, kept for the next call.
pub(crate) fn pool(threads: usize) -> PyResult<Arc<ThreadPool>> {
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let key = (process::id(), threads);
    if let Some(pool) = pools.get(&key) {
        return Ok(Arc::clone(pool));
    }
    let built = ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = Arc::new(built.map_err(|error| {
        PyRuntimeError::new_err(format!("cannot start {threads} threads: {error}"))
    })?);
    pools.insert(key, Arc::clone(&pool));
    Ok(pool)
}
