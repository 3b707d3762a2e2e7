"""The example runs, and draws what it says."""

import subprocess
import sys

from matplotlib import image

from conftest import ROOT


def test_section_5_is_drawn(tmp_path):
    picture = tmp_path / "section_5.png"
    example = ROOT / "python" / "examples" / "section_5.py"
    scenario = ROOT / "scenarios" / "paper_like.toml"
    run = subprocess.run([sys.executable, example, scenario, picture], capture_output=True, text=True, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert run.stdout.count("lock at") == 3 and "optimal" in run.stdout
    drawn = image.imread(picture)
    assert drawn.shape[1] > 1000 and drawn[..., :3].std() > 0.05
