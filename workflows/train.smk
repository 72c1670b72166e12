# A sweep of recipes and seeds to a run folder each and a comparison; and whole networks that a search finds, trained
# with the same seeds; and the average of a recipe's seeds, where they went on from one start.
#
#     snakemake -s workflows/train.smk --profile workflows/profiles/local --configfile sweep.yaml
#
# A job is one `normalight train --resume` or one `normalight search`, or a shard of a round of one: all go on where they
# were, however they ended.
import sys
import tomllib


configfile: f"{workflow.basedir}/config/train.yaml"


include: "common.smk"


RUNS = folder("runs")
PROGRAM = text("program")
FLAGS = f"{RUNS}/.workflow"
PYTHON = sys.executable
TABLES = f"{workflow.basedir}/tables.py"
COMPARE = "{PYTHON:q} {TABLES:q} {RUNS:q}"
SEARCH = (
    "RAYON_NUM_THREADS={threads} {PROGRAM:q} search {params.search.network:q}"
    " --recipe {params.search.recipe:q} --run {params.run:q}"
    " --threads {params.loaders} {params.device:q}"
)
Search = namedtuple("Search", "network recipe shards")


def by_name(paths):
    """Recipes under the names that their runs get: those of the files."""
    named = {}
    for path in paths:
        name = os.path.splitext(os.path.basename(path))[0]
        if set(name) & set("{}\n"):
            raise WorkflowError(f"{path!r}: a name without braces and line ends expected")
        if name in named:
            raise WorkflowError(f"{path!r} and {named[name]!r}: two runs would be called {name!r}; rename a recipe")
        named[name] = path
    return named


def seeds():
    found = config.get("seeds")
    if not isinstance(found, list) or not found or not all(isinstance(seed, int) and seed >= 0 for seed in found):
        raise WorkflowError(f"seeds is {found!r}: a list of numbers expected")
    return sorted(set(found))


def searches():
    found = {}
    for one in config.get("searches") or []:
        if not isinstance(one, dict) or not {"network", "recipe"} <= set(one) <= set(Search._fields):
            raise WorkflowError(f"searches has {one!r}: network, recipe and perhaps shards expected")
        shards = one.get("shards", 1)
        if isinstance(shards, bool) or not isinstance(shards, int) or shards < 1:
            raise WorkflowError(f"shards is {shards!r}: a whole number from 1 on expected")
        search = Search(str(one["network"]), str(one["recipe"]), shards)
        name = f"search-{search.network}-{os.path.splitext(os.path.basename(search.recipe))[0]}"
        if name in RECIPES or name in found:
            raise WorkflowError(f"two runs would be called {name!r}; rename a recipe")
        found[name] = search
    return found


RECIPES = by_name(words("recipes"))
SEEDS = seeds()
SEARCHES = searches()
AVERAGE = config.get("average")
if not RECIPES and not SEARCHES:
    raise WorkflowError("recipes and searches are empty: nothing to train")
if AVERAGE and len(SEEDS) < 2:
    raise WorkflowError(f"seeds is {SEEDS!r}: two or more expected for an average")


def rounds(search):
    """How many rounds a search has, as far as its recipe says: the last call trains whatever is left."""
    keep = [8, 3]
    if os.path.isfile(search.recipe):
        with open(search.recipe, "rb") as file:
            keep = tomllib.load(file).get("search", {}).get("keep", keep)
    return len(keep) + 1


def shards_of(name, number):
    """The flags of a round; one job does a search without shards as a whole."""
    shards = SEARCHES[name].shards
    if shards == 1 or number == 0:
        return []
    return [f"{FLAGS}/{name}/round-{number}/{shard}.done" for shard in range(1, shards + 1)]


def recipe_of(wildcards):
    """The recipe file of a run: one of the sweep, or one that a search has written."""
    name = wildcards.name
    if name in RECIPES:
        return RECIPES[name]
    search, _, front = name.partition("/")
    if search not in SEARCHES:
        raise WorkflowError(f"{name!r} is no recipe here")
    checkpoints.search.get(search=search)
    return f"{RUNS}/{search}/{front}.toml"


def network_of(wildcards, input):
    """The network that a recipe trains: the command wants to hear it."""
    with open(input.recipe, "rb") as file:
        return tomllib.load(file).get("network", "normal")


def done(wildcards):
    """The flags of all runs; what searches find is known when they are done."""
    found = list(RECIPES)
    for search in SEARCHES:
        checkpoints.search.get(search=search)
        recipes = (name for name in os.listdir(f"{RUNS}/{search}") if name.startswith("front-"))
        stems = (os.path.splitext(name) for name in sorted(recipes))
        found += [f"{search}/{stem}" for stem, extension in stems if extension == ".toml"]
    flags = [f"{FLAGS}/{name}/seed-{seed}.done" for name in found for seed in SEEDS]
    if AVERAGE:
        flags += [f"{FLAGS}/{name}/average.done" for name in found]
    return flags


wildcard_constraints:
    seed=r"\d+",
    round=r"\d+",
    shard=r"\d+",
    search="|".join(map(re.escape, SEARCHES)) or "none",


localrules:
    all,
    comparison,


rule all:
    default_target: True
    input:
        # The flags, too: the tables are also there after an error.
        done,
        f"{RUNS}/comparison.csv",


checkpoint search:
    input:
        # A name of a recipe inside the program is no file.
        lambda wildcards: [path for path in [SEARCHES[wildcards.search].recipe] if os.path.isfile(path)],
        lambda wildcards: shards_of(wildcards.search, rounds(SEARCHES[wildcards.search])),
    output:
        touch(f"{FLAGS}/{{search}}.done"),
    log:
        f"{FLAGS}/{{search}}.log",
    params:
        search=lambda wildcards: SEARCHES[wildcards.search],
        run=lambda wildcards: f"{RUNS}/{wildcards.search}",
        device=words("device"),
        loaders=lambda wildcards, threads: max(1, threads - 1),
    threads: count("threads", 1)
    retries: count("retries")
    resources:
        mem_mb=memory,
        runtime=count("minutes", 1),
        **gpus(),
    shell:
        SEARCH + " > {log:q} 2>&1"


# Every so-manieth network of a round, which begins when the round before is done.
rule round:
    input:
        lambda wildcards: shards_of(wildcards.search, int(wildcards.round) - 1),
    output:
        touch(f"{FLAGS}/{{search}}/round-{{round}}/{{shard}}.done"),
    log:
        f"{FLAGS}/{{search}}/round-{{round}}/{{shard}}.log",
    params:
        search=lambda wildcards: SEARCHES[wildcards.search],
        run=lambda wildcards: f"{RUNS}/{wildcards.search}",
        device=words("device"),
        loaders=lambda wildcards, threads: max(1, threads - 1),
    threads: count("threads", 1)
    retries: count("retries")
    resources:
        mem_mb=memory,
        runtime=count("minutes", 1),
        **gpus(),
    shell:
        SEARCH + " --round {wildcards.round} --shard {wildcards.shard}/{params.search.shards} > {log:q} 2>&1"


rule train:
    input:
        recipe=recipe_of,
    output:
        # Not the weights: Snakemake takes away what a job put out before it is done again.
        touch(f"{FLAGS}/{{name}}/seed-{{seed}}.done"),
    log:
        f"{FLAGS}/{{name}}/seed-{{seed}}.log",
    params:
        network=network_of,
        run=lambda wildcards: f"{RUNS}/{wildcards.name}/seed-{wildcards.seed}",
        device=words("device"),
        loaders=lambda wildcards, threads: max(1, threads - 1),
    threads: count("threads", 1)
    retries: count("retries")
    resources:
        mem_mb=memory,
        runtime=count("minutes", 1),
        **gpus(),
    shell:
        "RAYON_NUM_THREADS={threads} {PROGRAM:q} train {params.network:q} --recipe {input.recipe:q}"
        " --run {params.run:q} --seed {wildcards.seed} --resume"
        " --threads {params.loaders} {params.device:q} > {log:q} 2>&1"


rule average:
    input:
        seeds=lambda wildcards: [f"{FLAGS}/{wildcards.name}/seed-{seed}.done" for seed in SEEDS],
        recipe=recipe_of,
    output:
        touch(f"{FLAGS}/{{name}}/average.done"),
    log:
        f"{FLAGS}/{{name}}/average.log",
    params:
        weights=lambda wildcards: [f"{RUNS}/{wildcards.name}/seed-{seed}/weights.safetensors" for seed in SEEDS],
        out=lambda wildcards: f"{RUNS}/{wildcards.name}/average",
        device=words("device")[:2],
    threads: count("threads", 1)
    retries: count("retries")
    resources:
        mem_mb=memory,
        runtime=count("minutes", 1),
        **gpus(),
    shell:
        "RAYON_NUM_THREADS={threads} {PROGRAM:q} average {params.weights:q} --recipe {input.recipe:q}"
        " --out {params.out:q}.safetensors --report {params.out:q}.json {params.device:q} > {log:q} 2>&1"


rule comparison:
    input:
        done,
    output:
        f"{RUNS}/comparison.csv",
        f"{RUNS}/runs.csv",
    # Python is here, not in an image with our command.
    container: None
    shell:
        COMPARE


onerror:
    # The tables say which runs have not finished.
    shell(COMPARE)
