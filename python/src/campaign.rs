//! [`Campaign`]: a scenario's campaign, in one go or in shards, as files or as bytes.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use ulna_campaign::{Part, Shipped, Watch};
use ulna_experiments::Subject;
use ulna_files::Lock;
use ulna_study::LawName;
use ulna_study::experiment::Shard;

use crate::errors::{CampaignError, ExperimentError};
use crate::experiments::Scenario;
use crate::threads::{pool, resolved};

/// The native half of `ulna.campaign`.
#[pyclass(frozen, module = "ulna._ulna")]
pub(crate) struct Campaign {
    scenario: Arc<ulna_study::Scenario>,
    subject: Arc<dyn Subject>,
}

/// A shard as its number, from 1, and how many there are; none for all cases.
type Numbers = Option<(u64, u64)>;

/// Keeps others away from a folder until it is left, as a context.
#[pyclass(frozen, module = "ulna._ulna")]
pub(crate) struct FolderLock {
    lock: Mutex<Option<Lock>>,
}

#[pymethods]
impl FolderLock {
    fn __enter__(&self) {}

    // Not when Python drops it: the frames of an exception may live on.
    fn __exit__(&self, _kind: Py<PyAny>, _error: Py<PyAny>, _traceback: Py<PyAny>) {
        drop(
            self.lock
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .take(),
        );
    }
}

impl Campaign {
    fn part(&self, folder: PathBuf, shard: Numbers) -> PyResult<Part> {
        let cases = self.scenario.campaign().cases();
        let shard = shard.map(|(number, of)| {
            let found = Shard::new(number, of).filter(|_| of <= cases);
            found.ok_or_else(|| {
                CampaignError::new_err(format!(
                    "there is no shard {number} of {of} of {cases} cases"
                ))
            })
        });
        Ok(Part::new(folder, shard.transpose()?, cases))
    }

    /// Does `work` with the campaign, without Python's lock.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&ulna_campaign::Campaign<'_>) -> anyhow::Result<T> + Send,
    ) -> PyResult<T> {
        let done = py.detach(|| {
            let campaign = ulna_campaign::Campaign::new(&*self.subject, &self.scenario)
                .map_err(Failed::Impossible)?;
            work(&campaign).map_err(Failed::Files)
        });
        done.map_err(Failed::exception)
    }
}

/// Why there are no rows.
enum Failed {
    Impossible(ulna_study::experiment::ExperimentError),
    Files(anyhow::Error),
}

impl Failed {
    fn exception(self) -> PyErr {
        match self {
            Self::Impossible(error) => ExperimentError::new_err(error.to_string()),
            // What Python itself has raised, as Ctrl-C does, goes on as it is.
            Self::Files(error) => error
                .downcast::<PyErr>()
                .unwrap_or_else(|error| CampaignError::new_err(in_python(&format!("{error:#}")))),
        }
    }
}

/// A sentence of the program's without its options.
fn in_python(text: &str) -> String {
    text.replace("--output", "output")
}

/// Tells Python how far it is, and hears from it that it is to stop. Signals such as Ctrl-C only the main thread hears, if that is
/// who called.
struct Told(Py<PyAny>);

impl Watch for Told {
    fn begins(&self, rows: u64, _: u64, _: &Path) {
        // What it says of that, it says when the next rows are written.
        let _ = self.written(rows);
    }

    fn written(&self, rows: u64) -> anyhow::Result<()> {
        Python::attach(|py| {
            py.check_signals()?;
            self.0.call1(py, (rows,))
        })?;
        Ok(())
    }
}

#[pymethods]
impl Campaign {
    /// With so many cases and that seed, or with the scenario's.
    #[new]
    fn new(
        py: Python<'_>,
        scenario: &Scenario,
        cases: Option<u64>,
        seed: Option<u64>,
    ) -> PyResult<Self> {
        let subject = scenario.subject(py)?;
        let mut scenario = (*scenario.scenario).clone();
        if let Some(cases) = cases {
            let counted = scenario.with_cases(cases);
            scenario = counted.map_err(|error| CampaignError::new_err(error.to_string()))?;
        }
        if let Some(seed) = seed {
            scenario = scenario.with_seed(seed);
        }
        Ok(Self {
            scenario: Arc::new(scenario),
            subject,
        })
    }

    #[getter]
    fn cases(&self) -> u64 {
        self.scenario.campaign().cases()
    }

    #[getter]
    fn seed(&self) -> u64 {
        self.scenario.campaign().seed()
    }

    #[getter]
    fn laws(&self) -> Vec<&'static str> {
        let laws = self.scenario.campaign().laws();
        laws.iter().map(LawName::name).collect()
    }

    /// How many cases a shard has.
    fn size(&self, number: u64, of: u64) -> PyResult<u64> {
        let range = self.part(PathBuf::new(), Some((number, of)))?.range();
        Ok(range.end - range.start)
    }

    /// Makes what is missing of a part in `folder`, and returns how many cases that were. `told` hears how many are there.
    fn make(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        shard: Numbers,
        threads: Option<usize>,
        told: &Bound<'_, PyAny>,
    ) -> PyResult<u64> {
        let part = self.part(folder, shard)?;
        let pool = pool(resolved(threads))?;
        let told = Told(told.clone().unbind());
        self.with(py, |campaign| {
            Ok(ulna_campaign::make(&part, campaign, false, &pool, &told)?.made)
        })
    }

    /// Whether a part is whole in `folder`, and good.
    fn is_there(&self, py: Python<'_>, folder: PathBuf, shard: Numbers) -> PyResult<bool> {
        let part = self.part(folder, shard)?;
        self.with(py, |campaign| ulna_campaign::is_there(&part, campaign))
    }

    /// A shard's rows and manifest, for another machine's folder.
    fn shipped<'py>(
        &self,
        py: Python<'py>,
        number: u64,
        of: u64,
        threads: Option<usize>,
        told: &Bound<'_, PyAny>,
    ) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>)> {
        let part = self.part(PathBuf::new(), Some((number, of)))?;
        let pool = pool(resolved(threads))?;
        let told = Told(told.clone().unbind());
        let shipped = self.with(py, |campaign| Shipped::make(&part, campaign, &pool, &told))?;
        Ok((
            PyBytes::new(py, &shipped.rows),
            PyBytes::new(py, &shipped.record),
        ))
    }

    /// Puts what was [`shipped`](Self::shipped) into `folder`.
    fn store(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        number: u64,
        of: u64,
        rows: Vec<u8>,
        record: Vec<u8>,
    ) -> PyResult<()> {
        let part = self.part(folder, Some((number, of)))?;
        let shipped = Shipped { rows, record };
        self.with(py, |campaign| shipped.store(&part, campaign))
    }

    /// Takes `folder` for itself, which is made if need be.
    fn lock(&self, folder: PathBuf) -> PyResult<FolderLock> {
        let part = self.part(folder, None)?;
        let folder = part.folder();
        let taken = std::fs::create_dir_all(folder)
            .map_err(|error| format!("cannot make the folder {}: {error}", folder.display()))
            .and_then(|()| {
                let lock = Lock::take(&part.file("lock"), &part.to_string());
                lock.map_err(|error| format!("{error:#}"))
            });
        let lock = taken.map_err(|error| CampaignError::new_err(in_python(&error)))?;
        Ok(FolderLock {
            lock: Mutex::new(Some(lock)),
        })
    }

    /// Puts all `of` shards of `folder` together there, as campaign.csv. `told` hears how many files are done.
    fn merge(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        of: u64,
        told: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let parts = (1..=of).map(|number| self.part(folder.clone(), Some((number, of))));
        let manifests = parts.map(|part| Ok(part?.file("json")));
        let manifests = manifests.collect::<PyResult<Vec<_>>>()?;
        let output = self.part(folder, None)?.file("csv");
        let told = Told(told.clone().unbind());
        let merged = py.detach(|| {
            ulna_campaign::merge(&manifests, &output, &mut |done, _| told.written(done))
        });
        match merged.map_err(|error| Failed::Files(error).exception())? {
            Ok(_) => Ok(()),
            Err(errors) => Err(CampaignError::new_err(in_python(&errors.join("\n")))),
        }
    }
}
