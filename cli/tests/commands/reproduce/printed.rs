//! The tables on the console, beside the paper's.

/// The cells of the first row that starts with `title`.
fn row<'t>(text: &'t str, title: &str) -> Vec<&'t str> {
    let line = text
        .lines()
        .find(|line| line.trim_start().starts_with(title));
    let line = line.unwrap_or_else(|| panic!("no row {title:?} in:\n{text}"));
    line.trim_start()[title.len()..]
        .split_whitespace()
        .collect()
}

pub(super) fn tables_stand_beside_the_papers(out: &str) {
    assert!(
        out.starts_with("paper_like: arm ssrms, joint 2 locks (fitted"),
        "{out}"
    );
    // Before, the paper's, after the paper's search, the paper's, after the exact search, Eq. 20, optimal.
    assert_eq!(
        row(out, "1 "),
        ["35.97", "30.18", "0.1052", "0.1472", "0", "4.983", "3.896"]
    );
    assert_eq!(row(out, "2 (locks)")[..2], ["61.95", "66.72"]);
    assert_eq!(
        row(out, "norm, healthy joints"),
        ["42.87", "0.1173", "3.8e-4", "9.973", "6.591"]
    );
    assert_eq!(
        row(out, "10 s  paper, Table 4"),
        ["-9e7", "-8.5e7", "-9e7", "-8.5e7", "-1.2e8", "-1e8", "0"]
    );
    // Each with its own power of ten: a small one loses no digits to a large one.
    assert_eq!(
        row(out, "10 s  in steps"),
        ["5.1e7", "-8.1e7", "3.9e7", "-3.8e7", "1.1e7", "8e6", "0"]
    );
    assert_eq!(row(out, "10 s  exactly")[5], "7.770e6");
    // What the tool is asked to exert stands beside what it is off by.
    assert_eq!(
        row(out, "force error at the lock, N (34.64 asked)"),
        ["0", "13.57", "13.71", "0", "0"]
    );
    assert_eq!(
        row(out, "4               1.237 N m")[..3],
        ["80.89", "-3.827", "80.80"]
    );
    assert!(out.contains("with ever shorter brakes"), "{out}");
    let delta = "the first torque after the lock is taken 0.01 s after it (Delta t of Eq. 18)\n";
    assert_eq!(out.matches(delta).count(), 1);
    what_rated_torques_cut_is_printed(out);
    the_plans_steps_stand_beside_the_locks(out);
    // No norm without the joints that pay for it, and what proves that some have to.
    for line in [
        " Eq.16: no healthy joint is worse off\n",
        " Eq.20: worse off: joint 4 at 2.17 times its step, joint 5 at 3.10 times its step, joint 6 at 4.67 times its step; certificate 0.5564 N m per N\n",
        " optimal: worse off: joint 4 at 2.50 times its step; certificate 0.5564 N m per N\n",
        " certificate: no law that keeps the tool force lowers joints 1, 2, 3, 4, 5 and 6 all at once; a wrench",
        " tool force kept and no healthy joint worse off: 39.21 of 42.87 N m, or each of them at 95.1 % of its step at most; the locked joints no worse off either: 42.87 N m\n",
    ] {
        assert!(out.contains(line), "{line} is missing in:\n{out}");
    }
    // The field decides nothing but the force error, and what acts after the lock alone little.
    let ablation = |law: &str, what: &str| {
        let (_, table) = out.split_once("what it is due to, 5.2").unwrap();
        let mut lines = table.lines().map(str::trim_start);
        let line = lines.find(|line| line.contains(law) && line.contains(what));
        let (_, figures) = line.unwrap().split_once(what).unwrap();
        figures
            .split_whitespace()
            .next()
            .unwrap()
            .parse::<f64>()
            .unwrap()
    };
    for field in ["grad w_D", "grad w, kinematic", "ones", "random"] {
        assert!(ablation("Eq.16", field) < 1e-3 && ablation("Eq.20", field) == 9.973);
    }
    assert_eq!(ablation("optimal", "before only"), 6.591);
    assert_eq!(ablation("optimal", "after only"), 42.22);
    assert!(!out.contains(" \n"), "blanks at the end of a line:\n{out}");
}

/// Of Section 5.3, with the paper's Table 3 below each joint of it.
fn what_rated_torques_cut_is_printed(out: &str) {
    let (_, cut) = out.split_once("that rated torques cut\n").unwrap();
    assert_eq!(row(cut, "10 s      4")[4..], ["s", "75.6", "%"]);
    assert_eq!(row(cut, "10 s      6")[2], "upper");
    let (_, cost) = out
        .split_once("what the rated torques cost at 10 s")
        .unwrap();
    assert!(cost.starts_with(": Eq. 16 without and with them; below: paper, Table 3"));
    let ours = row(cost, "4 ");
    assert_eq!(ours[ours.len() - 4..], ["75.63", "%", "24.37", "%"]);
    let theirs = row(cost, "there ");
    assert_eq!(
        theirs.join(" "),
        "1.240 0.00580 99.53 % 0.2684 78.35 % 21.58 %"
    );
    let mean = row(cost, "mean tau^e of joints 4, 5 and 6:").join(" ");
    assert!(
        mean.starts_with("10") && mean.ends_with(" N m, of 160.7 N m rated; there 254.2"),
        "{mean}"
    );
}

fn the_plans_steps_stand_beside_the_locks(out: &str) {
    let (_, steps) = out.split_once("steps of the planned torque").unwrap();
    assert_eq!(row(steps, "trapezoid ")[..3], ["483.2", "20", "s"]);
    for profile in ["quintic ", "s_curve "] {
        assert_eq!(row(steps, profile)[0], "0");
    }
    assert_eq!(row(steps, "quintic ").last(), Some(&"75.34"));
}
