"""The journal paper's beam with two to twelve millimetres of particles: degrees of freedom and run time."""
from __future__ import annotations

from matplotlib.figure import Figure

from tools.validate.model import Band, Check, Claim, Picture, Results, Run, Study, Table
from tools.validate.plots import COUPLED, PARTICLES, THEORY as GREY, label, panels
from tools.validate.results import Result
from tools.validate.studies.beam import CONVERGED, THEORY, against_direct, all_particles, beam, percent

LENGTHS = (2, 4, 6, 8, 10, 12)
ALONE = "all particles"
SOURCE = "journal paper, section 4, beam, Figs. 9 and 10"


def runs(short: bool) -> dict[str, Run]:
    return {f"{length} mm": beam(length=length) for length in LENGTHS} | {ALONE: all_particles(0.1)}


def share(result: Result) -> float:
    """Of the particles, six each, in all degrees of freedom."""
    return 6 * result.summary["counts"]["particles"] / result.freedoms


def microseconds(result: Result) -> float:
    return 1e6 * result.seconds / result.steps


def cheaper(result: Result) -> float:
    """By how much the step of a particle costs less than that of a hexahedron with its nodes."""
    spent, counts = result.summary["wall_seconds"]["phases"], result.summary["counts"]
    return (spent["elements"] + spent["nodes and loads"]) / counts["hexahedra"] * counts["particles"] / spent["lattice"]


def tables(results: Results) -> list[Table]:
    rows = [[name, f"{r.freedoms:,}", f"{100 * share(r):.0f} %", f"{r.tip:.5f}", percent(r.tip / THEORY - 1),
             f"{r.steps:,}", f"{microseconds(r):.0f}", f"{r.seconds:.1f}"] for name, r in results.items()]
    return [Table("One run after the other, the fastest of three; times vary from machine to machine",
                  ["particles", "degrees of freedom", "of particles", "tip, mm", "against beam theory", "steps",
                   "µs a step", "run time, s"], rows)]


def claims_on_size(results: Results) -> list[Claim]:
    small, large = results["2 mm"], results["12 mm"]
    freedoms, time = large.freedoms / small.freedoms, large.seconds / small.seconds
    return [
        Claim(SOURCE, "the number of DoFs […] rises dramatically", "more than doubled from 2 to 12 mm", freedoms,
              Band(low=2), f"{freedoms:.1f} times as many at 12 mm as at 2 mm", True),
        Claim(SOURCE, "as well as the computation time", "more than doubled from 2 to 12 mm", time, Band(low=2),
              f"{time:.1f} times as long at 12 mm as at 2 mm", None,
              "It rises less than the degrees of freedom: a particle's step costs Geist "
              f"1/{cheaper(large):.0f} of a hexahedron's."),
        Claim(SOURCE, "the significantly increased proportion of the DoFs of DE particles", "rises with every length",
              min(share(results[f"{b} mm"]) - share(results[f"{a} mm"]) for a, b in zip(LENGTHS, LENGTHS[1:])),
              Band(low=0), f"{100 * share(small):.0f} % at 2 mm, {100 * share(large):.0f} % at 12 mm", True),
    ]


def claims_on_pure(results: Results) -> list[Claim]:
    coupled, pure = results["6 mm"], results[ALONE]
    return [
        Claim(SOURCE, "a coupling model is more computationally efficient than a pure DE model", "6 mm take less time",
              coupled.seconds / pure.seconds, Band(high=1),
              f"{100 * coupled.seconds / pure.seconds:.0f} % of the time, "
              f"{100 * coupled.freedoms / pure.freedoms:.0f} % of the degrees of freedom", None),
        Claim("journal paper, section 3", "the coupling model is able to significantly reduce DoFs",
              "less than half at 6 mm", coupled.freedoms / pure.freedoms, Band(high=0.5),
              f"{coupled.freedoms:,} instead of {pure.freedoms:,}", True),
    ]


def claims(results: Results) -> list[Claim]:
    return claims_on_size(results) + claims_on_pure(results)


def checks(results: Results) -> list[Check]:
    return [against_direct("4 mm", results["4 mm"], 2.018786), against_direct("6 mm", results["6 mm"], 2.048088)]


def draw(results: Results) -> Figure:
    figure, (freedoms, time, tip) = panels(1, 3, (10, 3.2))
    coupled = [results[f"{length} mm"] for length in LENGTHS]
    freedoms.plot(LENGTHS, [r.freedoms / 1000 for r in coupled], "o-", color=COUPLED, label="all")
    of_particles = [share(r) * r.freedoms / 1000 for r in coupled]
    freedoms.plot(LENGTHS, of_particles, "s--", color=PARTICLES, label="of particles")
    time.plot(LENGTHS, [r.seconds for r in coupled], "o-", color=COUPLED)
    tip.plot(LENGTHS, [r.tip for r in coupled], "o-", color=COUPLED, label="coupled")
    tip.axhline(THEORY, color=GREY, label="beam theory")
    tip.axhline(CONVERGED, color=GREY, linestyle=":", label="converged hexahedra")
    for axes in (freedoms, time):
        axes.set_ylim(bottom=0)
    for axes in (freedoms, time, tip):
        axes.set_xticks(LENGTHS)
    label(freedoms, "length of the discrete region [mm]", "degrees of freedom [thousands]")
    label(time, "length of the discrete region [mm]", "run time [s]")
    label(tip, "length of the discrete region [mm]", "tip deflection [mm]")
    freedoms.legend()
    tip.legend(loc="upper left")
    return figure


STUDY = Study(
    name="region-size",
    title="Journal paper: size of the discrete region",
    source=SOURCE,
    text="The same beam, four layers of hexahedra, with 2 to 12 mm of particles in its middle, and of particles alone.",
    runs=runs, tables=tables, claims=claims, checks=checks,
    pictures=[Picture("region-size.svg", "Degrees of freedom, run time and deflection over the region's length", draw)],
    timed=True,
)
