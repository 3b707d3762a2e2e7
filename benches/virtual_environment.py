"""Lets a bench run by the interpreter of a virtual environment of its own."""

import os
import subprocess
import sys
from pathlib import Path


def enter(here: Path):
    """Returns if the interpreter is that of `here`'s environment; else makes the environment of `here/requirements.txt`
    where it is absent or of another text, and runs the script again in it."""
    environment = here / ".venv"
    if Path(sys.prefix) == environment:
        return
    wanted = (here / "requirements.txt").read_text()
    installed = environment / "requirements.txt"
    if not installed.exists() or installed.read_text() != wanted:
        subprocess.run([sys.executable, "-m", "venv", "--clear", environment], check=True)
        subprocess.run([environment / "bin/pip", "install", "--quiet", "-r", here / "requirements.txt"], check=True)
        installed.write_text(wanted)
    python = str(environment / "bin/python")
    os.execv(python, [python, *sys.argv])
