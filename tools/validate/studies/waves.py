"""Waves through the interface at normal incidence: how much of them it returns, over their length."""
from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from tools.validate import chains
from tools.validate.model import Band, Check, Claim, Picture, Results, Run, Study, Table
from tools.validate.plots import COUPLED, PARTICLES, THEORY as GREY, label, panels
from tools.validate.results import Result
from tools.validate.spectra import step_frequency, transform

RATIOS = (10, 5, 4, 3, 2)  # length h of a hexahedron over the particles' radius
SHEAR_RATIOS = (5, 4, 3, 2)
LENGTHS = (5, 10, 20, 40, 100)  # of waves, in h
SHEAR_LENGTHS = (5, 10, 20, 40)
MODELS = {"published": PARTICLES, "consistent": COUPLED, "hexahedra": GREY}
COLUMN, SHEET = "tools/validate/cases/column.toml", "tools/validate/cases/sheet.toml"
SOURCE = "what the consistent method is to show"
WHOLE = "hexahedra of one length"


def hexahedra(box: str, divisions: str) -> str:
    return f'{{type="hexahedra",material="body",box={box},divisions={divisions},formulation="selective-reduced"}}'


def column(ratio: int, model: str) -> Run:
    """Two particles wide and high."""
    across = 4 / ratio
    layers = round(110 * ratio / 2)
    end = layers * 2 / ratio
    left = hexahedra(f"[[-120,0,0],[0,{across},{across}]]", "[120,1,1]")
    box = f"[[0,0,0],[{end},{across},{across}]]"
    if model == "hexahedra":
        return Run(COLUMN, (f"regions={{left={left},right={hexahedra(box, f'[{layers},1,1]')}}}", 'supports.0.fix=["y","z"]'))
    material = "column" if model == "published" else "body"
    right = f'{{type="lattice",material="{material}",box={box},radius={1 / ratio}}}'
    how = ("method=published", "coupling.rotation=none") if model == "published" else ("method=consistent",)
    return Run(COLUMN, (*how, f"regions={{left={left},right={right}}}"))


def sheet(ratio: int) -> Run:
    """Two particles thick, and about 220 h wide."""
    thick = 4 / ratio
    long, half = (round(length * ratio / 2) * 2 / ratio for length in (45, 110))
    left = hexahedra(f"[[-45,{-half},0],[0,{half},{thick}]]", "[45,110,1]")
    right = f'{{type="lattice",material="body",box=[[0,{-half},0],[{long},{half},{thick}]],radius={1 / ratio}}}'
    return Run(SHEET, ("method=consistent", f"regions={{left={left},right={right}}}"))


def runs(short: bool) -> dict[str, Run]:
    whole = hexahedra("[[-120,0,0],[110,1,1]]", "[230,1,1]")
    chosen = {WHOLE: Run(COLUMN, (f"regions={{left={whole}}}", 'supports.0.fix=["y","z"]'))}
    for ratio in (4, 2) if short else RATIOS:
        for model in MODELS:
            chosen[f"{model}, h = {ratio} r"] = column(ratio, model)
    if short:
        return chosen
    whole = hexahedra("[[-45,-110,0],[45,110,1]]", "[90,110,1]")
    chosen[f"shear, {WHOLE}"] = Run(SHEET, (f"regions={{left={whole}}}", 'supports.0.fix=["x","z"]'))
    for ratio in SHEAR_RATIOS:
        chosen[f"shear, h = {ratio} r"] = sheet(ratio)
    return chosen


def ratios(results: Results) -> list[int]:
    return [ratio for ratio in RATIOS if f"consistent, h = {ratio} r" in results]


def with_shear(results: Results) -> bool:
    return f"shear, {WHOLE}" in results


def returned(results: Results, name: str, length: float) -> float:
    """Amplitude that comes back over that which came: the difference between this run and that of hexahedra of one length,
    over the latter, at the frequency of that length. Both run by the same steps."""
    whole: Result = results[f"shear, {WHOLE}" if name.startswith("shear") else WHOLE]
    time, come = whole.history["time"], whole.history["before"]
    w = step_frequency(2 * math.pi / length, whole.time_step)
    back = results[name].history["before"] - come
    return abs(transform(time, back, w) / transform(time, come, w))


def exact(kind: str, ratio: int, length: float) -> float:
    r = 1 / ratio
    if kind == "shear":
        parts = chains.shear(1, r)
    elif kind == "hexahedra":
        parts = chains.all_hexahedra(1, 2 * r)
    else:
        parts = chains.pressure(1, r, kind)
    return chains.reflection(2 * math.pi / length, *parts)


def cell(results: Results, kind: str, ratio: int, length: float) -> str:
    ours, theirs = returned(results, f"{kind}, h = {ratio} r", length), exact(kind, ratio, length)
    return f"{100 * ours:#.3g} ({100 * theirs:#.3g})" if theirs > 1e-9 else f"{100 * ours:.1g} (0)"


def tables(results: Results) -> list[Table]:
    head = ["h", "model", *(f"λ = {length} h" for length in LENGTHS)]
    rows = [[f"{n} r", kind, *(cell(results, kind, n, length) for length in LENGTHS)]
            for n in ratios(results) for kind in MODELS]
    shown = [Table("Pressure waves: returned amplitude in per cent, and the exact solution (hexahedra: their length jumps from "
                   "h to 2 r)", head, rows)]
    if with_shear(results):
        rows = [[f"{n} r", *(cell(results, "shear", n, length) for length in SHEAR_LENGTHS),
                 *(f"{100 * exact('hexahedra', n, length):.3g}" if n > 2 else "0" for length in SHEAR_LENGTHS)]
                for n in SHEAR_RATIOS]
        shown.append(Table("Shear waves, consistent: returned amplitude in per cent, and the exact solution; beside it hexahedra "
                           "whose length jumps, exact", ["h", *(f"λ = {length} h" for length in SHEAR_LENGTHS),
                                                         *(f"jump, {length} h" for length in SHEAR_LENGTHS)], rows))
    return shown


def kinds(results: Results) -> list[tuple[str, int]]:
    """Consistent ones: kind of wave and ratio."""
    return [("consistent", n) for n in ratios(results)] + [("shear", n) for n in SHEAR_RATIOS if with_shear(results)]


def power(results: Results, name: str) -> float:
    """With which power of h/λ it falls from 10 to 20 h."""
    return math.log2(returned(results, name, 10) / returned(results, name, 20))


def over_jump(results: Results, lengths: tuple[int, ...]) -> float:
    """The most that the interface returns, of what hexahedra do whose length jumps; h at least 4 r."""
    return max(returned(results, f"{kind}, h = {n} r", length) / exact("hexahedra", n, length)
               for kind, n in kinds(results) if n >= 4 for length in lengths)


def claims(results: Results) -> list[Claim]:
    powers = [power(results, f"{kind}, h = {n} r") for kind, n in kinds(results)]
    published = [power(results, f"published, h = {n} r") for n in ratios(results)]
    longer, all_lengths = over_jump(results, (6, 7, 10, 20, 40)), over_jump(results, (5,))
    wave = "pressure and shear" if with_shear(results) else "pressure"
    coarse = max(returned(results, f"{kind}, h = {n} r", 10) for kind, n in kinds(results) if n == 2)
    return [
        Claim(SOURCE, "returns fall with the second power of h/λ", f"from λ = 10 to 20 h, every h/r, {wave}; at least 1.9",
              min(powers), Band(low=1.9),
              f"power {min(powers):.2f} to {max(powers):.2f}; published {min(published):.2f} to {max(published):.2f}", True),
        Claim(SOURCE, "at most 1.5 times what a mesh returns whose length jumps from h to 2 r, if h ≥ 4 r",
              f"λ = 6 to 40 h, {wave}", longer, Band(0, 1.5), f"at most {longer:.2f} times", True),
        Claim(SOURCE, "at most 1.5 times what a mesh returns whose length jumps from h to 2 r, if h ≥ 4 r",
              f"λ = 5 h, {wave}", all_lengths, Band(0, 1.5), f"at most {all_lengths:.2f} times", False,
              "At h = 4 r and the shortest wave alone. There a wave has five nodes to its length, and hexahedra of one length are "
              "7.5 % off its speed."),
        Claim(SOURCE, "less than 6.5 % at λ = 10 h for h = 2 r", f"the worst of {wave}", coarse, Band(0, 0.065),
              f"{100 * coarse:.2f} %", True),
    ]


def apart(results: Results, kind: str, lengths: tuple[int, ...]) -> float:
    """The most that program and exact solution differ by, in amplitudes of the wave that came."""
    return max(abs(returned(results, f"{k}, h = {n} r", length) - exact(k, n, length))
               for k, n in (kinds(results) if kind != "published" else [(kind, n) for n in ratios(results)])
               if (k == "shear") == (kind == "shear") for length in lengths)


def checks(results: Results) -> list[Check]:
    shown = [Check(f"{kind}, farthest from the exact solution at λ = 5 to 100 h", apart(results, kind, LENGTHS), 0,
                   Band(0, 2e-4), "of the amplitude that came, less than 0.02 %") for kind in ("published", "consistent")]
    if with_shear(results):
        shown.append(Check("shear, farthest from the exact solution at λ = 5 to 40 h", apart(results, "shear", SHEAR_LENGTHS),
                           0, Band(0, 1e-3), "of the amplitude that came, less than 0.1 %"))
    return shown


def draw_panel(axes: Axes, results: Results, ratio: int) -> None:
    fine = np.geomspace(4.5, 110, 60)
    dots = np.geomspace(5, 100, 14)
    for kind, colour in MODELS.items():
        if kind == "hexahedra" and ratio == 2:
            continue
        axes.loglog(fine, [100 * exact(kind, ratio, length) for length in fine], color=colour, linewidth=1,
                    label="mesh that jumps" if kind == "hexahedra" else kind)
        if kind != "hexahedra":
            axes.loglog(dots, [100 * returned(results, f"{kind}, h = {ratio} r", length) for length in dots], "o",
                        color=colour, markersize=3)
    if with_shear(results) and ratio in SHEAR_RATIOS:
        axes.loglog(fine, [100 * exact("shear", ratio, length) for length in fine], "--", color=COUPLED, linewidth=1,
                    label="consistent, shear")
        some = dots[dots <= 40]
        axes.loglog(some, [100 * returned(results, f"shear, h = {ratio} r", length) for length in some], "s", color=COUPLED,
                    markersize=3, markerfacecolor="none")
    axes.set_ylim(0.01, 40)
    axes.set_xticks([5, 10, 20, 50, 100], ["5", "10", "20", "50", "100"])
    axes.minorticks_off()


def draw(results: Results) -> Figure:
    shown = ratios(results)
    figure, axes = panels(1, len(shown), (2.4 * len(shown) + 1, 3.4), sharey=True)
    for panel, ratio in zip(axes, shown):
        draw_panel(panel, results, ratio)
        label(panel, "λ / h", "returned amplitude [%]" if panel is axes[0] else "", f"h = {ratio} r")
    axes[min(1, len(shown) - 1)].legend(loc="lower left", fontsize=7)
    return figure


STUDY = Study(
    name="waves",
    title="Waves through the interface",
    source=SOURCE,
    text="""Plane waves come through hexahedra of length h and meet the lattice at normal incidence. A pulse with lengths of
waves from 4 to 100 h is sent once; what comes back is the difference from a run with hexahedra of one length and the same time
step, and its spectrum over that of the pulse gives the returned amplitude for every length λ = 2πc/ω at once. Beside it stands
the exact solution of the same one-dimensional chain of nodes and particles without time steps (`tools/validate/chains.py`); a
frequency ω of the program, with steps Δt, belongs to 2/Δt sin(ωΔt/2) of the chain. No coupling can be expected to return less
than a conforming mesh of hexahedra whose length jumps from h to 2r, the distance of particles.

Poisson's ratio is 0 here. Then a column's free sides bear no stress in a pressure wave, and its skins, which are in plane
stress, are as stiff as the bulk: a column two particles wide, held across and with rotations held as symmetry holds them in a
body, is the endless lattice. The published lattice has no skins; two particles wide, each particle has three fifths of the
bonds that it has in a body, all of one stiffness, so 5/3 of the modulus makes the column the bulk exactly (ghosts do not turn
there by symmetry).

A shear wave needs tractions on the sides across its motion. It runs in a sheet two particles thick whose free faces bear no
stress, and which is so wide (220 h) that what its edges send does not reach the middle in time; rotations about the sheet's
normal are free. So thin, its bonds are as inside a body: at this ratio diagonals carry nothing. The published lattice is not isotropic in so thin a sheet and is left out.""",
    runs=runs, tables=tables, claims=claims, checks=checks,
    pictures=[Picture("waves.svg", "Returned amplitude over the length of the wave: dots are the program, lines the exact "
                                   "solutions", draw)],
    page="waves.md",
    findings="""## What was found, and what is left

The program is the exact chain, for both methods and both kinds of wave. The published interface returns waves with the first
power of h/λ: the strip between ghosts and interface is stiff and heavy for its length, whatever the length of the wave. With every
point counted once and the strip's mass carried by the ghosts, the second power is left, as at any change of the size of a mesh,
and close to what such a mesh returns. For h = 2r a mesh would not change at all and return nothing; the interface returns
little, of pressure waves with a higher power than the second.

Oblique incidence is not measured here.
""",
)
