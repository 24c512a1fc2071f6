"""Files that are valid but odd are read to the last bit; clouds that are valid but degenerate are labelled."""
import math
import os
import random
import struct
import unittest

import cloud_files as files
from keenline_program import FolderTest, read_csv, run, run_json

POINTS = files.POINTS
LABELS = ["feature", "kind", "score", "clusters"]


class OddTest(FolderTest):
    def read(self, name, content, *options, **arguments):
        """What `info` says, and the columns of the CSV that `detect` makes."""
        path = self.write(name, content)
        info = run_json("info", path)
        result = run("detect", path, "-o", self.path("out.csv"), *options, **arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        columns = read_csv(self.path("out.csv"))
        self.assertEqual(info["points"], len(columns["x"]))
        self.assertEqual(list(columns)[-4:], LABELS)
        return info, columns

    def expect_points(self, name, content, points=POINTS, attributes=None, **arguments):
        """Exactly these points and these attributes, in CSV and by way of PLY."""
        info, columns = self.read(name, content, **arguments)
        self.assertEqual(list(zip(columns["x"], columns["y"], columns["z"])), [tuple(map(float, p)) for p in points])
        self.assertEqual({key: values for key, values in list(columns.items())[3:-4]}, attributes or {})
        self.assertEqual(run("detect", self.path(name), "-o", self.path("out.ply"), **arguments).returncode, 0)
        self.assertEqual(run("detect", self.path("out.ply"), "-o", self.path("again.csv")).returncode, 0)
        again = read_csv(self.path("again.csv"))
        self.assertEqual({key: again[key] for key in columns}, columns)
        return info


class Texts(OddTest):
    def test_every_notation_of_rows(self):
        rows = files.xyz().decode()
        names = "x,y,z\n" + rows.replace(" ", ",")
        texts = [rows, rows[:-1], rows.replace("\n", "\r\n"), rows.replace("\n", "\r"), "\ufeff" + rows, rows.replace(" ", "\t"), rows.replace(" ", " \t  "),
                 rows.replace("\n", "  \n"), "  " + rows.replace("\n", "\n   "), rows.replace("\n", "\n\n\n"), "# comment\n" + rows, "// comment\n" + rows,
                 rows.replace("\n", " # comment\n"), rows + "# the end", "4\n" + rows, "x y z\n" + rows, "X Y Z\n" + rows, "//X Y Z\n" + rows, "# x y z\n" + rows,
                 names, names.replace(",", ";"), names.replace(",", "\t"), names.replace(",", " , "), names.replace("x,y,z", '"x","y","z"'),
                 names.replace("\n", "\r\n"), "\ufeff" + names, names.replace("x,y,z", "Easting,Northing,Height"), rows.replace(" ", ",").replace("\n", ",\n"),
                 '"' + rows.replace(" ", '","').replace("\n", '"\n"')[:-1], rows.replace("1.5", "+1.5"), rows.replace("1.5", "15e-1"), rows.replace("1.5", "0.15E+1"),
                 rows.replace("1.5", "1.50000000000000000000000000000000000"), rows.replace("0.25", ".25"), rows.replace("3.0", "3."), rows.replace("3.0", "003"),
                 rows.replace("0.5", "0." + "0" * 400 + "5e400"), rows.replace("\n", " " * 100_000 + "\n")]
        for number, text in enumerate(texts):
            for extension in ("xyz", "CSV"):
                with self.subTest(text=text[:200], extension=extension):
                    self.expect_points(f"{number}.{extension}", text)

    def test_columns_in_any_order_with_attributes(self):
        text = "intensity;Z;X;Y;class of point;ratio\n7;3;1;2;-5;0.5\n8;6;4;5;9007199254740993;nan\n"
        info = run_json("info", self.write("a.csv", text))
        self.assertEqual([(a["name"], a["type"]) for a in info["attributes"]], [("intensity", "int32"), ("class of point", "int64"), ("ratio", "float64")])
        self.assertEqual(info["bounding_box"], {"min": [1, 2, 3], "max": [4, 5, 6]})
        self.assertEqual(run("detect", self.path("a.csv"), "-o", self.path("b.csv")).returncode, 0)
        self.assertIn("9007199254740993", self.path("b.csv").read_text())

    def test_numbers_keep_every_bit(self):
        generator = random.Random(1)
        words = [struct.unpack("<d", generator.randbytes(8))[0] for _ in range(3000)]
        words = [word for word in words if math.isfinite(word)] + [-0.0, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 0.1, 1 / 3, 2 ** 53 + 2.0]
        points = list(zip(words[::3], words[1::3], words[2::3]))
        info, columns = self.read("a.xyz", files.xyz(points))
        for axis, name in enumerate("xyz"):
            self.assertEqual([struct.pack("<d", c) for c in columns[name]], [struct.pack("<d", p[axis]) for p in points])

    def test_the_locale_makes_no_difference(self):
        for locale in ("de_DE.UTF-8", "de_DE", "C", "tr_TR.UTF-8"):
            environment = {**os.environ, "LC_ALL": locale, "LANG": locale}
            self.expect_points("a.csv", "x,y,z\n1.5,2.25,1e3\n", [(1.5, 2.25, 1000)], env=environment)
            self.expect_refusal(run("info", self.write("b.xyz", "1,5 2,5 3,5\n"), env=environment), 1, "decimal point")

    def test_awkward_names(self):
        names = ["a b", "a,b", 'say "x"', "caf\u00e9", "\u4e2d\u6587", "a#b", "a//b", "x_2", "n" * 5000, "feature", "Kind", "9", "e5", "'q'", "<b>"]
        header = ",".join(["x", "y", "z", *('"' + name.replace('"', '""') + '"' for name in names)])
        text = header + "\n" + ",".join(map(str, range(3 + len(names)))) + "\n"
        info = run_json("info", self.write("a.csv", text))
        self.assertEqual([a["name"] for a in info["attributes"]], names)
        wanted = [name for name in names if name != "feature"]
        for first, second in (("b.csv", "c.csv"), ("d.ply", "e.csv")):
            self.assertEqual(run("detect", self.path("a.csv"), "-o", self.path(first)).returncode, 0)
            found = [a["name"] for a in run_json("info", self.path(first))["attributes"]]
            self.assertEqual([name.replace("_", " ") for name in found if name not in LABELS], [name.replace("_", " ") for name in wanted])
            self.assertEqual(run("detect", self.path(first), "-o", self.path(second)).returncode, 0)
            self.assertEqual(self.path(second).read_text().splitlines()[1].split(",")[:3], ["0", "1", "2"])

    def test_very_many_columns(self):
        count = 70_000
        text = ",".join(["x", "y", "z", *(f"attribute_{i}" for i in range(count))]) + "\n" + ",".join(map(str, range(count + 3))) + "\n"
        source = self.write("a.csv", text)
        for name in ("b.csv", "b.ply"):
            self.assertEqual(run("detect", source, "-o", self.path(name)).returncode, 0)
            self.assertEqual(len(run_json("info", self.path(name))["attributes"]), count + 4)


class Plys(OddTest):
    AXES = ["property double x", "property double y", "property double z"]

    def test_every_encoding_and_scalar(self):
        for form in ("ascii", "little", "big"):
            for scalar in ("float", "double"):
                self.expect_points("a.PLY", files.ply(form, scalar=scalar), attributes={"red": [0, 1, 2, 3]})
        whole = [(1, 2, 3), (-4, 5, -6)]
        for scalar in ("char", "short", "int", "int64"):
            for form in ("little", "big"):
                self.expect_points("b.ply", files.ply(form, whole, scalar), whole, {"red": [0, 1]})

    def test_order_and_unknown_parts(self):
        body = "7 8\n1 9\n" + "2 5 6 3 1 2\n1 4 33 23 13\n" + "3 0 1 0\n0\n"
        header = files.ply_header("comment first", "obj_info second", "element camera 2", "property int a", "property uchar b", "comment", "element vertex 2",
                                  "property list uchar short labels", "property double z", "property double x", "property float y",
                                  "element empty 0", "property int a", "element nothing 0", "element face 2", "property list int uint vertex_index")
        info = run_json("info", self.write("a.ply", header + body))
        self.assertEqual([(t["name"], t["rows"]) for t in info["tables"]][:2], [("camera", 2), ("empty", 0)])
        self.assertIn("obj_info second", info["comments"])
        self.assertEqual(info["bounding_box"], {"min": [1, 2, 3], "max": [23, 13, 33]})
        self.assertEqual(run("detect", self.path("a.ply"), "-o", self.path("b.ply")).returncode, 0)
        again = run_json("info", self.path("b.ply"))
        self.assertEqual(again["tables"], info["tables"])
        self.assertEqual([a["name"] for a in again["attributes"]], ["labels", *LABELS])
        self.assertEqual(again["coordinate_types"], info["coordinate_types"])

    def test_odd_headers(self):
        plain = files.ply("ascii").decode()
        for text in [plain.replace("\n", "\r\n"), plain.replace("\n", "\r"), "\ufeff" + plain, plain.replace("element vertex", "element   vertex"), plain + "\n\n \n",
                     plain.replace("format", "comment early\nformat"), plain.replace("float", "float32"), plain.replace("end_header", "end_header "),
                     plain.replace("comment", "comment"), plain[:-1], plain.replace("end_header\n", "end_header\n\n"), plain.replace("property float x", "comment \xff\x01\x1b\nproperty float x")]:
            with self.subTest(text=text):
                self.expect_points("a.ply", text, attributes={"red": [0, 1, 2, 3]})
        binary = files.ply("little")
        for content in [binary.replace(b"\n", b"\r\n", 7), binary + b"\0" * 7, binary + b"\n"]:
            self.expect_points("b.ply", content, attributes={"red": [0, 1, 2, 3]})

    def test_64_bit_integers(self):
        header = files.ply_header("element vertex 2", *self.AXES, "property int64 a", "property uint64 b")
        info = run_json("info", self.write("a.ply", header + "0 0 0 9007199254740993 18446744073709551615\n1 1 1 -9223372036854775808 0\n"))
        self.assertEqual([a["type"] for a in info["attributes"]], ["int64", "uint64"])
        self.assertEqual(run("detect", self.path("a.ply"), "-o", self.path("b.csv")).returncode, 0)
        self.assertIn("0,0,0,9007199254740993,18446744073709551615,", self.path("b.csv").read_text())
        self.assertIn("1,1,1,-9223372036854775808,0,", self.path("b.csv").read_text())
        self.assertIn("rounded", run("detect", self.path("a.ply"), "-o", self.path("b.ply")).stderr)

    def test_comments_cannot_forge_a_header(self):
        # An OBJ comment with a lone carriage return, a LAS text with line ends: neither may become a line of PLY.
        forged = "harmless\rend_header\relement vertex 1\x0bproperty int q"
        sources = [("a.obj", f"#\n# {forged}\n".encode() + files.obj(faces=())),
                   ("a.las", files.las(records=[(b"LASF_Projection", 2112, forged.replace("\r", "\n").encode() + b"\0")])),
                   ("a.pcd", f"#\n# {forged}\n".encode() + files.pcd())]
        for name, content in sources:
            with self.subTest(name=name):
                self.assertEqual(run("detect", self.write(name, content), "-o", self.path("out.ply")).returncode, 0)
                info = run_json("info", self.path("out.ply"))
                self.assertEqual(info["points"], 4)
                self.assertNotIn("q", [a["name"] for a in info["attributes"]])


class Others(OddTest):
    def test_pcd(self):
        ascii_file = files.pcd().decode()
        for text in [ascii_file, ascii_file.replace("\n", "\r\n"), ascii_file.replace("VERSION 0.7", "VERSION .7"), ascii_file.replace("FIELDS", "COLUMNS"),
                     "# .PCD v0.7 - Point Cloud Data file format\n" + ascii_file, ascii_file.replace("WIDTH 4\nHEIGHT 1", "WIDTH 2\nHEIGHT 2"),
                     *(files.pcd(leave_out=(key,)).decode() for key in ("VERSION", "COUNT", "HEIGHT", "VIEWPOINT", "POINTS")),
                     files.pcd(leave_out=("WIDTH", "HEIGHT")).decode(), ascii_file[:-1], ascii_file + "\n\n"]:
            with self.subTest(text=text):
                self.expect_points("a.pcd", text)
        for data in ("binary", "binary_compressed"):
            self.expect_points("b.PCD", files.pcd(data))
        self.expect_points("c.pcd", files.pcd("binary") + bytes(4096))
        lists = files.pcd_header("x y z f _", "4 4 4 2 1", "F F F I U", "1 1 1 3 5", 1, 1, 1, "binary").encode() + struct.pack("<3f3h5x", 1, 2, 3, -1, 0, 7)
        self.expect_points("d.pcd", lists, [(1, 2, 3)], {"f_0": [-1], "f_1": [0], "f_2": [7]})
        repeated = struct.pack("<2I", 5, 48) + b"\x00\0\xe0\x26\x00"  # a zero, then the same 47 times
        self.expect_points("e.pcd", files.pcd_header(data="binary_compressed").encode() + repeated, [(0, 0, 0)] * 4)

    def test_las(self):
        for minor in range(5):
            for point_format in range(11 if minor == 4 else 6):
                info, columns = self.read("a.las", files.las(minor, point_format))
                self.assertEqual(list(zip(columns["x"], columns["y"], columns["z"])), POINTS, (minor, point_format))
        legacy_only = files.las(4, 0, changes=dict(count=0))
        for content in [legacy_only, files.las(4, 0), files.las(4, 6), files.las(2, 0) + b"\0", files.las(3, 0, changes=dict(waveforms=2 ** 63)), files.las(scale=-0.25)]:
            self.assertEqual(self.read("b.LAS", content)[1]["x"], [p[0] for p in POINTS])
        far = [tuple(4.5e6 + 0.001 * c for c in p) for p in POINTS]
        columns = self.read("c.las", files.las(points=far, scale=0.00025, offset=4.5e6))[1]
        for axis, name in enumerate("xyz"):
            for value, point in zip(columns[name], far):
                self.assertAlmostEqual(value, point[axis], delta=1.3e-4)

    def test_off_obj_stl(self):
        off = files.off().decode()
        for text in [off, off.replace("\n", "\r\n"), off.replace("OFF\n", "OFF "), off.replace("OFF\n", "# comment\n\nOFF # more\n"), off.replace("OFF\n", ""), off.replace(" 0\n", "\n", 1),
                     off.replace("3 0 1 2", "3 0 1 2 0.5 0.5 0.5"), off.replace("3 0 1 2", "3 0 1 2 255 0 0 1")]:
            with self.subTest(text=text):
                self.assertEqual(self.read("a.OFF", text)[1]["z"], [p[2] for p in POINTS])
        obj = files.obj().decode()
        for text in [obj, obj.replace("\n", "\r\n"), obj.replace("f 1 2 3", "f -1 -2 -3"), obj.replace("f 1 2 3", "f 1/1 2//2 3/3/3"), "mtllib a.mtl\no part\ng a b\ns off\n" + obj,
                     "f 1 2 3\n" + obj, obj.replace("v 1.5 0.0", "v 1.5 \\\n0.0"), obj.replace("v 1.5", "\tv   1.5"), obj + "l 1 2\np 1\nvn 0 0 1\nvt 0 0\nusemtl x\n"]:
            with self.subTest(text=text):
                self.assertEqual(self.read("a.OBJ", text)[1]["z"], [p[2] for p in POINTS])
        self.expect_points("b.obj", "v 1 2 3 0.5 0 1\nv 4 5 6 1 0 0\n", [(1, 2, 3), (4, 5, 6)], {"red": [0.5, 1], "green": [0, 0], "blue": [1, 0]})
        stl = files.stl_ascii().decode()
        titles = [b"solid part", b"OFF", b"VERSION 0.7", b"ply", b"\xff\xfe", b"solid\nfacet normal 0 0 1\n", b""]
        texts = [stl, stl.replace("\n", "\r\n"), stl.upper(), stl.replace("\n", "\n\n   "), stl.replace(" part", ""), stl + stl]
        for content in [*map(str.encode, texts), *(files.stl_binary(title=title) for title in titles)]:
            with self.subTest(content=content):
                info, columns = self.read("a.STL", content)
                self.assertEqual(info["format"], "stl")
                self.assertEqual(list(zip(columns["x"], columns["y"], columns["z"])), POINTS)
        self.assertEqual(run_json("info", self.write("b.stl", files.stl_binary([])))["points"], 0)

    def test_content_wins_over_the_name(self):
        for name, content in files.samples().items():
            wanted = {"csv": "xyz", "txt": "xyz"}.get(name[-3:], name[-3:])
            if wanted in ("obj", "xyz"):
                continue  # these have no signature
            for extension in ("ply", "las", "xyz", "obj", "jpg"):
                self.assertEqual(run_json("info", self.write(f"a.{extension}", content))["format"], wanted, (name, extension))
        for name in ("a", "a.b.ply", " .ply", "\u00fc\U0001f600.ply", "-.ply", "a\nb.ply", "%s.ply", "'$(x)`.ply"):
            self.assertEqual(run_json("info", self.write(name, files.ply()))["points"], 4)


class Degenerate(OddTest):
    def kinds(self, points, *options):
        """Counts per kind; the labels are the same for 1 and 8 threads."""
        source = self.write("cloud.xyz", files.xyz(points) if points else "x y z\n")
        outputs = []
        for threads in ("1", "8"):
            report = run_json("detect", source, "-o", self.path("out.csv"), "--threads", threads, *options)
            outputs.append(self.path("out.csv").read_bytes())
        self.assertEqual(outputs[0], outputs[1])
        self.assertEqual(report["points"], len(points))
        return {kind: count for kind, count in report["counts"].items() if count}

    def test_few_points(self):
        generator = random.Random(2)
        points = [tuple(generator.random() for _ in range(3)) for _ in range(30)]
        for count in (0, 1, 2, 3, 15, 16):
            self.assertEqual(self.kinds(points[:count]), {"undecided": count} if count else {})
        for count in (17, 18):
            self.assertNotIn("undecided", self.kinds(points[:count]))
        for count in (3, 4):
            self.assertEqual(self.kinds(points[:count], "--neighbors", 3).get("undecided", 0), 3 if count == 3 else 0)

    def test_points_that_coincide(self):
        self.assertEqual(self.kinds([(1.5, 2.5, -3.5)] * 200_000), {"undecided": 200_000})
        self.assertEqual(self.kinds([(0.0, 0.0, 0.0), (-0.0, 0.0, -0.0)] * 20), {"undecided": 40})
        self.assertEqual(self.kinds([(float(i % 2), 0.0, 0.0) for i in range(100_000)]), {"flat": 100_000})

    def test_lines_and_planes(self):
        for factor in (1.0, 1e-300, 1e300, 5e-324):
            self.assertEqual(self.kinds([(i * factor, 0.0, 0.0) for i in range(200)]), {"flat": 200}, factor)
            self.assertEqual(self.kinds([(i % 20 * factor, i // 20 * factor, 0.0) for i in range(400)]), {"flat": 324, "border": 76}, factor)
        self.assertEqual(self.kinds([(i / 7, i / 3, i / 11) for i in range(200)]), {"flat": 200})

    def test_points_that_are_not_finite(self):
        nan, infinity = float("nan"), float("inf")
        self.assertEqual(self.kinds([(nan, nan, nan)] * 40), {"undecided": 40})
        self.assertEqual(self.kinds([(infinity, 0.0, -infinity)] * 40), {"undecided": 40})
        plane = [(float(i % 20), float(i // 20), 0.0) for i in range(400)]
        mixed = [p for point in plane for p in (point, (nan, point[1], infinity))]
        self.assertEqual(self.kinds(mixed), {"flat": 324, "border": 76, "undecided": 400})

    def test_every_magnitude(self):
        generator = random.Random(3)
        def cube(size, count=1500, center=0.0):
            points = []
            for _ in range(count):
                p = [generator.uniform(-1, 1) * size for _ in range(3)]
                p[generator.randrange(3)] = size * generator.choice((-1, 1))
                points.append((p[0] + center, p[1], p[2]))
            return points
        plain = cube(1.0)
        expected = self.kinds(plain)
        self.assertGreater(expected["edge"], 100)
        for scale in (2.0 ** -600, 2.0 ** 600, 2.0 ** 1000, 2.0 ** -960):
            self.assertEqual(self.kinds([tuple(c * scale for c in p) for p in plain]), expected, scale)
        for outlier in (1e30, 1e308, -1e308):
            found = self.kinds(plain + [(outlier, outlier, outlier)])
            self.assertEqual(sum(found.values()), len(plain) + 1)
            self.assertAlmostEqual(found["edge"], expected["edge"], delta=1)
        # Two far apart: each is labelled as if it were alone, save for points whose coordinates the distance rounds.
        shifted = [(1e200, y, z) for _, y, z in plain]
        self.assertGreaterEqual(self.kinds(plain + shifted)["edge"], expected["edge"])
        tiny = [tuple(c * 2.0 ** -660 for c in p) for p in plain]
        for order in (tiny + plain, plain + tiny):
            self.assertEqual(sum(self.kinds(order).values()), 3000)
        spread = [tuple(math.copysign(10 ** generator.uniform(-200, 308), generator.uniform(-1, 1)) for _ in range(3)) for _ in range(3000)]
        self.assertEqual(sum(self.kinds(spread).values()), 3000)

    def test_grids_full_of_ties(self):
        self.assertEqual(sum(self.kinds([(i % 12, i // 12 % 12, i // 144) for i in range(1728)]).values()), 1728)


if __name__ == "__main__":
    unittest.main()
