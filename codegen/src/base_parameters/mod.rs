//! [`BaseParameters`]: which combinations of the links' inertial parameters the torque depends on, and no fewer.
//!
//! Two steps. What a joint's motion cannot change of its link's parameters is counted with the link before, in closed form
//! (`formulate/body.rs`; Gautier and Khalil 1990). That leaves seven parameters of a link behind a revolute joint, four behind
//! a prismatic one, and is all there is wherever a link moves freely enough. Where it does not, among the first joints, parameters
//! remain that have no effect or the same as others; they are found by eliminating among the columns of the regressor, stacked over
//! random states, in 106 bits (Gautier 1991, there in doubles by QR).

mod display;
mod elimination;

use ulna::internal::random::SplitMix64;
use ulna::{Joint, JointKind, Method, Parameter, Real as _};
use ulna_table::Model;

use crate::accuracy::State;
use crate::double_double::DoubleDouble;
use crate::formulate::body::{Body, indifferent_part, seen_from_link_before};
use crate::formulate::chain::Chain;
use crate::formulate::regressor::Columns;
use crate::formulate::{Choices, formulate};
use crate::graph::Graph;
use crate::schedule::schedule;

use elimination::{Dependency, eliminate};

/// States at which the regressor is stacked: a block has no more than seven columns left, and each state gives it a row at least.
const STATES: usize = 12;

/// The base (minimal) parameters of an arm: the fewest combinations of inertial parameters on which the joint torques depend.
///
/// ```
/// use ulna_codegen::BaseParameters;
/// use ulna_table::Model;
///
/// let model = Model::load("../arms/planar_2r.toml")?;
/// let base = BaseParameters::of(&model);
/// assert_eq!(base.list().len(), 6);
/// println!("{base}");
/// # Ok::<(), ulna_table::TableErrors>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BaseParameters {
    links: usize,
    list: Vec<BaseParameter>,
}

/// A base parameter: a link's inertial parameter, and what is grouped with it.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseParameter {
    /// The link, counted from 0.
    pub link: usize,
    /// Which of its parameters.
    pub parameter: Parameter,
    /// What is added to it, by links and by the regressor's columns.
    pub grouped: Vec<Term>,
}

/// A multiple of a link's inertial parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// The factor: 1, m or m², as the units of both parameters ask for.
    pub coefficient: f64,
    /// The link, counted from 0.
    pub link: usize,
    /// Which of its parameters.
    pub parameter: Parameter,
}

impl BaseParameters {
    /// The base parameters of the arm of `model`. Its links' masses and inertias do not matter: its geometry and gravity do.
    ///
    /// What differs by less than 1e-14 of what its terms can amount to counts as the same: no double tells it apart.
    pub fn of(model: &Model) -> Self {
        let links = model.joints().len();
        let mut groups = grouped_in_closed_form(model);
        let left = left_in_order(model.joints());
        let rows = stacked(model, &left);
        let found = eliminate(rows, left.len());
        let mut kept: Vec<(usize, Parameter)> = Vec::new();
        for (place, dependency) in left.iter().zip(&found) {
            match dependency {
                Dependency::Independent => kept.push(*place),
                Dependency::On(factors) => {
                    let dropped = groups[index(*place)].clone();
                    let others = left.iter().zip(factors);
                    for (other, factor) in others.filter(|(_, factor)| **factor != 0.0) {
                        // In units of what each column's terms can amount to, as they were compared.
                        let factor = *factor * size(model, *place) / size(model, *other);
                        add(&mut groups[index(*other)], &dropped, factor);
                    }
                }
            }
        }
        kept.sort_unstable();
        let list = kept.into_iter().map(|(link, parameter)| BaseParameter {
            link,
            parameter,
            grouped: terms(&groups[index((link, parameter))], (link, parameter)),
        });
        Self {
            links,
            list: list.collect(),
        }
    }

    /// The base parameters: by links, base first, and by the regressor's columns.
    pub fn list(&self) -> &[BaseParameter] {
        &self.list
    }

    /// How many links the arm has, and ten times as many inertial parameters.
    pub fn links(&self) -> usize {
        self.links
    }

    /// The base parameters' values, in the order of the [list](Self::list), from all links' [parameters](ulna::Link::parameters).
    ///
    /// Links that are not there count as massless.
    pub fn values(&self, parameters: &[[f64; Parameter::COUNT]]) -> Vec<f64> {
        let value = |link: usize, parameter: Parameter| {
            let own = parameters.get(link);
            own.map_or(0.0, |own| own[parameter.index()])
        };
        let of = |base: &BaseParameter| {
            let grouped = base.grouped.iter();
            let grouped = grouped.map(|term| term.coefficient * value(term.link, term.parameter));
            value(base.link, base.parameter) + grouped.sum::<f64>()
        };
        self.list.iter().map(of).collect()
    }

    /// Their columns of the regressor.
    pub(crate) fn columns(&self) -> Columns {
        Columns::of(self.list.iter().map(|base| (base.link, base.parameter)))
    }
}

/// A linear combination of all parameters of all links.
type Combination = Vec<DoubleDouble>;

fn index((link, parameter): (usize, Parameter)) -> usize {
    link * Parameter::COUNT + parameter.index()
}

fn add(combination: &mut Combination, other: &Combination, factor: DoubleDouble) {
    for (x, y) in combination.iter_mut().zip(other) {
        *x = *x + factor * *y;
    }
}

/// For each parameter of each link, what stands in its place after regrouping in closed form.
fn grouped_in_closed_form(model: &Model) -> Vec<Combination> {
    let links = model.joints().len();
    let count = links * Parameter::COUNT;
    let unit = |place: usize| {
        let mut combination = vec![DoubleDouble::default(); count];
        combination[place] = DoubleDouble::of(1.0);
        combination
    };
    let mut groups: Vec<Combination> = (0..count).map(unit).collect();
    for (link, joint) in model.joints().iter().enumerate().rev() {
        let own: Vec<Combination> = Parameter::ALL
            .map(|parameter| groups[index((link, parameter))].clone())
            .to_vec();
        for (parameter, combination) in Parameter::ALL.into_iter().zip(&own) {
            let (stays, passed) = parted(joint, parameter);
            let mut give = |link: usize, factors: Numbers, sign: f64| {
                for (to, factor) in Parameter::ALL.into_iter().zip(factors) {
                    let factor = factor * DoubleDouble::of(sign);
                    if factor != 0.0 {
                        add(&mut groups[index((link, to))], combination, factor);
                    }
                }
            };
            give(link, stays, -1.0);
            if link > 0 {
                give(link - 1, passed, 1.0);
            }
        }
    }
    groups
}

/// A body's ten parameters.
type Numbers = [DoubleDouble; Parameter::COUNT];

/// Of a unit parameter of a joint's link, the part that the joint's motion cannot change: in the link's frame, and in that of the link before.
fn parted(joint: &Joint, parameter: Parameter) -> (Numbers, Numbers) {
    let graph = Graph::without_labels();
    let unit = Parameter::ALL.map(|other| graph.constant(f64::from(u8::from(other == parameter))));
    let part = indifferent_part(joint, &Body::of_parameters(unit));
    let numbers = |body: Body<'_>| {
        // Sums and products of numbers are numbers.
        body.parameters().map(|x| x.value().unwrap_or_default())
    };
    (
        numbers(part),
        numbers(seen_from_link_before(
            &graph,
            joint,
            graph.constant(joint.d),
            part,
        )),
    )
}

/// The parameters that regrouping leaves, in the order in which a base is chosen.
fn left_in_order(joints: &[Joint]) -> Vec<(usize, Parameter)> {
    let of_link = |(link, joint): (usize, &Joint)| {
        let kind = joint.kind;
        let left = move |parameter: &Parameter| match kind {
            JointKind::Revolute => {
                use Parameter::{Iyy, Mass, Mz};
                ![Mass, Mz, Iyy].contains(parameter)
            }
            JointKind::Prismatic => parameter.degree() < 2,
        };
        let left = Parameter::BASE_ORDER.into_iter().filter(left);
        left.map(move |parameter| (link, parameter))
    };
    joints.iter().enumerate().flat_map(of_link).collect()
}

/// The regressor's columns at all states, one below the other, relative to what their terms can amount to.
fn stacked(model: &Model, places: &[(usize, Parameter)]) -> Vec<Vec<DoubleDouble>> {
    let links = model.joints().len();
    let graph = Graph::without_labels();
    let chain = Chain::new(&graph, model);
    let outputs = formulate(Method::Regressor, &chain, Choices::default());
    let program = schedule(&graph, &outputs);
    let mut random = SplitMix64::new(2);
    let sizes: Vec<DoubleDouble> = places.iter().map(|place| size(model, *place)).collect();
    let mut rows = Vec::new();
    for _ in 0..STATES {
        let regressor = State::random(model, &mut random).exactly(&program);
        rows.extend((0..links).map(|joint| {
            // A force as the torque that it is at its joint's farthest.
            let length = match model.joints()[joint].kind {
                JointKind::Revolute => DoubleDouble::of(1.0),
                JointKind::Prismatic => DoubleDouble::of(reach(model, joint)),
            };
            let entries = places.iter().zip(&sizes).map(|(place, size)| {
                let entry = regressor[index(*place) * links + joint] * length;
                if *size == 0.0 { entry } else { entry / *size }
            });
            entries.collect()
        }));
    }
    rows
}

/// What the terms of a parameter's column can amount to, at rates and accelerations of about 1.
fn size(model: &Model, (link, parameter): (usize, Parameter)) -> DoubleDouble {
    let gravity = model.gravity().map(f64::abs).iter().sum::<f64>();
    let reach = reach(model, link);
    let field = gravity + reach;
    DoubleDouble::of([reach * field, reach + field, 1.0][parameter.degree()])
}

/// The farthest that a link's origin can be from the base's.
fn reach(model: &Model, link: usize) -> f64 {
    let length = |joint: &Joint| match joint.kind {
        JointKind::Revolute => joint.a.abs() + joint.d.abs(),
        JointKind::Prismatic => joint.a.abs() + joint.d.abs() + 1.0,
    };
    model.joints()[..=link].iter().map(length).sum()
}

/// The terms of a combination but that of `own` itself.
fn terms(combination: &Combination, own: (usize, Parameter)) -> Vec<Term> {
    let links = 0..combination.len() / Parameter::COUNT;
    let places = links.flat_map(|link| Parameter::ALL.map(|parameter| (link, parameter)));
    let others = places.zip(combination);
    others
        .filter(|(place, coefficient)| *place != own && **coefficient != 0.0)
        .map(|((link, parameter), coefficient)| Term {
            coefficient: coefficient.to_f64(),
            link,
            parameter,
        })
        .collect()
}
