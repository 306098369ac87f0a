"""Readers of what a run leaves in its folder."""
from __future__ import annotations

import csv
import json
import xml.etree.ElementTree as xml
import zlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

TYPES = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}


@dataclass(frozen=True)
class Grid:
    """Points where they were at the start, and what is known at each of them."""

    points: np.ndarray  # [points, 3]
    data: dict[str, np.ndarray]  # [points] or [points, components]


def array_at(appended: bytes, offset: int, kind: str, compressed: bool) -> np.ndarray:
    """One appended array: its size and bytes, or the sizes of its compressed blocks and these."""
    if not compressed:
        size = int(np.frombuffer(appended, "<u8", 1, offset)[0])
        return np.frombuffer(appended[offset + 8 : offset + 8 + size], kind)
    blocks = int(np.frombuffer(appended, "<u8", 1, offset)[0])
    sizes = np.frombuffer(appended, "<u8", blocks, offset + 24)
    start, raw = offset + 24 + 8 * blocks, b""
    for size in map(int, sizes):
        raw += zlib.decompress(appended[start : start + size])
        start += size
    return np.frombuffer(raw, kind)


def read_vtu(path: Path) -> Grid:
    """The points and point data of a file as Geist writes them: arrays appended as raw bytes."""
    text, appended = path.read_bytes().split(b'<AppendedData encoding="raw">\n_', 1)
    root = xml.fromstring(text + b"</VTKFile>")
    compressed = "compressor" in root.attrib

    def read(element: xml.Element) -> np.ndarray:
        values = array_at(appended, int(element.attrib["offset"]), TYPES[element.attrib["type"]], compressed)
        width = int(element.attrib["NumberOfComponents"])
        return values.reshape(-1, width) if width > 1 else values

    points = root.find(".//Points/DataArray")
    if points is None:
        raise ValueError(f"{path} has no points")
    return Grid(read(points), {e.attrib["Name"]: read(e) for e in root.iterfind(".//PointData/DataArray")})


class Result:
    """The results of one run."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @cached_property
    def summary(self) -> dict:
        return json.loads((self.folder / "summary.json").read_text())

    @cached_property
    def history(self) -> dict[str, np.ndarray]:
        with open(self.folder / "history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}

    @property
    def tip(self) -> float:
        """Deflection of a beam's end, downwards."""
        return -self.summary["probes"]["tip"]

    @property
    def freedoms(self) -> int:
        return self.summary["counts"]["degrees_of_freedom"]

    @property
    def steps(self) -> int:
        return self.summary["steps"]

    @property
    def seconds(self) -> float:
        return self.summary["wall_seconds"]["total"]

    @property
    def time_step(self) -> float:
        return self.summary["time_step"]["value"]

    def grids(self, time: float | None = None) -> list[Grid]:
        """Hexahedra and particles, as far as there are any, as written nearest to a time, or last."""
        sets = xml.parse(self.folder / "fields.pvd").getroot().findall(".//DataSet")
        sets = [s for s in sets if s.attrib["name"] != "ghosts"]
        times = {float(s.attrib["timestep"]) for s in sets}
        chosen = max(times) if time is None else min(times, key=lambda t: abs(t - time))
        return [read_vtu(self.folder / s.attrib["file"]) for s in sets if float(s.attrib["timestep"]) == chosen]
