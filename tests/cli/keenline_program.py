"""Running the real program, and small files to run it on. Standard library only."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["KEENLINE"]


def run(*arguments, timeout=200, **options):
    """Runs keenline; the result has returncode, stdout and stderr as text."""
    options.setdefault("stdout", subprocess.PIPE)
    return subprocess.run([PROGRAM, *map(str, arguments)], stderr=subprocess.PIPE, timeout=timeout,
                          text=True, errors="backslashreplace", **options)


def run_json(*arguments, **options):
    result = run(*arguments, "--json", **options)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def read_csv(path):
    """Column name -> list of numbers."""
    with open(path, encoding="utf-8") as file:
        names = file.readline().rstrip("\n").split(",")
        rows = [line.rstrip("\n").split(",") for line in file]
    return {name: [float(row[i]) for row in rows] for i, name in enumerate(names)}


def ply_bytes(points, scalar="d", extra=b""):
    """A binary little endian PLY of (x, y, z) tuples."""
    names = {"d": "double", "f": "float"}
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    header += "".join(f"property {names[scalar]} {axis}\n" for axis in "xyz") + "end_header\n"
    return header.encode() + b"".join(struct.pack("<3" + scalar, *p) for p in points) + extra


class FolderTest(unittest.TestCase):
    """Every test has an empty folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="keenline-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, name):
        return self.folder / name

    def write(self, name, content):
        path = self.path(name)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def names(self):
        return sorted(os.listdir(self.folder))

    def cube(self, points=2000, name="cube.ply", *arguments):
        result = run("synth", "cube", "-o", self.path(name), "--points", points, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.path(name)

    def expect_refusal(self, result, code, *parts):
        """One line on stderr, nothing on stdout, the exit code, and every part in the message."""
        self.assertEqual(result.returncode, code, result.stderr)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertTrue(lines[0].startswith("keenline: "), lines[0])
        if result.stdout is not None:
            self.assertEqual(result.stdout, "")
        for part in parts:
            self.assertIn(part, lines[0])
