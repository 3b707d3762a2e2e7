//! Axes that are almost parallel.

use ulna_table::diagnostics::Diagnostic;
use ulna_table::toml_reader::closest;

use crate::chain::Chain;
use crate::import::Import;
use crate::report::Report;
use crate::rows::{NEARLY_PARALLEL, NearlyParallel, Rows};
use crate::tree::{Tree, some_of};

/// Which joints of the chain may be taken as parallel to those before them. Reports names that no joint of it has.
pub(crate) fn parallel(import: &Import, tree: &Tree, chain: &Chain, report: &Report) -> Vec<usize> {
    let names = || chain.joints.iter().map(|joint| &tree.joint(*joint).name);
    let mut found = Vec::new();
    for name in &import.parallel {
        match names().position(|known| known == name) {
            Some(joint) => found.push(joint),
            None => {
                let message = format!("the chain has no joint `{name}` for `--parallel`");
                let help = match closest(name, names()) {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None => format!("its joints are {}", some_of(&names().collect::<Vec<_>>())),
                };
                report.push(Diagnostic::file_error(message).help(help));
            }
        }
    }
    found
}

/// Says which axes are almost parallel, and so that rows say it badly: they are taken as parallel, or refused.
pub(crate) fn doubts(
    tree: &Tree,
    chain: &Chain,
    rows: &Result<Rows, Vec<NearlyParallel>>,
    report: &Report,
) {
    let (doubts, refused) = match rows {
        Ok(rows) => (&rows.nearly_parallel, false),
        Err(doubts) => (doubts, true),
    };
    for doubt in doubts {
        let [before, joint] = [doubt.joint - 1, doubt.joint].map(|i| tree.joint(chain.joints[i]));
        let span = joint.origin.span.clone();
        let almost = format!(
            "the axes of joints `{}` and `{}` are almost parallel: {:.1e} rad are missing",
            before.name, joint.name, doubt.angle
        );
        let label = format!("their common normal is {:.0} m away", doubt.distance);
        report.push(if refused {
            Diagnostic::error(
                span,
                format!("{almost}; rows of Denavit and Hartenberg lose their digits there"),
            )
            .label(label)
            .help(format!(
                "`--parallel {}` takes them as parallel, as the arm was meant before it was calibrated",
                joint.name
            ))
        } else {
            Diagnostic::warning(span, format!("{almost}; they are taken as parallel"))
                .label(label)
                .help(if doubt.angle <= NEARLY_PARALLEL {
                    "write angles with all digits: 1.5707963267948966 for a quarter turn"
                } else {
                    "as `--parallel` asks; a note says how far the tool moves by it"
                })
        });
    }
}
