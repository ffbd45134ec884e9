"""Holds what `export` wrote into a folder against closed forms, by the eyes of other programs."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

import ezdxf
import vpype

ROOM = Path(sys.argv[1])
WIDTH, HOLE, KERF, HEIGHT = 12.0, 4.0, 0.2, 3.0
MM = 96 / 25.4


def near(found, wanted, part, what):
    """Fails unless two numbers agree to a part of the second."""
    assert abs(found - wanted) <= part * abs(wanted), f"{what}: {found}, not {wanted}"
    print(f"{what}: {found:.6g}, expected {wanted:.6g}")


def area_of_parts():
    """The area of three rods and a right triangle of 30 and 40, holes taken out."""
    radius, hole = (WIDTH + KERF) / 2, (HOLE - KERF) / 2
    rods = sum(2 * radius * length + math.pi * radius**2 for length in (10, 30 * math.sqrt(2), 30))
    plate = 600 + 120 * radius + math.pi * radius**2
    return rods + plate - 9 * math.pi * hole**2


def strokes():
    """vpype: a layer for the mechanism and each path, in true size."""
    document = vpype.read_multilayer_svg(str(ROOM / "plot.svg"), quantization=0.01 * MM)
    names = [document.layers[k].metadata.get(vpype.METADATA_FIELD_NAME) for k in sorted(document.layers)]
    assert len(names) == 3, names
    print("layers:", names)
    crank_pin = document.layers[2]
    left, bottom, right, top = crank_pin.bounds()
    near((right - left) / MM, 20, 1e-3, "the path of B across, mm")
    near((top - bottom) / MM, 20, 1e-3, "the path of B upwards, mm")
    # A turn of 360 frames is closed: all of the circle.
    near(crank_pin.length() / MM, 20 * math.pi, 1e-3, "the path of B, mm")
    width, height = document.page_size
    print(f"page: {width / MM:.2f} x {height / MM:.2f} mm")


def audit():
    """ezdxf: no error, and as many circles as holes."""
    document = ezdxf.readfile(ROOM / "parts.dxf")
    auditor = document.audit()
    assert not auditor.errors and not auditor.fixes, (auditor.errors, auditor.fixes)
    space = document.modelspace()
    holes = space.query("CIRCLE[layer=='hole']")
    assert len(holes) == 9, len(holes)
    assert all(abs(hole.dxf.radius - (HOLE - KERF) / 2) < 1e-9 for hole in holes)
    print("ezdxf: no errors, 9 holes")


def solids():
    """OpenSCAD: extruded, each file is watertight and of the right volume."""
    if shutil.which("openscad") is None:
        print("SKIPPED: no OpenSCAD is here and none can be installed, so no solids are made")
        return
    for name in ("parts.dxf", "parts.svg"):
        script = ROOM / "solid.scad"
        script.write_text(
            f'linear_extrude(height = {HEIGHT}) import("{ROOM / name}", $fn = 720);\n'
        )
        solid = ROOM / "solid.stl"
        made = subprocess.run(
            ["openscad", "-o", str(solid), str(script)], capture_output=True, text=True, check=False
        )
        assert made.returncode == 0, made.stderr
        assert "WARNING" not in made.stderr and "ERROR" not in made.stderr, made.stderr
        volume, n_open = measured(solid)
        assert n_open == 0, f"{name}: {n_open} edges are not shared by two triangles"
        near(volume, HEIGHT * area_of_parts(), 1e-3, f"the volume of {name}, mm^3")


def measured(stl):
    """The volume of a solid, and how many of its edges are not shared by two triangles."""
    corners = [
        tuple(float(word) for word in line.split()[1:])
        for line in stl.read_text().splitlines()
        if line.strip().startswith("vertex")
    ]
    volume, edges = 0.0, {}
    for a, b, c in zip(corners[::3], corners[1::3], corners[2::3]):
        volume += (
            a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
        ) / 6
        for edge in ((a, b), (b, c), (c, a)):
            edges[edge] = edges.get(edge, 0) + 1
    n_open = sum(n != edges.get((end, start), 0) for (start, end), n in edges.items())
    return abs(volume), n_open


strokes()
audit()
solids()
