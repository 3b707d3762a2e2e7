"""The file of methods, and the stubs, say what the native half does."""

import inspect
import subprocess
import sys
from pathlib import Path

import ulna

from conftest import TABLE

TOOLS = Path(__file__).parent.parent / "tools"


def test_the_file_of_methods_follows_the_table(tmp_path):
    sys.path.insert(0, str(TOOLS))
    import write_methods

    old, new = write_methods.FILE.read_text(encoding="utf-8"), write_methods.module()
    if old != new:
        write_methods.FILE.write_text(new, encoding="utf-8")
    assert old == new, f"{write_methods.FILE} was out of date and has been written anew: look at the change and commit it"


def test_every_method_has_its_arguments_by_name():
    for method, (arguments, _) in TABLE.items():
        signature = inspect.signature(getattr(ulna.Arm, method))
        assert [*signature.parameters] == ["self", *arguments, "out", "threads"]


def test_docs_have_no_links_that_python_cannot_follow():
    for method in TABLE:
        text = getattr(ulna.Arm, method).__doc__
        assert "](" not in text and "crate::" not in text and "Self::" not in text, text


def test_the_stubs_are_those_of_the_native_half():
    checked = subprocess.run([sys.executable, "-m", "mypy.stubtest", "ulna"], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_types_hold(tmp_path):
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--no-warn-return-any", "--cache-dir", str(tmp_path), "-p", "ulna"],
        capture_output=True,
        text=True,
    )
    assert checked.returncode == 0, checked.stdout + checked.stderr
