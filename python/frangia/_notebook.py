"""Pictures of meshes and tables of inspections in notebooks."""

from __future__ import annotations

import html
import math
import os
import struct
import zlib
from typing import TYPE_CHECKING, Any

from ._arguments import ArgumentError
from ._frangia import Inspection, Mesh

if TYPE_CHECKING:
    from numpy.typing import NDArray


def png_bytes(picture: NDArray[Any]) -> bytes:
    """A PNG of an array, height x width x 3 of uint8."""
    height, width, _ = picture.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + picture[y].tobytes() for y in range(height))
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows))
        + chunk(b"IEND", b"")
    )


class Picture:
    """A picture that a notebook shows; `save` writes it as PNG."""

    def __init__(self, pixels: NDArray[Any]) -> None:
        self.pixels = pixels

    def _repr_png_(self) -> bytes:
        return png_bytes(self.pixels)

    def save(self, path: str | os.PathLike[str]) -> None:
        with open(path, "wb") as file:
            file.write(png_bytes(self.pixels))


def show(self: Mesh, **options: Any) -> Picture:
    """A picture of the mesh for a notebook; options as `render`. values="sigma_mm" colours by it."""
    values = options.get("values")
    if isinstance(values, str):
        if not hasattr(self, values):
            raise ArgumentError(
                f'frangia.Mesh.show: the mesh has no values "{values}"; give sigma_mm, or one per vertex'
            )
        options["label"] = options.get("label", values.replace("_mm", ", mm"))
        options["values"] = getattr(self, values)
    return Picture(self.render(**options))


setattr(Mesh, "show", show)


def table(self: Inspection) -> str:
    """The verdict and the characteristics as a table of HTML."""

    def number(value: float | None, digits: int = 4) -> str:
        return "" if value is None or not math.isfinite(value) else f"{value:.{digits}f}"

    heads = ("characteristic", "nominal", "limits", "measured", "U95", "unit", "verdict")
    rows = [
        (
            row.name,
            number(row.nominal),
            " … ".join(number(limit) for limit in row.limits) if row.limits else "",
            number(row.value) or "not found",
            number(row.u95),
            row.unit,
            row.verdict or "",
        )
        for row in self.characteristics
    ]
    cells = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    head = "<tr>" + "".join(f"<th>{name}</th>" for name in heads) + "</tr>"
    sentence = f": {html.escape(self.sentence)}" if self.sentence else ""
    return f"<p><b>{self.verdict}</b>{sentence}</p>" + (f"<table>{head}{cells}</table>" if rows else "")


setattr(Inspection, "_repr_html_", table)
