"""keenline relabel: the file of a fresh run, without the run."""
import struct
import subprocess
import unittest

from keenline_program import PROGRAM, FolderTest, ply_bytes, read_csv, run, run_json

SIGMAS = ("3", "9.9", "12", "20", "33.3", "60")


def with_spectrum(points, columns, rows):
    """A PLY of `points` with three lists of type int each; `rows` holds (from, kind, clusters) of every point."""
    lines = [f"element vertex {len(points)}", *(f"property double {axis}" for axis in "xyz"),
             *(f"property list uchar int {name}" for name in columns)]
    header = "\n".join(["ply", "format binary_little_endian 1.0", *lines, "end_header"]) + "\n"
    body = b"".join(struct.pack("<3d", *p) + b"".join(struct.pack(f"<B{len(values)}i", len(values), *values) for values in lists)
                    for p, lists in zip(points, rows))
    return header.encode() + body


class RelabelTest(FolderTest):
    def fandisk(self, points=10000):
        result = run("synth", "fandisk", "-o", self.path("fandisk.ply"), "--points", points, "--noise", "0.05h")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.path("fandisk.ply")

    def done(self, *arguments):
        result = run(*arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def spectrum(self, points=500):
        self.done("detect", self.fandisk(points), "-o", self.path("spectrum.ply"), "--spectrum")
        return self.path("spectrum.ply")


class SameAsAFreshRun(RelabelTest):
    def expect_fresh_files(self, *options):
        source = self.fandisk()
        self.done("detect", source, "-o", self.path("kept.ply"), "--spectrum", *options)
        kinds = set()
        for sigma in SIGMAS:
            with self.subTest(sigma=sigma):
                self.done("detect", source, "-o", self.path("fresh.ply"), "--spectrum", "--sigma", sigma, *options)
                self.done("relabel", self.path("kept.ply"), "-o", self.path("again.ply"), "--sigma", sigma)
                self.assertEqual(self.path("again.ply").read_bytes(), self.path("fresh.ply").read_bytes())
                # Without the option only the spectrum and its comment are missing.
                self.done("detect", source, "-o", self.path("fresh.csv"), "--sigma", sigma, *options)
                run("relabel", self.path("kept.ply"), "-o", self.path("again.csv"), "--sigma", sigma)
                fresh, again = read_csv(self.path("fresh.csv")), read_csv(self.path("again.csv"))
                for name in ("feature", "kind", "score", "clusters"):
                    self.assertEqual(again[name], fresh[name], name)
                self.assertEqual(len(again["kind"]), 10000)
                kinds.add(tuple(again["kind"]))
        self.assertEqual(len(kinds), len(SIGMAS))

    def test_on_every_point(self):
        self.expect_fresh_files()

    def test_on_every_point_with_plain(self):
        self.expect_fresh_files("--plain")

    def test_local_is_a_choice_for_every_point(self):
        self.done("detect", self.fandisk(), "-o", self.path("fresh.ply"), "--spectrum", "--sigma", "local")
        self.done("detect", self.path("fandisk.ply"), "-o", self.path("kept.ply"), "--spectrum")
        self.done("relabel", self.path("kept.ply"), "-o", self.path("again.ply"), "--sigma", "local")
        self.assertNotEqual(self.path("kept.ply").read_bytes(), self.path("fresh.ply").read_bytes())
        self.assertEqual(self.path("again.ply").read_bytes(), self.path("fresh.ply").read_bytes())

    def test_one_after_the_other_and_back(self):
        kept = self.spectrum()
        sigma = next(c for c in run_json("info", kept)["comments"] if c.startswith("keenline sigma ")).split()[-1]
        self.done("relabel", kept, "-o", self.path("a.ply"), "--sigma", "7")
        self.assertNotEqual(self.path("a.ply").read_bytes(), kept.read_bytes())
        self.assertEqual([c for c in run_json("info", self.path("a.ply"))["comments"] if "sigma" in c], ["keenline sigma 7"])
        self.done("relabel", self.path("a.ply"), "-o", self.path("b.ply"), "--sigma", sigma)
        self.assertEqual(self.path("b.ply").read_bytes(), kept.read_bytes())

    def test_auto_is_what_detect_chooses(self):
        self.done("detect", self.fandisk(), "-o", self.path("auto.ply"), "--spectrum", "--sigma", "auto")
        self.done("relabel", self.path("auto.ply"), "-o", self.path("7.ply"), "--sigma", "7")
        self.done("relabel", self.path("7.ply"), "-o", self.path("again.ply"), "--sigma", "auto")
        self.assertEqual(self.path("again.ply").read_bytes(), self.path("auto.ply").read_bytes())

    def test_without_points(self):
        empty = self.write("empty.ply", ply_bytes([]))
        self.done("detect", empty, "-o", self.path("kept.ply"), "--spectrum", "--sigma", "20")
        self.done("detect", empty, "-o", self.path("fresh.ply"), "--spectrum", "--sigma", "7")
        self.done("relabel", self.path("kept.ply"), "-o", self.path("again.ply"), "--sigma", "7")
        self.assertEqual(self.path("again.ply").read_bytes(), self.path("fresh.ply").read_bytes())


class Report(RelabelTest):
    def test_json(self):
        kept = self.spectrum()
        report = run_json("relabel", kept, "-o", self.path("out.ply"), "--sigma", "12.5")
        self.assertEqual(set(report), {"input", "output", "format", "encoding", "points", "finite_points", "sigma", "counts",
                                       "feature_points", "notes", "timings_s", "peak_memory_bytes"})
        self.assertEqual((report["input"], report["output"]), (str(kept), str(self.path("out.ply"))))
        self.assertEqual((report["points"], report["finite_points"], report["sigma"], report["notes"]), (500, 500, 12.5, []))
        self.assertEqual(sum(report["counts"].values()), 500)
        self.assertEqual(report["counts"]["edge"] + report["counts"]["corner"] + report["counts"]["peak"], report["feature_points"])
        self.assertEqual(set(report["timings_s"]), {"read", "relabel", "write", "total"})
        fresh = run_json("detect", self.path("fandisk.ply"), "-o", self.path("fresh.ply"), "--sigma", "12.5")
        self.assertEqual(report["counts"], fresh["counts"])

    def test_summary_and_quiet(self):
        kept = self.spectrum()
        summary = self.done("relabel", kept, "-o", self.path("out.ply"), "--sigma", "12.5")
        for part in ("500 points", "sigma 12.5", "edge", "sharp points", "out.ply"):
            self.assertIn(part, summary)
        self.assertEqual(self.done("relabel", kept, "-o", self.path("out.ply"), "--sigma", "12.5", "--quiet"), "")

    def test_csv_says_what_it_cannot_hold(self):
        result = run("relabel", self.spectrum(), "-o", self.path("out.csv"), "--sigma", "12")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("note: ", result.stderr)
        self.assertIn("spectrum_from", result.stderr)

    def test_same_bytes_for_any_number_of_threads(self):
        kept = self.spectrum(5000)
        outputs = set()
        for threads in ("1", "2", "16"):
            self.done("relabel", kept, "-o", self.path("out.ply"), "--sigma", "auto", "--threads", threads)
            outputs.add(self.path("out.ply").read_bytes())
        self.assertEqual(len(outputs), 1)


class OtherFiles(RelabelTest):
    """A spectrum from somewhere else: other types, other attributes beside it, none of the labels."""
    POINTS = [(0.5, 0.25, 4.0), (1.0, -1.0, 0.125)]
    NAMES = ("spectrum_from", "spectrum_kind", "spectrum_clusters")

    def test_labels_are_added(self):
        source = self.write("other.ply", with_spectrum(self.POINTS, self.NAMES, [([0, 7280], [1, 2], [5, 2]), ([0], [255], [0])]))
        for sigma, kind, clusters in (("9.999", 1, 5), ("10", 2, 2)):
            self.done("relabel", source, "-o", self.path("out.ply"), "--sigma", sigma)
            run("relabel", source, "-o", self.path("out.csv"), "--sigma", sigma)
            columns = read_csv(self.path("out.csv"))
            self.assertEqual(list(columns), ["x", "y", "z", "feature", "kind", "clusters"])
            self.assertEqual(list(zip(*columns.values())),
                             [(*self.POINTS[0], int(kind == 2), kind, clusters), (*self.POINTS[1], 0, 255, 0)])
            # The lists keep their type.
            self.assertIn(b"property list uchar int spectrum_kind\n", self.path("out.ply").read_bytes())

    def test_what_is_wrong_is_told_with_file_attribute_and_point(self):
        good = [([0, 7280], [1, 2], [5, 2]), ([0], [255], [0])]
        cases = [
            (self.NAMES, [good[0], ([1], [255], [0])], ("'spectrum_from'", "point 1", "found 1 ", "expected 0")),
            (self.NAMES, [good[0], ([0], [9], [0])], ("'spectrum_kind'", "point 1", "found 9")),
            (self.NAMES, [([0, 7], [1, 2], [5]), good[1]], ("'spectrum_clusters'", "point 0", "found 1 values", "expected 2")),
            (self.NAMES, [good[0], ([], [], [])], ("'spectrum_from'", "point 1", "empty")),
            (("spectrum_from", "spectrum_kind", "clusters"), good, ("'spectrum_clusters'", "--spectrum")),
        ]
        for names, rows, parts in cases:
            with self.subTest(parts=parts):
                bad = self.write("bad.ply", with_spectrum(self.POINTS, names, rows))
                self.expect_refusal(run("relabel", bad, "-o", self.path("out.ply"), "--sigma", "12"), 1, "bad.ply: ", *parts)
        self.assertEqual(self.names(), ["bad.ply"])

    def test_a_file_without_a_spectrum(self):
        source = self.cube(100)
        self.expect_refusal(run("relabel", source, "-o", self.path("out.ply"), "--sigma", "12"), 1, "cube.ply", "spectrum_from")
        self.expect_refusal(run("relabel", self.path("none.ply"), "-o", self.path("out.ply"), "--sigma", "12"), 1, "none.ply")
        self.assertEqual(self.names(), ["cube.ply"])


class Refusals(RelabelTest):
    def test_wrong_usage(self):
        kept = self.spectrum()
        before = kept.read_bytes()
        for sigma in ("0", "-5", "90.5", "nan", "wide"):
            self.expect_refusal(run("relabel", kept, "-o", self.path("out.ply"), "--sigma", sigma), 2, "up to 90 degrees, or auto")
        self.expect_refusal(run("relabel", kept, "-o", self.path("out.ply")), 2, "--sigma")
        self.expect_refusal(run("relabel", kept, "--sigma", "12"), 2, "--output")
        self.expect_refusal(run("relabel", kept, "-o", self.path("out.txt"), "--sigma", "12"), 2, ".ply or .csv")
        self.expect_refusal(run("relabel", kept, "-o", self.path("out.ply"), "--sigma", "12", "--plain"), 2, "plain")
        self.path("link.ply").symlink_to("spectrum.ply")
        for target in ("spectrum.ply", "link.ply"):
            self.expect_refusal(run("relabel", kept, "-o", self.path(target), "--sigma", "12"), 2, "is the input")
        self.assertEqual(kept.read_bytes(), before)
        self.assertEqual(self.names(), ["fandisk.ply", "link.ply", "spectrum.ply"])

    def test_an_output_that_cannot_be_written(self):
        kept = self.spectrum(5000)
        old = self.write("out.ply", "old")
        self.expect_refusal(run("relabel", kept, "-o", self.path("no/out.ply"), "--sigma", "12"), 3, "out.ply")
        limited = ["bash", "-c", 'ulimit -f 8; exec "$@"', "-", PROGRAM, "relabel", str(kept), "-o", str(old), "--sigma", "12"]
        self.expect_refusal(subprocess.run(limited, capture_output=True, text=True, timeout=60), 3, "out.ply")
        with open("/dev/full", "w") as full:
            self.expect_refusal(run("relabel", kept, "-o", old, "--sigma", "12", stdout=full), 3, "standard output")
        self.assertEqual(old.read_bytes(), b"old")
        self.assertEqual(self.names(), ["fandisk.ply", "out.ply", "spectrum.ply"])

    def test_a_spectrum_needs_a_ply(self):
        result = run("detect", self.path("not-even-there.ply"), "-o", self.path("out.csv"), "--spectrum")
        self.expect_refusal(result, 2, "--spectrum", "out.csv", ".ply")

    def test_a_spectrum_does_not_outlive_its_labels(self):
        kept = self.spectrum()
        self.done("detect", self.path("fandisk.ply"), "-o", self.path("plain.ply"), "--plain")
        result = run("detect", kept, "-o", self.path("again.ply"), "--plain")
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in OtherFiles.NAMES:
            self.assertIn(f"'{name}' is left out", result.stderr)
        self.assertEqual(self.path("again.ply").read_bytes(), self.path("plain.ply").read_bytes())

    def test_a_picture_of_one_point_needs_no_spectrum(self):
        result = run("gaussmap", self.cube(100), "--point", "0", "-o", self.path("out.png"), "--spectrum")
        self.expect_refusal(result, 2, "spectrum")


if __name__ == "__main__":
    unittest.main()
