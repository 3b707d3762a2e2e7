//! [`Description`]: an arm as a program gives it.

use super::Model;
use super::joint_names::numbered;
use super::written::TableText;
use crate::diagnostics::{Diagnostic, Diagnostics, Sink, TableErrors};
use crate::lint::Lint;
use crate::table::{ArmTable, Author, Convention, InertiaTable};
use crate::toml_reader::Located;
use ulna::{Joint, Placement, TaskRows};

/// An arm as a program gives it: read from another format, or changed. [`Model::new`] examines it.
///
/// The numbers are those of a table, in SI units and radians. [`Model::description`] gives those of a model:
///
/// ```
/// use ulna_table::{Model, TableErrors};
///
/// /// The arm with a payload of `mass` kg at its last link's centroid.
/// fn loaded(arm: &Model, mass: f64) -> Result<Model, TableErrors> {
///     let mut description = arm.description();
///     if let Some(last) = description.joints.last_mut() {
///         last.link.mass += mass;
///     }
///     Model::new(&description)
/// }
/// # let arm = Model::load("../arms/planar_2r.toml")?;
/// assert_eq!(loaded(&arm, 2.0)?.joints()[1].link.mass, 3.0);
/// let refused = loaded(&arm, -2.0).unwrap_err().to_string();
/// assert!(refused.contains("`mass` of joint 2 is out of bounds"));
/// # Ok::<(), TableErrors>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The arm's name, `snake_case`, a Rust identifier that is no keyword.
    pub name: String,
    /// What the joints' rows mean.
    pub convention: Convention,
    /// Gravity, m/s², world axes.
    pub gravity: [f64; 3],
    /// The rows of J in w_D: at least one, and no more than there are joints.
    pub task: TaskRows,
    /// `world_from_base`.
    pub base: Placement,
    /// `frame_N_from_tool`; frame N is that of the last row in the convention above.
    pub tool: Placement,
    /// Whether the arm has a payload that is known only at run time.
    pub payload: bool,
    /// The joints, base first, 1 to 32. In standard form `a` and `alpha` are `a_i` and `α_i`, and the link stands in frame i of that form.
    pub joints: Vec<Joint>,
    /// The joints' names, base first, where they have any; those left out at the end have none.
    pub joint_names: Vec<Option<String>>,
    /// The lints that are switched off.
    pub allow: Vec<Lint>,
    /// Whether a link's inertia is taken over although no rigid body can have it, base first; those left out at the end are not.
    pub accept_inertia: Vec<bool>,
}

impl Model {
    /// The model of an arm that a program describes.
    ///
    /// The description is written down as a table and read as one, so that it is held to every rule of a table and
    /// refused with the same words. The lines that errors show are those of what was written; they call it
    /// "the description of" the arm. [`table_hash`](Self::table_hash) is the SHA-256 of that text: the same on every
    /// machine, and another for every other description.
    ///
    /// # Errors
    /// Everything that is wrong with the description, at once.
    pub fn new(description: &Description) -> Result<Self, TableErrors> {
        Self::lint_description(description).map(|(model, _)| model)
    }

    /// [`Model::new`], together with warnings of what is allowed but rarely meant.
    ///
    /// # Errors
    /// Everything that is wrong with the description, at once.
    pub fn lint_description(description: &Description) -> Result<(Self, Diagnostics), TableErrors> {
        let text = TableText::of_program(description).to_string();
        let source_name = match super::name::check(&description.name) {
            Ok(()) => format!("the description of {}", description.name),
            Err(_) => "the description".to_owned(),
        };
        Self::examine(&text, &source_name, Author::Program, |table, sink| {
            description.refuse_unsymmetric(table, sink);
            description.refuse_surplus_names(sink);
        })
    }

    /// The model as a description, in modified form whatever its table was in: to change it, and make another model of it.
    pub fn description(&self) -> Description {
        Description {
            name: self.name.clone(),
            convention: Convention::Modified,
            gravity: self.gravity,
            task: self.task,
            base: self.base,
            tool: self.tool,
            payload: self.payload,
            joints: self.joints.clone(),
            joint_names: self.given_names(),
            allow: self.allow.clone(),
            accept_inertia: self.accept_inertia.clone(),
        }
    }
}

impl Model {
    fn given_names(&self) -> Vec<Option<String>> {
        let names = self.joint_names.iter().enumerate();
        let given = names.map(|(index, name)| (*name != numbered(index)).then(|| name.clone()));
        given.collect()
    }
}

impl Description {
    /// Reports names that no joint has.
    fn refuse_surplus_names(&self, sink: &Sink) {
        let beyond = self.joint_names.iter().skip(self.joints.len());
        for name in beyond.flatten() {
            let message = format!("there is no joint for the name {name:?}");
            sink.push(
                Diagnostic::file_error(message).help("give the names as the joints, base first"),
            );
        }
    }

    /// Takes tensors that differ from their transposes out of `table`, which has their upper triangles, and reports them.
    fn refuse_unsymmetric(&self, table: &mut ArmTable, sink: &Sink) {
        let rows = table.joints.iter_mut().flatten();
        for (joint, row) in self.joints.iter().zip(rows) {
            let Some(link) = &mut row.link else { continue };
            let Some(written) = &link.inertia else {
                continue;
            };
            if let Some(error) = asymmetry(&joint.link.inertia, written) {
                sink.push(error);
                link.inertia = None;
            }
        }
    }
}

/// What is wrong with `tensor`, of which `written` has the upper triangle.
fn asymmetry(tensor: &[[f64; 3]; 3], written: &Located<InertiaTable>) -> Option<Diagnostic> {
    /// Share of the largest entry that counts as rounding.
    const ROUNDING: f64 = 1e-12;
    let InertiaTable { moments, products } = &written.value;
    let upper: Option<Vec<f64>> = moments
        .iter()
        .chain(products)
        .map(|number| Some(number.as_ref()?.value.abs()))
        .collect();
    // A number that is none has been reported.
    let largest = upper?.into_iter().fold(0.0, f64::max);
    let symmetric = |i: usize, j: usize| {
        let difference = (tensor[i][j] - tensor[j][i]).abs();
        difference <= ROUNDING * largest
    };
    let (i, j) = [(0, 1), (0, 2), (1, 2)]
        .into_iter()
        .find(|&(i, j)| !symmetric(i, j))?;
    let axes = ['x', 'y', 'z'];
    let (upper, lower) = (tensor[i][j], tensor[j][i]);
    let message = format!("{} is not symmetric", written.name);
    Some(
        Diagnostic::error(written.span.clone(), message)
            .label(format!(
                "{0}{1} is {upper:?}, {1}{0} is {lower:?}",
                axes[i], axes[j]
            ))
            .help("give a tensor that equals its transpose"),
    )
}
