"""keenline lines: from a cloud to a drawing, in one command."""
import json
import math
import unittest

from keenline_program import FolderTest, run, run_json

CORNERS = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]


class Lines(FolderTest):
    def done(self, *arguments):
        result = run(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def shape(self, name, points=6000, *arguments):
        self.done("synth", name, "-o", self.path(name + ".ply"), "--points", points, "--lines", self.path("truth.json"), *arguments)
        return self.path(name + ".ply")

    def drawing(self, source, *arguments):
        self.done("lines", source, "-o", self.path("found.json"), *arguments)
        return json.loads(self.path("found.json").read_text(encoding="utf-8"))

    def compared(self):
        return run_json("evaluate", self.path("found.json"), "--lines", self.path("truth.json"))["files"][0]

    def test_a_cube_has_eight_corners_and_twelve_edges(self):
        graph = self.drawing(self.shape("cube", 6000, "--noise", "0.05h"))
        self.assertEqual((len(graph["corners"]), len(graph["polylines"])), (8, 12))
        found = self.compared()
        self.assertEqual(found["found"]["loose_ends"], 0)
        self.assertAlmostEqual(found["length_ratio"], 1, delta=0.01)
        self.assertLess(found["hausdorff"]["distance"], 0.02)
        for line in graph["polylines"]:
            self.assertEqual(line["kind"], "crease")
            self.assertGreater(line["support"], 10)
            self.assertNotIn(None, line["corners"])
            for angle in line["dihedral_deg"]:
                self.assertAlmostEqual(angle, 90, delta=10)

    def test_a_cylinder_has_two_closed_lines(self):
        graph = self.drawing(self.shape("cylinder"))
        self.assertEqual([(line["closed"], line["corners"]) for line in graph["polylines"]], [(True, [None, None])] * 2)
        self.assertEqual(graph["corners"], [])

    def test_nothing_sharp_is_an_empty_drawing(self):
        graph = self.drawing(self.shape("sphere"))
        self.assertEqual((graph["corners"], graph["polylines"]), ([], []))

    def test_several_drawings_at_once_and_the_report(self):
        source = self.shape("cube", 3000)
        names = ["a.dxf", "b.gpkg", "c.geojson", "d.json", "e.obj", "f.ply"]
        outputs = [argument for name in names for argument in ("-o", self.path(name))]
        report = run_json("lines", source, *outputs)
        self.assertEqual(report["outputs"], [str(self.path(name)) for name in names])
        self.assertEqual((report["points"], report["method"], report["corners"], report["polylines"], report["loose_ends"]),
                         (3000, "gauss", 8, 12, 0))
        self.assertAlmostEqual(report["length"], 12, delta=0.3)
        self.assertEqual(report["options"]["neighbors"], 16)
        self.assertEqual(set(report["timings_s"]), {"read", "neighborhoods", "smooth", "detect", "lines", "write", "total"})
        for name in names:
            self.assertGreater(self.path(name).stat().st_size, 100)

    def test_a_labelled_cloud_is_not_looked_at_again(self):
        source = self.shape("cube", 3000)
        self.done("detect", source, "-o", self.path("labels.ply"))
        fresh = self.drawing(source)
        report = run_json("lines", self.path("labels.ply"), "-o", self.path("found.json"))
        self.assertEqual(report["method"], None)
        self.assertTrue(any("labels of the input" in note for note in report["notes"]))
        self.assertEqual(json.loads(self.path("found.json").read_text(encoding="utf-8")), fresh)
        # Points of another program: a column feature, and nothing else.
        rows = [f"{x},{y},0,{int(y == 0.0)}" for x in range(40) for y in (0.0, 1.0, 2.0, -1.0, -2.0)]
        foreign = self.write("foreign.csv", "x,y,z,feature\n" + "\n".join(rows) + "\n")
        self.assertEqual(run_json("lines", foreign, "-o", self.path("foreign.json"), "--no-snap")["method"], None)
        # A method asks for labels of its own.
        self.assertEqual(run_json("lines", self.path("labels.ply"), "-o", self.path("found.json"), "--method", "gauss")["method"], "gauss")
        self.assertEqual(run_json("lines", self.path("labels.ply"), "-o", self.path("found.json"), "--sigma", "20")["options"]["sigma"], 20)

    def test_every_method_by_every_tracer(self):
        source = self.shape("cube", 2500)
        listing = run_json("methods")
        for method in listing["methods"]:
            self.done("detect", source, "--method", method["name"], "-o", self.path("labels.ply"))
            for tracer in (tracer["name"] for tracer in listing["tracers"]):
                with self.subTest(method=method["name"], trace=tracer):
                    report = run_json("lines", self.path("labels.ply"), "-o", self.path("out.json"), "--trace", tracer)
                    self.assertEqual(report["trace"], tracer)
                    self.assertAlmostEqual(report["length"], 12, delta=2.5)
                    if tracer == "walk":
                        self.assertEqual((report["corners"], report["polylines"], report["loose_ends"]), (8, 12, 0))

    def test_same_bytes_for_any_number_of_threads_and_every_time(self):
        source = self.shape("fandisk", 6000, "--noise", "0.05h")
        drawings = set()
        for threads in (1, 4, 4, 3):
            self.done("lines", source, "-o", self.path("out.json"), "-o", self.path("out.dxf"), "--threads", threads, "--fit", "0.3")
            drawings.add((self.path("out.json").read_bytes(), self.path("out.dxf").read_bytes()))
        self.assertEqual(len(drawings), 1)

    def test_far_from_the_origin_nothing_is_lost(self):
        self.shape("cube", 3000)
        self.done("detect", self.path("cube.ply"), "-o", self.path("near.csv"))
        rows = self.path("near.csv").read_text(encoding="utf-8").splitlines()
        far = [(32500000.0, 5980000.0, 500.0)[i] for i in range(3)]
        moved = ["x,y,z"]
        for row in rows[1:]:
            moved.append(",".join(repr(float(value) * 100 + far[i]) for i, value in enumerate(row.split(",")[:3])))
        graph = self.drawing(self.write("far.csv", "\n".join(moved) + "\n"))
        self.assertEqual(len(graph["corners"]), 8)
        for corner in graph["corners"]:
            near = [(c - f) / 100 for c, f in zip(corner["position"], far)]
            self.assertLess(min(math.dist(near, c) for c in CORNERS), 0.02)

    def test_resampled_and_fitted(self):
        source = self.shape("cylinder")
        fine = self.drawing(source, "--resample", "0.5")
        coarse = self.drawing(source, "--resample", "4")
        count = lambda graph: sum(len(line["vertices"]) for line in graph["polylines"])
        self.assertAlmostEqual(count(fine) / count(coarse), 8, delta=1)
        fitted = self.drawing(source, "--fit", "0.3")
        for line in fitted["polylines"]:
            self.assertEqual(line["curve"]["type"], "arc")
            self.assertEqual(line["curve"]["sweep_deg"], 360)
            self.assertAlmostEqual(line["curve"]["radius"], 1, delta=0.02)

    def test_mistakes_are_found_before_the_work(self):
        source = self.shape("cube", 100)
        before = self.names()
        for output, code, part in ((self.path("out.stl"), 2, ".dxf"), (self.path("no/out.dxf"), 3, "no/out.dxf"), (source, 2, "cube.ply")):
            self.expect_refusal(run("lines", source, "-o", output), code, part)
        out = self.path("out.dxf")
        self.expect_refusal(run("lines", source, "-o", out, "-o", self.path("./out.dxf")), 2, "out.dxf")
        self.expect_refusal(run("lines", source, "-o", out, "--resample", "-1"), 2, "--resample")
        self.expect_refusal(run("lines", source, "-o", out, "--fit", "nan"), 2, "--fit")
        self.expect_refusal(run("lines", source, "-o", out, "--method", "magic"), 2, "magic")
        self.expect_refusal(run("lines", source, "-o", out, "--trace", "magic"), 2, "magic", "walk")
        self.expect_refusal(run("lines", self.path("missing.ply"), "-o", out), 1, "missing.ply")
        self.expect_refusal(run("lines", source), 2, "output")
        self.assertEqual(self.names(), before)

    def test_hardly_any_points(self):
        for count in range(5):
            rows = "\n".join(f"{i},{i * i},0" for i in range(count))
            self.assertEqual(self.drawing(self.write("few.csv", f"x,y,z\n{rows}\n"))["polylines"], [])
        same = self.write("same.csv", "x,y,z\n" + "1,2,3\n" * 500)
        self.assertEqual(self.drawing(same)["polylines"], [])
        broken = self.write("nan.csv", "x,y,z\n" + "nan,2,3\n" * 50)
        self.assertEqual(self.drawing(broken)["polylines"], [])


if __name__ == "__main__":
    unittest.main()
