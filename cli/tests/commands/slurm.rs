//! `ulna campaign --slurm`: the script is run as Slurm runs it, by a `sbatch` that waits for nobody.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use crate::support::{root, stderr, stdout, ulna};

const SCENARIO: &str = "scenarios/paper_like.toml";

/// Notes its arguments; runs each task of the array, or what comes by stdin, the merge.
const SBATCH: &str = r#"#!/bin/bash
set -euo pipefail
echo "$*" >> "$CALLS"
if [[ "$1" == --parsable ]]; then
    script="${@: -1}"
    last=$(sed -n 's/^#SBATCH --array=1-//p' "$script")
    for ((task = 1; task <= last; task++)); do
        SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=2 bash "$script" >&2
    done
    echo '4711;cluster'
else
    bash
fi
"#;

fn write_executable(path: &Path, text: &str) {
    fs::write(path, text).unwrap();
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
}

/// In folders with blanks and quotes in their names.
#[test]
fn the_script_makes_the_campaign() {
    let folder = tempfile::tempdir().unwrap();
    let home = folder.path().join("it's a \"$HOME\"; `here`");
    fs::create_dir(&home).unwrap();
    let scenario = home.join("a scenario.toml");
    fs::copy(root().join(SCENARIO), &scenario).unwrap();
    let output = home.join("out put");
    let [scenario, out] = [&scenario, &output].map(|path| path.to_str().unwrap());
    let fixed = ["campaign", scenario, "--cases", "42", "--output", out];
    let slurm = ["--slurm", "--shards", "3"];
    let text = stdout(&ulna(&[&fixed[..], &slurm].concat()).code(0).stderr(""));
    assert!(!output.exists(), "nothing is made yet");
    let lines: Vec<_> = text
        .lines()
        .filter(|line| line.starts_with("#SBATCH "))
        .collect();
    for line in [
        "--array=1-3",
        "--requeue",
        "--cpus-per-task=1",
        "--job-name=ulna-paper_like",
    ] {
        assert!(
            lines.contains(&&*format!("#SBATCH {line}")),
            "{line}: {text}"
        );
    }
    let time = lines
        .iter()
        .find_map(|line| line.strip_prefix("#SBATCH --time="));
    // Ten minutes, and four times what is measured.
    let time: u64 = time.unwrap().parse().unwrap();
    assert!((11..30).contains(&time), "{time}");
    assert_eq!(text.matches("set -euo pipefail\n").count(), 2, "{text}");

    // Each task by itself: what Slurm runs of `sbatch SCRIPT`.
    let script = home.join("a script.sh");
    fs::write(&script, &text).unwrap();
    for task in ["1", "3"] {
        let run = Command::new("bash")
            .arg(&script)
            .env("SLURM_ARRAY_TASK_ID", task)
            .output();
        let run = run.unwrap();
        assert!(
            run.status.success(),
            "{}",
            String::from_utf8_lossy(&run.stderr)
        );
        assert!(
            output
                .join(format!("campaign-000{task}-of-0003.csv"))
                .exists()
        );
    }
    assert!(!output.join("campaign-0002-of-0003.csv").exists());

    // All of it, with what the user gives to sbatch: two tasks find their shard there, and the merge comes last.
    let bin = folder.path().join("bin");
    fs::create_dir(&bin).unwrap();
    write_executable(&bin.join("sbatch"), SBATCH);
    let calls = folder.path().join("calls");
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let run = Command::new("bash")
        .arg(&script)
        .args(["--account", "some one"])
        .env("PATH", path)
        .env("CALLS", &calls)
        .output()
        .unwrap();
    let err = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{err}");
    assert_eq!(err.matches("14 of 14 cases are in").count(), 2, "{err}");
    assert!(err.contains("42 of 42 cases are in"), "{err}");
    let calls = fs::read_to_string(calls).unwrap();
    let calls: Vec<_> = calls.lines().collect();
    assert_eq!(calls.len(), 2, "{calls:?}");
    assert!(
        calls[0].starts_with("--parsable --account some one "),
        "{calls:?}"
    );
    assert_eq!(
        calls[1],
        "--dependency=afterok:4711 --kill-on-invalid-dep=yes --account some one"
    );

    let alone = folder.path().join("alone");
    let arguments = [&fixed[..5], &[alone.to_str().unwrap()]].concat();
    ulna(&arguments).code(0);
    for name in [
        "campaign.csv",
        "campaign.json",
        "campaign.md",
        "figures/campaign.png",
    ] {
        let [made, alone] = [&output, &alone].map(|folder| fs::read(folder.join(name)).unwrap());
        assert!(made == alone, "{name}");
    }
}

#[test]
fn what_the_script_cannot_have_or_a_user_may_have_to_change() {
    let folder = tempfile::tempdir().unwrap();
    let run = |output: &str, arguments: &[&str]| {
        let output = folder.path().join(output);
        let fixed = [
            "campaign",
            SCENARIO,
            "--slurm",
            "--output",
            output.to_str().unwrap(),
        ];
        ulna(&[&fixed[..], arguments].concat())
    };
    let err = stderr(&run("two\nlines", &[]).code(1).stdout(""));
    assert!(err.contains("cannot be written into a script"), "{err}");
    let err = stderr(
        &run("out", &["--cases", "5", "--shards", "6"])
            .code(1)
            .stdout(""),
    );
    assert!(err.contains("6 shards of 5 cases"), "{err}");
    let err = stderr(&run("out", &["--cases", "20000000", "--shards", "2000"]).code(0));
    assert!(
        err.contains("MaxArraySize") && err.contains("of the first 10000000 of 20000000"),
        "{err}"
    );
    // Half an hour each, and not more than an array has.
    let shards = |cases: &str| {
        let text = stdout(&run("out", &["--cases", cases]).code(0));
        let array = text
            .lines()
            .find_map(|line| line.strip_prefix("#SBATCH --array=1-"));
        array.unwrap().parse::<u64>().unwrap()
    };
    assert_eq!(shards("10"), 1);
    assert_eq!(shards("1000000000000"), 1000);
}
