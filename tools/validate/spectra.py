"""Frequencies and reflections from histories."""
from __future__ import annotations

import numpy as np


def transform(time: np.ndarray, signal: np.ndarray, w: float) -> complex:
    """Of a signal that has come to rest at the end of its record."""
    return complex((signal * np.exp(-1j * w * time)).sum())


def step_frequency(W: float, dt: float) -> float:
    """The frequency at which central differences swing what swings at W without time steps."""
    return float(2 / dt * np.arcsin(W * dt / 2))


def true_frequency(f: float, dt: float) -> float:
    return float(np.sin(np.pi * f * dt) / (np.pi * dt)) if dt else f


def peaks(time: np.ndarray, signal: np.ndarray, dt: float, low: float, high: float) -> list[tuple[float, float]]:
    """Frequencies (by the unit of time) between two limits at which a signal that is a sum of undamped swings has peaks,
    without what the time step adds, and how high they are; the highest first.

    Through Hann's window, whose side lobes fall with the third power of the distance: a neighbour twenty lines off moves a
    peak by 10^-4 of a line. The spectrum is refined sixteen times and a parabola laid through its logarithm's
    highest three points, which finds a lone swing to 10^-4 of a line."""
    n = len(signal)
    spacing = (time[-1] - time[0]) / (n - 1)
    size = 16 * 2 ** int(np.ceil(np.log2(n)))
    spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(n), size))
    line = 1 / (size * spacing)
    found = []
    for k in range(max(1, int(low / line)), min(len(spectrum) - 1, int(high / line))):
        if spectrum[k - 1] < spectrum[k] >= spectrum[k + 1]:
            a, b, c = np.log(spectrum[k - 1 : k + 2])
            at = k + 0.5 * (a - c) / (a - 2 * b + c)
            found.append((true_frequency(at * line, dt), float(spectrum[k])))
    return sorted(found, key=lambda peak: -peak[1])
