"""The C code of an arm: generated, compiled, looked at, run under valgrind."""

import hashlib
import json
import os
import re
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
BUILD = ROOT / "target/checked_c"

WARNINGS = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]
COMPILERS = ["gcc", "clang"]
CONTRACTIONS = ["off", "fast"]
PRECISIONS = ["double", "float"]
# Multiply-adds are there to be fused.
MACHINE = ["-march=x86-64-v3"]

PROTOTYPE = re.compile(r"^void (\w+)\(([^)]*)\);", re.MULTILINE)
PARAMETER = re.compile(r"(\w+)\[(\d+)\]")


@dataclass
class Files:
    arm: str
    precision: str
    folder: Path

    def sources(self):
        return sorted(self.folder.glob("*.c"))

    def library(self, compiler, contraction):
        return self.folder / f"{compiler}-{contraction}.so"


@dataclass
class Checked:
    arm: str
    # What was not asked for is None.
    compiled: list  # (precision, compiler, contraction, warnings)
    findings: dict  # source file -> how often each rule was found against
    memory: dict  # precision -> what valgrind says, or nothing

    @property
    def faults(self):
        warnings = [text for *_, text in self.compiled]
        findings = sum((found for found in self.findings.values() if found is not None), start=Counter())
        return sum(map(bool, [*warnings, *self.memory.values()])) + findings.total()


def run(command, may_fail=False, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0 and not may_fail:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done


def program():
    run(["cargo", "build", "--package", "ulna-cli"], cwd=ROOT)
    return ROOT / "target/debug/ulna"


def rust():
    """Every arm's generated Rust behind C functions: the library of benches/peers, default flags."""
    target = ROOT / "target/peers/rust-default"
    cargo = ["cargo", "build", "--release", "--package", "ulna-peers", "--features", "all-arms", "--target-dir", target]
    run(cargo, cwd=ROOT, env=os.environ | {"RUSTFLAGS": ""})
    return target / "release/libulna_peers.so"


def generated(ulna, arm):
    """In both precisions, the one in double with CasADi's functions."""
    found = []
    for precision in PRECISIONS:
        files = Files(arm, precision, BUILD / arm / precision)
        interface = ["--abi", "casadi"] if precision == "double" else []
        command = [ulna, "generate", ROOT / f"arms/{arm}.toml", "--language", "c", "--precision", precision, *interface]
        run([*command, "--output", files.folder])
        found.append(files)
    return found


def digest(paths):
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).hexdigest()[:8]


# Whether what has not been asked before stays unasked.
known_alone = False


def said(command, folder, inputs):
    """What a command prints, and whether it failed; of the same command on the same files only once. Its paths are relative to the folder."""
    key = hashlib.sha256(json.dumps([str(word) for word in command]).encode())
    for path in inputs:
        key.update(path.read_bytes())
    record = BUILD / "said" / f"{key.hexdigest()[:24]}.json"
    if not record.exists():
        if known_alone:
            return None, None
        done = run(command, may_fail=True, cwd=folder)
        record.parent.mkdir(exist_ok=True)
        record.write_text(json.dumps([done.stdout + done.stderr, done.returncode]))
    return json.loads(record.read_text())


def checked(arm, files):
    return Checked(arm, compiled(files), findings(files), memory(files))


def headers(one):
    return sorted(one.folder.glob("*.h"))


def compiled(files):
    found = []
    for one in files:
        for compiler in COMPILERS:
            for contraction in CONTRACTIONS:
                flags = [*WARNINGS, "-O2", *MACHINE, f"-ffp-contract={contraction}", "-fPIC", "-c"]
                texts, objects = [], []
                for source in one.sources():
                    inputs = [source, *headers(one)]
                    # Another text is another object.
                    objects.append(f"{source.stem}-{compiler}-{contraction}-{digest(inputs)}.o")
                    texts.append(said([compiler, *flags, source.name, "-o", objects[-1]], one.folder, inputs)[0])
                is_known = None not in texts
                if is_known and not any(texts):
                    run([compiler, "-shared", *objects, "-o", one.library(compiler, contraction), "-lm"], cwd=one.folder)
                found.append((one.precision, compiler, contraction, "".join(texts) if is_known else None))
    return found


def findings(files):
    """Of cppcheck, its style included, and of its MISRA add-on. One at a time in a folder: runs in one overwrite each other's files."""
    found = {}
    for one in files:
        checks = ["--addon=misra", "--enable=warning,style,performance,portability", "--quiet", "--template={id}"]
        for source in one.sources():
            text, _ = said(["cppcheck", *checks, source.name], one.folder, [source, *headers(one)])
            lines = text.split("\n") if text is not None else None
            found[one.precision, source.name] = lines and Counter(line for line in lines if line)
    return found


def prototypes(files):
    """Names of the functions for methods, each with the names and lengths of its parameters."""
    header = (files.folder / f"{files.arm}.h").read_text()
    return {name: [(parameter, int(length)) for parameter, length in PARAMETER.findall(text)] for name, text in PROTOTYPE.findall(header)}


def memory(files):
    """Every function on arrays that are as long as its prototype says, the results read: nothing that is not there, nothing that was not written."""
    found = {}
    for one in files:
        if not one.library("gcc", "off").exists():
            found[one.precision] = None
            continue
        source = one.folder / "every_function.txt"
        source.write_text(every_function(one))
        command = ["gcc", "-g", "-O1", "-x", "c", source.name, "-x", "none", "-I.", one.library("gcc", "off").name]
        run([*command, "-Wl,-rpath,.", "-o", "every_function", "-lm"], cwd=one.folder)
        command = ["valgrind", "--quiet", "--error-exitcode=9", "--leak-check=full", "./every_function"]
        text, failed = said(command, one.folder, [source, one.library("gcc", "off")])
        found[one.precision] = "" if text is not None and not failed else text
    return found


def every_function(files):
    calls = []
    for name, parameters in prototypes(files).items():
        arrays = [f"    {files.precision} *{parameter} = numbers({length});" for parameter, length in parameters[:-1]]
        last, length = parameters[-1]
        arrays.append(f"    {files.precision} *{last} = malloc({length} * sizeof *{last});")
        names = [parameter for parameter, _ in parameters]
        frees = "".join(f" free({parameter});" for parameter in names)
        calls.append("\n".join(["  {", *arrays, f"    {name}({', '.join(names)});", f"    read({last}, {length});{frees}", "  }"]))
    return f"""#include "{files.arm}.h"
#include <stdio.h>
#include <stdlib.h>
static {files.precision} *numbers(int count) {{
  {files.precision} *found = malloc((size_t)count * sizeof *found);
  for (int i = 0; i < count; i++) found[i] = ({files.precision})(0.1 + 0.05 * i);
  return found;
}}
static void read(const {files.precision} *found, int count) {{
  for (int i = 0; i < count; i++) if (found[i] != found[i]) exit(8);
}}
int main(void) {{
{chr(10).join(calls)}
  return 0;
}}
"""
