//! Crates outside the workspace, built by a cargo of their own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// The generated file that is checked in.
pub(crate) const CHECKED_IN: &str = "examples/checked_in/src/planar_2r.rs";

/// The repository.
pub(crate) fn root() -> &'static Path {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    tests.parent().expect("the folder of the workspace")
}

/// A crate with its own `Cargo.lock`. All of them share one target folder, and with it their dependencies.
pub(crate) struct Crate {
    folder: PathBuf,
}

/// What came of `cargo build`.
pub(crate) struct Build {
    pub(crate) succeeded: bool,
    /// What a user reads, paths made short.
    pub(crate) stderr: String,
    /// `OUT_DIR` of the crate's build script, if it has one.
    pub(crate) out_dir: Option<PathBuf>,
}

impl Crate {
    /// The crate in `folder` of the repository.
    pub(crate) fn of_repository(folder: &str) -> Self {
        let folder = root().join(folder);
        Self { folder }
    }

    /// A crate of a user, made from the example in `folder` but with a table of its own, `arms/planar_2r.toml`.
    pub(crate) fn of_user(name: &str, folder: &str) -> Self {
        let example = root().join(folder);
        let user = Self {
            folder: Path::new(env!("CARGO_TARGET_TMPDIR"))
                .join("users")
                .join(name),
        };
        // Cargo takes crates of one name for the same one if they only differ in their place.
        let own = |text: &str| {
            text.replace(
                "name = \"ulna-example-",
                &format!("name = \"ulna-user-{name}-"),
            )
        };
        let manifest = fs::read_to_string(example.join("Cargo.toml")).unwrap();
        let manifest = manifest.replace("\"../..", &format!("\"{}", root().display()));
        // It lies in the workspace's target folder, and is no part of the workspace all the same.
        user.write("Cargo.toml", &format!("[workspace]\n\n{}", own(&manifest)));
        for file in ["Cargo.lock", "build.rs", "src/main.rs"] {
            if let Ok(text) = fs::read_to_string(example.join(file)) {
                user.write(file, &own(&text).replace("../../arms/", "arms/"));
            }
        }
        user
    }

    pub(crate) fn path(&self, file: &str) -> PathBuf {
        self.folder.join(file)
    }

    /// Writes `text` into `file`, and touches nothing if that is what it holds.
    pub(crate) fn write(&self, file: &str, text: &str) {
        let path = self.path(file);
        if fs::read_to_string(&path).ok().as_deref() != Some(text) {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
    }

    /// Fails if `Cargo.lock` no longer fits the manifests, after mending it.
    pub(crate) fn assert_lock_file_fits(&self) {
        let metadata = ["--format-version=1", "--quiet", "--locked"];
        if self.cargo("metadata", &metadata).status.success() {
            return;
        }
        let mended = self.cargo("metadata", &metadata[..2]);
        let folder = self.folder.display();
        assert!(
            mended.status.success(),
            "{}",
            String::from_utf8_lossy(&mended.stderr)
        );
        panic!("{folder}/Cargo.lock was out of date. It has been written anew: commit it.");
    }

    pub(crate) fn build(&self) -> Build {
        let options = ["--quiet", "--message-format=json-render-diagnostics"];
        let output = self.cargo("build", &options);
        let stderr = String::from_utf8(output.stderr).unwrap();
        let messages = String::from_utf8(output.stdout).unwrap();
        let out_dir = messages.lines().find_map(|line| {
            let message: Value = serde_json::from_str(line).unwrap();
            let package = message["package_id"].as_str()?;
            let own = package.contains(self.folder.to_str()?);
            own.then(|| message["out_dir"].as_str().map(PathBuf::from))?
        });
        Build {
            succeeded: output.status.success(),
            out_dir,
            stderr: stderr
                .replace(&format!("{}/", self.folder.display()), "")
                .replace(&format!("{}", self.folder.display()), "CRATE"),
        }
    }

    /// Everything that cargo has to say while it builds the crate.
    pub(crate) fn messages(&self) -> String {
        let output = self.cargo("build", &[]);
        String::from_utf8(output.stderr).unwrap()
    }

    /// What the crate's program prints.
    pub(crate) fn run(&self) -> String {
        let output = self.cargo("run", &["--quiet"]);
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).unwrap()
    }

    fn cargo(&self, command: &str, options: &[&str]) -> Output {
        Command::new(env!("CARGO"))
            .arg(command)
            .args(options)
            .current_dir(&self.folder)
            .env(
                "CARGO_TARGET_DIR",
                Path::new(env!("CARGO_TARGET_TMPDIR")).join("outside"),
            )
            .env("CARGO_TERM_COLOR", "never")
            .output()
            .unwrap()
    }
}
