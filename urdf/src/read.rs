//! XML → [`Robot`]: the elements of URDF that say what an arm is. Meshes, colours, transmissions and what simulators add are not looked at.

use nalgebra::{Matrix3, Vector3};
use roxmltree::Node;
use ulna_table::diagnostics::{Diagnostic, Sink};
use ulna_table::toml_reader::closest;

use crate::body::Body;
use crate::elements::{Elements, Reported};
use crate::frame::Frame;
use crate::robot::{
    Axis, Inertial, JointElement, LimitElement, LinkElement, Mimic, Motion, Number, Origin,
    Reference, Robot,
};
use crate::xml::{document, is_plain};

/// The most links, and the most joints.
const MOST: usize = 10_000;

/// The robot that `text` describes. `None` if something has been reported to `sink`.
pub(crate) fn read(text: &str, sink: &Sink) -> Option<Robot> {
    let document = document(text, sink)?;
    let root = document.root_element();
    // Kept apart: of a source of xacro everything else would be said besides.
    let found = Sink::new("", text);
    let elements = Elements::new(text, &found);
    let links: Vec<_> = elements
        .all(root, "link")
        .map(|node| link(&elements, node))
        .collect();
    let joints: Vec<_> = elements
        .all(root, "joint")
        .map(|node| joint(&elements, node))
        .collect();
    let name = root
        .has_attribute("name")
        .then(|| elements.word(root, "name", "the robot"))
        .flatten()
        .map(|(name, _)| name.to_owned());
    for node in root.descendants() {
        if node.is_element() && !is_plain(text, node) && is_xacro(text, node) {
            elements.unexpanded(elements.tag(node));
        }
    }
    if let Some(error) = elements.xacro() {
        sink.push(error);
        return None;
    }
    if let Some(node) = elements
        .all(root, "link")
        .nth(MOST)
        .or(elements.all(root, "joint").nth(MOST))
    {
        let message = format!("there are more than {MOST} links or joints");
        let error = Diagnostic::error(elements.tag(node), message).label("one too many");
        sink.push(error.help("a robot has some hundreds: take a part of the description"));
        return None;
    }
    if links.is_empty() {
        let error = Diagnostic::error(elements.tag(root), "there is no <link> in <robot>");
        sink.push(error.help("a robot description has <link> and <joint> directly in <robot>"));
        return None;
    }
    let errors = found.finish();
    for error in errors.list() {
        sink.push(error.clone());
    }
    Some(Robot {
        name,
        links: links.into_iter().collect::<Option<_>>()?,
        joints: joints.into_iter().collect::<Option<_>>()?,
    })
    .filter(|_| !errors.has_errors())
}

/// Whether the element's prefix is that of xacro, or stands for its namespace.
fn is_xacro(text: &str, node: Node) -> bool {
    let written = text.get(node.range().start + 1..).unwrap_or_default();
    let namespace = node.tag_name().namespace().unwrap_or_default();
    written.starts_with("xacro:") || namespace.trim_end_matches('/').ends_with("xacro")
}

/// What a link or joint is called in messages: by its name, if it has one.
fn called(node: Node, what: &str) -> String {
    match node.attribute("name") {
        Some(name) => format!("{what} `{}`", name.trim()),
        None => format!("a {what}"),
    }
}

fn link(elements: &Elements, node: Node) -> Option<LinkElement> {
    let owner = called(node, "link");
    let name = elements.word(node, "name", &owner);
    let inertial = elements.only(node, "inertial", &owner);
    let inertial = inertial.map(|node| self::inertial(elements, node, &owner));
    let (name, span) = name?;
    Some(LinkElement {
        name: name.to_owned(),
        span,
        inertial: match inertial {
            Some(inertial) => Some(inertial?),
            None => None,
        },
    })
}

fn inertial(elements: &Elements, node: Node, owner: &str) -> Option<Inertial> {
    let origin = origin(elements, node, owner);
    let mass_node = elements.required(node, "mass", owner, "<mass value=\"...\"/>, in kg");
    let mass = mass_node.and_then(|node| elements.required_number(node, "value", owner));
    if let Some(mass) = mass.as_ref().filter(|mass| mass.value < 0.0) {
        let message = format!("the mass of {owner} is negative");
        elements.push(
            Diagnostic::error(mass.span.clone(), message).help("write what it weighs, in kg"),
        );
    }
    let tensor_node = elements.required(
        node,
        "inertia",
        owner,
        "<inertia ixx=\"...\" ixy=\"...\" ixz=\"...\" iyy=\"...\" iyz=\"...\" izz=\"...\"/>, about the centroid, in kg m^2",
    );
    let tensor = tensor_node.map(|node| {
        ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
            .map(|name| elements.required_number(node, name, owner).map(|n| n.value))
    });
    let [xx, xy, xz, yy, yz, zz] = tensor?;
    let (xx, xy, xz, yy, yz, zz) = (xx?, xy?, xz?, yy?, yz?, zz?);
    let (mass, origin) = (mass?, origin?);
    let own = Body {
        mass: mass.value,
        com: Vector3::zeros(),
        inertia: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
    };
    Some(Inertial {
        body: own.seen_from(&origin.frame),
        span: elements.tag(node),
        mass_span: mass.span,
        inertia_span: tensor_node.map(|node| elements.tag(node))?,
    })
}

/// The element's `<origin>`; without one, no rotation and no translation.
fn origin(elements: &Elements, node: Node, owner: &str) -> Option<Origin> {
    let Some(node) = elements.only(node, "origin", owner) else {
        return Some(Origin {
            frame: Frame::identity(),
            span: elements.tag(node),
            rpy: [0.0; 3],
        });
    };
    if node.has_attribute("quat_xyzw") {
        let message = format!("`quat_xyzw` of <origin> of {owner} is not read");
        elements.push(
            Diagnostic::error(elements.tag(node), message)
                .help("write the same rotation as rpy=\"roll pitch yaw\", in radians"),
        );
        return None;
    }
    let xyz = elements.vector(node, "xyz", owner);
    let rpy = elements.vector(node, "rpy", owner);
    let (xyz, rpy) = (xyz.ok()?, rpy.ok()?.unwrap_or_default());
    Some(Origin {
        frame: Frame::from_rpy(xyz.unwrap_or_default(), rpy),
        span: elements.tag(node),
        rpy,
    })
}

fn joint(elements: &Elements, node: Node) -> Option<JointElement> {
    let owner = called(node, "joint");
    let name = elements.word(node, "name", &owner);
    let motion = motion(elements, node, &owner);
    let end = |name: &'static str| {
        let example = format!("<{name} link=\"...\"/>");
        let node = elements.required(node, name, &owner, &example)?;
        reference(elements, node, "link", &owner)
    };
    let (parent, child) = (end("parent"), end("child"));
    let origin = origin(elements, node, &owner);
    let axis = axis(elements, node, motion, &owner);
    let limit = elements.only(node, "limit", &owner);
    let limit = limit.map(|node| self::limit(elements, node, &owner));
    let dynamics = elements.only(node, "dynamics", &owner);
    let dynamic = |name: &'static str| match dynamics {
        Some(node) => positive(elements, node, name, &owner),
        None => Ok(None),
    };
    let (damping, friction) = (dynamic("damping"), dynamic("friction"));
    let mimic = elements.only(node, "mimic", &owner);
    let mimic = mimic.map(|node| self::mimic(elements, node, &owner));
    let (name, span) = name?;
    Some(JointElement {
        name: name.to_owned(),
        span,
        motion: motion?,
        parent: parent?,
        child: child?,
        origin: origin?,
        axis: axis?,
        limit: match limit {
            Some(limit) => Some(limit?),
            None => None,
        },
        damping: damping.ok()?,
        friction: friction.ok()?,
        mimic: match mimic {
            Some(mimic) => Some(mimic?),
            None => None,
        },
    })
}

fn motion(elements: &Elements, node: Node, owner: &str) -> Option<Motion> {
    let (word, span) = elements.word(node, "type", owner)?;
    let known = Motion::WORDS.iter().find(|(known, _)| *known == word);
    if let Some((_, motion)) = known {
        return Some(*motion);
    }
    let words = Motion::WORDS.map(|(word, _)| word);
    let help = match closest(word, words) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("URDF has {}", words.join(", ")),
    };
    let message = format!("the type of {owner} is none of URDF: `{word}`");
    elements.push(Diagnostic::error(span, message).help(help));
    None
}

fn reference(
    elements: &Elements,
    node: Node,
    attribute: &'static str,
    owner: &str,
) -> Option<Reference> {
    let (name, span) = elements.word(node, attribute, owner)?;
    Some(Reference {
        name: name.to_owned(),
        span,
    })
}

/// The joint's axis; x where none is given, as URDF has it.
fn axis(elements: &Elements, node: Node, motion: Option<Motion>, owner: &str) -> Option<Axis> {
    let element = elements.only(node, "axis", owner);
    let span = elements.tag(element.unwrap_or(node));
    let written = match element {
        Some(node) => elements.vector(node, "xyz", owner).ok()?,
        None => None,
    };
    let written = Vector3::from(written.unwrap_or([1.0, 0.0, 0.0]));
    // Scaled first: the squares of small numbers are 0.
    let largest = written.amax();
    if largest > 0.0 {
        let scaled = written / largest;
        return Some(Axis {
            unit: scaled.normalize(),
            length: scaled.norm() * largest,
            span,
        });
    }
    // Fixed and floating joints have none, and some files say so with zeros.
    if matches!(motion, Some(Motion::Fixed | Motion::Floating)) {
        return Some(Axis {
            unit: Vector3::x(),
            length: 1.0,
            span,
        });
    }
    let message = format!("the axis of {owner} has no direction");
    elements.push(
        Diagnostic::error(span, message)
            .help("write a vector along the axis in the joint's frame, such as xyz=\"0 0 1\""),
    );
    None
}

/// A number that may not be negative.
fn positive(
    elements: &Elements,
    node: Node,
    name: &'static str,
    owner: &str,
) -> Result<Option<Number>, Reported> {
    let number = elements.number(node, name, owner)?;
    let Some(negative) = number.as_ref().filter(|number| number.value < 0.0) else {
        return Ok(number);
    };
    let message = format!("`{name}` of {owner} is negative");
    elements.push(
        Diagnostic::error(negative.span.clone(), message)
            .help("write its size, or leave the attribute out"),
    );
    Err(Reported)
}

fn limit(elements: &Elements, node: Node, owner: &str) -> Option<LimitElement> {
    let lower = elements.number(node, "lower", owner);
    let upper = elements.number(node, "upper", owner);
    let effort = positive(elements, node, "effort", owner);
    let velocity = positive(elements, node, "velocity", owner);
    Some(LimitElement {
        span: elements.tag(node),
        lower: lower.ok()?,
        upper: upper.ok()?,
        effort: effort.ok()?,
        velocity: velocity.ok()?,
    })
}

fn mimic(elements: &Elements, node: Node, owner: &str) -> Option<Mimic> {
    let joint = reference(elements, node, "joint", owner);
    let multiplier = elements.number(node, "multiplier", owner);
    let offset = elements.number(node, "offset", owner);
    let value = |number: Option<Number>, without| number.map_or(without, |number| number.value);
    Some(Mimic {
        joint: joint?,
        multiplier: value(multiplier.ok()?, 1.0),
        offset: value(offset.ok()?, 0.0),
    })
}
