"""Campaigns: in one go, in shards, gone on with, and through a real Ray that loses a worker."""

import importlib.util
import json
import os
import pickle
import shutil
import signal
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import ulna
from ulna import _ray, _ulna

from conftest import ROOT

PAPER = ROOT / "scenarios" / "paper_like.toml"
CASES = 60

needs_ray = pytest.mark.skipif(importlib.util.find_spec("ray") is None, reason="Ray is not installed: pip install ray")


@pytest.fixture(scope="module")
def scenario():
    return ulna.Scenario.load(PAPER)


@pytest.fixture(scope="module")
def whole(scenario, tmp_path_factory):
    """The campaign made in one go."""
    return ulna.campaign(scenario, output=tmp_path_factory.mktemp("whole"), cases=CASES)


def same(one, other):
    """Rows and records are the same bytes."""
    assert one.rows.read_bytes() == other.rows.read_bytes()
    assert one.record.read_bytes() == other.record.read_bytes()


def test_all_rows_are_there(whole):
    assert (whole.cases, whole.made, whole.shards, whole.seed) == (CASES, CASES, None, 2026)
    columns = whole.columns()
    assert columns["case"].tolist() == list(range(CASES))
    assert columns["failed_joint"].tolist() == [case % 7 for case in range(CASES)]
    assert columns["status"].dtype.kind == "U" and all(values.shape == (CASES,) for values in columns.values())
    found = columns["status"] == "ok"
    assert found.sum() > CASES // 2
    assert np.all(columns["limit"][found] <= columns["eq20"][found] * (1 + 1e-9) + 1e-12)
    record = json.loads(whole.record.read_text())
    assert record["rows"] == CASES and record["formulas"] == "generated" and "multiply-adds" in record["arithmetic"]


def test_shards_and_threads_make_the_same_file(scenario, whole, tmp_path):
    sharded = ulna.campaign(scenario, output=tmp_path, cases=CASES, shards=4, threads=1)
    assert (sharded.made, sharded.shards) == (CASES, 4)
    same(sharded, whole)
    assert len(list(tmp_path.glob("campaign-*-of-0004.csv"))) == 4
    again = ulna.campaign(scenario, output=tmp_path, cases=CASES, shards=4)
    assert again.made == 0
    # A shard that is not there is made again, and no other.
    whole_rows = again.rows.read_bytes()
    for name in ("campaign.csv", "campaign.json", "campaign-0003-of-0004.csv"):
        (tmp_path / name).unlink()
    assert ulna.campaign(scenario, output=tmp_path, cases=CASES, shards=4).made == 15
    assert again.rows.read_bytes() == whole_rows


def test_an_interrupted_campaign_goes_on(scenario, whole, tmp_path):
    def stop(done, total):
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ulna.campaign(scenario, output=tmp_path, cases=200, progress=stop)
    assert (tmp_path / "campaign.csv.partial").exists() and not (tmp_path / "campaign.csv").exists()
    told = []
    made = ulna.campaign(scenario, output=tmp_path, cases=200, progress=lambda *counts: told.append(counts)).made
    assert 0 < made < 200 and told[0] == (200 - made, 200) and told[-1] == (200, 200)
    text = (tmp_path / "campaign.csv").read_bytes()
    assert text.startswith(whole.rows.read_bytes()) and text.count(b"\n") == 201


@pytest.mark.skipif(sys.platform == "win32", reason="signals are otherwise there")
def test_ctrl_c_stops_it(scenario, tmp_path):
    timer = threading.Timer(1.0, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        ulna.campaign(scenario, output=tmp_path, cases=1_000_000)
    assert not (tmp_path / "campaign.csv").exists()


def test_what_is_another_campaigns_or_changed_is_refused_and_left(scenario, tmp_path):
    first = ulna.campaign(scenario, output=tmp_path, cases=20, shards=2)
    for name in ("campaign.csv", "campaign.json"):
        (tmp_path / name).unlink()
    shard = tmp_path / "campaign-0001-of-0002.csv"
    with pytest.raises(ulna.CampaignError, match="0001-of-0002.csv has the seed 2026, not 7; remove it, or choose another output"):
        ulna.campaign(scenario, output=tmp_path, cases=20, shards=2, seed=7)
    text = shard.read_text()
    changed = text.replace("1", "2", 1) if "1" in text else text + "x"
    shard.write_text(changed)
    with pytest.raises(ulna.CampaignError, match="0001-of-0002.csv "):
        ulna.campaign(scenario, output=tmp_path, cases=20, shards=2)
    assert shard.read_text() == changed and not first.rows.exists()


def test_shards_of_other_arithmetic_are_named(scenario, tmp_path):
    """As of a cluster whose machines are not alike."""
    ulna.campaign(scenario, output=tmp_path, cases=20, shards=2)
    for name in ("campaign.csv", "campaign.json"):
        (tmp_path / name).unlink()
    manifest = tmp_path / "campaign-0002-of-0002.json"
    record = json.loads(manifest.read_text())
    record["arithmetic"] = "plain multiply-adds, m68k amiga"
    manifest.write_text(json.dumps(record))
    with pytest.raises(ulna.CampaignError, match=r"was computed with other arithmetic \(plain multiply-adds, m68k amiga, not "):
        ulna.campaign(scenario, output=tmp_path, cases=20, shards=2)
    native = _ulna.Campaign(scenario._native, 20, None)
    with pytest.raises(ulna.CampaignError, match="shard of another campaign than .*: it was computed with other arithmetic"):
        native.merge(tmp_path, 2, lambda _: None)


def test_a_shard_that_came_is_looked_at(scenario, tmp_path):
    native = _ulna.Campaign(scenario._native, 20, None)
    rows, record = native.shipped(1, 2, 1, lambda _: None)
    for wrong, message in [
        ((2, 2, rows, record), "is another shard"),
        ((1, 2, rows[:-1], record), "is not what its record is of"),
        ((1, 2, rows, b"{}"), "has no record"),
    ]:
        with pytest.raises(ulna.CampaignError, match=message):
            native.store(tmp_path, *wrong)
    assert list(tmp_path.iterdir()) == [] or [it.suffix for it in tmp_path.iterdir()] == [".lock"]
    native.store(tmp_path, 1, 2, rows, record)
    assert native.is_there(tmp_path, (1, 2)) and not native.is_there(tmp_path, (2, 2))
    with pytest.raises(ulna.CampaignError, match="is there already"):
        native.store(tmp_path, 1, 2, rows, record)


def test_a_scenario_travels_with_its_table(tmp_path):
    """Own tables are of the same campaign as the arm that comes with the package, if they are the same arm."""
    home = tmp_path / "home"
    home.mkdir()
    text = PAPER.read_text().replace('arm = "ssrms"', 'arm = "mine.toml"')
    (home / "own.toml").write_text(text)
    table = (ROOT / "arms" / "ssrms.toml").read_text()
    (home / "mine.toml").write_text("# My own words about it.\n" + table)
    own = ulna.Scenario.load(home / "own.toml")
    shutil.rmtree(home)
    there = pickle.loads(pickle.dumps(own))
    assert there.arm.table.startswith("# My own words") and repr(there) == repr(own)
    made = ulna.campaign(there, output=tmp_path / "out", cases=20)
    known = ulna.campaign(PAPER, output=tmp_path / "known", cases=20)
    same(made, known)


def test_what_cannot_be_asked_for_is_refused(scenario, tmp_path):
    for error, message, asked in [
        (ValueError, 'expected "local" or "ray"', {"engine": "slurm"}),
        (ValueError, "30 of 20 cases", {"cases": 20, "shards": 30}),
        (ValueError, "expected 1 or more, found 0", {"shards": 0}),
        (TypeError, 'is for engine="ray"', {"address": "auto"}),
        (ulna.CampaignError, "cases", {"cases": 0}),
    ]:
        with pytest.raises(error, match=message):
            ulna.campaign(scenario, output=tmp_path / "out", **asked)
    assert not (tmp_path / "out").exists()
    (tmp_path / "file.csv").write_text("a,b\n1,2\n")
    with pytest.raises(ValueError, match="is no file of a campaign"):
        ulna.read_campaign(tmp_path / "file.csv")


def test_without_ray_it_is_said_what_to_install(scenario, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(ModuleNotFoundError, match="pip install ray"):
        ulna.campaign(scenario, output=tmp_path / "out", cases=20, engine="ray")


@pytest.fixture(scope="module")
def ray():
    """A Ray of two workers on this machine."""
    os.environ["RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO"] = "0"
    import ray

    try:
        ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, object_store_memory=100_000_000)
    except Exception as error:
        # A machine without shared memory or sockets of its own says nothing about campaigns.
        pytest.skip(f"Ray does not start here: {error}")
    yield ray
    ray.shutdown()


def workers():
    """The processes below this one that work on a shard: their number by the shard's."""
    parents, titles = {}, {}
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        try:
            title = (folder / "cmdline").read_bytes().decode(errors="replace")
            parents[int(folder.name)] = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue
        if title.startswith("ray::ulna-shard-"):
            titles[int(folder.name)] = title
    found = {}
    for pid, title in titles.items():
        above = pid
        while above in parents and above != os.getpid():
            above = parents[above]
        if above == os.getpid():
            found[int(title.split("-")[2])] = pid
    return found


class Killer:
    """Kills a worker that is in the middle of a shard, once, while a campaign runs."""

    def __init__(self):
        self.killed = []
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._watch)

    def _watch(self):
        while not self._over.is_set() and not self.killed:
            for number, pid in workers().items():
                os.kill(pid, signal.SIGKILL)
                self.killed.append(number)
                break
            time.sleep(0.01)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._over.set()
        self._thread.join()


@needs_ray
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="workers are found in /proc")
def test_a_lost_workers_shard_is_made_again(ray, scenario, whole, tmp_path, monkeypatch):
    # Where nothing is made again, a lost worker is the end: the one that is killed has really been at it.
    monkeypatch.setattr(_ray, "RETRIES", 0)
    with Killer() as killer, pytest.raises(ulna.CampaignError, match="its worker was lost") as raised:
        ulna.campaign(scenario, output=tmp_path / "lost", cases=CASES, shards=4, engine="ray")
    assert len(killer.killed) == 1 and f"shard {killer.killed[0]} of 4" in str(raised.value)
    assert not (tmp_path / "lost" / "campaign.csv").exists()
    monkeypatch.undo()

    told = []
    with Killer() as killer:
        made = ulna.campaign(
            scenario, output=tmp_path / "made", cases=CASES, shards=4, engine="ray", progress=lambda *counts: told.append(counts)
        )
    assert len(killer.killed) == 1
    assert (made.made, made.shards) == (CASES, 4) and told == [(0, 60), (15, 60), (30, 60), (45, 60), (60, 60)]
    same(made, whole)

    # The first goes on with the shards that it has not.
    there = len(list((tmp_path / "lost").glob("campaign-*.csv")))
    on = ulna.campaign(scenario, output=tmp_path / "lost", cases=CASES, shards=4, engine="ray")
    assert on.made == CASES - 15 * there
    same(on, whole)


@needs_ray
def test_ray_makes_the_same_file_and_goes_on(ray, whole, tmp_path):
    """Of an own table as well, which workers have not."""
    home = tmp_path / "home"
    home.mkdir()
    (home / "own.toml").write_text(PAPER.read_text().replace('arm = "ssrms"', 'arm = "mine.toml"'))
    (home / "mine.toml").write_text((ROOT / "arms" / "ssrms.toml").read_text())
    own = ulna.Scenario.load(home / "own.toml")
    shutil.rmtree(home)
    made = ulna.campaign(own, output=tmp_path, cases=CASES, engine="ray")
    assert made.shards == 1
    same(made, whole)
    assert ulna.campaign(own, output=tmp_path, cases=CASES, engine="ray").made == 0


@needs_ray
def test_shards_fit_into_memory(scenario):
    for cases, shards in [(60, 1), (20_000, 20), (1_000_000, 256), (1_000_000_000, 20_000)]:
        native = _ulna.Campaign(scenario._native, cases, None)
        assert abs(_ray.shards(native, None) - shards) <= shards // 50
    with pytest.raises(ValueError, match="which is kept in memory; make "):
        _ray.shards(_ulna.Campaign(scenario._native, 10_000_000, None), 2)
