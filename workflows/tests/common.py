"""What the tests share: the command, the engine, captures, and what of two results has to be equal."""

import contextlib
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import psutil
import yaml

WORKFLOWS = Path(__file__).resolve().parents[1]
PROGRAM = os.environ["NORMALIGHT_CLI"]
# A shell, Snakemake's patterns and a table each take one of these for something else.
NAMES = ["plain", 'it\'s "quoted" $HOME; {x}', "Ümläut 雪/nested \\ deep", "new\nline"]
SETTINGS = ["--quality", "fast", "--device", "cpu"]
# A training of seconds that needs no files.
RECIPE = """network = "{network}"
steps = {steps}
size = {size}
batch = 2
images = [3, 4]
validate_every = 20
validation_objects = 1
checkpoint_every = 5
[optimiser]
warm_up = 2
"""
# How long anything here may take: many times what it does.
LONG = 120


class Case(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="normalight-workflows-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def normalight(self, *words, code=0):
        """Calls our command by itself."""
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, capture_output=True, timeout=LONG)
        self.assertEqual(done.returncode, code, done.stderr.decode())

    def start(self, workflow, config, profile="local", more=()):
        """Calls the engine, in a process group of its own, and does not wait."""
        file = self.folder / "config file.yaml"
        file.write_text(yaml.safe_dump(config, allow_unicode=True), "utf-8")
        words = [sys.executable, "-m", "snakemake", "-s", WORKFLOWS / workflow, "--configfile", file]
        words += ["--profile", WORKFLOWS / "profiles" / profile, *more]
        return subprocess.Popen(
            [str(word) for word in words],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    def snakemake(self, workflow, config, code=0, **options):
        """Calls the engine and waits; what it says."""
        return self.ended(self.start(workflow, config, **options), code)

    def ended(self, process, code=0, limit=LONG):
        said, _ = process.communicate(timeout=limit)
        self.assertEqual(process.returncode, code, said)
        return said

    def does_nothing(self, workflow, config, **options):
        """A call of a finished workflow leaves every file as it is."""
        before = stamps(self.folder)
        said = self.snakemake(workflow, config, **options)
        self.assertIn("Nothing to be done", said)
        self.assertEqual(stamps(self.folder), before)

    def wait_until(self, condition, limit=LONG):
        """Looks often, as what is waited for may soon be over."""
        end = time.monotonic() + limit
        while not condition():
            self.assertLess(time.monotonic(), end, "waited in vain")
            time.sleep(0.002)

    def recipe(self, name, network, steps, more="", first=""):
        """Writes a recipe; its file. Keys stand first, tables last."""
        file = self.folder / f"{name}.toml"
        text = RECIPE.format(network=network, steps=steps, size=64 if network == "light" else 16)
        file.write_text(first + text + more, "utf-8")
        return file

    def same_training(self, run, recipe, network="normal"):
        """A run is, bit for bit, what the command makes of its recipe and seed."""
        seed = summary(run)["seed"]
        plain = self.folder / f"plain {recipe.stem} {seed}"
        words = ["train", network, "--recipe", recipe, "--run", plain, "--seed", seed]
        self.normalight(*words, "--threads", 1, "--device", "cpu", "--quiet")
        for name in ("weights.safetensors", "recipe.toml"):
            self.assertEqual((run / name).read_bytes(), (plain / name).read_bytes(), f"{run} {name}")
        untimed = [
            {key: value for key, value in summary(one).items() if not key.startswith("hours")} for one in (run, plain)
        ]
        self.assertEqual(*untimed)

    def same_results(self, plain, ours):
        """Two outputs of a batch are equal but for times."""
        self.assertEqual(results(plain), results(ours))


def make_captures(folder, names):
    """Rendered captures of 6 images of 48 pixels with their masks."""
    stacks = folder.with_name(folder.name + " rendered")
    render = [PROGRAM, "render", "--count", str(len(names)), "--images", "6", "--size", "48", "--quiet"]
    subprocess.run([*render, "--out", stacks], check=True, timeout=LONG)
    for scene, name in zip(sorted((stacks / "Images").iterdir()), names, strict=True):
        shutil.copytree(scene / "rendered", folder / name)
        shutil.copy(scene / f"{scene.name}_mask.png", folder / name / "mask.png")
    shutil.rmtree(stacks)


def results(folder):
    """Every file of a batch's output by its path, without times, and without what the workflow keeps for itself."""
    found = {}
    for path in files(folder):
        name = str(path.relative_to(folder))
        if path.name in ("report.json", "batch.json"):
            found[name] = timeless(json.loads(path.read_text("utf-8")))
        elif name == "batch.csv":
            with open(path, newline="", encoding="utf-8") as file:
                found[name] = [{**row, "at": None, "seconds": None} for row in csv.DictReader(file)]
        elif name == "index.html":
            # Seconds stand in it, and what sorts by them.
            found[name] = re.sub(r"[\d.]+", "", path.read_text("utf-8"))
        else:
            found[name] = path.read_bytes()
    return found


def summary(run):
    """How a training stands."""
    return json.loads((run / "summary.json").read_text("utf-8"))


def timeless(value):
    """JSON without what a clock said, and without the size of the report, which holds such."""
    if isinstance(value, dict):
        return {key: timeless(one) for key, one in value.items() if key not in ("seconds", "read")}
    if isinstance(value, list):
        if value and value[0] == "report.json":
            return value[:1]
        return [timeless(one) for one in value]
    return value


def files(folder):
    """All files below a folder; the engine's own state lies in hidden ones."""
    for place, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name not in (".workflow", ".snakemake")]
        yield from (Path(place) / name for name in names)


def stamps(folder):
    """What tells whether a file was written."""
    return {path: path.stat().st_mtime_ns for path in files(folder) if path.suffix != ".yaml"}


def jobs(process, word):
    """Processes below the engine that are our command with this as its first word."""
    found = []
    with contextlib.suppress(psutil.Error):
        for child in psutil.Process(process.pid).children(recursive=True):
            with contextlib.suppress(psutil.Error):
                if child.cmdline()[:2] == [PROGRAM, word]:
                    found.append(child)
    return found


def kill_all(process):
    """As when the power fails: the engine and all its jobs at once."""
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
