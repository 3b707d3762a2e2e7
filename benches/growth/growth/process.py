"""Commands, and what they cost."""

import os
import signal
import subprocess
import sys
import threading
import time
from dataclasses import dataclass
from pathlib import Path


@dataclass
class Cost:
    """Of a command and all that it starts. Where it was stopped or failed, `fault` says so and the rest is what it took until then."""

    seconds: float  # of processors
    elapsed: float
    megabytes: float  # of the largest process
    fault: str = ""


def measured(command: list, folder: Path, limit: float) -> Cost:
    """Runs a command for at most `limit` seconds."""
    start = time.monotonic()
    process = subprocess.Popen(
        command, cwd=folder, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
    )
    late = threading.Event()

    def stop():
        late.set()
        os.killpg(process.pid, signal.SIGKILL)

    timer = threading.Timer(limit, stop)
    timer.start()
    errors = process.stderr.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    timer.cancel()
    elapsed = time.monotonic() - start
    process.returncode = status
    fault = f"over {limit:.0f} s" if late.is_set() else f"failed: {errors[-2000:]}" if status else ""
    return Cost(usage.ru_utime + usage.ru_stime, elapsed, usage.ru_maxrss / 1024, fault)


def output(command: list, cwd: Path | None = None, may_fail: bool = False) -> str | None:
    """What a command prints; without it the bench ends, unless it may fail."""
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True)
    if done.returncode == 0:
        return done.stdout
    if may_fail:
        return None
    sys.exit(f"{' '.join(map(str, command))}: {done.stderr[-2000:]}")
