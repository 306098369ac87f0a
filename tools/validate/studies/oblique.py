"""Waves through the interface at an angle: how much of them it returns, as waves of their own kind and of the other."""
from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from tools.validate import chains
from tools.validate.model import Band, Check, Claim, Picture, Results, Run, Study, Table
from tools.validate.plane_waves import SPEED, direction, flux
from tools.validate.plots import COUPLED, THEORY as GREY, label, panels
from tools.validate.results import Result
from tools.validate.spectra import step_frequency

CASE = "tools/validate/cases/oblique.toml"
SOURCE = "what the consistent method is to show"
MODELS = ("h = 4 r", "h = 2 r", "mesh that jumps")
WAVES = (("P", 30), ("P", 45), ("S", 20), ("S", 30))  # that come, and their angles of incidence, degrees
LENGTHS = (7, 10, 14, 20)  # in h
SHAKEN = "xy"  # along which the edge is
HEIGHT = 101  # of the probes, at y = 0, 1, ...
WHOLE = "hexahedra of one length"


def hexahedra(box: str, divisions: str) -> str:
    return f'{{type="hexahedra",material="body",box={box},divisions={divisions},formulation="selective-reduced"}}'


def sheet(thick: int) -> str:
    return hexahedra(f"[[-50,-126,0],[0,126,{thick}]]", "[50,252,1]")


def runs(short: bool) -> dict[str, Run]:
    if short:
        return {}
    held = 'supports.0.fix=["z"]'
    lattice = '{type="lattice",material="body",box=[[0,-126,0],[50,126,2]],radius=0.5}'
    finer = hexahedra("[[0,-126,0],[50,126,1]]", "[100,252,1]")
    settings = {
        WHOLE: (f"regions={{left={hexahedra('[[-50,-126,0],[50,126,1]]', '[100,252,1]')}}}", held),
        "h = 4 r": ("method=consistent",),
        "h = 2 r": ("method=consistent", f"regions={{left={sheet(2)},right={lattice}}}"),
        "mesh that jumps": (f"regions={{left={sheet(1)},right={finer}}}", held),
    }
    shaken = {"x": "supports.1.displacement={x=1,y=0}", "y": "supports.1.displacement={x=0,y=1}"}
    return {f"{model}, shaken along {s}": Run(CASE, (*sets, shaken[s])) for model, sets in settings.items() for s in SHAKEN}


def record(result: Result) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, and displacements along x and y of the probes [time, probe]."""
    if not hasattr(result, "line"):
        h = result.history
        result.line = (h["time"], *(np.stack([h[f"{c}{y}"] for y in range(HEIGHT)], axis=1) for c in "xy"))
    return result.line


def fade(at: np.ndarray, begin: float) -> np.ndarray:
    """1, and to 0 at the end."""
    share = np.clip((at - begin) / (at[-1] - begin), 0, 1)
    return 0.5 * (1 + np.cos(np.pi * share))


def component(results: Results, model: str, shaken: str, W: float, ky: float) -> np.ndarray:
    """Amplitude (x, y) along the line of probes of what moves by W and ky; what is not the mesh of one length, is the
    difference from it. Shaken along x, displacements along x are even in y and those along y odd; else the reverse."""
    result = results[f"{model}, shaken along {shaken}"]
    time, x, y = record(result)
    if model != WHOLE:
        _, x0, y0 = record(results[f"{WHOLE}, shaken along {shaken}"])
        x, y = x - x0, y - y0
    of_time = fade(time, time[-1] - 8) * np.exp(-1j * step_frequency(W, result.time_step) * time)
    at = np.arange(float(HEIGHT))
    along = fade(at, 78)
    along[0] = 0.5
    even, odd = 2 * along * np.cos(ky * at), -2j * along * np.sin(ky * at)
    of_x, of_y = (even, odd) if shaken == "x" else (odd, even)
    return np.array([(of_time @ x) @ of_x, (of_time @ y) @ of_y])


def returned(results: Results, model: str, W: float, ky: float) -> np.ndarray:
    """Matrix of amplitudes: what comes back (P, S) of what came (P, S). Two ways of shaking tell the four apart."""
    right = np.stack([direction("P", ky, W), direction("S", ky, W)], axis=1)
    left = right * np.array([[-1], [1]])
    come = np.stack([np.linalg.solve(right, component(results, WHOLE, s, W, ky)) for s in SHAKEN], axis=1)
    back = np.stack([np.linalg.solve(left, component(results, model, s, W, ky)) for s in SHAKEN], axis=1)
    return back @ np.linalg.inv(come)


def amplitudes(results: Results, model: str, kind: str, angle: float, length: float) -> tuple[float, float, float]:
    """Of a wave that comes with this length: returned as its own kind, as the other, and the root of the energy returned."""
    k = 2 * math.pi / length
    W, ky = k * SPEED[kind], k * math.sin(math.radians(angle))
    own, other = (0, 1) if kind == "P" else (1, 0)
    column = np.abs(returned(results, model, W, ky)[:, own])
    share = flux("PS"[other], ky, W) / flux(kind, ky, W)
    return column[own], column[other], math.sqrt(column[own] ** 2 + share * column[other] ** 2)


def tables(results: Results) -> list[Table]:
    if not results:
        return []
    rows = [[f"{kind}, {angle}°", model, *(" / ".join(f"{100 * a:.2f}" for a in amplitudes(results, model, kind, angle, length))
                                           for length in LENGTHS)] for kind, angle in WAVES for model in MODELS]
    return [Table("Returned in per cent of the amplitude that came: as a wave of its own kind / of the other / root of the energy",
                  ["wave that comes", "model", *(f"λ = {length} h" for length in LENGTHS)], rows)]


def over_jump(results: Results) -> float:
    return max(amplitudes(results, "h = 4 r", *wave, length)[2] / amplitudes(results, "mesh that jumps", *wave, length)[2]
               for wave in WAVES for length in LENGTHS)


def claims(results: Results) -> list[Claim]:
    if not results:
        return []
    most = over_jump(results)
    powers = [math.log2(amplitudes(results, model, *wave, 10)[2] / amplitudes(results, model, *wave, 20)[2])
              for wave in WAVES for model in ("h = 4 r", "h = 2 r")]
    coarse = max(amplitudes(results, "h = 2 r", *wave, 10)[2] for wave in WAVES)
    return [
        Claim(SOURCE, "returns fall with the second power of h/λ", "root of the energy, from λ = 10 to 20 h; at least 1.9",
              min(powers), Band(low=1.9), f"power {min(powers):.2f} to {max(powers):.2f}", True),
        Claim(SOURCE, "at most 1.5 times what a mesh returns whose length jumps from h to 2 r, if h ≥ 4 r",
              "root of the energy, h = 4 r, λ = 7 to 20 h", most, Band(0, 1.5), f"at most {most:.2f} times", True),
        Claim(SOURCE, "less than 6.5 % at λ = 10 h for h = 2 r", "root of the energy", coarse, Band(0, 0.065),
              f"{100 * coarse:.2f} %", True),
    ]


def from_exact(results: Results) -> float:
    """At normal incidence, the most that shear and pressure waves differ by from the exact solutions of chains."""
    worst = 0.0
    for model, r in (("h = 4 r", 0.25), ("h = 2 r", 0.5)):
        for length in LENGTHS:
            W = 2 * math.pi / length
            matrix = np.abs(returned(results, model, W, 0))
            worst = max(worst, abs(matrix[1, 1] - chains.reflection(W, *chains.shear(1, r))),
                        abs(matrix[0, 0] - chains.reflection(W / SPEED["P"], *chains.pressure(1, r, "consistent"))))
    return worst


def from_reciprocal(results: Results) -> float:
    """P returned as S and S returned as P carry the same share of the energy: by how much the amplitudes differ."""
    worst = 0.0
    for model in MODELS:
        for angle in (20, 30):
            for length in LENGTHS:
                W = 2 * math.pi / length
                ky = W * math.sin(math.radians(angle))
                matrix = np.abs(returned(results, model, W, ky))
                share = math.sqrt(flux("S", ky, W) / flux("P", ky, W))
                worst = max(worst, abs(matrix[1, 0] * share - matrix[0, 1] / share))
    return worst


def checks(results: Results) -> list[Check]:
    if not results:
        return []
    return [Check("normal incidence: farthest from the exact solution", from_exact(results), 0, Band(0, 2e-3),
                  "of the amplitude that came, less than 0.2 %"),
            Check("reciprocity: P returned as S and S as P, farthest apart", from_reciprocal(results), 0, Band(0, 4e-3),
                  "of the amplitude that came, less than 0.4 %")]


def draw(results: Results) -> Figure:
    figure, axes = panels(1, len(WAVES), (11, 3.4), sharey=True)
    if not results:
        return figure
    lengths = np.geomspace(6, 25, 12)
    looks = {"h = 4 r": ("o-", COUPLED), "h = 2 r": ("s--", COUPLED), "mesh that jumps": ("-", GREY)}
    for panel, (kind, angle) in zip(axes, WAVES):
        for model, (style, colour) in looks.items():
            panel.loglog(lengths, [100 * amplitudes(results, model, kind, angle, length)[2] for length in lengths], style,
                         color=colour, markersize=3, label=model)
        panel.set_xticks([6, 10, 20], ["6", "10", "20"])
        panel.minorticks_off()
        label(panel, "λ / h", "root of the returned energy [%]" if panel is axes[0] else "", f"{kind} wave, {angle}°")
    axes[0].legend()
    return figure


STUDY = Study(
    name="oblique",
    title="Waves through the interface at an angle",
    source=SOURCE,
    text="""A short piece of the edge of a wide, thin sheet is shaken, along x and, in another run, along y; its waves, pressure (P) and
shear (S), come to the interface from all directions. Probes before it record them, in hexahedra of one length and in the coupled
sheet with the same time step; the difference is what came back. Transformed over time and along the interface, both are sums of one
P and one S wave for each frequency and each wave number along the interface (with the directions of displacement that such waves have
in the mesh itself, `tools/validate/plane_waves.py`), and two ways of shaking tell what comes back of each. All angles and lengths
come from the same runs.

Poisson's ratio is 0, as for [normal incidence](waves.md): so a sheet two particles thick with faces free of stress is in plane
strain and in plane stress at once. Pressure waves are √2 faster, so a shear wave at 45° is at the critical angle. Beside the
lattice stands a mesh whose hexahedra become half as long across the interface, as far apart as particles are if h = 4 r. For h = 2 r
such a mesh is of one length and returns nothing. The published lattice is not isotropic in so thin a sheet and is left out.

What is left of the waves at the end of the records, in time and along the line, and the finite number of both limit the accuracy, to
about 0.1 to 0.3 % of the amplitude that came: at normal incidence it can be compared with the exact solutions, at an angle by
reciprocity.""",
    runs=runs, tables=tables, claims=claims, checks=checks,
    pictures=[Picture("oblique.svg", "Root of the returned energy over the length of the wave that comes", draw)],
    page="oblique.md",
    findings="""## What was found, and what is left

At an angle the interface returns what it does at normal incidence, as much as a mesh that jumps, and as steeply less for longer
waves. A good part comes back as the other kind of wave, in the lattice as in the mesh.
""",
)
