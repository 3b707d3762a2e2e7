//! Strategies for whole arms, and the tree of simpler arms that each of them shrinks through.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::bodies::{distal, link};
use super::geometry::{decades, length, place, turn, twist};
use super::table::{Joint, ROWS, Table, Task};

/// A table, and how many of the states of `proof::states` are left out before the first that it is judged at.
#[derive(Clone, Debug)]
pub(crate) struct Arm {
    pub(crate) table: Table,
    pub(crate) first_state: usize,
}

/// What arms that are built have in common and independent draws rarely give.
#[derive(Clone, Debug)]
enum Pattern {
    Any,
    /// All axes parallel.
    Parallel,
    /// The last three axes meet in a point.
    Wrist,
}

fn joint() -> BoxedStrategy<Joint> {
    let prismatic = proptest::bool::weighted(0.2);
    let row = (turn(), length(), length(), twist());
    (prismatic, row, motor(), friction(), link())
        .prop_map(|(prismatic, row, motor, friction, link)| {
            let (theta, d, a, alpha) = row;
            Joint {
                prismatic,
                theta,
                d,
                a,
                alpha,
                motor,
                friction,
                link,
            }
        })
        .boxed()
}

/// A rotor like a watch's to one like a flywheel, behind gears or not.
fn motor() -> BoxedStrategy<Option<(f64, f64)>> {
    let motor = (decades(-80..=-10), decades(0..=30));
    proptest::option::weighted(0.3, motor).boxed()
}

fn friction() -> BoxedStrategy<Option<[f64; 3]>> {
    let friction = [decades(-20..=20), decades(-20..=20), decades(-40..=0)];
    proptest::option::weighted(0.3, friction).boxed()
}

fn task() -> BoxedStrategy<Task> {
    prop_oneof![
        3 => Just(Task::Position),
        2 => Just(Task::Pose),
        2 => (Just(ROWS.to_vec()).prop_shuffle(), 1..=2_usize).prop_map(chosen),
        3 => (Just(ROWS.to_vec()).prop_shuffle(), 1..=6_usize).prop_map(chosen),
    ]
    .boxed()
}

fn chosen((mut rows, count): (Vec<&'static str>, usize)) -> Task {
    rows.truncate(count);
    Task::Rows(rows)
}

fn gravity() -> BoxedStrategy<Option<[f64; 3]>> {
    let any = || (-3000..=3000).prop_map(|tenths| f64::from(tenths) / 10.0);
    prop_oneof![
        2 => Just(None),
        2 => Just(Some([0.0, 0.0, -9.81])),
        1 => [any(), any(), any()].prop_map(Some),
    ]
    .boxed()
}

fn pattern() -> BoxedStrategy<Pattern> {
    prop_oneof![
        6 => Just(Pattern::Any),
        1 => Just(Pattern::Parallel),
        1 => Just(Pattern::Wrist),
    ]
    .boxed()
}

impl Pattern {
    fn impose(&self, joints: &mut [Joint]) {
        let count = joints.len();
        match self {
            Self::Any => {}
            Self::Parallel => joints.iter_mut().for_each(|joint| joint.alpha = 0.0),
            Self::Wrist => {
                for joint in &mut joints[count.saturating_sub(3)..] {
                    (joint.a, joint.d) = (0.0, 0.0);
                }
            }
        }
    }
}

/// Any arm of up to seven joints.
pub(crate) fn arm() -> BoxedStrategy<Arm> {
    // What comes first shrinks first: an arm of fewer joints is quicker to shrink on.
    let joints = (vec(joint(), 1..=7), pattern(), distal());
    let words = (any::<bool>(), proptest::bool::weighted(0.3));
    let first_state = (0..500_usize).no_shrink();
    (
        joints,
        words,
        gravity(),
        task(),
        place(),
        place(),
        first_state,
    )
        .prop_map(|(joints, words, gravity, task, base, tool, first_state)| {
            let (standard, in_radians) = words;
            let (mut joints, pattern, distal) = joints;
            pattern.impose(&mut joints);
            if let (Some(last), Some(link)) = (joints.last_mut(), distal) {
                last.link = link;
            }
            let table = Table {
                standard,
                in_radians,
                gravity,
                task,
                base,
                tool,
                joints,
            };
            Arm { table, first_state }
        })
        .boxed()
}

/// The arm number `index` of the series that starts from `seed`, the same on every machine.
pub(crate) fn tree(
    strategy: &BoxedStrategy<Arm>,
    seed: u64,
    index: u64,
) -> Box<dyn ValueTree<Value = Arm>> {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    bytes[8..16].copy_from_slice(&index.to_le_bytes());
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    let config = Config {
        failure_persistence: None,
        ..Config::default()
    };
    strategy
        .new_tree(&mut TestRunner::new_with_rng(config, rng))
        .unwrap_or_else(|reason| panic!("no strategy here rejects anything: {reason}"))
}
