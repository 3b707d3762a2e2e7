//! The search in steps as a flow diagram: the paper's Figure 2, as it is done here.

use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::HPos;
use ulna_study::scenario::SearchGrid;

use super::chart::tick;
use super::sketch::{ARROW, Node, Shape, arrow, text};
use super::style::{BLUE, GREEN, GREY, ORANGE, Pen};
use super::{Area, Drawn, Figure};

/// The search that a scenario asks for.
pub(crate) struct SearchFlow {
    pub(crate) grid: SearchGrid,
    pub(crate) joints: usize,
    /// The most steps.
    pub(crate) most: usize,
}

impl Figure for SearchFlow {
    fn size(&self) -> (u32, u32) {
        (900, 640)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<DB>, pen: Pen) -> Drawn<DB> {
        let node = |x: i32, y: i32, width: i32, height: i32| Node {
            at: (pen.at(x), pen.at(y)),
            size: (pen.at(width), pen.at(height)),
        };
        let (start, step) = (tick(self.grid.start()), tick(self.grid.step()));
        let begin = node(300, 40, 330, 44);
        let joint = node(300, 118, 330, 44);
        let interval = node(300, 204, 330, 64);
        let better = node(300, 334, 400, 120);
        let go = node(700, 334, 220, 60);
        let last = node(300, 464, 300, 80);
        let moved = node(300, 574, 300, 90);
        let end = node(700, 574, 240, 60);

        arrow(area, pen, &[begin.bottom(), joint.top()], ARROW)?;
        arrow(area, pen, &[joint.bottom(), interval.top()], ARROW)?;
        arrow(area, pen, &[interval.bottom(), better.top()], ARROW)?;
        arrow(area, pen, &[better.right(), go.left()], ARROW)?;
        let above = pen.at(262);
        let back = [go.top(), (go.at.0, above), (better.at.0 + pen.at(3), above)];
        arrow(area, pen, &back, ARROW)?;
        arrow(area, pen, &[better.bottom(), last.top()], ARROW)?;
        arrow(area, pen, &[last.bottom(), moved.top()], ARROW)?;
        arrow(area, pen, &[moved.right(), end.left()], ARROW)?;
        let left = pen.at(84);
        let next = [
            last.left(),
            (left, last.at.1),
            (left, interval.at.1),
            interval.left(),
        ];
        arrow(area, pen, &next, ARROW)?;
        let left = pen.at(34);
        let again = [
            moved.left(),
            (left, moved.at.1),
            (left, joint.at.1),
            joint.left(),
        ];
        arrow(area, pen, &again, ARROW)?;

        begin.draw(
            area,
            pen,
            Shape::Step,
            GREY,
            &[&format!("k_di = {start} for every joint i")],
        )?;
        joint.draw(
            area,
            pen,
            Shape::Step,
            BLUE,
            &[&format!("a pass: joints i = 1 to {}", self.joints)],
        )?;
        let bounds = [
            "interval of k_di that keeps all rated torques",
            "over the whole motion (Eq. 28);",
            "k_di goes to its nearest point",
        ];
        interval.draw(area, pen, Shape::Step, BLUE, &bounds)?;
        let question = [
            &*format!("does k_di \u{b1} {step} lie in it"),
            "and leave less impact?",
        ];
        better.draw(area, pen, Shape::Question, ORANGE, &question)?;
        go.draw(
            area,
            pen,
            Shape::Step,
            BLUE,
            &[&format!("k_di \u{b1} {step}"), "up first, then down"],
        )?;
        last.draw(area, pen, Shape::Question, ORANGE, &["last joint?"])?;
        moved.draw(
            area,
            pen,
            Shape::Question,
            ORANGE,
            &["has any", "coefficient moved?"],
        )?;
        end.draw(
            area,
            pen,
            Shape::Step,
            GREEN,
            &["k_d: no neighbour on the", "grid leaves less impact"],
        )?;

        let label = |at: (i32, i32), word: &str| text(area, pen, at, &[word], HPos::Left);
        let beside = |at: (i32, i32), dx: i32, dy: i32| (at.0 + pen.at(dx), at.1 + pen.at(dy));
        label(beside(better.right(), 8, -12), "yes")?;
        label(beside(better.bottom(), 8, 13), "no")?;
        label(beside(last.left(), -30, -12), "no")?;
        label(beside(last.bottom(), 8, 13), "yes")?;
        label(beside(moved.left(), -36, -12), "yes")?;
        label(beside(moved.right(), 8, -12), "no")?;
        let limit = [
            "Eq. 16: the impact of joint i alone.".to_owned(),
            "Eq. 20: the norm over the healthy joints.".to_owned(),
            format!("After {} steps it stops and says so.", self.most),
        ];
        let limit = limit.each_ref().map(String::as_str);
        text(area, pen, (pen.at(560), pen.at(118)), &limit, HPos::Left)
    }
}
