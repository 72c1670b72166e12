"""A sweep and a search through train.smk."""

import csv
import hashlib
import json
import statistics

from common import PROGRAM, Case, jobs, kill_all, summary

SEARCH = """[search]
space = "network"
candidates = 2
keep = [1]
growth = 2
[search.networks]
widths = [8]
sizes = [16]
"""


ROUNDS = ["round-1 1", "round-1 2", "round-2 1", "round-2 2"]


def errors_of_search(folder):
    """Number, error and place on the front of each network of each round."""
    found = json.loads((folder / "search.json").read_text("utf-8"))
    assert found["state"] == "finished"
    return [
        [(one["number"], one["degrees"], one["on_front"]) for one in rung["candidates"]] for rung in found["rounds"]
    ]


class Train(Case):
    def setUp(self):
        super().setUp()
        self.runs = self.folder / "runs ü"
        self.recipe("it's normal", "normal", 40)
        self.config = {
            "recipes": ["it's normal.toml"],
            "seeds": [2, 1],
            "runs": self.runs.name,
            "program": PROGRAM,
            "threads": 1,
            "memory_gib": 1,
            "retries": 0,
        }

    def table(self, name):
        with open(self.runs / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_a_sweep_is_its_plain_runs_and_is_done_once(self):
        self.recipe("light", "light", 4)
        self.config["recipes"].append("light.toml")
        self.snakemake("train.smk", self.config)
        for name, network in [("it's normal", "normal"), ("light", "light")]:
            for seed in (1, 2):
                self.same_training(self.runs / name / f"seed-{seed}", self.folder / f"{name}.toml", network)
        self.does_nothing("train.smk", self.config)
        # The tables say what the runs do.
        runs = [self.runs / "it's normal" / f"seed-{seed}" for seed in (1, 2)]
        errors = [summary(run)["best"]["degrees"] for run in runs]
        row = next(row for row in self.table("comparison.csv") if row["recipe"] == "it's normal")
        self.assertAlmostEqual(float(row["mean"]), statistics.fmean(errors), places=4)
        self.assertAlmostEqual(float(row["spread"]), statistics.stdev(errors), places=4)
        self.assertEqual((row["runs"], row["finished"]), ("2", "2"))
        self.assertEqual(int(row["best seed"]), 1 + errors.index(min(errors)))
        weights = {row["weights_sha256"] for row in self.table("runs.csv")}
        found = self.runs.glob("*/seed-*/weights.safetensors")
        self.assertEqual(weights, {hashlib.sha256(path.read_bytes()).hexdigest() for path in found})
        # A further seed leaves the others alone.
        before = {run: (run / "summary.json").stat().st_mtime_ns for run in runs}
        self.config["seeds"].append(3)
        self.snakemake("train.smk", self.config)
        self.assertEqual({run: (run / "summary.json").stat().st_mtime_ns for run in runs}, before)
        self.assertEqual(len(self.table("runs.csv")), 6)

    def test_what_was_killed_goes_on_from_its_checkpoint(self):
        self.config["seeds"] = [1]
        run = self.runs / "it's normal/seed-1"
        # First a job, then the engine with its job.
        running = self.start("train.smk", self.config)
        self.wait_until((run / "checkpoint.safetensors").is_file)
        for job in jobs(running, "train"):
            job.kill()
        self.ended(running, code=1)
        self.assertEqual(summary(run)["state"], "running")
        self.assertEqual([row["state"] for row in self.table("runs.csv")], ["running"])
        before = (run / "checkpoint.safetensors").stat().st_mtime_ns
        running = self.start("train.smk", self.config)
        self.wait_until(lambda: (run / "checkpoint.safetensors").stat().st_mtime_ns != before)
        kill_all(running)
        self.assertEqual(summary(run)["state"], "running")
        self.snakemake("train.smk", self.config)
        self.assertIn("continue", (run / "log.txt").read_text("utf-8"))
        self.same_training(run, self.folder / "it's normal.toml")
        self.does_nothing("train.smk", self.config)

    def test_networks_of_a_search_are_trained_with_all_seeds(self):
        self.recipe("small", "normal", 2, SEARCH)
        self.config["recipes"] = []
        self.config["searches"] = [{"network": "normal", "recipe": "small.toml"}]
        self.snakemake("train.smk", self.config)
        search = self.runs / "search-normal-small"
        fronts = sorted(search.glob("front-*.toml"))
        self.assertTrue(fronts)
        for front in fronts:
            for seed in (1, 2):
                self.same_training(search / front.stem / f"seed-{seed}", front)
        self.assertEqual(len(self.table("comparison.csv")), len(fronts))
        self.does_nothing("train.smk", self.config)

    def test_a_search_in_shards_finds_what_one_job_finds(self):
        recipe = self.recipe("small", "normal", 2, SEARCH)
        self.config["recipes"] = []
        self.config["seeds"] = [1]
        self.config["searches"] = [{"network": "normal", "recipe": "small.toml", "shards": 2}]
        self.snakemake("train.smk", self.config)
        search = self.runs / "search-normal-small"
        logs = (self.runs / ".workflow/search-normal-small").glob("round-*/*.log")
        self.assertEqual(sorted(f"{log.parent.name} {log.stem}" for log in logs), ROUNDS)
        words = ["search", "normal", "--recipe", recipe, "--run", self.folder / "whole"]
        self.normalight(*words, "--threads", 1, "--device", "cpu", "--quiet")
        for front in (self.folder / "whole").glob("front-*.toml"):
            self.assertEqual((search / front.name).read_bytes(), front.read_bytes())
        found, expected = (errors_of_search(folder) for folder in (search, self.folder / "whole"))
        self.assertEqual(found, expected)
        self.does_nothing("train.smk", self.config)

    def test_seeds_from_one_start_are_averaged(self):
        start = self.folder / "start"
        self.normalight("train", "normal", "--recipe", "it's normal.toml", "--run", start, "--device", "cpu", "--quiet")
        self.recipe("on", "normal", 10, first='init = "start/weights.safetensors"\n')
        self.config.update(recipes=["on.toml"], average=True)
        self.snakemake("train.smk", self.config)
        weights = [self.runs / f"on/seed-{seed}/weights.safetensors" for seed in (1, 2)]
        self.normalight("average", *weights, "--out", "plain.safetensors")
        averaged = self.runs / "on/average.safetensors"
        self.assertEqual(averaged.read_bytes(), (self.folder / "plain.safetensors").read_bytes())
        report = json.loads((self.runs / "on/average.json").read_text("utf-8"))
        self.assertEqual(float(self.table("comparison.csv")[0]["average"]), report["average"])
        # What a training measures of the same weights on the same objects.
        errors = [one["degrees"] for one in report["networks"]]
        for error, file in zip(errors, weights, strict=True):
            self.assertAlmostEqual(error, summary(file.parent)["best"]["degrees"], delta=0.05)
        self.assertNotIn("one start", (self.runs / ".workflow/on/average.log").read_text("utf-8"))
        self.does_nothing("train.smk", self.config)

    def test_what_makes_no_sense_is_refused_in_words(self):
        for change, words in [
            ({"recipes": []}, "nothing to train"),
            ({"average": True, "seeds": [1]}, "two or more expected"),
            ({"searches": [{"network": "normal", "recipe": "networks", "shards": 0}]}, "shards is 0"),
            ({"recipes": ["a/x.toml", "b/x.toml"]}, "two runs would be called 'x'"),
        ]:
            with self.subTest(words):
                said = self.snakemake("train.smk", {**self.config, **change}, code=1)
                self.assertIn(words, said)
