"""Plane waves at normal incidence on an interface, solved exactly: an endless chain of nodes meets an endless chain of
particles, all masses and springs per area.

The left chain has nodes at 0, -h, -2h, ... with masses h and springs 1/h (density, modulus and speed of waves 1). What
lies beyond, and how the two are tied, is given by matrices. Time does not step: a frequency W stands for a step dt's w by
W = 2/dt sin(w dt/2), so that one curve over W is right for every time step."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Chain:
    """Equal places one after the other: K0 x[j] + K1 x[j+1] + K1' x[j-1] = W^2 M x[j]."""

    mass: np.ndarray
    own: np.ndarray
    next: np.ndarray

    def outgoing(self, W: float) -> tuple[np.ndarray, np.ndarray]:
        """Factors z from place to place and shapes of all waves that travel or fade to the right."""
        n = len(self.mass)
        D = self.own - W**2 * self.mass
        # z^2 K1 v + z D v + K1' v = 0 as an eigenproblem of (v, z v); K1 may be singular, so in 1/z where it must.
        A = np.block([[np.zeros((n, n)), np.eye(n)], [-self.next.T, -D]])
        B = np.block([[np.eye(n), np.zeros((n, n))], [np.zeros((n, n)), self.next]])
        z, v = np.linalg.eig(np.linalg.solve(B, A))
        pick = []
        for k in range(2 * n):
            if abs(z[k]) < 1 - 1e-7:
                pick.append(k)
            elif abs(z[k]) < 1 + 1e-7:  # travels: energy to the right, power = W Im(...) of the force on what follows
                x = v[:n, k]
                if (x.conj() @ self.next @ (z[k] * x)).imag < 0:
                    pick.append(k)
        assert len(pick) == n, (W, z)
        return z[pick], v[:n, pick]


@dataclass(frozen=True)
class Interface:
    """Ties nodes -h and 0 to the first place of a chain. `stiffness` and `mass` are over (u at -h, u at 0, place 1, more
    that only the interface has): all between and at them but for the spring from -2h to -h and the chain's own of place
    1 and onwards."""

    stiffness: np.ndarray
    mass: np.ndarray


def wave_number(W: float, h: float = 1) -> float:
    return 2 / h * np.arcsin(W * h / 2)


def reflection(W: float, interface: Interface, chain: Chain, h: float = 1) -> float:
    """Amplitude of the wave that returns over that of the wave that comes."""
    n, total = len(chain.mass), len(interface.mass)
    z, shapes = chain.outgoing(W)
    phase = np.exp(1j * wave_number(W, h) * h)
    dynamic = (interface.stiffness - W**2 * interface.mass).astype(complex)
    dynamic[0, 0] += 1 / h  # of the spring from -2h
    beyond = np.zeros(total, complex)  # the row of node -h also has -1/h u(-2h); that of place 1 the chain
    dynamic[2 : 2 + n, 2 : 2 + n] += chain.own - W**2 * chain.mass
    # unknowns: R, u at 0, amplitudes of the chain's waves, what only the interface has
    S = np.zeros((total, total), complex)
    S[0, 0], S[1, 1] = phase, 1  # u(-h) = 1/phase + R phase
    S[2 : 2 + n, 2 : 2 + n] = shapes * z
    S[2 + n :, 2 + n :] = np.eye(total - 2 - n)
    A = dynamic @ S
    A[0, 0] -= phase**2 / h
    A[2 : 2 + n, 2 : 2 + n] += chain.next @ (shapes * z**2)
    come = np.zeros(total, complex)
    come[0] = 1 / phase
    beyond[0] = -1 / h * phase**-2
    return abs(np.linalg.solve(A, -(dynamic @ come + beyond))[0])


def springs(total: int, *terms: tuple[float, np.ndarray | list[float]]) -> np.ndarray:
    """Stiffness of springs k with elongations b.x."""
    K = np.zeros((total, total))
    for k, b in terms:
        row = np.zeros(total)
        row[: len(b)] = b
        K += k * np.outer(row, row)
    return K


def pressure_chain(d: float) -> Chain:
    """Layers d apart."""
    return Chain(np.array([[d]]), np.array([[2 / d]]), np.array([[-1 / d]]))


def all_hexahedra(h: float, d: float) -> tuple[Interface, Chain]:
    """Elements of length h, then of length d."""
    return (Interface(springs(3, (1 / h, [1, -1]), (1 / d, [0, 1, -1])) - springs(3, (1 / d, [0, 0, 1])),
                      np.diag([h, (h + d) / 2, 0])), pressure_chain(d))


def pressure(h: float, r: float, method: str) -> tuple[Interface, Chain]:
    """Particles at r, 3r, ..., tied to a ghost at -r."""
    tie = (1 / (2 * r), [-r / h, -(1 - r / h), 1])
    keep, mass = 1.0, np.diag([h, h / 2, 0])
    if method != "published":
        keep = 1 - r / h
        if method == "consistent":
            at_0 = (h * h - r * r) / (2 * h)
            mass = np.diag([h + h / 2 - at_0, at_0, 0])
    K = springs(3, (keep / h, [1, -1]), tie) - springs(3, (1 / (2 * r), [0, 0, 1]))
    return Interface(K, mass), pressure_chain(2 * r)


def shear(h: float, r: float) -> tuple[Interface, Chain]:
    """The consistent lattice in a shear wave (E 2, G 1, nu 0), a sheet of two layers with free faces: displacements u
    across and rotations t. With nu 0 diagonals carry nothing, and a particle's bonds in the sheet, along the wave and across
    it, have 2 E r (E r of cells and E r of the skin), as inside a body; they bend with E (2r)^3/12. A cube's inertia."""
    E, area = 2.0, 4 * r * r
    along, across, bending = 2 * E * r, 2 * E * r, E * 8 * r**3 / 12

    def pair(total: int, u_i: np.ndarray, t_i: np.ndarray, u_j: np.ndarray, t_j: np.ndarray) -> np.ndarray:
        return springs(total, (along, u_j - u_i - r * (t_i + t_j)), (bending, t_j - t_i)) / area

    e = np.eye(4)
    K = pair(4, *e)
    lone = np.diag([0, across * 4 * r * r / area])
    chain = Chain(np.diag([2 * r, 2 * r * (2 * r) ** 2 / 6]), K[:2, :2] + K[2:, 2:] + lone, K[:2, 2:])
    u_g, t_g = (r / h * e[0] + (1 - r / h) * e[1]), (e[1] - e[0]) / (2 * h)
    tie = pair(4, u_g, t_g, e[2], e[3]) + springs(4, (across / 2 * 4 * r * r / area, t_g))
    tie[2:, 2:] -= K[2:, 2:]  # the chain's own stiffness of place 1 has it already
    at_0 = (h * h - r * r) / (2 * h)
    keep = (1 - r / h) / h
    return (Interface(springs(4, (keep, [1, -1])) + tie, np.diag([h + h / 2 - at_0, at_0, 0, 0])), chain)
