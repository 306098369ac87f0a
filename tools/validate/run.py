"""Runs cases with the program, each once."""
from __future__ import annotations

import os
import shlex
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tools.validate.model import Run, Study
from tools.validate.results import Result

PROGRAM = Path("build/geist")
ROUNDS = 3  # of timed runs


class RunFailed(Exception):
    """A run that did not complete: which one, how to repeat it, and what the program said."""


def command(run: Run) -> list[str]:
    """As one would type it."""
    sets = [word for setting in run.settings for word in ("--set", setting)]
    return [str(PROGRAM), "run", run.file, *sets]


def execute(name: str, run: Run, folder: Path, options: list[str]) -> Result:
    words = [*command(run), "--out", str(folder), "--force", "--quiet", *options]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip()
        raise RunFailed(f"{name} failed with exit code {done.returncode}:\n{shlex.join(words)}\n{said}")
    result = Result(folder)
    print(f"  {name}: {result.steps:,} steps in {result.seconds:.1f} s", flush=True)
    return result


def run_all(studies: list[Study], short: bool, folder: Path, jobs: int) -> dict[Run, Result]:
    """Several at once with one thread each, then those that are timed, one after the other and in rounds: of each the
    fastest counts, for others may use the machine."""
    names: dict[Run, str] = {}
    timed: set[Run] = set()
    for study in studies:
        for label, run in study.runs(short).items():
            names.setdefault(run, f"{study.name}/{label}")
            if study.timed:
                timed.add(run)

    def go(run: Run, suffix: str = "", options: tuple[str, ...] = ("--threads", "1")) -> Result:
        where = names[run].replace(" ", "-").replace(",", "") + suffix
        return execute(names[run], run, folder / where, [*options])

    results: dict[Run, Result] = {}
    with ThreadPoolExecutor(jobs) as pool:
        together = [run for run in names if run not in timed]
        results.update(zip(together, pool.map(go, together)))
    for number in range(1 if short else ROUNDS):
        for run in (run for run in names if run in timed):
            result = go(run, f"-{number}", ())
            results[run] = min(results.get(run, result), result, key=lambda r: r.seconds)
    return results


def processors() -> int:
    return len(os.sched_getaffinity(0))
