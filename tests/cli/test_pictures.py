"""Pictures: keenline picture and keenline gaussmap."""
import os
import pathlib
import struct
import subprocess
import unittest
import zlib

from keenline_program import PROGRAM, FolderTest, run, run_json


def read_png(path):
    """(width, height, rows of (red, green, blue)) by the PNG specification: no library's word is taken for it."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    place, packed, header = 8, b"", None
    while place < len(data):
        (length,), kind = struct.unpack(">I", data[place:place + 4]), data[place + 4:place + 8]
        body = data[place + 8:place + 8 + length]
        (check,) = struct.unpack(">I", data[place + 8 + length:place + 12 + length])
        assert check == zlib.crc32(kind + body)
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        if kind == b"IDAT":
            packed += body
        place += 12 + length
    width, height, depth, color, _, _, interlace = header
    assert (depth, color, interlace) == (8, 2, 0)
    raw, rows, above = zlib.decompress(packed), [], bytearray(3 * width)
    for y in range(height):
        start = y * (3 * width + 1)
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + 3 * width])
        for i in range(3 * width):
            left = row[i - 3] if i >= 3 else 0
            corner = above[i - 3] if i >= 3 else 0
            guess = left + above[i] - corner
            nearest = min((left, above[i], corner), key=lambda v: abs(guess - v))
            row[i] = (row[i] + (0, left, above[i], (left + above[i]) // 2, nearest)[kind]) & 255
        rows.append([tuple(row[i:i + 3]) for i in range(0, 3 * width, 3)])
        above = row
    return width, height, rows


def count(rows, color):
    return sum(row.count(color) for row in rows)


EDGE, CORNER = (213, 94, 0), (0, 68, 158)


class Picture(FolderTest):
    def labelled(self):
        out = self.path("labels.ply")
        result = run("detect", self.cube(), "-o", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return out

    def test_lines_are_drawn_over_their_cloud(self):
        cloud, lines = self.cube(), self.path("lines.json")
        self.assertEqual(run("synth", "cube", "-o", self.path("same.ply"), "--points", 2000, "--lines", lines).returncode, 0)
        result = run("picture", cloud, "--lines", lines, "-o", self.path("out.png"), "--size", "300,240")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        _, _, rows = read_png(self.path("out.png"))
        self.assertGreater(count(rows, EDGE), 100)
        self.assertGreater(count(rows, CORNER), 10)
        self.expect_refusal(run("picture", cloud, "--lines", lines, "--lines", lines, "-o", self.path("out.png")), 2, "--lines")
        self.expect_refusal(run("picture", cloud, "--lines", self.path("no.json"), "-o", self.path("out.png")), 1, "no.json")

    def test_a_labelled_cloud_shows_its_kinds(self):
        result = run("picture", self.labelled(), "-o", self.path("out.png"), "--size", "200,160")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("200 x 160", result.stdout)
        width, height, rows = read_png(self.path("out.png"))
        self.assertEqual((width, height), (200, 160))
        self.assertGreater(count(rows, EDGE), 50)
        self.assertGreater(count(rows, (255, 255, 255)), 5000)

    def test_a_cloud_without_labels_is_drawn_too(self):
        self.assertEqual(run("picture", self.cube(), "-o", self.path("out.png"), "--size", "200,160").returncode, 0)
        _, _, rows = read_png(self.path("out.png"))
        self.assertEqual(count(rows, EDGE), 0)
        self.assertLess(count(rows, (255, 255, 255)), 200 * 160 - 5000)

    def test_color_view_and_caption_change_the_picture(self):
        source = self.labelled()
        pictures = set()
        cases = [[], ["--color", "score"], ["--color", "truth_distance"], ["--color", "truth_kind"], ["--view", "-60,-25"],
                 ["--view", "10.5,80"], ["--caption", "a cube"], ["--size", "100,100"]]
        for arguments in cases:
            result = run("picture", source, "-o", self.path("out.png"), *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            pictures.add(self.path("out.png").read_bytes())
        self.assertEqual(len(pictures), len(cases))

    def test_several_clouds_stand_on_one_sheet(self):
        source = self.labelled()
        report = run_json("picture", source, self.path("cube.ply"), source, "-o", self.path("out.png"), "--size", "100,90",
                          "--caption", "one", "--caption", "two", "--columns", "3")
        self.assertEqual(report, {"inputs": [str(source), str(self.path("cube.ply")), str(source)], "output": str(self.path("out.png")),
                                  "pictures": 3, "width": 300, "height": 90})
        self.assertEqual(read_png(self.path("out.png"))[:2], (300, 90))
        self.assertEqual(run_json("picture", source, source, source, "-o", self.path("out.png"), "--size", "100,90")["height"], 180)

    def test_same_bytes_for_any_number_of_threads(self):
        source = self.labelled()
        outputs = set()
        for threads in ("1", "4"):
            self.assertEqual(run("picture", source, "-o", self.path("out.png"), "--threads", threads, "--quiet").stdout, "")
            outputs.add(self.path("out.png").read_bytes())
        self.assertEqual(len(outputs), 1)

    def test_odd_clouds_are_drawn(self):
        for name, text in (("empty.csv", "x,y,z\n"), ("one.xyz", "1 2 3\n"), ("nan.xyz", "nan nan nan\n1 2 inf\n"),
                           ("far.xyz", "1e300 0 0\n-1e300 5 5\n0 0 1e-300\n"), ("same.xyz", "1 1 1\n" * 50)):
            with self.subTest(name=name):
                result = run("picture", self.write(name, text), "-o", self.path("out.png"), "--size", "80,80")
                expected = run("info", self.path(name)).returncode
                self.assertEqual(result.returncode, expected, result.stderr)
                if expected == 0:
                    self.assertEqual(read_png(self.path("out.png"))[:2], (80, 80))

    def test_wrong_usage(self):
        source = self.labelled()
        cases = [(["--size", "10,10"], "64 to 8192"), (["--size", "100"], "W,H"), (["--size", "1e9,1"], "64 to 8192"), (["--size", "1,x"], "W,H"),
                 (["--view", "10"], "AZ,EL"), (["--view", "0,91"], "-90 to 90"), (["--view", "nan,0"], "AZ,EL"),
                 (["--color", "speed"], "score"), (["--columns", "0"], "columns"), (["--caption", "a", "--caption", "b"], "captions")]
        for arguments, part in cases:
            with self.subTest(arguments=arguments):
                self.expect_refusal(run("picture", source, "-o", self.path("out.png"), *arguments), 2, part)
        self.expect_refusal(run("picture", source, "-o", self.path("out.jpg")), 2, ".png")
        self.expect_refusal(run("picture", "-o", self.path("out.png")), 2, "CLOUD")
        self.assertEqual(self.names(), ["cube.ply", "labels.ply"])

    def test_the_input_is_never_the_output(self):
        source = self.cube(100, "cube.ply").rename(self.path("cube.png"))
        self.expect_refusal(run("picture", source, "-o", source), 2, "is the input")
        self.expect_refusal(run("gaussmap", source, "--point", "0", "-o", source), 2, "is the input")

    def test_input_and_output_errors(self):
        source = self.cube(100)
        self.expect_refusal(run("picture", self.path("none.ply"), "-o", self.path("out.png")), 1, "none.ply")
        self.expect_refusal(run("picture", source, "-o", self.path("none/out.png")), 3, "out.png")
        self.write("out.png", "old")
        limited = ["bash", "-c", 'ulimit -f 1; exec "$@"', "-", PROGRAM, "picture", str(source), "-o", str(self.path("out.png"))]
        self.expect_refusal(subprocess.run(limited, capture_output=True, text=True), 3, "out.png")
        with open("/dev/full", "w") as full:
            self.expect_refusal(run("picture", source, "-o", self.path("out.png"), stdout=full), 3, "standard output")
        self.assertEqual(self.path("out.png").read_bytes(), b"old")
        self.assertEqual(self.names(), ["cube.ply", "out.png"])


class Gaussmap(FolderTest):
    def fold(self):
        # Point 0 on the fold of two planes; none of its neighbours lies on the fold.
        points = [(0, 0, 0)]
        for i in range(8):
            angle = -1.4 + 2.8 * i / 7
            u, v = 1 + 0.01 * i, angle * (1 + 0.02 * i)
            points += [(u, v, 0), (0, v + 0.013, u)]
        return self.write("fold.xyz", "".join(f"{x} {y} {z}\n" for x, y, z in points))

    def test_the_clusters_of_a_fold_have_two_colors(self):
        result = run("gaussmap", self.fold(), "--point", "0", "-o", self.path("out.png"), "--plain")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        width, height, rows = read_png(self.path("out.png"))
        self.assertEqual((width, height), (480, 560))
        self.assertGreater(count(rows, EDGE), 50)
        self.assertGreater(count(rows, CORNER), 50)

    def test_options_of_the_method_count(self):
        source = self.fold()
        pictures = set()
        for arguments in ([], ["--sigma", "89"], ["--min-cluster", "100"], ["--neighbors", "8"], ["--sigma", "auto"], ["--view", "0,90"]):
            result = run("gaussmap", source, "--point", "0", "-o", self.path("out.png"), *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            pictures.add(self.path("out.png").read_bytes())
        self.assertGreaterEqual(len(pictures), 5)

    def test_several_points_stand_on_one_sheet(self):
        report = run_json("gaussmap", self.fold(), "--point", "0", "--point", "16", "-o", self.path("out.png"), "--size", "90,100",
                          "--caption", "on the fold")
        self.assertEqual((report["pictures"], report["width"], report["height"]), (2, 180, 100))

    def test_wrong_usage(self):
        source = self.fold()
        cases = [(["--point", "17"], "0 to 16"), (["--point", "-1"], "point"), (["--point", "x"], "point"), ([], "point"),
                 (["--point", "0", "--sigma", "91"], "up to 90"),
                 (["--point", "0", "--view", "x,y"], "AZ,EL")]
        for arguments, part in cases:
            with self.subTest(arguments=arguments):
                self.expect_refusal(run("gaussmap", source, "-o", self.path("out.png"), *arguments), 2, part)
        self.expect_refusal(run("gaussmap", self.write("empty.csv", "x,y,z\n"), "--point", "0", "-o", self.path("out.png")), 2, "no points")
        self.expect_refusal(run("gaussmap", source, "--point", "0", "-o", self.path("out.ply")), 2, ".png")
        self.assertEqual(self.names(), ["empty.csv", "fold.xyz"])


class Figures(FolderTest):
    def test_the_script_makes_every_figure(self):
        script = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "figures.sh"
        environment = {**os.environ, "KEENLINE_FIGURE_POINTS": "1500"}
        result = subprocess.run([script, PROGRAM, self.path("figures")], capture_output=True, text=True, env=environment, timeout=600)
        self.assertEqual(result.returncode, 0, result.stderr)
        names = sorted(os.listdir(self.path("figures")))
        self.assertEqual(names, ["default.png", "demarsin-lines.png", "demarsin-score.png", "demarsin.png", "figure2-cube.png", "figure2-sphere.png", "figure4-fandisk.png", "figure4-icosahedron.png",
                                 "figure5-bounding-box.png", "figure5-spacing.png", "figure6.png",
                                 "gumhold-kinds.png", "gumhold-lines.png", "gumhold-score.png", "pauly-kinds.png", "pauly-lines.png",
                                 "pauly-score.png", "tensor-voting-lines.png", "tensor-voting-score.png", "tensor-voting.png"])
        pages = (script.parent.parent / "docs" / "methods").glob("*.md")
        shown = "".join(page.read_text() for page in pages)
        for name in names:
            self.assertIn(name, shown)


if __name__ == "__main__":
    unittest.main()
