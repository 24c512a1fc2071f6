"""The same bytes for any number of threads and on any CPU, and the same memory for every point."""
import array
import os
import pathlib
import random
import struct
import unittest

from keenline_program import FolderTest, ply_bytes, run, run_json

SANITIZED = "san" in pathlib.Path(os.environ.get("KEENLINE_BUILD_DIR", "")).name


def triangles_off(points):
    return "OFF\n%d 0 0\n" % len(points) + "".join("%r %r %r\n" % p for p in points)


def las_bytes(points):
    """LAS 1.2, point format 0, millimetres."""
    header = bytearray(227)
    struct.pack_into("<4s", header, 0, b"LASF")
    struct.pack_into("<BB", header, 24, 1, 2)
    struct.pack_into("<HIIBHI", header, 94, 227, 227, 0, 0, 20, len(points))
    struct.pack_into("<I", header, 111, len(points))
    struct.pack_into("<6d", header, 131, 0.001, 0.001, 0.001, 0, 0, 0)
    for axis in range(3):
        values = [round(p[axis] * 1000) * 0.001 for p in points]
        struct.pack_into("<2d", header, 179 + 16 * axis, max(values), min(values))
    return bytes(header) + b"".join(
        struct.pack("<3iHBBBBH", *(round(c * 1000) for c in p), 0, 0x09, 0, 0, 0, 0) for p in points)


def cube_points(count, seed=1):
    """Random points on the surface of a cube."""
    numbers = random.Random(seed)
    points = []
    for _ in range(count):
        p = [numbers.random() for _ in range(3)]
        p[numbers.randrange(3)] = float(numbers.randrange(2))
        points.append(tuple(p))
    return points


class SameBytes(FolderTest):
    def test_of_detect_for_any_number_of_threads(self):
        points = cube_points(1500)
        self.write("cube.ply", ply_bytes(points, "f"))
        self.write("cube.csv", "x,y,z\n" + "".join("%r,%r,%r\n" % p for p in points))
        self.write("cube.off", triangles_off(points))
        self.write("cube.las", las_bytes(points))
        for source in self.names():
            for extension in (".ply", ".csv"):
                outputs = set()
                for threads in ("1", "2", "16", "16"):
                    target = self.path("out" + extension)
                    result = run("detect", self.path(source), "-o", target, "--threads", threads, "--sigma", "auto", "--quiet")
                    self.assertEqual(result.returncode, 0, result.stderr)
                    outputs.add(target.read_bytes())
                    target.unlink()
                self.assertEqual(len(outputs), 1, (source, extension))

    def test_of_synth_for_any_number_of_threads(self):
        for sampling in ("random", "grid", "mesh", "scan"):
            for shape in ("cube", "cone", "torus"):
                outputs = set()
                for threads in ("1", "2", "16"):
                    result = run("synth", shape, "-o", self.path("out.ply"), "--points", "4000", "--sampling", sampling, "--noise", "0.1h",
                                 "--seed", "7", "--threads", threads)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    outputs.add(self.path("out.ply").read_bytes())
                self.assertEqual(len(outputs), 1, (sampling, shape))

    def test_on_another_cpu(self):
        # The C library then chooses other code for its functions.
        old_cpu = dict(os.environ, GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,-FMA,-FMA_Usable,-FMA4,-AVX,-AVX_Usable,-AVX512F,"
                                                  "-AVX512F_Usable,-ERMS,-SSE4_1,-SSE4_2")
        for shape, sampling in (("cone", "random"), ("torus", "scan"), ("fandisk", "mesh")):
            clouds, labels = set(), set()
            for environment in (dict(os.environ), old_cpu):
                self.assertEqual(run("synth", shape, "-o", self.path("cloud.ply"), "--points", "2000", "--sampling", sampling,
                                     "--noise", "0.1h", env=environment).returncode, 0)
                self.assertEqual(run("detect", self.path("cloud.ply"), "-o", self.path("out.csv"), "--sigma", "auto",
                                     env=environment).returncode, 0)
                clouds.add(self.path("cloud.ply").read_bytes())
                labels.add(self.path("out.csv").read_bytes())
            self.assertEqual((len(clouds), len(labels)), (1, 1), (shape, sampling))

    def test_on_every_instruction_set(self):
        unknown = run("--version", env=dict(os.environ, KEENLINE_TARGET="abacus"))
        self.assertEqual(unknown.returncode, 2)
        self.assertRegex(unknown.stderr, r"^keenline: KEENLINE_TARGET: found 'abacus', expected one of scalar[a-z0-9, ]*\n$")
        names = unknown.stderr.strip().split("expected one of ")[1].split(", ")
        for shape, sampling, noise in (("cube", "grid", "0"), ("fandisk", "mesh", "0"), ("torus", "scan", "0.2h")):
            self.assertEqual(run("synth", shape, "-o", self.path("cloud.ply"), "--points", "1500", "--sampling", sampling,
                                 "--noise", noise).returncode, 0)
            outputs = set()
            for name in names:
                environment = dict(os.environ, KEENLINE_TARGET=name)
                self.assertRegex(run("--version", env=environment).stdout, r" \(%s\)\n$" % name)
                result = run("detect", self.path("cloud.ply"), "-o", self.path("out.ply"), "--spectrum", env=environment)
                self.assertEqual(result.returncode, 0, result.stderr)
                outputs.add(self.path("out.ply").read_bytes())
            self.assertEqual(len(outputs), 1, shape)


class MemoryPerPoint(FolderTest):
    @unittest.skipIf(SANITIZED, "a sanitizer has its own memory")
    def test_is_flat(self):
        numbers = random.Random(3)
        peaks = []
        for points in (250_000, 1_000_000):
            coordinates = array.array("f", array.array("H", numbers.randbytes(2 * 3 * points)))
            header = f"ply\nformat binary_little_endian 1.0\nelement vertex {points}\n" \
                     "property float x\nproperty float y\nproperty float z\nend_header\n"
            source = self.write("large.ply", header.encode() + coordinates.tobytes())
            report = run_json("detect", source, "-o", self.path("out.ply"), "--neighbors", "4", "--smooth", "no")
            peaks.append(report["peak_memory_bytes"])
        per_point = (peaks[1] - peaks[0]) / 750_000
        print(f"{per_point:.0f} bytes per point at 4 neighbours, {peaks[0] / 250_000:.0f} over all at 250,000")
        self.assertLess(per_point, 400)
        self.assertLess(peaks[1] / 1_000_000, peaks[0] / 250_000 + 1)


if __name__ == "__main__":
    unittest.main()
