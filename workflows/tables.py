"""The tables of a sweep, from the summary.json that each run keeps for scripts.

    python tables.py RUNS

writes RUNS/runs.csv, a line for each run as it stands, and RUNS/comparison.csv, a line for each recipe over its seeds, the
best first. Runs are the folders RECIPE/seed-N.
"""

import csv
import json
import math
import os
import statistics
import sys
from pathlib import Path

RUN = ["network", "parameters", "seed", "state", "steps", "steps_planned", "hours", "weights_sha256"]
RECIPE = ["recipe", "network", "parameters", "runs", "finished", "mean", "spread", "best seed", "average"]


def runs(folder):
    """Name of the recipe and summary of each run."""
    found = [
        (path.parent.parent.relative_to(folder).as_posix(), json.loads(path.read_text("utf-8")))
        for path in folder.glob("**/seed-*/summary.json")
    ]
    return sorted(found, key=lambda run: (run[0], run[1]["seed"]))


def degrees(run):
    """Mean error on unseen objects of the weights that were kept."""
    return (run["best"] or {}).get("degrees")


def averaged(folder, name):
    """Mean error of the average of a recipe's weights, where there is one."""
    path = folder / name / "average.json"
    return json.loads(path.read_text("utf-8"))["average"] if path.is_file() else ""


def compared(name, all_runs):
    """The line of a recipe; only finished runs have an error that may be compared."""
    done = [run for run in all_runs if run["state"] == "finished" and degrees(run) is not None]
    errors = [degrees(run) for run in done]
    line = [name, all_runs[0]["network"], all_runs[0]["parameters"], len(all_runs), len(done)]
    if not done:
        return [*line, "", "", ""]
    spread = statistics.stdev(errors) if len(errors) > 1 else ""
    return [*line, statistics.fmean(errors), spread, min(done, key=degrees)["seed"]]


def write(path, lines):
    """Under its name when it is complete."""
    aside = path.with_name(f".{path.name}.new")
    with open(aside, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(lines)
    os.replace(aside, path)


def main(folder):
    found = runs(folder)
    write(
        folder / "runs.csv",
        [["recipe", "degrees", *RUN]]
        + [[name, degrees(run), *(run[field] for field in RUN)] for name, run in found],
    )
    names = dict.fromkeys(name for name, _ in found)
    lines = [
        [*compared(name, [run for other, run in found if other == name]), averaged(folder, name)] for name in names
    ]
    # Errors of the two networks are of different things.
    lines.sort(key=lambda line: (line[1], math.inf if line[5] == "" else line[5]))
    write(folder / "comparison.csv", [RECIPE, *lines])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
