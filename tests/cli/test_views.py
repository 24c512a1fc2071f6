"""--report and --picture of detect and lines."""
import base64
import json
import re
import unittest
import zlib

from keenline_program import FolderTest, run, run_json
from test_pictures import read_png


def read_report(path):
    """The facts and the inflated data of a report, taken out of it as a browser would."""
    html = path.read_text(encoding="utf-8")
    facts = re.search(r'<script type="application/json" id="keenline-facts">(.*?)</script>', html, re.S)[1]
    data = re.search(r'<script type="text/plain" id="keenline-data">(.*?)</script>', html, re.S)[1]
    return json.loads(facts), zlib.decompress(base64.b64decode(data, validate=True))


def numbers(report, name):
    """A buffer as a list of columns, one for each component; see docs/report-format.md."""
    facts, data = report
    buffer = next(b for b in facts["buffers"] if b["name"] == name)
    size = {"uint8": 1, "uint16": 2, "uint32": 4}[buffer["type"]]
    data, count = data[buffer["offset"]:buffer["offset"] + buffer["bytes"]], buffer["count"]
    if buffer["coding"] == "raw":
        assert size == buffer["components"] == 1
        return [list(data)]
    columns = []
    for component in range(buffer["components"]):
        planes = [data[(component * size + b) * count:][:count] for b in range(size)]
        column = [sum(byte << 8 * b for b, byte in enumerate(number)) for number in zip(*planes)]
        if buffer["coding"] == "delta":
            total = 0
            for i, folded in enumerate(column):
                total = total + ((folded >> 1) ^ -(folded & 1)) & (1 << 8 * size) - 1
                column[i] = total
        columns.append(column)
    return columns


class Views(FolderTest):
    def setUp(self):
        super().setUp()
        self.source = self.cube(3000, "cube.ply", "--noise", "0.05h")

    def test_a_report_is_enough_and_its_facts_are_those_of_json(self):
        told = run_json("detect", self.source, "--report", self.path("cube.html"))
        self.assertEqual((told["output"], told["report"], told["picture"]), (None, str(self.path("cube.html")), None))
        self.assertEqual(self.names(), ["cube.html", "cube.ply"])
        facts, _ = read_report(self.path("cube.html"))
        self.assertEqual((facts["title"], facts["command"], facts["method"]), ("cube.ply", "detect", "gauss"))
        for name in ("spacing", "noise", "smoothed", "options", "notes"):
            self.assertEqual(facts[name], told[name])
        self.assertEqual({kind["name"]: kind["count"] for kind in facts["kinds"]}, told["counts"])
        self.assertEqual((facts["input"]["points"], facts["cloud"]["kept"], facts["cloud"]["left_out"]), (3000, 3000, ""))

    def test_counts_of_every_sensitivity_are_those_of_relabel(self):
        spectrum = self.path("spectrum.ply")
        run("detect", self.source, "--spectrum", "-o", spectrum, "--report", self.path("r.html"), "--report-points", 700)
        report = read_report(self.path("r.html"))
        self.assertLess(report[0]["cloud"]["kept"], 3000)
        self.assertIn("left out", report[0]["cloud"]["left_out"])
        counts = numbers(report, "counts")
        for sigma in (0.5, 9.99, 20, 33.3333, 60, 90):
            told = run_json("relabel", spectrum, "--sigma", sigma, "-o", self.path("again.ply"))["counts"]
            found = [column[int(sigma * 728)] for column in counts]
            self.assertEqual(dict(zip((kind["name"] for kind in report[0]["kinds"]), found)), told)

    def test_data_have_the_same_bytes_for_any_number_of_threads(self):
        found = set()
        for threads in (1, 4, 3):
            run("detect", self.source, "--report", self.path("r.html"), "--report-points", 900, "--threads", threads)
            facts, data = read_report(self.path("r.html"))
            del facts["times"]
            found.add((json.dumps(facts), data))
        self.assertEqual(len(found), 1)

    def test_lines_with_report_picture_and_drawing(self):
        outputs = [self.path(name) for name in ("a.json", "a.html", "a.png")]
        result = run("lines", self.source, "-o", outputs[0], "--report", outputs[1], "--picture", outputs[2])
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for output in outputs:
            self.assertIn(str(output), result.stdout)
        facts, _ = read_report(outputs[1])
        self.assertEqual(facts["graph"], json.loads(outputs[0].read_text(encoding="utf-8")))
        rows = read_png(outputs[2])
        self.assertTrue(any((213, 94, 0) == pixel for row in rows[-1] for pixel in row))

    def test_a_picture_is_enough(self):
        result = run("detect", self.source, "--picture", self.path("a.png"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("result in " + str(self.path("a.png")), result.stdout)
        self.assertEqual(self.names(), ["a.png", "cube.ply"])

    def test_nothing_to_write_is_wrong_usage(self):
        for command in ("detect", "lines"):
            self.expect_refusal(run(command, self.source), 2, "--output", "--report", "--picture")
            self.expect_refusal(run(command, self.source, "--report", self.path("a.txt")), 2, ".html")
            self.expect_refusal(run(command, self.source, "--picture", self.path("a.txt")), 2, ".png")
            self.expect_refusal(run(command, self.source, "--report", self.path("none") / "a.html"), 3, "none/a.html")
            self.expect_refusal(run(command, self.source, "--report", self.path("a.html"), "--report-points", 0), 2, "--report-points")
        self.assertEqual(self.names(), ["cube.ply"])

    def test_one_that_cannot_be_written_leaves_nothing(self):
        self.path("a.png").mkdir()
        for command, output in (("detect", "a.ply"), ("lines", "a.dxf")):
            result = run(command, self.source, "-o", self.path(output), "--report", self.path("a.html"), "--picture", self.path("a.png"))
            self.assertEqual(result.returncode, 3)
        self.assertEqual(self.names(), ["a.png", "cube.ply"])

    def test_names_and_comments_stay_text(self):
        name = "<img src=x onerror=alert(1)>&amp;.ply"
        self.source.rename(self.path(name))
        self.assertEqual(run("detect", self.path(name), "--report", self.path("r.html")).returncode, 0)
        self.assertEqual(read_report(self.path("r.html"))[0]["title"], name)
        self.assertNotIn("<img", self.path("r.html").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
