# What both workflows share.
import os
import re
from collections import namedtuple

from snakemake.exceptions import WorkflowError


def text(key):
    """A setting that has to be there, as text: `--config` takes 2024 for a number."""
    value = config.get(key)
    if value is None or str(value) == "":
        raise WorkflowError(f"{key} is not set: give --config {key}=..., or a --configfile")
    return str(value)


def folder(key):
    """A folder to be written into. Flags lie in it, and in their names Snakemake reads braces as wildcards."""
    path = text(key).rstrip("/") or "/"
    for sign in "{}\n":
        if sign in path:
            raise WorkflowError(f"{key} is {path!r}: a name without {sign!r} expected; captures may have any")
    return path


def count(key, least=0):
    """A number of the configuration."""
    value = config.get(key)
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise WorkflowError(f"{key} is {value!r}: a whole number from {least} on expected")
    return value


def words(key):
    """Arguments of our command, each by itself."""
    value = config.get(key) or []
    if not isinstance(value, list):
        raise WorkflowError(f"{key} is {value!r}: a list of arguments expected")
    return [str(word) for word in value]


def memory(wildcards, attempt):
    """MiB for a job. A second attempt may have been needed because they were too few: it gets half of them more."""
    return count("memory_gib", 1) * 1024 * (1 + attempt) // 2


def gpus():
    """Resources of a job on GPUs; without, a scheduler is asked for none."""
    return {"gpu": count("gpus", 1)} if config.get("gpus") else {}


# Jobs on other machines hear of `--config` through a shell, and Snakemake writes it down as Python would, not as a shell.
for key, value in workflow.config_settings.config.items():
    if set(str(value)) & set("'\\") or not str(value).isprintable():
        raise WorkflowError(f"--config {key}={value!r}: jobs elsewhere would get this wrong; use a --configfile")

# Snakemake has no empty container, so the line must be left out where none is wanted.
if config.get("container"):

    container: str(config["container"])
