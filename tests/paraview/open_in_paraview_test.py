#!/usr/bin/python3
"""The script that each run leaves opens its fields in ParaView, with bodies, a field, levels and all times.

Environment: RECOIL_PROGRAM, and PVPYTHON, the Python of ParaView (tools/with_paraview sets it and gives it a screen).
"""

import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

RECOIL = os.environ["RECOIL_PROGRAM"]
PVPYTHON = os.environ["PVPYTHON"]

# A ball of 2 mm meets a plate, with cells of two sizes: in the plane, and a quarter of it in space.
CASE = """
format = 1
title = "A ball meets a plate"
[domain]
geometry = "{geometry}"
{domain}
[mesh]
finest = "0.25 mm"
levels = 2
block = 10
[time]
end = "0.4 us"
[body.ball]
material = "copper/seed"
shape = {{ kind = "{ball}", centre = {{ {up} = "1.1 mm" }}, radius = "1 mm" }}
velocity = {{ {up} = "-400 m/s" }}
[body.plate]
material = "aluminium/6061-t6"
shape = {{ kind = "box", {plate} }}
[output]
fields = {{ every = "0.1 us" }}
"""
SPACE = CASE.format(
    geometry="3d", ball="sphere", up="z",
    domain="""x = ["0 mm", "10 mm"]
y = ["0 mm", "10 mm"]
z = ["-15 mm", "5 mm"]
boundary = { x = ["symmetry", "outflow"], y = ["symmetry", "outflow"] }""",
    plate='x = ["0 mm", "10 mm"], y = ["0 mm", "10 mm"], z = ["-15 mm", "0 mm"]')  # fmt: skip
PLANE = CASE.format(geometry="planar", ball="disc", up="y",
                    domain='x = ["-10 mm", "10 mm"]\ny = ["-15 mm", "5 mm"]',
                    plate='x = ["-10 mm", "10 mm"], y = ["-15 mm", "0 mm"]')  # fmt: skip

# The plate is rigid, free and turning.
FREE = SPACE.replace('material = "aluminium/6061-t6"\n', """rigid = true
mass = "5 g"
inertia = { x = "20 g*mm2", y = "20 g*mm2", z = "20 g*mm2" }
centre-of-mass = { z = "-2 mm" }
spin = { x = "50 rad/ms" }
""").replace('boundary = { x = ["symmetry", "outflow"], y = ["symmetry", "outflow"] }', "").replace(
    'x = ["0 mm", "10 mm"], y = ["0 mm", "10 mm"], z = ["-15 mm", "0 mm"]', 'x = ["2 mm", "8 mm"], y = ["2 mm", "8 mm"], z = ["-4 mm", "0 mm"]').replace(
    'centre = { z = "1.1 mm" }', 'centre = { x = "5 mm", y = "5 mm", z = "1.1 mm" }').replace(
    'centre-of-mass = { z', 'centre-of-mass = { x = "5 mm", y = "5 mm", z')  # fmt: skip

ASK = """
import sys
sys.argv = ["open_in_paraview.py", "--picture", sys.argv[1]]
exec(compile(open("open_in_paraview.py").read(), "open_in_paraview.py", "exec"))
view = pv.GetActiveView()
visible = [r.Input.SMProxy for r in view.Representations if hasattr(r, "Input") and r.Visibility]
shown = sorted(name for (name, _), source in pv.GetSources().items() if source.SMProxy in visible)
print("times", len(pv.FindSource("fields").TimestepValues), pv.FindSource("fields").TimestepValues[-1])
print("now", pv.GetAnimationScene().AnimationTime)
print("shown", *shown)
print("levels", *pv.FindSource("levels").CellData["level"].GetRange())
print("bodies", *pv.FindSource("bodies").GetDataInformation().GetBounds())
for (name, _), source in pv.GetSources().items():
    if name.startswith("rigid "):
        print(name.replace(" ", "-"), *source.GetDataInformation().GetBounds())
print("cells", pv.FindSource("matter").GetDataInformation().GetNumberOfCells())
"""


def pixels(png):
    """Rows of (red, green, blue) of a PNG of 8 bits a channel without interlacing."""
    data, place, packed = png.read_bytes(), 8, b""
    while place < len(data):
        (size,), kind = struct.unpack(">I", data[place : place + 4]), data[place + 4 : place + 8]
        body = data[place + 8 : place + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
        packed += body if kind == b"IDAT" else b""
        place += size + 12
    assert depth == 8 and colour in (2, 6), (depth, colour)
    wide, raw, before, rows = (3 if colour == 2 else 4), zlib.decompress(packed), None, []
    for j in range(height):
        rule, row = raw[j * (wide * width + 1)], bytearray(raw[j * (wide * width + 1) + 1 : (j + 1) * (wide * width + 1)])
        before = before or bytearray(len(row))
        for k in range(len(row)):
            left, up, corner = (row[k - wide] if k >= wide else 0), before[k], (before[k - wide] if k >= wide else 0)
            near = min((left, up, corner), key=lambda p, s=left + up - corner: abs(s - p))
            row[k] = (row[k] + (0, left, up, (left + up) // 2, near)[rule]) % 256
        rows.append([tuple(row[wide * i : wide * i + 3]) for i in range(width)])
        before = row
    return rows


class ParaView(unittest.TestCase):
    def opened(self, case):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        folder = pathlib.Path(holder.name)
        (folder / "case.toml").write_text(case)
        done = subprocess.run([RECOIL, "run", "case.toml", "-o", "run", "-q"], cwd=folder, capture_output=True, text=True,
                              timeout=300, check=False)  # fmt: skip
        self.assertIn(done.returncode, (0, 6), done.stdout + done.stderr)
        run = folder / "run"
        (run / "ask.py").write_text(ASK)
        done = subprocess.run([PVPYTHON, "ask.py", "picture.png"], cwd=run, capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        said = {line.split()[0]: line.split()[1:] for line in done.stdout.splitlines() if line}
        if keep := os.environ.get("RECOIL_KEEP"):
            (pathlib.Path(keep) / f"{self.id().rsplit('.', 1)[1]}.png").write_bytes((run / "picture.png").read_bytes())
        return said, pixels(run / "picture.png")

    def expect_view(self, said, picture, shown, up):
        self.assertEqual(int(said["times"][0]), 5)
        self.assertAlmostEqual(float(said["times"][1]), 4e-7, delta=1e-12)
        self.assertEqual(float(said["now"][0]), float(said["times"][1]))
        self.assertEqual(said["shown"], shown)
        self.assertEqual([float(v) for v in said["levels"]], [0, 1])
        low, high = float(said["bodies"][2 * up]), float(said["bodies"][2 * up + 1])
        self.assertAlmostEqual(low, -15e-3 if up == 2 else -0.2e-3, delta=0.3e-3, msg="in the plane an outline, which the edge of the domain is not")
        self.assertAlmostEqual(high, 2.1e-3 - 400 * 4e-7, delta=1e-4, msg="the ball has moved")
        colours = [p for row in picture for p in row if max(p) - min(p) > 40]
        self.assertGreater(len(colours), 0.1 * len(picture) * len(picture[0]), "the bodies fill much of the picture")
        self.assertGreater(len({tuple(c // 16 for c in p) for p in colours}), 20, "a field in many colours")

    def test_plane(self):
        self.expect_view(*self.opened(PLANE), ["bodies", "matter", "time"], 1)

    def test_space(self):
        self.expect_view(*self.opened(SPACE), ["bodies", "time"], 2)

    def test_free_rigid_body(self):
        """Turned by 50 rad/ms 0.4 us = 0.02 rad about x: its corners reach 3 cos + 2 sin mm from the middle along y."""
        said, _ = self.opened(FREE)
        self.assertEqual(said["shown"], ["bodies", "rigid", "plate", "time"])
        bounds = [float(b) * 1e3 for b in said["rigid-plate"]]
        turn = float(50e3 * 4e-7)
        reach = 3 * math.cos(turn) + 2 * math.sin(turn)
        self.assertAlmostEqual(bounds[3] - bounds[2], 2 * reach, delta=0.03)
        self.assertAlmostEqual(bounds[1] - bounds[0], 6, delta=0.01)
        self.assertAlmostEqual((bounds[2] + bounds[3]) / 2, 5, delta=0.01)


if __name__ == "__main__":
    sys.exit(unittest.main())
