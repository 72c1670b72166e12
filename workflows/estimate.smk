# A tree of captures: a result folder for each, a table and a page of all.
#
#     snakemake -s workflows/estimate.smk --profile workflows/profiles/local --config captures=captures results=results
#
# A job is one shard of `normalight batch`: every so-manieth capture of the tree. The command itself finds the captures,
# knows which have their results and goes on after a kill, so nothing here knows of single captures, and their names
# pass through no shell.
import hashlib
from functools import cache


configfile: f"{workflow.basedir}/config/estimate.yaml"


include: "common.smk"


CAPTURES = text("captures")
RESULTS = folder("results")
SHARDS = count("shards", 1)
# Hidden, so that it is no capture and no result.
FLAGS = f"{RESULTS}/.workflow"
DONE = [f"{FLAGS}/shard-{number}-of-{SHARDS}.done" for number in range(1, SHARDS + 1)]
COLLECT = "{PROGRAM:q} batch --collect --out {RESULTS:q} --quiet"
PROGRAM = text("program")
# Rules run in the container by themselves, what follows an error does not.
BINDS = workflow.deployment_settings.apptainer_args
WITHIN = "apptainer exec {BINDS} {config[container]:q} " if config.get("container") else ""

if not os.path.isdir(CAPTURES):
    raise WorkflowError(f"captures is {CAPTURES!r}: no folder of that name is here")


@cache
def tree():
    """A text that changes when a file of the tree does, by path, size or time: then all shards are looked at again."""
    seen = hashlib.sha256()
    for place, folders, files in os.walk(CAPTURES):
        folders.sort()
        for name in sorted(files):
            path = os.path.join(place, name)
            try:
                status = os.stat(path)
                line = (os.fsencode(path), status.st_size, status.st_mtime_ns)
            except OSError:
                # A link to nowhere: its name is all there is.
                line = (os.fsencode(path),)
            seen.update(repr(line).encode())
    return seen.hexdigest()


localrules:
    all,
    page,


rule all:
    default_target: True
    input:
        # The flags, too: the page is also there after an error.
        DONE,
        f"{RESULTS}/index.html",


rule shard:
    output:
        # Not the shard's table: Snakemake takes away what a failed job put out, and that table says what failed.
        touch(f"{FLAGS}/shard-{{number}}-of-{SHARDS}.done"),
    log:
        f"{FLAGS}/shard-{{number}}-of-{SHARDS}.log",
    params:
        # Only the process that decides needs it; what jobs on other machines see of a drive may be older.
        tree=lambda wildcards: tree() if workflow.is_main_process else "",
        memory=count("memory_gib", 1),
        settings=words("settings"),
    threads: count("threads", 1)
    retries: count("retries")
    resources:
        mem_mb=memory,
        runtime=count("minutes", 1),
        **gpus(),
    shell:
        "RAYON_NUM_THREADS={threads} {PROGRAM:q} batch {CAPTURES:q} --out {RESULTS:q}"
        " --shard {wildcards.number}/{SHARDS} --jobs {threads} --memory {params.memory}"
        " -- {params.settings:q} > {log:q} 2>&1"


rule page:
    input:
        DONE,
    output:
        f"{RESULTS}/index.html",
        f"{RESULTS}/batch.csv",
    log:
        f"{FLAGS}/page.log",
    shell:
        COLLECT + " > {log:q} 2>&1"


onerror:
    # Table and page say which captures have no result, and why; that there are some is no further error.
    shell(f"{WITHIN}{COLLECT} || true")
