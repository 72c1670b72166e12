"""A tree of captures through estimate.smk."""

import os
import shutil
import subprocess
import sys

from common import NAMES, PROGRAM, SETTINGS, WORKFLOWS, Case, jobs, kill_all, make_captures


class Estimate(Case):
    def setUp(self):
        super().setUp()
        self.captures, self.results = self.folder / "cap'tures ü", self.folder / "re\"sults $x"
        make_captures(self.captures, NAMES)
        self.config = {
            "captures": self.captures.name,
            "results": self.results.name,
            "program": PROGRAM,
            "settings": SETTINGS,
            "shards": 2,
            "threads": 1,
            "memory_gib": 1,
            "retries": 0,
        }

    def plain(self, code=0):
        """The same tree by the command alone."""
        out = self.folder / "plain"
        shutil.rmtree(out, ignore_errors=True)
        self.normalight("batch", self.captures.name, "--out", out, "--", *SETTINGS, code=code)
        return out

    def made(self):
        """Finished results and when each was made. Its record may be newer: where the photographs are so young that a
        change of them might not show, the next call reads them again and notes it there."""
        records = self.results.glob("**/batch.json")
        return {path.parent: path.with_name("report.json").stat().st_mtime_ns for path in records}

    def test_results_are_those_of_a_plain_run_and_are_made_once(self):
        self.snakemake("estimate.smk", self.config)
        self.same_results(self.plain(), self.results)
        self.does_nothing("estimate.smk", self.config)
        # One capture more: the others stay as they are.
        before = self.made()
        shutil.copytree(self.captures / "plain", self.captures / "another")
        self.snakemake("estimate.smk", self.config)
        after = self.made()
        self.assertEqual({path: time for path, time in after.items() if path in before}, before)
        self.assertEqual(set(after) - set(before), {self.results / "another"})
        self.same_results(self.plain(), self.results)

    def test_what_was_killed_is_done_by_the_next_call(self):
        self.config["shards"] = 1
        # First a job, then the engine with its job.
        running = self.start("estimate.smk", self.config)
        self.wait_until(self.made)
        for job in jobs(running, "batch"):
            job.kill()
        self.ended(running, code=1)
        self.assertLess(len(self.made()), len(NAMES))
        # The page of what is there was made all the same.
        self.assertTrue((self.results / "index.html").is_file())
        running = self.start("estimate.smk", self.config)
        self.wait_until(lambda: jobs(running, "estimate"))
        kill_all(running)
        self.assertLess(len(self.made()), len(NAMES))
        self.snakemake("estimate.smk", self.config)
        self.same_results(self.plain(), self.results)
        self.does_nothing("estimate.smk", self.config)

    def test_a_bad_capture_stops_no_other_and_is_on_the_page(self):
        bad = self.captures / "bad"
        bad.mkdir()
        for index in range(3):
            bad.joinpath(f"{index}.png").write_bytes(b"no picture")
        self.config["retries"] = 1
        said = self.snakemake("estimate.smk", self.config, code=1)
        self.assertIn("Trying to restart", said)
        self.same_results(self.plain(code=1), self.results)
        self.assertIn("bad", (self.results / "index.html").read_text("utf-8"))
        # Failed is not finished: the next call tries again.
        shutil.rmtree(bad)
        self.snakemake("estimate.smk", self.config)
        self.same_results(self.plain(), self.results)

    def test_what_makes_no_sense_is_refused_in_words(self):
        for change, words in [
            ({"captures": "nowhere"}, "no folder of that name"),
            ({"results": "re{sults}"}, "a name without '{' expected"),
        ]:
            with self.subTest(words):
                said = self.snakemake("estimate.smk", {**self.config, **change}, code=1)
                self.assertIn(words, said)
        # Through a shell such a name would become another one.
        line = [sys.executable, "-m", "snakemake", "-s", WORKFLOWS / "estimate.smk", "--dry-run"]
        asked = ["--config", f"captures={self.captures.name}", "results=x"]
        done = subprocess.run([*map(os.fspath, line), *asked], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("use a --configfile", done.stdout + done.stderr)
