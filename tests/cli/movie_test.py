#!/usr/bin/python3
"""Moving pictures of runs, as `recoil movie` makes them. Environment: see program.py."""

import os
import shutil
import struct
import unittest

from program import DATA, Program, recoil


def size_of(png):
    """Width and height of a picture."""
    return struct.unpack(">II", png.read_bytes()[16:24])


def webp_frames(file):
    data = file.read_bytes()
    assert data[:4] == b"RIFF" and data[8:12] == b"WEBP", data[:12]
    at, count = 12, 0
    while at < len(data):
        name, length = data[at : at + 4], struct.unpack("<I", data[at + 4 : at + 8])[0]
        count += name == b"ANMF"
        at += 8 + length + length % 2
    return count


class Movie(Program):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def run_flyer(self):
        self.expect(self.run_coarse("--set", "output.fields.every=0.5us", "--end", "2us"), 0)

    def test_numbered_pictures_share_colours_and_size(self):
        self.run_flyer()
        self.expect(recoil("movie", self.out, "pressure", self.folder / "p.png"), 0, "p_0000.png to ", "5 pictures")
        pictures = sorted(self.folder.glob("p_*.png"))
        self.assertEqual([p.name for p in pictures], [f"p_{n:04}.png" for n in range(5)])
        self.assertEqual({size_of(p) for p in pictures}, {(1200, 800)})
        self.assertEqual(len({p.read_bytes() for p in pictures}), 5)
        self.expect(recoil("movie", self.out, "pressure", self.folder / "q.png", "--from", "0.5 us", "--to", "1.5us", "--min",
                           "-1", "--max", "5 GPa", "--width", "600", "--height", "400"), 0, "3 pictures")  # fmt: skip
        self.assertEqual({size_of(p) for p in self.folder.glob("q_*.png")}, {(600, 400)})
        self.assertFalse([p for p in self.out.iterdir() if p.name.endswith(".png")])

    def test_plane_fields_keep_their_frame_while_bodies_move(self):
        self.expect(recoil("run", DATA / "cases" / "slip_aligned", "--end", "0.06 us", "-o", self.out, "--set",
                           "output.fields.every=0.02us"), 5)  # fmt: skip
        for words in ([], ["--window", "x=-2.5mm..1mm,y=0mm..0.4mm"], ["--along", "-1mm,-0.5mm:1mm,0.5mm"]):
            self.expect(recoil("movie", self.out, "velocity.x", self.folder / "v.png", *words), 0, "4 pictures")
            self.assertEqual(len({size_of(p) for p in self.folder.glob("v_*.png")}), 1, words)
        self.expect(recoil("movie", self.out, "body", self.folder / "b.png"), 0, "4 pictures")

    @unittest.skipUnless(shutil.which("img2webp"), "there is no img2webp")
    def test_webp(self):
        self.run_flyer()
        self.expect(recoil("movie", self.out, "pressure", "--rate", "5"), 0, "pressure.webp: 5 pictures, 1 s")
        self.assertEqual(webp_frames(self.out / "pressure.webp"), 5)
        self.assertFalse(list(self.out.glob(".pressure*")), "the single pictures are removed")

    @unittest.skipUnless(shutil.which("apngasm"), "there is no apngasm")
    def test_apng(self):
        self.run_flyer()
        file = self.folder / "p.apng"
        self.expect(recoil("movie", self.out, "pressure", file), 0, "p.apng: 5 pictures")
        self.assertEqual(file.read_bytes().count(b"fcTL"), 5)

    def test_mp4_by_ffmpeg(self):
        """Where there is no ffmpeg a script stands for it that keeps its arguments."""
        self.run_flyer()
        file, environment = self.folder / "p.mp4", dict(os.environ)
        if not shutil.which("ffmpeg"):
            tool = self.folder / "bin" / "ffmpeg"
            tool.parent.mkdir()
            tool.write_text('#!/bin/sh\nfor last; do :; done\necho "$@" > "$last"\n')
            tool.chmod(0o755)
            environment["PATH"] = f"{tool.parent}:{environment['PATH']}"
        self.expect(recoil("movie", self.out, "pressure", file, "--rate", "4", env=environment), 0, "p.mp4: 5 pictures, 1.25 s")
        said = file.read_bytes()
        self.assertTrue(b"ftyp" in said[:16] or b"-framerate 4" in said, said[:200])

    def test_mistakes_and_missing_programs(self):
        self.run_flyer()
        bare = dict(os.environ, PATH="/nowhere")
        self.expect(recoil("movie", self.out, "pressure", env=bare), 4, "no img2webp", "Debian's webp", "pressure.png")
        self.expect(recoil("movie", self.out, "pressure", "a.mp4", env=bare), 4, "no ffmpeg", "Debian's ffmpeg")
        self.expect(recoil("movie", self.out, "pressure", "a.gif"), 2, ".webp, .apng or .mp4")
        png = self.folder / "p.png"
        self.expect(recoil("movie", self.out, "presure", png), 2, "pressure")
        self.expect(recoil("movie", self.folder / "nowhere", "pressure", png), 2, "no folder")
        self.expect(recoil("movie", self.out, "gauge.rear", png), 2, "recoil plot")
        self.expect(recoil("movie", self.out, "pressure", png, "--from", "1.9us", "--to", "1.95us"), 2, "too few", "output.fields.every")
        self.expect(recoil("movie", self.out, "pressure", png, "--from", "2us", "--to", "1us"), 2, "is not before")
        self.expect(recoil("movie", self.out, "pressure", png, "--from", "2mm"), 2, "--from")
        self.expect(recoil("movie", self.out, "pressure", png, "--to", "20 us"), 2, "beyond the end of the run")
        self.expect(recoil("movie", self.out, "pressure", png, "--rate", "0"), 2, "--rate")
        self.expect(recoil("movie", self.out, "pressure", png, "--window", "x=0mm..1mm"), 2, "1d run")
        self.assertFalse(list(self.folder.glob("p_*.png")))
        failing = self.folder / "bin" / "img2webp"
        failing.parent.mkdir(exist_ok=True)
        failing.write_text("#!/bin/sh\necho broken; exit 3\n")
        failing.chmod(0o755)
        broken = dict(os.environ, PATH=f"{failing.parent}:/usr/bin:/bin")
        self.expect(recoil("movie", self.out, "pressure", env=broken), 4, "img2webp failed", "pressure.webp.log")
        self.assertIn("broken", (self.out / "pressure.webp.log").read_text())


if __name__ == "__main__":
    unittest.main()
