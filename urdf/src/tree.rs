//! [`Tree`]: a robot's links and joints as the tree that they are to make.

use std::collections::HashMap;

use ulna_table::diagnostics::{Diagnostic, Sink};
use ulna_table::toml_reader::closest;

use crate::robot::{JointElement, LinkElement, Reference, Robot, Span, quoted};

/// So many names are compared with one that is not there; no robot has more, and comparing takes its time.
const COMPARED: usize = 500;

/// A robot whose joints make its links a tree. Links and joints go by their numbers in the file.
pub(crate) struct Tree {
    pub(crate) robot: Robot,
    pub(crate) root: usize,
    /// The joint that moves each link; none for the root.
    parent_joint: Vec<Option<usize>>,
    /// The joints on each link, in the file's order.
    child_joints: Vec<Vec<usize>>,
    /// For each joint the links that it connects.
    ends: Vec<Ends>,
    /// The joint that each joint mimics.
    masters: Vec<Option<usize>>,
}

#[derive(Clone, Copy)]
struct Ends {
    parent: usize,
    child: usize,
}

impl Tree {
    /// The tree. `None` if something has been reported.
    pub(crate) fn grow(robot: Robot, sink: &Sink) -> Option<Self> {
        let links = indices(&robot.links, "link", |link| (&link.name, &link.span), sink);
        let joints = indices(
            &robot.joints,
            "joint",
            |joint| (&joint.name, &joint.span),
            sink,
        );
        let find = |reference: &Reference, joint: &JointElement| {
            let found = links.get(reference.name.as_str()).copied();
            if found.is_none() {
                let message = format!(
                    "joint `{}` refers to the link `{}`, which is not there",
                    joint.name, reference.name
                );
                let names = robot.links.iter().map(|link| &link.name);
                let help = match closest(&reference.name, names.take(COMPARED)) {
                    Some(name) => format!("did you mean `{name}`?"),
                    None => format!("write <link name=\"{}\"/>, or another name", reference.name),
                };
                sink.push(Diagnostic::error(reference.span.clone(), message).help(help));
            }
            found
        };
        let ends: Vec<_> = robot
            .joints
            .iter()
            .map(|joint| {
                let (parent, child) = (find(&joint.parent, joint), find(&joint.child, joint));
                Some(Ends {
                    parent: parent?,
                    child: child?,
                })
            })
            .collect();
        let masters = masters(&robot, &joints, sink);
        let sound = links.len() == robot.links.len() && joints.len() == robot.joints.len();
        let ends = ends.into_iter().collect::<Option<Vec<_>>>()?;
        let mut child_joints = vec![Vec::new(); robot.links.len()];
        let mut parent_joint: Vec<Option<usize>> = vec![None; robot.links.len()];
        let mut single = true;
        for (joint, Ends { parent, child }) in ends.iter().enumerate() {
            if let Some(first) = parent_joint[*child] {
                let element = &robot.joints[joint];
                let message = format!(
                    "the link `{}` has two parents: joint `{}` moves it as well as joint `{}`",
                    robot.links[*child].name, element.name, robot.joints[first].name
                );
                sink.push(
                    Diagnostic::error(element.child.span.clone(), message)
                        .help("a closed loop is no tree: cut it, by leaving one of the joints out"),
                );
                single = false;
                continue;
            }
            parent_joint[*child] = Some(joint);
            child_joints[*parent].push(joint);
        }
        let root = single
            .then(|| root(&robot, &parent_joint, &ends, sink))
            .flatten()?;
        sound.then_some(Self {
            robot,
            root,
            parent_joint,
            child_joints,
            ends,
            masters: masters?,
        })
    }

    pub(crate) fn link(&self, link: usize) -> &LinkElement {
        &self.robot.links[link]
    }

    pub(crate) fn joint(&self, joint: usize) -> &JointElement {
        &self.robot.joints[joint]
    }

    /// The link of that name.
    pub(crate) fn find_link(&self, name: &str) -> Option<usize> {
        self.robot.links.iter().position(|link| link.name == name)
    }

    /// The joint that a joint mimics; following it leads to one that mimics none.
    pub(crate) fn master(&self, joint: usize) -> Option<usize> {
        self.masters[joint]
    }

    /// The joints that mimic a joint.
    pub(crate) fn mimics(&self, joint: usize) -> impl Iterator<Item = usize> {
        let masters = self.masters.iter().enumerate();
        masters.filter_map(move |(other, master)| (*master == Some(joint)).then_some(other))
    }

    /// The joints on a link, in the file's order.
    pub(crate) fn child_joints(&self, link: usize) -> &[usize] {
        &self.child_joints[link]
    }

    pub(crate) fn parent_link(&self, joint: usize) -> usize {
        self.ends[joint].parent
    }

    pub(crate) fn child_link(&self, joint: usize) -> usize {
        self.ends[joint].child
    }

    /// The joints from `ancestor` to `link`, in that order. `None` if `link` does not hang on `ancestor`.
    pub(crate) fn path(&self, ancestor: usize, link: usize) -> Option<Vec<usize>> {
        let mut joints = Vec::new();
        let mut at = link;
        while at != ancestor {
            let joint = self.parent_joint[at]?;
            joints.push(joint);
            at = self.ends[joint].parent;
        }
        joints.reverse();
        Some(joints)
    }

    /// `link` and all that hangs on it, each before what hangs on it, in the file's order.
    pub(crate) fn subtree(&self, link: usize) -> Vec<usize> {
        let mut found = Vec::new();
        let mut open = vec![link];
        while let Some(link) = open.pop() {
            found.push(link);
            let joints = self.child_joints[link].iter().rev();
            open.extend(joints.map(|joint| self.ends[*joint].child));
        }
        found
    }
}

/// The numbers of `elements` by name; a name that stands twice is reported, and counts once.
fn indices<'e, E>(
    elements: &'e [E],
    what: &str,
    name: impl Fn(&'e E) -> (&'e String, &'e Span),
    sink: &Sink,
) -> HashMap<&'e str, usize> {
    let mut indices = HashMap::new();
    for (index, element) in elements.iter().enumerate() {
        let (name, span) = name(element);
        if indices.contains_key(name.as_str()) {
            let message = format!("there is a second {what} `{name}`");
            sink.push(
                Diagnostic::error(span.clone(), message)
                    .help(format!("give each {what} a name of its own")),
            );
        } else {
            indices.insert(name.as_str(), index);
        }
    }
    indices
}

/// The one link without a parent, on which all others hang.
fn root(
    robot: &Robot,
    parent_joint: &[Option<usize>],
    ends: &[Ends],
    sink: &Sink,
) -> Option<usize> {
    let is_root = |link: &usize| parent_joint[*link].is_none();
    let roots: Vec<usize> = (0..robot.links.len()).filter(is_root).collect();
    if let [_, second, ..] = roots[..] {
        let names: Vec<_> = roots
            .iter()
            .map(|root| robot.links[*root].name.as_str())
            .collect();
        let message = format!(
            "there are {} links without a parent: {}",
            roots.len(),
            some_of(&names)
        );
        sink.push(
            Diagnostic::error(robot.links[second].span.clone(), message)
                .label("not connected with the first")
                .help("connect them by joints, fixed ones if need be, or take out what is no part of the robot"),
        );
        return None;
    }
    let parents: Vec<_> = parent_joint
        .iter()
        .map(|joint| joint.map(|joint| ends[joint].parent))
        .collect();
    if let Some(link) = looped(&parents) {
        let link = &robot.links[link];
        let message = format!(
            "the link `{}` hangs on itself, through a loop of joints",
            link.name
        );
        sink.push(
            Diagnostic::error(link.span.clone(), message)
                .help("let one link have no parent, and every other one"),
        );
        return None;
    }
    roots.first().copied()
}

/// The joint that each joint mimics. `None` if something has been reported.
fn masters(
    robot: &Robot,
    joints: &HashMap<&str, usize>,
    sink: &Sink,
) -> Option<Vec<Option<usize>>> {
    let mut sound = true;
    let mut refuse = |reference: &Reference, message: String, help: String| {
        sink.push(Diagnostic::error(reference.span.clone(), message).help(help));
        sound = false;
    };
    let mut masters = Vec::new();
    for joint in &robot.joints {
        let master = joint.mimic.as_ref().and_then(|mimic| {
            let found = joints.get(mimic.joint.name.as_str()).copied();
            if found.is_none() {
                let names = robot.joints.iter().map(|joint| &joint.name);
                let help = match closest(&mimic.joint.name, names.take(COMPARED)) {
                    Some(name) => format!("did you mean `{name}`?"),
                    None => "name a joint of the file".to_owned(),
                };
                let message = format!(
                    "joint `{}` mimics the joint `{}`, which is not there",
                    joint.name, mimic.joint.name
                );
                refuse(&mimic.joint, message, help);
            }
            found
        });
        masters.push(master);
    }
    if let Some(joint) = looped(&masters) {
        let joint = &robot.joints[joint];
        if let Some(mimic) = &joint.mimic {
            let message = format!("joint `{}` mimics itself, in the end", joint.name);
            let help = "let one of the joints that mimic one another have no <mimic>".to_owned();
            refuse(&mimic.joint, message, help);
        }
    }
    sound.then_some(masters)
}

/// One of a loop of steps, if following them from anywhere ever ends in one.
fn looped(next: &[Option<usize>]) -> Option<usize> {
    let mut ends = vec![false; next.len()];
    let mut seen_from: Vec<Option<usize>> = vec![None; next.len()];
    for start in 0..next.len() {
        let mut way = Vec::new();
        let mut at = Some(start);
        while let Some(here) = at.filter(|here| !ends[*here]) {
            if seen_from[here] == Some(start) {
                return Some(here);
            }
            seen_from[here] = Some(start);
            way.push(here);
            at = next[here];
        }
        way.into_iter().for_each(|here| ends[here] = true);
    }
    None
}

/// The first names of a list, and how many more there are.
pub(crate) fn some_of<S: AsRef<str>>(names: &[S]) -> String {
    const SHOWN: usize = 6;
    let shown: Vec<_> = names
        .iter()
        .take(SHOWN)
        .map(|name| quoted(name.as_ref()))
        .collect();
    let mut text = shown.join(", ");
    if let Some(more @ 1..) = names.len().checked_sub(SHOWN) {
        text.push_str(&format!(" and {more} more"));
    }
    text
}
