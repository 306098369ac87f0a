"""The journal paper's beam with particles of several sizes and ghosts that turn or do not."""
from __future__ import annotations

from matplotlib.figure import Figure

from tools.validate.model import CLOSE, Band, Check, Claim, Picture, Results, Run, Study, Table
from tools.validate.plots import COUPLED, HEXAHEDRA, THEORY as GREY, label, panels
from tools.validate.studies.beam import CONVERGED, THEORY, against_converged, against_direct, beam, percent

RADII = (0.25, 0.2, 0.125, 0.1)
FINE = (0.0625, 0.05)  # left out of the short set
SOURCE = "journal paper, section 4, beam, Table 3"


def runs(short: bool) -> dict[str, Run]:
    radii = RADII if short else RADII + FINE
    return ({f"r {r}, turning": beam(radius=r) for r in radii} |
            {f"r {r}, not turning": beam(radius=r, rotation=False) for r in radii})


def radii(results: Results) -> list[float]:
    return [r for r in RADII + FINE if f"r {r}, turning" in results]


def tips(results: Results, turning: str) -> list[float]:
    return [results[f"r {r}, {turning}"].tip for r in radii(results)]


def tables(results: Results) -> list[Table]:
    rows = []
    for r, free, held in zip(radii(results), tips(results, "turning"), tips(results, "not turning")):
        run = results[f"r {r}, turning"]
        rows.append([f"{r}", f"{free:.5f}", percent(free / THEORY - 1), f"{held:.5f}", percent(held / THEORY - 1),
                     f"{run.time_step:.5g}", f"{run.steps:,}"])
    return [Table("Deflection", ["radius, mm", "tip with one-step back, mm", "against beam theory", "tip without, mm",
                                 "against beam theory", "time step, ms", "steps"], rows)]


def claims_on_rotation(results: Results) -> list[Claim]:
    free, held = tips(results, "turning"), tips(results, "not turning")
    margin = min(abs(h / THEORY - 1) - abs(f / THEORY - 1) for f, h in zip(free, held))
    ratio = min(abs(h / THEORY - 1) / abs(f / THEORY - 1) for f, h in zip(free, held))
    return [
        Claim(SOURCE,
              "the models with rotation effect are able to produce better results than those without rotation effect",
              "smaller error at every radius", margin, Band(low=0),
              f"at every radius the error without it is at least {ratio:.1f} times as large", True),
        Claim(SOURCE, "[without it] their results seem be slowly close to the analytical value with diminishing radius",
              "each smaller radius comes closer", min(b - a for a, b in zip(held, held[1:])), Band(low=0),
              f"{percent(held[0] / THEORY - 1, 0)} at r = {radii(results)[0]} to "
              f"{percent(held[-1] / THEORY - 1, 0)} at r = {radii(results)[-1]} mm", True),
        Claim(SOURCE, "evidently, they are hardly comparative to their counterparts", "all outside 3 %",
              min(abs(h / THEORY - 1) for h in held), Band(low=CLOSE),
              f"the best without it, {percent(held[-1] / THEORY - 1, 0)}, is farther off than the worst with it, "
              f"{percent(free[0] / THEORY - 1, 0)}", True),
    ]


def claims_on_radius(results: Results) -> list[Claim]:
    free, sizes = tips(results, "turning"), radii(results)
    worst, spread = max(abs(f / THEORY - 1) for f in free), max(free) / min(free) - 1
    time_steps = [results[f"r {r}, turning"].time_step for r in sizes]
    fine = [f for f, r in zip(free, sizes) if r <= 0.1]
    soft = ("The skin of particles that lack outer bonds is one radius thick, so that larger particles soften the beam "
            "more. We do not have the radii of Table 3: ")
    return [
        Claim(SOURCE, "which are all pretty close to δana", "all within 3 %", worst, Band(0, CLOSE),
              f"{percent(free[0] / THEORY - 1, 1)} at r = {sizes[0]} to {percent(free[-1] / THEORY - 1, 1)} at "
              f"r = {sizes[-1]} mm", False,
              f"{soft}for 0.1 mm and less all are within {100 * (max(fine) / THEORY - 1):.1f} %."),
        Claim(SOURCE, "almost insensitive to the DE radius in terms of their computed results",
              "within 3 % of each other", spread, Band(0, CLOSE),
              f"{100 * spread:.1f} % between r = {sizes[0]} and {sizes[-1]} mm", False,
              f"{soft}the spread from 0.1 to {sizes[-1]} mm is {100 * (max(fine) / min(fine) - 1):.1f} %."),
        Claim(SOURCE, "for a smaller size of DEs, a smaller size of time step has to be adopted",
              "falls with the radius", min(a - b for a, b in zip(time_steps, time_steps[1:])), Band(low=0),
              f"{1e6 * time_steps[0]:.0f} ns at r = {sizes[0]} to {1e6 * time_steps[-1]:.0f} ns at r = {sizes[-1]} mm", True),
    ]


def claims(results: Results) -> list[Claim]:
    return claims_on_rotation(results) + claims_on_radius(results)


def checks(results: Results) -> list[Check]:
    return [
        against_converged("r 0.25, turning", results["r 0.25, turning"], CONVERGED, 11.1),
        against_direct("r 0.2, turning", results["r 0.2, turning"], 2.156817),
        against_direct("r 0.2, not turning", results["r 0.2, not turning"], 1.207094),
        against_converged("r 0.125, turning", results["r 0.125, turning"], CONVERGED, 3.1),
        against_direct("r 0.1, turning", results["r 0.1, turning"], 2.048088),
    ]


def draw(results: Results) -> Figure:
    figure, (axes,) = panels(size=(6, 3.4))
    sizes = radii(results)
    axes.plot(sizes, tips(results, "turning"), "o-", color=COUPLED, label="with one-step back")
    axes.plot(sizes, tips(results, "not turning"), "s--", color=HEXAHEDRA, label="without")
    axes.axhline(THEORY, color=GREY, label="beam theory")
    axes.axhline(CONVERGED, color=GREY, linestyle=":", label="converged hexahedra")
    axes.axhspan(THEORY * (1 - CLOSE), THEORY * (1 + CLOSE), color=GREY, alpha=0.12, linewidth=0, label="± 3 %")
    axes.set_ylim(0, 2.4)
    axes.set_xlim(0, 0.26)
    label(axes, "radius of the particles [mm]", "tip deflection [mm]")
    axes.legend(loc="lower left")
    return figure


STUDY = Study(
    name="rotation",
    title="Journal paper: one-step back",
    source=SOURCE,
    text="The same beam, four layers of hexahedra, 6 mm of particles of several radii, with ghosts that turn by the "
         "moment on them (one-step back) and with ghosts that do not turn.",
    runs=runs, tables=tables, claims=claims, checks=checks,
    pictures=[Picture("rotation.svg", "Tip deflection over the particles' radius", draw)],
)
