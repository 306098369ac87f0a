"""The journal paper's beam and its variants: examples/beam by the published method, with something set."""
from __future__ import annotations

from tools.validate.model import Band, Check, Run
from tools.validate.results import Result

THEORY = 2.0  # mm, P L³/(3 E I)
CONVERGED = 2.0077  # mm, converged hexahedra: with shear, and with a clamp that holds the section

ALL_HEXAHEDRA = ("regions.middle.type=hexahedra", "regions.middle.divisions=[12,4,4]")
FULL = tuple(f"regions.{name}.formulation=full" for name in ("left", "middle", "right"))


def journal(*settings: str) -> Run:
    return Run("beam", ("method=published", *settings))


def beam(layers: int = 4, length: int = 6, radius: float = 0.1, rotation: bool = True) -> Run:
    """The coupled beam; what is as shipped is not set."""
    settings: list[str] = []
    if length != 6:
        first, last, divisions = 10 - length // 2, 10 + length // 2, 20 - length
        settings += [f"regions.left.box=[[0,0,0],[{first},2,2]]", f"regions.left.divisions=[{divisions},4,4]",
                     f"regions.middle.box=[[{first},0,0],[{last},2,2]]",
                     f"regions.right.box=[[{last},0,0],[20,2,2]]", f"regions.right.divisions=[{divisions},4,4]"]
    if layers != 4:
        settings += [f"regions.{name}.divisions=[14,4,{layers}]" for name in ("left", "right")]
    if radius != 0.1:
        settings.append(f"regions.middle.radius={radius}")
    if not rotation:
        settings.append("coupling.rotation=none")
    return journal(*settings)


def all_particles(radius: float) -> Run:
    lattice = f'{{type="lattice",material="polymer",box=[[0,0,0],[20,2,2]],radius={radius}}}'
    return journal(f"regions={{all={lattice}}}")


def against_direct(what: str, result: Result, reference: float) -> Check:
    """A deflection beside the direct solution of the same equations. Runs that stop at a residual of 1e-6 of the
    load stop 0.01 % short of it, so 0.05 % tests the equations and leaves room for another way to relax."""
    why = "direct solution of the same equations, ± 0.05 %"
    return Check(what, result.tip, reference, Band.around(reference, 5e-4), why)


def against_converged(what: str, result: Result, converged: float, percent: float) -> Check:
    """The same where the direct solution is known as a share of converged hexahedra, to a tenth of a per cent."""
    reference = converged * (1 + percent / 100)
    why = f"direct solution: converged hexahedra {percent:+.1f} %, ± 0.1 %"
    return Check(what, result.tip, reference, Band.around(reference, 1e-3), why)


def percent(value: float, digits: int = 2) -> str:
    return f"{100 * value:+.{digits}f} %".replace("-", "−")
