//! The page in words: what the numbers of this run say, and nothing else.

use std::fmt::Write;

use ulna_study::assess::{GroundTruth, Law, LawAssessment};

use super::table::{columns, failure, felt_columns, heading, name, simulated, title};
use super::{Findings, MAPS, PAIRS};
use crate::numbers::significant;

/// Markdown.
pub(super) fn write(findings: &Findings<'_>) -> String {
    let mut page = "# Every law over failures for which it was not tuned\n\n".to_owned();
    for sentence in heading(findings) {
        let _ = writeln!(page, "{sentence}.");
    }
    page.push('\n');
    for sentence in sentences(findings) {
        let _ = writeln!(page, "- {sentence}");
    }
    page.push('\n');
    let (head, rows) = columns(findings);
    // A bar would end the cell.
    let head: Vec<_> = head.iter().map(|text| text.replace('|', "\\|")).collect();
    table(&mut page, &head, &rows);
    let _ = write!(
        page,
        "\nThe force error is the static one of Eq. 13, at worst over the whole motion, and at the lock; what the tool is to exert is not in it.\n\
         The limit knows the joint and the time and keeps the static tool force: it is a bound, not a law.\n\n\
         ![ratio of the step after to before, by law, joint and time]({MAPS}.png)\n"
    );
    if findings.has_pairs() {
        let _ = write!(page, "\n![the same for pairs of joints]({PAIRS}.png)\n");
    }
    if findings.simulated > 0 {
        let _ = write!(
            page,
            "\n## What the structure feels\n\n{}.\n",
            simulated(findings)
        );
        for sentence in felt(findings) {
            let _ = writeln!(page, "- {sentence}");
        }
        let (head, rows) = felt_columns(findings);
        page.push('\n');
        table(&mut page, &head, &rows);
    }
    let notes = findings.assessment.laws.iter();
    let notes: Vec<_> = notes.filter(|law| !law.note.is_empty()).collect();
    if !notes.is_empty() {
        page.push_str("\n## How the searches ended\n\n");
        for law in notes {
            let _ = writeln!(page, "- {}: {}", title(law), law.note);
        }
    }
    page
}

/// A table in Markdown.
fn table(page: &mut String, head: &[String], rows: &[Vec<String>]) {
    let _ = writeln!(page, "| {} |", head.join(" | "));
    let _ = writeln!(page, "|{}", " --- |".repeat(head.len()));
    for row in rows {
        let _ = writeln!(page, "| {} |", row.join(" | "));
    }
}

/// A force error below it is rounding, N.
const FORCE_ROUNDING: f64 = 1e-6;

/// A change by less counts as none.
const NOTABLE: f64 = 0.01;

/// What can be said of this run.
fn sentences(findings: &Findings<'_>) -> Vec<String> {
    let mut said = Vec::new();
    let laws = &findings.assessment.laws;
    if findings.assessment.largest == 0.0 {
        said.push("No lock in this motion makes a step: there is nothing to suppress.".to_owned());
        return said;
    }
    if findings.null_space == 0 {
        said.push(
            "The task takes all joints: there is no null space, and no compensation keeps the static tool force.".to_owned(),
        );
    }
    for law in laws.iter().filter(|law| law.tuned.is_some()) {
        said.push(tuned(law));
    }
    let bounded = |law: &&LawAssessment| !matches!(law.law, Law::None | Law::Limit);
    let harmless: Vec<_> = laws
        .iter()
        .filter(bounded)
        .filter(|law| law.singles.share_worse == 0.0)
        .map(title)
        .collect();
    match &harmless[..] {
        [] => said.push("Every law makes some failure worse.".to_owned()),
        names => said.push(format!(
            "No failure of a single joint is made worse by: {}.",
            names.join("; ")
        )),
    }
    let best = laws
        .iter()
        .filter(bounded)
        .min_by(|a, b| a.singles.worst_ratio.total_cmp(&b.singles.worst_ratio));
    if let Some(best) = best {
        let singles = &best.singles;
        said.push(format!(
            "The least worst ratio, {}, is that of {}; its force error is at most {} N.",
            significant(singles.worst_ratio),
            title(best),
            significant(singles.worst_force_error)
        ));
    }
    if let Some(limit) = laws.iter().find(|law| law.law == Law::Limit) {
        said.push(format!(
            "With the static tool force kept and the failure known, the median ratio is {} and the worst {}.",
            significant(limit.singles.median_ratio),
            significant(limit.singles.worst_ratio)
        ));
    }
    said
}

/// Which law lowers what is felt at each gain.
fn felt(findings: &Findings<'_>) -> Vec<String> {
    let sentence = |truth: &GroundTruth| {
        let laws = truth.laws.iter();
        let laws = laws.filter(|law| !matches!(law.law, Law::None | Law::Limit));
        let best = laws.min_by(|a, b| a.median_ratio.total_cmp(&b.median_ratio))?;
        let name = name(best.law, best.force_budget);
        Some(if best.median_ratio < 1.0 - NOTABLE {
            format!(
                "With a gain of {} rad/s the lowest median, {}, is that of {name}; its worst is {}.",
                truth.gain,
                significant(best.median_ratio),
                significant(best.worst_ratio)
            )
        } else {
            format!(
                "With a gain of {} rad/s no law lowers the median by 1 %.",
                truth.gain
            )
        })
    };
    findings.felt.iter().filter_map(sentence).collect()
}

fn tuned(law: &LawAssessment) -> String {
    let singles = &law.singles;
    let for_what = law.tuned.as_ref().map_or_else(String::new, failure);
    let worst = singles.worst.as_ref().map_or_else(String::new, failure);
    let force = if singles.worst_force_error > FORCE_ROUNDING {
        format!(
            "it bends the static tool force by up to {} N on the way",
            significant(singles.worst_force_error)
        )
    } else {
        "it keeps the static tool force".to_owned()
    };
    let worse = if singles.share_worse > 0.0 {
        format!(
            "makes {:.0} % of the {} failures of single joints worse, at worst {worst} by a factor of {}",
            100.0 * singles.share_worse,
            singles.count,
            significant(singles.worst_ratio)
        )
    } else {
        format!(
            "makes none of the {} failures of single joints worse",
            singles.count
        )
    };
    format!("{}, tuned for {for_what}, {worse}; {force}.", title(law))
}
