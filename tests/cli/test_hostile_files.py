"""Files that are malformed, cut, lying or not what their name says: one line, exit 1, no output, little memory."""
import concurrent.futures
import os
import re
import resource
import struct
import unittest

import cloud_files as files
from keenline_program import FolderTest, run, run_json

ASAN = "asan" in os.environ.get("KEENLINE_BUILD_DIR", "")
LIMIT_S = 100 if ASAN else 10
COUNTS = ["-1", "2147483648", "4294967306", "9223372036854775808", "1e30", "99999999999999999999999", "many", "",
          "nan", "0x4", "4.5", "4,0", "\uff14", "3", "5"]
NOT_NUMBERS = ["1e", "e5", "1.2.3", "--5", "+-5", "0x10", "1_000", "\uff11", "\u0661", "1,000.5", "1,5", "five", "1e999",
               "1d5", "0b1", "1f", "1;", "$1", "..", "-", "+", "\u22121", "1\u00a0", "infinit", "nan(", "NULL"]
EXTENSIONS = ["ply", "pcd", "las", "off", "obj", "stl", "xyz", "txt", "csv"]


def setUpModule():
    # The whole test runs under it, so that every program does: what a header claims must never be allocated.
    if not ASAN:
        resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, resource.getrlimit(resource.RLIMIT_DATA)[1]))


class HostileTest(FolderTest):
    def examine(self, name, content, number):
        """Detects on a file of its own; returns the result and the output's text."""
        path = self.write(f"{number}-{name}", content)
        output = self.path(f"{number}.csv")
        result = run("detect", path, "-o", output, timeout=LIMIT_S)
        text = output.read_text(encoding="utf-8") if output.exists() else None
        for left in (path, output):
            left.unlink(missing_ok=True)
        return result, text

    def examine_all(self, cases):
        """`cases`: (name, content, …); yields (case, result, output) in order."""
        cases = list(cases)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            results = pool.map(lambda job: self.examine(job[1][0], job[1][1], job[0]), enumerate(cases))
            for case, (result, output) in zip(cases, results):
                yield case, result, output

    def require_refused(self, cases):
        """`cases`: (name, content, part of the message …). Every message tells what was found and what was expected."""
        for (name, content, *parts), result, output in self.examine_all(cases):
            with self.subTest(name=name, content=content[:400]):
                self.expect_refusal(result, 1, name, "found ", "expected ", *parts)
                self.assertRegex(result.stderr, r": (line|byte) \d+: found |: found ")
                self.assertIsNone(output)
        self.assertEqual(self.names(), [])

    def require_consistent(self, name, result, output):
        """Refused in one line, or read and then written with as many rows as were read."""
        if result.returncode == 1:
            self.expect_refusal(result, 1, name)
            self.assertIsNone(output)
        else:
            self.assertEqual(result.returncode, 0, result.stderr)
            points = int(re.search(r": ([\d,]+) points", result.stdout)[1].replace(",", ""))
            self.assertEqual(output.count("\n"), points + 1)


class Ply(HostileTest):
    AXES = ["property float x", "property float y", "property float z"]
    ROWS = "0 0 0\n1 1 1\n2 2 2\n3 3 3\n"

    def header(self, *lines, form="ascii 1.0"):
        return files.ply_header("element vertex 4", *self.AXES, *lines, form=form)

    def test_counts(self):
        def cases():
            for count in COUNTS + ["0"]:
                for form, rows in (("ascii 1.0", self.ROWS.encode()), ("binary_little_endian 1.0", bytes(48)), ("binary_big_endian 1.0", bytes(48))):
                    yield "count.ply", files.ply_header(f"element vertex {count}", *self.AXES, form=form).encode() + rows
                    if count not in ("0", "3"):
                        first = files.ply_header(f"element other {count}", "property list uchar int a", "element vertex 4", *self.AXES, form=form)
                        yield "first.ply", first.encode() + bytes(3) + rows
        self.require_refused(cases())

    def test_headers(self):
        good = self.header()
        spoil = [("format ascii 1.0\n", ""), ("ascii", "acsii"), ("1.0", "2.0"), ("1.0", ""), ("ascii 1.0", "ascii 1.0 1.0"),
                 ("format ascii 1.0\n", "format ascii 1.0\n" * 2), ("element vertex 4", "element vertex 4 6"),
                 ("element vertex 4", "element vertices 4"), ("element vertex 4", "element"), ("element vertex 4", "element vertex"),
                 ("element vertex 4\n", ""), ("element vertex 4\n", "element vertex 4\n" * 2), ("property float x\n", ""),
                 ("property float x", "property float x x"), ("property float x", "property float"), ("property float x", "property"),
                 ("property float x", "property floaty x"), ("property float x", "property float y"),
                 ("property float x", "property list uchar float x"), ("property float x", "property list float float x"),
                 ("property float x", "property list uchar x"), ("property float x", "property list list uchar float x"),
                 ("element vertex 4", "property float w\nelement vertex 4"), ("end_header\n", ""), ("end_header", "end_header now"),
                 ("end_header", "endheader"), ("ply\n", "ply 1\n"), ("ply\n", "PLY\n"), ("ply\n", "plyplyply\n"),
                 ("element vertex 4", "element empty 7\nelement vertex 4"), ("element vertex 4", "remark\nelement vertex 4"),
                 ("element vertex 4", "element ve\0tex 4")]
        self.require_refused(("header.ply", good.replace(*change, 1) + self.ROWS) for change in spoil)

    def test_rows(self):
        def cases():
            for row in ["1 1", "1 1 1 1", "1 1 x", "1 1 ", "# 1 1 1", "1,1,1", "1 1 1\0", "1 1 1 # comment"]:
                yield "row.ply", self.header() + self.ROWS.replace("1 1 1", row)
            for word in NOT_NUMBERS:
                yield "word.ply", self.header() + self.ROWS.replace("1 1 1", f"1 {word} 1"), "line 9"
            yield "double.ply", self.header().replace("float", "double") + self.ROWS.replace("1 1 1", "1 1e309 1"), "line 9"
            for kind, word in (("uchar", "256"), ("uchar", "-1"), ("char", "128"), ("ushort", "65536"), ("int", "2147483648"),
                               ("uint", "-1"), ("int64", "9223372036854775808"), ("uchar", "1.5"), ("int", "nan"), ("int", "1e3000")):
                text = self.header(f"property {kind} a") + self.ROWS.replace("\n", " 0\n").replace("1 1 1 0", f"1 1 1 {word}")
                yield f"{kind}.ply", text, "line 10", "'a'"
            yield "more.ply", self.header() + self.ROWS + "4 4 4\n", "line 12", "expected the end of the file"
            for padding in (b"\0" * 8, b"x", b"\0\1"):
                yield "more.ply", self.header(form="binary_little_endian 1.0").encode() + bytes(48) + padding
        self.require_refused(cases())

    def test_lists_and_faces(self):
        face = "element face 1\nproperty list {} int vertex_indices"
        def cases():
            for row in ["3 0 1", "3 0 1 2 3", "3 0 1 4", "3 0 1 -1", "-1 0 1 2", "2147483648 0 1 2", "99999999999 0", "", "x 0 1 2", "3 0 1 2.5",
                        "3.5 0 1 2"]:
                yield "face.ply", self.header(face.format("uint")) + self.ROWS + row + "\n"
            for kind, code, count in (("uchar", "B", 255), ("char", "b", -1), ("int", "i", -1), ("int", "i", 2 ** 31 - 1),
                                      ("uint", "I", 2 ** 32 - 1), ("uint64", "Q", 2 ** 61), ("int64", "q", -2 ** 63)):
                for form, order in (("binary_little_endian 1.0", "<"), ("binary_big_endian 1.0", ">")):
                    row = struct.pack(order + code + "3i", count, 0, 1, 2)
                    yield "face.ply", self.header(face.format(kind), form=form).encode() + bytes(48) + row
            yield "float.ply", self.header("element face 1", "property list uchar float vertex_index") + self.ROWS + "3 0 1 2\n"
            lists = ["element lists 1099511627776", "property list uchar int a"]
            yield "tiny.ply", files.ply_header(*lists, "element vertex 4", *self.AXES) + self.ROWS
            yield "tiny.ply", files.ply_header(*lists, "element vertex 0", *self.AXES, form="binary_little_endian 1.0")
        self.require_refused(cases())


class Pcd(HostileTest):
    ROWS = "0 0 0\n1 1 1\n2 2 2\n3 3 3\n"

    def test_headers(self):
        def cases():
            for data, rows in (("ascii", self.ROWS.encode()), ("binary", bytes(48)), ("binary_compressed", struct.pack("<2I", 50, 48) + files.lzf_literals(bytes(48)))):
                for key in ("width", "height", "points"):
                    for count in COUNTS + ["0"]:
                        yield f"{key}.pcd", files.pcd_header(data=data, **{key: count}).encode() + rows
                for size in ("4 4 3", "4 4 0", "4 4 -4", "4 4", "4 4 4 4", "4 4 16", "", "8 8 8"):
                    yield "size.pcd", files.pcd_header(data=data, size=size).encode() + (rows if data != "ascii" or size != "8 8 8" else b"")
            changes = [dict(count="1 1 0"), dict(count="1 1 -1"), dict(count="1 1 2"), dict(count="1 1 99999999999"), dict(count="1 1"),
                       dict(kind="F F X"), dict(kind="F F"), dict(data="binary_zip"), dict(data=""), dict(data="ASCII"), dict(fields="x y"),
                       dict(fields="x y x"), dict(fields="x y intensity"), dict(fields=""), dict(width=65536, height=65537, points=4295032832),
                       dict(width=2 ** 32, height=2 ** 32, points=0), dict(width=2 ** 63, height=2, points=0)]
            changes += [dict(leave_out=(key,)) for key in ("FIELDS", "SIZE", "TYPE", "DATA")] + [dict(leave_out=("WIDTH", "HEIGHT", "POINTS"))]
            for change in changes:
                yield "header.pcd", files.pcd_header(**change) + self.ROWS
            yield "version.pcd", (files.pcd_header() + self.ROWS).replace("VERSION 0.7", "VERSION 7")
            yield "twice.pcd", files.pcd_header().replace("WIDTH 4", "WIDTH 4\nWIDTH 4") + self.ROWS
            yield "view.pcd", files.pcd_header().replace("0 0 0 1", "0 0 1") + self.ROWS
            yield "word.pcd", files.pcd_header().replace("WIDTH", "WIDHT") + self.ROWS
        self.require_refused(cases())

    def test_rows(self):
        def cases():
            for row in ["1 1", "1 1 1 1", "", "1,1,1", "1 1 1\0", *(f"1 {word} 1" for word in NOT_NUMBERS)]:
                yield "row.pcd", files.pcd_header() + self.ROWS.replace("1 1 1", row)
            yield "more.pcd", files.pcd_header() + self.ROWS + "4 4 4\n", "line 15"
            yield "more.pcd", files.pcd_header(data="binary").encode() + bytes(48) + b"x"
            yield "less.pcd", files.pcd_header(data="binary").encode() + bytes(47)
        self.require_refused(cases())

    def test_compression(self):
        packed = files.lzf_literals(bytes(48))
        bodies = [(len(packed) + 1, 48, packed), (len(packed) - 1, 48, packed), (len(packed), 47, packed), (len(packed), 49, packed),
                  (len(packed), 0, packed), (2 ** 32 - 1, 48, packed), (len(packed), 2 ** 32 - 1, packed), (0, 0, b""), (0, 48, b""),
                  (len(packed), 48, packed + b"x"), (2, 48, b"\x20\x00"), (4, 48, b"\x00a\xe0\xff"), (5, 48, b"\x00a\xe0\xff\xff"),
                  (1, 48, b"\x1f"), (1, 48, b"\xe0"), (4, 48, b"\x00a\x20\x01"), (5, 48, b"\x00a\xe0\x40\x00")]
        self.require_refused(("packed.pcd", files.pcd_header(data="binary_compressed").encode() + struct.pack("<2I", a, b) + body) for a, b, body in bodies)


class Las(HostileTest):
    def test_headers(self):
        nan, infinity = float("nan"), float("inf")
        changes = [(2, 0, dict(signature=b"LASX")), (2, 0, dict(major=2)), (2, 0, dict(minor=5)), (2, 0, dict(minor=255)), (3, 0, dict(header_size=227)),
                   (2, 0, dict(header_size=0)), (2, 0, dict(header_size=226)), (2, 0, dict(header_size=65535)), (2, 0, dict(header_size=228)),
                   (2, 0, dict(start=0)), (2, 0, dict(start=226)), (2, 0, dict(start=2 ** 32 - 1)), (2, 0, dict(start=228)), (2, 0, dict(start=247)),
                   (2, 0, dict(record_count=1)), (2, 0, dict(record_count=2 ** 32 - 1)), (2, 0, dict(record_length=0)), (2, 0, dict(record_length=19)),
                   (2, 0, dict(record_length=21)), (2, 0, dict(record_length=65535)), (2, 0, dict(legacy=0)), (2, 0, dict(legacy=3)),
                   (2, 0, dict(legacy=5)), (2, 0, dict(legacy=2 ** 31)), (2, 0, dict(legacy=2 ** 32 - 1)), (4, 6, dict(count=0)), (4, 6, dict(count=5)),
                   (4, 6, dict(count=2 ** 32 + 10)), (4, 6, dict(count=2 ** 63)), (4, 6, dict(count=2 ** 64 - 1)), (4, 0, dict(legacy=3)),
                   (4, 6, dict(legacy=3)), (4, 0, dict(count=3)), (4, 6, dict(extended_count=1)), (4, 6, dict(extended_count=1, extended_start=2 ** 63)),
                   (4, 6, dict(extended_count=2 ** 32 - 1, extended_start=495)), (4, 6, dict(extended_count=1, extended_start=495)),
                   (4, 6, dict(extended_count=1, extended_start=375)), (3, 4, dict(encoding=2, waveforms=2 ** 62)), (3, 4, dict(encoding=2, waveforms=1))]
        changes += [(2, 0, {axis: value}) for axis in ("scale", "scale_y", "scale_z") for value in (0, nan, infinity, -infinity, 1e308)]
        changes += [(2, 0, {axis: value}) for axis in ("offset", "offset_y", "offset_z") for value in (nan, infinity)]
        changes += [(2, 0, dict(point_format=value)) for value in (1, 3, 11, 63, 127, 128, 130, 192, 255)]
        self.require_refused((f"{minor}.las", files.las(minor, form, changes=change)) for minor, form, change in changes)

    def test_compressed_points_are_named(self):
        laszip = [(b"laszip encoded", 22204, bytes(46))]
        self.require_refused([("a.las", files.las(changes=dict(point_format=128)), "LAZ"), ("a.laz", files.las(changes=dict(point_format=131)), "LAZ"),
                              ("b.las", files.las(2, 0, records=laszip), "LAZ")])

    def test_records(self):
        def spoilt(at, code, value, **arguments):
            content = bytearray(files.las(**arguments))
            struct.pack_into(code, content, at, value)
            return bytes(content)
        record = dict(minor=2, records=[(b"someone", 1, b"text")])
        last = dict(minor=4, point_format=6, extended=[(b"someone", 1, b"text")])
        extra = dict(points=())
        def description(kind, options=0, length=192):
            return struct.pack("<2xBB32s156x", kind, options, b"extra").ljust(length, b"\0")[:length]
        cases = [("record.las", spoilt(227 + 20, "<H", length, **record)) for length in (5, 65535)]
        cases += [("record.las", spoilt(375 + 120 + 20, "<Q", length, **last)) for length in (5, 2 ** 32 + 10, 2 ** 63, 2 ** 64 - 1)]
        cases += [("extra.las", files.las(**extra, records=[(b"LASF_Spec", 4, description(*arguments))]))
                  for arguments in ((1,), (31,), (255,), (0, 0), (0, 255), (1, 0, 191))]
        self.require_refused(cases)


class OffObjStl(HostileTest):
    ROWS = "0 0 0\n1 1 1\n2 2 2\n3 3 3\n"

    def test_off(self):
        def cases():
            for count in COUNTS + ["0"]:
                yield "vertices.off", f"OFF\n{count} 1 0\n{self.ROWS}3 0 1 2\n"
                if count != "0":
                    yield "faces.off", f"OFF\n4 {count} 0\n{self.ROWS}3 0 1 2\n"
            for face in ["3 0 1 4", "3 0 1 -1", "3 0 1", "4294967299 0 1 2", "-1 0 1 2", "3 0 1 2.5", "3 0 1 x", "2147483648 0", "3 0 1 2 1 2 3 4 5",
                         "3 0 1 2 red", "", "3 0 1 2\0", "99999999999999999999 0 1 2"]:
                yield "face.off", f"OFF\n4 1 0\n{self.ROWS}{face}\n"
            for row in ["1 1", "1 1 1 1 1 1 1 1 1 1 1 x", *(f"1 {word} 1" for word in NOT_NUMBERS)]:
                yield "row.off", "OFF\n4 0 0\n" + self.ROWS.replace("1 1 1", row)
            for text in ["OFF", "OFF\n", "OFF\n4", "OFF\n4 1\n", "OFF\n-4 0 0\n", "4OFF 4 0 0\n", "nOFF\n3\n4 0 0\n" + self.ROWS, "OFF BINARY\n", "OFFX\n",
                         "COFF\n4 0 0\n" + self.ROWS, "OFF\n4 0 0 0\n" + self.ROWS, "OFF\n4 0 0\n" + self.ROWS + "more\n"]:
                yield "text.off", text
        self.require_refused(cases())

    def test_obj(self):
        lines = ["v", "v 1 2", "v 1 2 3 4", "v 1 2 3 4 5", "v 1 2 3 4 5 6 7 8", "f", "f 0 1 2", "f 1 2 5", "f -1 -2 -9", "f 1.5 2 3", "f 1/x 2 3",
                 "f 1/1/1/1 2 3", "f 1/0 2 3", "f 99999999999999999999 1 2", "f 4294967298 1 2", "f -9223372036854775808 1 2", "l 1 9", "l", "q 1", "vertex 1 2 3",
                 "v 1 2 3\\", "1 2 3", "<html>", *(f"v 1 {word} 3" for word in NOT_NUMBERS)]
        self.require_refused(("line.obj", f"v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\n", "line 4") for line in lines)

    def test_stl(self):
        binary = files.stl_binary()
        text = files.stl_ascii().decode()
        cases = [("binary.stl", binary + b"x"), ("binary.stl", binary[:-1]), ("binary.stl", binary[1:]), ("binary.stl", b"x" + binary)]
        cases += [("count.stl", files.stl_binary(count=count)) for count in (0, 1, 3, 2 ** 31, 2 ** 32 - 1)]
        cases += [("solid.stl", files.stl_binary(title=b"solid part", count=count)) for count in (0, 1, 3, 2 ** 32 - 1)]
        spoil = [("endsolid part\n", ""), ("endsolid", "endsolids"), ("endloop\n", ""), ("endfacet\n", ""), ("outer loop\n", ""), ("facet normal 0 0 1\n", ""),
                 ("normal 0 0 1", "normal 0 0"), ("normal 0 0 1", "normal 0 0 up"), ("vertex 1.5", "vertex"), ("vertex 1.5", "vertex 1 1.5"),
                 ("endloop", "vertex 0 0 0\nendloop"), ("vertex 0.0 0.0 0.0\n", ""), ("solid part", "sold part"), ("endsolid part", "endsolid part\nsolid again")]
        cases += [("text.stl", text.replace(*change, 1)) for change in spoil]
        cases += [("word.stl", text.replace("1.5", word, 1), "line 5") for word in NOT_NUMBERS]
        self.require_refused(cases)


class Text(HostileTest):
    def test_rows(self):
        def cases():
            for delimiter in " ,;\t":
                rows = files.xyz(delimiter=delimiter).decode().splitlines(keepends=True)
                for word in NOT_NUMBERS:
                    if delimiter == "," and "," in word or delimiter == ";" and ";" in word:
                        continue
                    yield "word.xyz", "".join(rows[:2]) + delimiter.join(["1", word, "1"]) + "\n" + rows[3], "line 3"
                    yield "first.txt", delimiter.join(["1", word, "1"]) + "\n" + "".join(rows)
                for row in ("1 1", "1 1 1 1", "1 1 1 # 1\0", "1 1 1\0", "1"):
                    yield "row.txt", "".join(rows) + row.replace(" ", delimiter) + "\n", "line 5"
                yield "few.txt", delimiter.join("12") + "\n"
            for text in ["x,y\n1,2\n", "a,b,c\n1,2,3\n", "x,y,z,x\n1,2,3,4\n", "x,y,z\n1,2\n", "x,y,z\n1,,3\n", "x,y,z\n1,2,3,\n4,5,6\n", "3\n1 2 3\n4 5 6\n",
                         "2\n1 2 3\n", "5 x 7\n1 2 3\n", "1 2 3\n\n4 5\n", "x y z\n1 2 3\nx y z\n1 2 3\n", "1,5 2,5 3,5\n", "1,5;2,5;3,5\n", "1,5\t2,5\t3,5\n",
                         "x;y;z\n1,5;2;3\n", "1\n", "one two three\n", "lat,lon,h\n1,2,3\n", '"1","2","3\n', "1 2 3\r4 5\r"]:
                yield "text.csv", text
            yield "wide.xyz", "1 " * 100_000 + "x\n", "line 1"
            yield "wide.xyz", "1 2 3\n" + "1 " * 100_000 + "\n", "line 2"
            yield "long.xyz", "1 2 3\n1 2 " + "9" * 1_000_000 + "x\n", "line 2"
            yield "utf16.xyz", "1 2 3\n4 5 6\n".encode("utf-16"), "UTF-16"
            yield "utf16.csv", "1,2,3\n4,5,6\n".encode("utf-16-be")
        self.require_refused(cases())


class AnyFormat(HostileTest):
    def test_cut_at_every_byte(self):
        # What is left of a text may be whole: then it is read, with no more points than it has lines.
        whole = {".xyz", ".csv", ".txt", ".obj"}
        names = ("ascii.ply", "little.ply", "ascii.pcd", "binary_compressed.pcd", "1.4.las", "a.off", "a.obj", "ascii.stl", "binary.stl", "blank.xyz", "named.csv")
        samples = [(name, files.samples()[name]) for name in names]
        cases = [(f"{len(content)}-{name}", content[:length], length) for name, content in samples for length in range(len(content))]
        for (name, content, length), result, output in self.examine_all(cases):
            with self.subTest(name=name, length=length):
                self.require_consistent(name, result, output)
                if result.returncode == 0:
                    missing = int(name.split("-")[0]) - length
                    # Of the others only the last number's line end and digits, or a name after the last keyword.
                    self.assertTrue(name[-4:] in whole or (missing <= len(" part\n") and not content.endswith(b"\0")), (name, missing))

    def test_every_bit_of_a_header_flipped(self):
        # Titles and the bounding box are text and numbers that nothing depends on: one bit of each byte will do.
        idle = {"1.4.las": [*range(26, 94), *range(179, 227)], "binary.stl": range(80)}
        cases = []
        for name, size in (("1.4.las", 375), ("binary.stl", 84), ("big.ply", 200), ("binary_compressed.pcd", 160)):
            content = files.samples()[name]
            for at in range(min(len(content), size)):
                text = name.endswith(("ply", "pcd"))
                for bit in range(0, 8, 8 if at in idle.get(name, ()) else 3 if text else 1):
                    cases.append((name, content[:at] + bytes([content[at] ^ 1 << bit]) + content[at + 1:]))
        for (name, content), result, output in self.examine_all(cases):
            with self.subTest(name=name, content=content):
                self.require_consistent(name, result, output)

    def test_nothing_in_the_file(self):
        contents = [b"", b" ", b"\n", b" \n\t\r\n ", b"\xef\xbb\xbf", b"\xef\xbb\xbf\n", b"\n" * 100_000]
        self.require_refused((f"nothing.{extension}", content) for extension in EXTENSIONS + ["dat"] for content in contents)

    def test_something_else_in_the_file(self):
        contents = [b"\xff\xd8\xff\xe0\x00\x10JFIF\x00" + bytes(range(256)), b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR" + bytes(200), b"PK\x03\x04\x14\x00" + bytes(200),
                    b"\x1f\x8b\x08\x00\x00\x00\x00\x00" + bytes(range(200)), b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n1 0 obj\n<<>>\nendobj\n",
                    b"<!DOCTYPE html>\n<html><body>404 Not Found</body></html>\n", b"\x7fELF\x02\x01\x01" + bytes(300), b"\0" * 1000, b"\xff" * 1000,
                    b"version https://git-lfs.github.com/spec/v1\noid sha256:0123\nsize 12345\n", "\u00fc\u00f6\u00e4\n".encode("latin-1"), b"x", b"[", b"\0", b"{\"a\": 1}"]
        self.require_refused((f"other.{extension}", content) for extension in EXTENSIONS + ["dat"] for content in contents)

    def test_text_named_like_another_format(self):
        self.require_refused((f"text.{extension}", b"1 2 3\n4 5 6\n") for extension in ("ply", "pcd", "las", "stl", "obj"))

    def test_messages_stay_on_one_line(self):
        control = "a\x1b[31m\r\x07\u2028\u202e\x7f" + "b" * 10_000
        contents = [("a.ply", f"ply\nformat {control} 1.0\n"), ("b.ply", f"ply\nformat ascii 1.0\nelement {control} 1\n"), ("a.obj", control + "\n"),
                    ("a.off", control + "\n"), ("a.pcd", control + "\n"), ("a.xyz", f"{control} {control} {control}\n1 2 3\n"), ("b.xyz", f"1 2 3\n1 {control} 3\n"),
                    ("c.xyz", b"1 2 3\n1 \xff\xfe\x80 3\n"), ("a.stl", f"solid\n{control}\nfacet\n")]
        for name, content in contents:
            with self.subTest(name=name):
                content = content if isinstance(content, bytes) else content.encode("utf-8", "surrogateescape")
                result = run("info", self.write(name, content))
                self.expect_refusal(result, 1, name)
                self.assertNotRegex(result.stderr[:-1], "[\x00-\x1f\x7f\u2028\u202e]")
                self.assertLess(len(result.stderr), 1000)
        for name in (b"new\nline.xyz", b"\x1b[31m.xyz", b"\xff\xfe.xyz", "\u202e.xyz".encode()):
            path = os.path.join(os.fsencode(self.folder), name)
            with open(path, "wb") as file:
                file.write(b"1 2\n")
            self.expect_refusal(run("info", os.fsdecode(path)), 1, "xyz: line 1")

    def test_paths_that_are_no_files(self):
        (self.folder / "folder.ply").mkdir()
        os.mkfifo(self.path("pipe.ply"))
        self.path("loop.ply").symlink_to("loop.ply")
        self.path("dangling.ply").symlink_to("nowhere.ply")
        before = self.names()
        paths = [self.path(name) for name in ("folder.ply", "pipe.ply", "loop.ply", "dangling.ply", "missing.ply", "folder.ply/x.ply", "x" * 300 + ".ply")]
        for path in [*paths, "/dev/zero", "/dev/null", "/dev/random", ""]:
            with self.subTest(path=path):
                result = run("detect", path, "-o", self.path("out.ply"), timeout=LIMIT_S)
                self.expect_refusal(result, 1)
        if os.geteuid() != 0:
            self.write("secret.xyz", "1 2 3\n").chmod(0)
            self.expect_refusal(run("info", self.path("secret.xyz")), 1, "secret.xyz")
            self.path("secret.xyz").unlink()
        self.assertEqual(self.names(), before)

    def test_sparse_files_of_64_gigabytes(self):
        vertices = files.ply_header("element vertex 4000000000", "property uchar x", "property uchar y", "property uchar z", form="binary_little_endian 1.0")
        starts = [(extension, b"") for extension in EXTENSIONS + ["dat"]]
        starts += [(name.split(".")[-1], content) for name, content in files.samples().items()]
        starts += [("ply", vertices.encode()), ("ply", vertices.replace("little", "big").encode()), ("ply", b"ply\n"), ("stl", b"solid"), ("stl", b"x" * 80 + b"\xff\xff\xff\x4f"),
                   ("las", files.las(changes=dict(legacy=2 ** 32 - 1))), ("las", files.las(4, 6, changes=dict(count=3_000_000_000))), ("off", b"OFF\n4000000000 1 0\n"),
                   ("las", files.las(4, 6, points=(), changes=dict(extended_start=375, extended_count=1_000_000_000))), ("csv", b"x,y,z\n"), ("obj", b"# comment\n"),
                   ("las", files.las(points=(), changes=dict(start=0xF0000000, record_count=70_000_000))), ("pcd", files.pcd_header(width=4000000000, points=4000000000, data="binary").encode())]
        for number, (extension, start) in enumerate(starts):
            path = self.write(f"{number}.{extension}", start)
            os.truncate(path, 64 << 30)
            with self.subTest(extension=extension, start=start[:300]):
                self.expect_refusal(run("info", path, timeout=LIMIT_S), 1, path.name)
            path.unlink()

    def test_memory_stays_a_small_multiple_of_the_file(self):
        name = "n" * 100_000
        contents = [("name.pcd", files.pcd_header(f"x y z {name}", "4 4 4 1", "F F F U", f"1 1 1 {2 ** 19}", 1, 1, 1) + "1 2 3" + " 1" * 2 ** 19 + "\n"),
                    ("wide.xyz", "1 " * 200_000 + "\n"), ("wide.csv", ",".join(["x", "y", "z", *(f"c{i}" for i in range(100_000))]) + "\n")]
        for name, content in contents:
            with self.subTest(name=name):
                self.assertEqual(run_json("info", self.write(name, content))["format"], name.split(".")[1].replace("csv", "xyz"))


if __name__ == "__main__":
    unittest.main()
