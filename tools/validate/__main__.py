"""The whole validation: runs the papers' cases and our own studies, judges what is said or wanted of them, and writes
docs/validation.

Ends with 1 if a run fails, a figure leaves its band or a verdict is not the one known."""
from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from tools.validate import page
from tools.validate.model import Check, Claim, Study
from tools.validate.run import RunFailed, processors, run_all
from tools.validate.studies import STUDIES


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./dev validate", description=__doc__)
    parser.add_argument("--short", action="store_true",
                        help="a reduced set, for tests: leaves docs as it is, writes to results/validation-short")
    parser.add_argument("--jobs", type=int, default=processors(), metavar="N",
                        help="runs at once (default: one a processor)")
    parser.add_argument("--only", nargs="+", default=[], metavar="STUDY", choices=[study.name for study in STUDIES],
                        help="these studies alone: writes pictures and pages of their own, not the papers' page")
    return parser.parse_args()


def complaints(study: Study, claims: list[Claim], checks: list[Check]) -> list[str]:
    lines = [f"{study.name}: {c.what} is {c.value:.7g}, outside {c.band.low:.7g} to {c.band.high:.7g} ({c.why})"
             for c in checks if not c.holds]
    for c in claims:
        if not c.holds:
            lines.append(f'{study.name}: "{c.quote}" now {"agrees" if c.agrees else "differs"} ({c.figure})')
    return lines


def main() -> int:
    chosen = arguments()
    studies = [study for study in STUDIES if not chosen.only or study.name in chosen.only]
    results = Path("results/validation-short" if chosen.short else "results/validation")
    begin = time.monotonic()
    try:
        every = run_all(studies, chosen.short, results, chosen.jobs)
    except RunFailed as failure:
        print(f"validate: {failure}", file=sys.stderr)
        return 1
    minutes = (time.monotonic() - begin) / 60
    judged: list[page.Judged] = []
    for study in studies:
        of_study = {label: every[run] for label, run in study.runs(chosen.short).items()}
        judged.append((study, of_study, study.claims(of_study), study.checks(of_study)))
    folder = results if chosen.short else Path("docs/validation")
    told = "" if chosen.only else f"this time all {len(every)} runs took {minutes:.1f} minutes, {chosen.jobs} at once."
    page.write(folder, judged, chosen.short, told)
    wrong = [line for study, _, claims, checks in judged for line in complaints(study, claims, checks)]
    for line in wrong:
        print(f"validate: {line}", file=sys.stderr)
    print(f"validate: {len(every)} runs, {'all as known' if not wrong else f'{len(wrong)} wrong'}; see {folder}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
