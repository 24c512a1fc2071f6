"""Drawings: what other programs read in them, keenline synth --lines, keenline evaluate --lines. Needs ezdxf."""
import json
import math
import os
import sqlite3
import struct
import subprocess
import unittest

import ezdxf

from keenline_program import FolderTest, run, run_json

CONVERT = os.environ["KEENLINE_CONVERT_GRAPH"]
EXTENSIONS = ("dxf", "gpkg", "geojson", "json", "obj", "ply")

# Georeferenced, with millimetres, and with digits that only a double holds.
FAR = [[32512345.678, 5987654.321, 123.456], [32512345.679, 5987654.322, 123.457], [32512399.0001, 5987655.0, -0.1]]
FAR_GRAPH = {"corners": [{"position": FAR[0], "residual": 0.001}, {"position": FAR[2]}],
             "polylines": [{"vertices": FAR, "corners": [0, 1], "dihedral_deg": [90, 90, 93], "support": 17},
                           {"vertices": FAR, "closed": True, "kind": "border"}]}


def points(rows):
    return [tuple(row) for row in rows]


class LinesTest(FolderTest):
    def convert(self, graph, *extensions):
        """Paths of the graph in these formats."""
        source = self.path("source.json")
        source.write_text(json.dumps(graph), encoding="utf-8")
        paths = [self.path("out." + extension) for extension in extensions]
        subprocess.run([CONVERT, source, *paths], check=True)
        return paths

    def dxf(self, graph):
        """The drawing as ezdxf reads it, with nothing to complain of."""
        document = ezdxf.readfile(self.convert(graph, "dxf")[0])
        auditor = document.audit()
        self.assertEqual([str(e.message) for e in auditor.errors + auditor.fixes], [])
        self.assertEqual(document.dxfversion, "AC1015")
        return document

    def curve(self, **curve):
        (entity,) = self.dxf({"corners": [], "polylines": [{"vertices": [[0, 0, 0], [1, 0, 0]], "curve": curve}]}).modelspace()
        return entity


class Dxf(LinesTest):
    def test_polylines_and_corners_are_exact_and_in_their_layers(self):
        document = self.dxf(FAR_GRAPH)
        lines = document.modelspace().query("POLYLINE")
        self.assertEqual([line.dxf.layer for line in lines], ["CREASES", "BORDERS"])
        self.assertEqual([line.is_3d_polyline for line in lines], [True, True])
        self.assertEqual([line.is_closed for line in lines], [False, True])
        for line in lines:
            self.assertEqual([tuple(p) for p in line.points()], points(FAR))
        corners = document.modelspace().query("POINT")
        self.assertEqual([tuple(p.dxf.location) for p in corners], points([FAR[0], FAR[2]]))
        self.assertEqual({p.dxf.layer for p in corners}, {"CORNERS"})
        self.assertEqual(tuple(document.header["$EXTMIN"]), tuple(min(p[i] for p in FAR) for i in range(3)))
        self.assertEqual(tuple(document.header["$EXTMAX"]), tuple(max(p[i] for p in FAR) for i in range(3)))
        self.assertEqual(document.header["$INSUNITS"], 0)

    def test_an_empty_drawing_is_one(self):
        self.assertEqual(len(self.dxf({"corners": [], "polylines": []}).modelspace()), 0)

    def test_arcs_lie_where_they_were_fitted_however_they_are_tilted(self):
        s = math.sqrt(0.5)
        frames = (([0, 0, 1], [0, -1, 0]), ([0, 0, -1], [1, 0, 0]), ([1, 0, 0], [0, 0, 1]), ([0, s, s], [1, 0, 0]),
                  ([0, s, -s], [0, s, s]), ([0.6, 0, -0.8], [0.8, 0, 0.6]))
        for normal, x_axis in frames:
            y_axis = [normal[1] * x_axis[2] - normal[2] * x_axis[1], normal[2] * x_axis[0] - normal[0] * x_axis[2],
                      normal[0] * x_axis[1] - normal[1] * x_axis[0]]
            center, radius, sweep = [10, 20, 30], 2.5, 200
            arc = self.curve(type="arc", center=center, normal=normal, x_axis=x_axis, radius=radius, sweep_deg=sweep)
            self.assertEqual(arc.dxftype(), "ARC")
            turn = math.radians(sweep)
            start = [c + radius * x for c, x in zip(center, x_axis)]
            end = [c + radius * (math.cos(turn) * x + math.sin(turn) * y) for c, x, y in zip(center, x_axis, y_axis)]
            for found, expected in ((arc.start_point, start), (arc.end_point, end), (arc.ocs().to_wcs(arc.dxf.center), center)):
                self.assertLess(max(abs(f - e) for f, e in zip(found, expected)), 1e-12)
            # Half way round tells the arc from its other half.
            (middle,) = arc.vertices([arc.dxf.start_angle + sweep / 2])
            half = [c + radius * (math.cos(turn / 2) * x + math.sin(turn / 2) * y) for c, x, y in zip(center, x_axis, y_axis)]
            self.assertLess(max(abs(f - e) for f, e in zip(middle, half)), 1e-12)
            circle = self.curve(type="arc", center=center, normal=normal, x_axis=x_axis, radius=radius, sweep_deg=360)
            self.assertEqual((circle.dxftype(), circle.dxf.radius), ("CIRCLE", radius))
            self.assertLess(max(abs(f - e) for f, e in zip(circle.ocs().to_wcs(circle.dxf.center), center)), 1e-12)

    def test_lines_and_splines_keep_their_points(self):
        line = self.curve(type="line", start=FAR[0], end=FAR[2])
        self.assertEqual((line.dxftype(), tuple(line.dxf.start), tuple(line.dxf.end)), ("LINE", tuple(FAR[0]), tuple(FAR[2])))
        controls, knots = FAR + [[32512400, 5987700, 0.5], [32512401, 5987700, 0.5]], [0, 0, 0, 0, 0.3, 1, 1, 1, 1]
        spline = self.curve(type="spline", control_points=controls, knots=knots)
        self.assertEqual((spline.dxftype(), spline.dxf.degree, list(spline.knots)), ("SPLINE", 3, knots))
        self.assertEqual([tuple(p) for p in spline.control_points], points(controls))


class GeoPackage(LinesTest):
    def read(self, graph):
        database = sqlite3.connect(self.convert(graph, "gpkg")[0])
        self.addCleanup(database.close)
        return database

    def geometry(self, blob):
        """The points of a geometry, read by the GeoPackage and WKB specifications."""
        magic, version, flags, srs_id = struct.unpack("<2sBBi", blob[:8])
        self.assertEqual((magic, version, flags), (b"GP", 0, 0b101))
        envelope = struct.unpack("<6d", blob[8:56])
        order, kind = struct.unpack("<BI", blob[56:61])
        self.assertEqual(order, 1)
        count, start = (struct.unpack("<I", blob[61:65])[0], 65) if kind == 1002 else (1, 61)
        self.assertIn(kind, (1001, 1002))
        rows = [struct.unpack_from("<3d", blob, start + 24 * i) for i in range(count)]
        self.assertEqual(len(blob), start + 24 * count)
        for axis in range(3):
            self.assertEqual(envelope[2 * axis:2 * axis + 2], (min(r[axis] for r in rows), max(r[axis] for r in rows)))
        return srs_id, rows

    def test_geometries_are_exact(self):
        database = self.read(FAR_GRAPH)
        lines = database.execute("SELECT geom, kind, closed, support, dihedral_deg FROM feature_lines ORDER BY fid").fetchall()
        self.assertEqual([row[1:] for row in lines], [("crease", 0, 17, 91.0), ("border", 1, 0, None)])
        self.assertEqual(self.geometry(lines[0][0]), (-1, points(FAR)))
        self.assertEqual(self.geometry(lines[1][0]), (-1, points(FAR + FAR[:1])))
        corners = database.execute("SELECT geom, residual FROM feature_corners ORDER BY fid").fetchall()
        self.assertEqual([(self.geometry(geom)[1], residual) for geom, residual in corners],
                         [(points(FAR[:1]), 0.001), (points(FAR[2:]), None)])
        extent = database.execute("SELECT min_x, min_y, max_x, max_y FROM gpkg_contents WHERE table_name='feature_lines'").fetchone()
        self.assertEqual(extent, (FAR[0][0], FAR[0][1], FAR[2][0], FAR[2][1]))

    def test_the_file_is_sound_with_lines_and_without(self):
        for graph in (FAR_GRAPH, {"crs": "EPSG:25832", "corners": [], "polylines": []}):
            database = self.read(graph)
            self.assertEqual(database.execute("PRAGMA integrity_check").fetchone(), ("ok",))
            self.assertEqual(database.execute("PRAGMA foreign_key_check").fetchall(), [])
            self.assertEqual(database.execute("PRAGMA application_id").fetchone(), (int.from_bytes(b"GPKG", "big"),))


class Synth(LinesTest):
    def synth(self, shape, *extensions, points=2000):
        lines = [self.path(f"{shape}.{extension}") for extension in extensions]
        arguments = [x for line in lines for x in ("--lines", line)]
        report = run_json("synth", shape, "-o", self.path(f"{shape}-points.ply"), "--points", points, *arguments)
        self.assertEqual(report["lines"], [str(line) for line in lines])
        return lines

    def test_every_format_is_written_at_once_and_the_same_again(self):
        first = [path.read_bytes() for path in self.synth("fandisk", *EXTENSIONS)]
        self.assertEqual(len(os.listdir(self.folder)), 1 + len(EXTENSIONS))
        again = [path.read_bytes() for path in self.synth("fandisk", *EXTENSIONS)]
        for extension, one, other in zip(EXTENSIONS, first, again):
            self.assertTrue(one == other, extension)

    def test_the_graph_is_as_promised(self):
        (path,) = self.synth("cube", "json")
        graph = json.loads(path.read_text(encoding="utf-8"))
        self.assertEqual((len(graph["corners"]), len(graph["polylines"])), (8, 12))
        for line in graph["polylines"]:
            self.assertEqual((line["closed"], line["kind"], line["length"]), (False, "crease", 1))
            self.assertEqual(line["vertices"], [graph["corners"][i]["position"] for i in line["corners"]])

    def test_a_shape_without_features_gives_empty_drawings(self):
        for path in self.synth("sphere", *EXTENSIONS):
            self.assertGreater(path.stat().st_size, 0)
        self.assertEqual(json.loads(self.path("sphere.geojson").read_text(encoding="utf-8"))["features"], [])

    def test_what_cannot_be_written_leaves_nothing(self):
        out = self.path("a.ply")
        for lines, code, words in ((self.path("a.dwg"), 2, ".dxf, .gpkg, .geojson, .json, .obj"),
                                   (self.path("none/a.dxf"), 3, "cannot be written"), (out, 2, "named twice")):
            result = run("synth", "cube", "-o", out, "--lines", lines, "--points", 100)
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertIn(words, result.stderr)
            self.assertEqual(os.listdir(self.folder), [])

    @unittest.skipUnless(os.path.exists("/dev/full"), "needs /dev/full")
    def test_a_summary_that_cannot_be_told_leaves_nothing(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = run("synth", "cube", "-o", self.path("a.ply"), "--lines", self.path("a.dxf"), stdout=full)
        self.assertEqual(result.returncode, 3)
        self.assertEqual(os.listdir(self.folder), [])


class Evaluate(LinesTest):
    def write(self, name, graph):
        path = self.path(name)
        path.write_text(json.dumps(graph), encoding="utf-8")
        return path

    def setUp(self):
        super().setUp()
        self.truth = self.write("truth.json", {"corners": [{"position": [0, 0, 0]}, {"position": [10, 0, 0]}],
                                               "polylines": [{"vertices": [[0, 0, 0], [10, 0, 0]], "corners": [0, 1]}]})
        self.found = self.write("found.json", {"corners": [{"position": [0, 3, 4]}],
                                               "polylines": [{"vertices": [[0, 3, 4], [10, 3, 4]], "corners": [0, None]}]})

    def test_json_has_every_measure_in_every_unit(self):
        report = run_json("evaluate", self.found, self.truth, "--lines", self.truth, "--spacing", 0.5)
        self.assertEqual((report["spacing"], report["truth"]), (0.5, str(self.truth)))
        far, same = report["files"]
        self.assertEqual(far["found"], {"length": 10, "corners": 1, "polylines": 1, "loops": 0, "loose_ends": 1})
        self.assertEqual((far["length_ratio"], far["missed_corners"], far["invented_corners"]), (1, 2, 1))
        self.assertEqual(far["hausdorff"], {"distance": 5, "in_diagonals": 0.5, "in_spacings": 10})
        self.assertAlmostEqual(far["chamfer"]["in_spacings"], 10)
        self.assertAlmostEqual(far["corner_mean"]["distance"], (5 + 125 ** 0.5) / 2)
        self.assertLess(same["hausdorff"]["distance"], 1e-14)

    def test_the_table_is_for_people(self):
        result = run("evaluate", self.found, "--lines", self.truth)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"Hausdorff +5 +0\.500000\n")
        self.assertNotIn("/ h", result.stdout)

    def test_nothing_found_is_infinitely_far(self):
        nothing = self.write("nothing.json", {"corners": [], "polylines": []})
        report = run_json("evaluate", nothing, "--lines", self.truth)["files"][0]
        self.assertEqual((report["length_ratio"], report["hausdorff"]["distance"]), (0, None))

    def test_bad_input_and_usage_have_their_codes(self):
        broken = self.write("broken.json", {"corners": [], "polylines": [{"vertices": [[0, 0]]}]})
        result = run("evaluate", broken, "--lines", self.truth)
        self.assertEqual(result.returncode, 1)
        self.assertIn("broken.json: polylines[0].vertices[0]: found an array of 2, expected an array of 3", result.stderr)
        for arguments in (("--lines", self.truth, "--spacing", 0), ("--spacing", 1), ("--lines", self.truth, "--truth", self.truth)):
            self.assertEqual(run("evaluate", self.found, *arguments).returncode, 2, arguments)


if __name__ == "__main__":
    unittest.main()
