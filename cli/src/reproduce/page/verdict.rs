//! What the structure feels of a lock, over gains and rotors, in sentences: each follows from the numbers of the run.

use std::fmt::{self, Write};

use ulna_study::Scenario;
use ulna_study::experiment::{LockVerdict, SearchMethod, Sweep, Verdict};
use ulna_study::scenario::ServoSettings;

use super::besides;
use crate::reproduce::Findings;
use crate::reproduce::verdict::{FIGURE, METHODS, law, outcome, shown};
use crate::reproduce::words::significant;
use crate::setting::{Setting, short, with_rotors};

/// A simulated lock of a sweep: its gain and rotors, and what came of it.
type Cell<'v> = (&'v Verdict, &'v LockVerdict);

/// The section.
pub(super) fn write(page: &mut String, scenario: &Scenario, findings: &Findings) -> fmt::Result {
    writeln!(page, "## What the structure feels of it\n")?;
    let sweeps = match &findings.sweeps {
        Ok(sweeps) => sweeps,
        Err(error) => return writeln!(page, "It could not be simulated: {error}.\n"),
    };
    let Some(sweep) = sweeps.first() else {
        return Ok(());
    };
    setting(page, scenario, sweep)?;
    let verdicts = Verdict::of(sweeps);
    if let Some(own) = verdicts.iter().find(|verdict| verdict.own) {
        of_the_scenario(page, sweeps, own)?;
    }
    for (method, title) in METHODS {
        of_a_method(page, &verdicts, method, title)?;
    }
    writeln!(page)?;
    where_none_helps(page, &verdicts)?;
    heaviest(page, sweeps)?;
    table(page, sweeps)?;
    match &findings.simulations {
        Ok(simulations) => besides::write(page, simulations),
        Err(_) => Ok(()),
    }
}

/// What is varied, and what is not.
fn setting(page: &mut String, scenario: &Scenario, sweep: &Sweep) -> fmt::Result {
    let gains: Vec<_> = sweep.gains.iter().map(f64::to_string).collect();
    let rotors: Vec<_> = sweep.rotors.iter().map(short).collect();
    writeln!(
        page,
        "What a joint transmits to the structure is what its motor and its brake give, less what accelerates its rotor. \
         Its step at a lock is taken from just before the lock to when the brake has done its work and the controller knows, as a control cycle at either time makes it; \
         below, its norm over the healthy joints. \
         It depends on what holds the healthy joints to their plan, and so it is simulated with gains of the servo of {} rad/s (0 is no feedback) \
         and with rotors of {} kg·m² (kg at sliding joints), as the joints feel them; `own` are those of [motors]. \
         This scenario has: {}. The motors hold their torques for {} s. A change by less than {} % counts as none.\n",
        listed(&gains),
        listed(&rotors),
        Setting::own(sweep).in_words(),
        sweep.cycle,
        100.0 * Verdict::NOTABLE,
    )?;
    if !sweep.unstable_gains.is_empty() {
        let gains: Vec<_> = sweep.unstable_gains.iter().map(f64::to_string).collect();
        writeln!(
            page,
            "Gains of {} rad/s are left out: the gain times the control cycle of {} s is not below 1, and such a loop is not stable by itself.\n",
            listed(&gains),
            sweep.cycle,
        )?;
    }
    if sweep.brake_time.max(sweep.detection) < sweep.cycle {
        writeln!(
            page,
            "The lock is over before the next control cycle: until that one the motors go on with what they held before, and the step comes with it.\n"
        )?;
    }
    let servo = scenario.servo();
    if !ServoSettings::is_stable(servo.gain(), sweep.cycle) {
        writeln!(
            page,
            "**The scenario's own servo is not stable with this cycle**: its gain of {} rad/s times {} s is not below 1. What is simulated with it says more about the servo than about the lock.\n",
            servo.gain(),
            sweep.cycle,
        )?;
    }
    Ok(())
}

/// The verdict on the scenario as it is.
fn of_the_scenario(page: &mut String, sweeps: &[Sweep], own: &Verdict) -> fmt::Result {
    for (sweep, lock) in sweeps.iter().zip(&own.locks) {
        let (Some(without), Some(felt)) = (lock.without, sweep.felt(own.gain, &own.rotors, None))
        else {
            writeln!(
                page,
                "- Lock at {} s, as the scenario has it: the simulation did not come to its end.",
                lock.failure_time
            )?;
            continue;
        };
        let effects: Vec<_> = lock
            .with
            .iter()
            .filter_map(|(method, with)| {
                Some(format!(
                    "{} N·m with {}",
                    significant((*with)?),
                    law(*method)
                ))
            })
            .collect();
        let verdict = match lock.helps() {
            Some((method, ratio)) => format!(
                "{} lowers it most, by {:.1} %",
                law(method),
                100.0 * (1.0 - ratio)
            ),
            None => "no compensation lowers it".to_owned(),
        };
        writeln!(
            page,
            "- Lock at {} s, as the scenario has it: a step of {} N·m is predicted without compensation, and {} N·m are transmitted; {}: **{verdict}**.",
            lock.failure_time,
            significant(felt.predicted_step),
            significant(without),
            listed(&effects),
        )?;
    }
    writeln!(page)
}

/// Where a method lowers the step, and where it raises it.
fn of_a_method(
    page: &mut String,
    verdicts: &[Verdict],
    method: SearchMethod,
    title: &str,
) -> fmt::Result {
    let cells = verdicts
        .iter()
        .flat_map(|verdict| verdict.locks.iter().map(move |lock| (verdict, lock)));
    let mut known: Vec<(Cell<'_>, f64)> = cells
        .filter_map(|cell| Some((cell, cell.1.ratio(method)?)))
        .collect();
    known.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (Some((best, least)), Some((worst, most))) = (known.first(), known.last()) else {
        return Ok(());
    };
    let lowered = known.iter().filter(|((_, lock), _)| lock.lowers(method));
    let raised = known
        .iter()
        .filter(|(_, ratio)| *ratio > 1.0 + Verdict::NOTABLE);
    let (lowered, raised) = (lowered.count(), raised.count());
    let example = |(verdict, lock): &Cell<'_>, ratio: f64| {
        let without = lock.without.unwrap_or(0.0);
        format!(
            "from {} to {} N·m at {} s with a gain of {} rad/s and {}",
            significant(without),
            significant(without * ratio),
            lock.failure_time,
            verdict.gain,
            with_rotors(&verdict.rotors)
        )
    };
    let mut sentence = format!("- {title}: of {} simulated locks", known.len());
    match lowered {
        0 => write!(sentence, " it lowers none")?,
        count => write!(
            sentence,
            " it lowers {count}, most {}",
            example(best, *least)
        )?,
    }
    match raised {
        0 => write!(sentence, ", and raises none")?,
        count => write!(
            sentence,
            ", and raises {count}, most {}",
            example(worst, *most)
        )?,
    }
    writeln!(page, "{sentence}.")
}

/// The gains and rotors at which no compensation lowers any lock, and those at which one lowers each.
fn where_none_helps(page: &mut String, verdicts: &[Verdict]) -> fmt::Result {
    let known = |verdict: &&Verdict| verdict.locks.iter().any(|lock| lock.best().is_some());
    let named = |chosen: &dyn Fn(&Verdict) -> bool| {
        let chosen = verdicts
            .iter()
            .filter(known)
            .filter(|verdict| chosen(verdict));
        by_gain(&chosen.collect::<Vec<_>>())
    };
    let never = named(&|verdict| verdict.locks.iter().all(|lock| lock.helps().is_none()));
    let always = named(&|verdict| verdict.locks.iter().all(|lock| lock.helps().is_some()));
    match never {
        Some(never) => writeln!(
            page,
            "**No compensation lowers the step of any lock** with {never}.\n"
        )?,
        None => writeln!(
            page,
            "With every gain and all rotors some compensation lowers the step of one lock at least.\n"
        )?,
    }
    match always {
        Some(always) => writeln!(
            page,
            "Some compensation lowers the step of every lock with {always}.\n"
        ),
        None => writeln!(
            page,
            "With no gain and no rotors is the step of every lock lowered.\n"
        ),
    }
}

/// "a gain of 0 rad/s and rotors of 0 or 100 kg·m²; ..."; `None` for none.
fn by_gain(verdicts: &[&Verdict]) -> Option<String> {
    let mut groups: Vec<(f64, Vec<String>)> = Vec::new();
    for verdict in verdicts {
        let rotors = short(&verdict.rotors);
        match groups.last_mut() {
            Some((gain, group)) if *gain == verdict.gain => group.push(rotors),
            _ => groups.push((verdict.gain, vec![rotors])),
        }
    }
    let groups = groups
        .iter()
        .map(|(gain, rotors)| {
            let rotors = rotors.join(" or ");
            format!("a gain of {gain} rad/s and rotors of {rotors} kg·m²")
        })
        .collect::<Vec<_>>();
    (!groups.is_empty()).then(|| groups.join("; "))
}

/// The geared end of the sweep, beside the prediction.
fn heaviest(page: &mut String, sweeps: &[Sweep]) -> fmt::Result {
    let Some(rotors) = sweeps.first().and_then(|sweep| sweep.rotors.last()) else {
        return Ok(());
    };
    let locks = sweeps.iter().filter_map(|sweep| {
        let gain = sweep.gains.first()?;
        let [without, with] =
            [None, Some(SearchMethod::PerJoint)].map(|method| sweep.felt(*gain, rotors, method));
        let (without, with) = (without?, with?);
        Some(format!(
            "{} N·m at {} s where {} are predicted, and {} with Eq. 16 where {} are",
            significant(without.step),
            sweep.failure_time,
            significant(without.predicted_step),
            significant(with.step),
            significant(with.predicted_step),
        ))
    });
    let locks: Vec<_> = locks.collect();
    if locks.is_empty() {
        return Ok(());
    }
    let gain = sweeps[0].gains.first().copied().unwrap_or(0.0);
    writeln!(
        page,
        "With the heaviest rotors ({}) and a gain of {gain} rad/s the healthy joints transmit {}. \
         The heavier the rotors, the better the joints keep to their plan; but what a compensation adds has to accelerate them too.\n",
        with_rotors(rotors),
        locks.join("; "),
    )
}

/// The two cuts through the sweep.
fn table(page: &mut String, sweeps: &[Sweep]) -> fmt::Result {
    let titles: Vec<_> = METHODS.map(|(_, title)| title).into();
    writeln!(
        page,
        "Step that the healthy joints transmit (norm, N·m), with the scenario's rotors and with its gain; all others are in `sweep.csv`:\n\n\
         | lock, s | gain, rad/s | rotors, kg·m² | none | {} | lowered most by |\n|---|---|---|---|---|---|---|---|",
        titles.join(" | ")
    )?;
    let verdicts = shown(sweeps);
    for (i, sweep) in sweeps.iter().enumerate() {
        for verdict in &verdicts {
            let Some(lock) = verdict.locks.get(i) else {
                continue;
            };
            let step = |step: Option<f64>| step.map_or_else(String::new, significant);
            let with = METHODS.map(|(method, _)| {
                let with = lock.with.iter().find(|(known, _)| *known == method);
                step(with.and_then(|(_, with)| *with))
            });
            writeln!(
                page,
                "| {} | {} | {} | {} | {} | {} |",
                sweep.failure_time,
                verdict.gain,
                short(&verdict.rotors),
                step(lock.without),
                with.join(" | "),
                outcome(lock),
            )?;
        }
    }
    let caption = "The step that the healthy joints transmit: on the left with the scenario's rotors, on the right with its gain";
    writeln!(
        page,
        "\n![{caption}](figures/{FIGURE}.svg)\n\n*{caption}.*\n"
    )
}

/// "a", "a and b", "a, b and c".
fn listed(parts: &[String]) -> String {
    match parts {
        [] => String::new(),
        [only] => only.clone(),
        [others @ .., last] => format!("{} and {last}", others.join(", ")),
    }
}
