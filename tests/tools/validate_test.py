"""The validation fails when it should, and reads what the program writes."""
import contextlib
import io
import math
import struct
import tempfile
import unittest
import zlib
from pathlib import Path
from unittest import mock

import numpy as np

from tools.validate import __main__ as command
from tools.validate import chains, run
from tools.validate.model import Band, Check, Claim
from tools.validate.results import read_vtu
from tools.validate.spectra import peaks


def vtu(arrays: list[bytes], compressed: bool) -> bytes:
    """Points and one scalar, as Geist writes them."""
    appended, offsets = b"", []
    for raw in arrays:
        offsets.append(len(appended))
        if compressed:  # in blocks of 16 bytes
            blocks = [zlib.compress(raw[i : i + 16]) for i in range(0, len(raw), 16)]
            appended += struct.pack("<3Q", len(blocks), 16, len(raw) % 16)
            appended += struct.pack(f"<{len(blocks)}Q", *map(len, blocks)) + b"".join(blocks)
        else:
            appended += struct.pack("<Q", len(raw)) + raw
    compressor = ' compressor="vtkZLibDataCompressor"' if compressed else ""
    return (f'<VTKFile{compressor}><UnstructuredGrid><Piece><PointData><DataArray type="Float32" Name="radius" '
            f'NumberOfComponents="1" format="appended" offset="{offsets[1]}"/></PointData><Points>'
            f'<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="appended" offset="{offsets[0]}"/>'
            '</Points></Piece></UnstructuredGrid>\n<AppendedData encoding="raw">\n_').encode() + appended + (
                b"\n</AppendedData>\n</VTKFile>\n")


class ReadsFields(unittest.TestCase):
    def test_points_and_data(self) -> None:
        points, radius = np.arange(9.0).reshape(3, 3), np.array([1, 2, 3], "f4")
        for compressed in (False, True):
            with self.subTest(compressed=compressed), tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "particles.vtu"
                path.write_bytes(vtu([points.tobytes(), radius.tobytes()], compressed))
                grid = read_vtu(path)
                np.testing.assert_array_equal(grid.points, points)
                np.testing.assert_array_equal(grid.data["radius"], radius)


class SolvesChains(unittest.TestCase):
    """Returned amplitudes in per cent, solved by another program."""

    def test_pressure(self) -> None:
        lengths = (5, 10, 20, 40)
        for parts, known in ((chains.pressure(1, 0.1, "published"), (6.8, 2.8, 1.4, 0.71)),
                             (chains.pressure(1, 0.2, "consistent"), (14.39, 2.38, 0.54, 0.13)),
                             (chains.pressure(1, 0.5, "consistent"), (28.1, 1.44, 0.15, 0.02)),
                             (chains.all_hexahedra(1, 0.4), (10.88, 2.20, 0.53, 0.13))):
            for length, percent in zip(lengths, known):
                self.assertAlmostEqual(100 * chains.reflection(2 * math.pi / length, *parts), percent, delta=0.06)

    def test_long_shear_waves_pass(self) -> None:
        self.assertLess(chains.reflection(2 * math.pi / 1000, *chains.shear(1, 0.25)), 2e-6)


class MeasuresFrequencies(unittest.TestCase):
    def test_of_swings_side_by_side(self) -> None:
        time, dt = np.arange(0, 12, 0.002), 0.01
        signal = sum(a * np.sin(2 * math.pi * f * time + 1) for f, a in ((0.8, 1), (4.8, 0.5), (12.7, 0.3)))
        for f, low, high in ((0.8, 0.4, 2), (4.8, 3, 7), (12.7, 10, 16)):
            self.assertAlmostEqual(peaks(time, signal, 0, low, high)[0][0] / f, 1, delta=1e-4)
        with_steps = peaks(time, signal, dt, 3, 7)[0][0]
        self.assertAlmostEqual(math.asin(math.pi * with_steps * dt) / (math.pi * dt), 4.8, delta=1e-3)


class Fails(unittest.TestCase):
    def test_says_which_run_failed_and_why(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "geist"
            program.write_text("#!/bin/sh\necho out of luck >&2\nexit 3\n")
            program.chmod(0o755)
            told = io.StringIO()
            with mock.patch.object(run, "PROGRAM", program), mock.patch("sys.argv", ["validate", "--short"]), \
                    contextlib.redirect_stderr(told):
                self.assertEqual(command.main(), 1)
        self.assertIn("wide-beam/all hexahedra failed with exit code 3", told.getvalue())
        self.assertIn("out of luck", told.getvalue())

    def test_figures_outside_their_band(self) -> None:
        study = command.STUDIES[0]
        for value, wrong in ((1.0, 0), (1.2, 1), (math.nan, 1)):
            check = Check("tip", value, 1, Band.around(1, 0.1), "")
            self.assertEqual(len(command.complaints(study, [], [check])), wrong, value)

    def test_verdicts_other_than_known(self) -> None:
        study = command.STUDIES[0]
        for known, wrong in ((True, 1), (False, 0), (None, 0)):
            claim = Claim("", "close", "", 0.2, Band(0, 0.1), "", known)
            self.assertEqual(len(command.complaints(study, [claim], [])), wrong, known)


if __name__ == "__main__":
    unittest.main()
