"""Plane waves in an endless mesh of square hexahedra of length 1, in plane strain with Poisson's ratio 0, density 1 and shear
modulus 1: speeds 1 (S) and the square root of 2 (P) where waves are long. Motion in the plane, masses lumped, no time steps."""
from __future__ import annotations

import numpy as np

SPEED = {"P": np.sqrt(2.0), "S": 1.0}


def dynamic_matrix(kx: complex, ky: float, W: float) -> np.ndarray:
    """Force on a node by the amplitude of its displacement (x, y) in a wave exp(i(kx x + ky y)), less inertia."""

    def stretch(k: complex) -> complex:
        return 2 * (1 - np.cos(k))

    def mean(k: complex) -> complex:
        return (2 + np.cos(k)) / 3

    own = [2 * stretch(kx) * mean(ky) + mean(kx) * stretch(ky), 2 * stretch(ky) * mean(kx) + mean(ky) * stretch(kx)]
    mixed = np.sin(kx) * np.sin(ky)
    return np.array([[own[0], mixed], [mixed, own[1]]]) - W**2 * np.eye(2)


def along_x(kind: str, ky: float, W: float) -> complex:
    """kx of the wave to the right: by Newton's method, from that of the continuum."""

    def determinant(k: complex) -> complex:
        return complex(np.linalg.det(dynamic_matrix(k, ky, W)))

    k, small = complex(np.sqrt((W / SPEED[kind]) ** 2 - ky**2 + 0j)), 1e-6
    for _ in range(60):
        change = 2 * small * determinant(k) / (determinant(k + small) - determinant(k - small))
        k -= change
        if abs(change) < 1e-12:
            break
    return k


def direction(kind: str, ky: float, W: float) -> np.ndarray:
    """Displacement (x, y) of the wave to the right, of length 1; that of the wave to the left has the other sign of x."""
    if abs(ky) < 1e-12:
        return np.array([1, 0] if kind == "P" else [0, 1], complex)
    matrix = dynamic_matrix(along_x(kind, ky, W), ky, W)
    v = np.array([matrix[0, 1], -matrix[0, 0]])
    kx = np.sqrt((W / SPEED[kind]) ** 2 - ky**2 + 0j)
    like = np.array([kx, ky] if kind == "P" else [-ky, kx])
    return v / np.linalg.norm(v) * np.exp(-1j * np.angle(np.vdot(like, v)))


def flux(kind: str, ky: float, W: float) -> float:
    """Energy that a wave of amplitude 1 carries along x, but for a factor: its group's speed along x."""
    v, k, small = direction(kind, ky, W), along_x(kind, ky, W), 1e-5
    slope = (dynamic_matrix(k + small, ky, W) - dynamic_matrix(k - small, ky, W)) / (2 * small)
    return float(np.real(np.vdot(v, slope @ v))) / (2 * W)
