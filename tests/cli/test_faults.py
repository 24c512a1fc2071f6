"""What the system can do to a run: memory that ends, calls that fail, signals, limits, closed descriptors.

Whatever happens, the program ends with a promised exit code and one line, and the target is old or complete."""
import concurrent.futures
import errno
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest

from keenline_program import PROGRAM, FolderTest, ply_bytes, run

BUILD = pathlib.Path(os.environ.get("KEENLINE_BUILD_DIR", "")).name
SANITIZED = "san" in BUILD
MIB = 1 << 20

needs_its_own_memory = unittest.skipIf(SANITIZED, "a sanitizer has its own memory and its own limits")
needs_root = unittest.skipUnless(os.geteuid() == 0, "only root can become somebody else")


def limited(**limits):
    """For subprocess: resource limits by name, such as AS=bytes."""
    def set_limits():
        for name, value in limits.items():
            resource.setrlimit(getattr(resource, "RLIMIT_" + name), (value, value))
    return {"preexec_fn": set_limits}


def temporary_files(folder):
    return [name for name in os.listdir(folder) if name.startswith(".keenline")]


class FaultTest(FolderTest):
    """Runs the program with fault_injection.cpp before the C library."""

    @classmethod
    def setUpClass(cls):
        if SANITIZED:
            raise unittest.SkipTest("a sanitizer replaces the same functions")
        cls.tools = pathlib.Path(tempfile.mkdtemp(prefix="keenline-faults-"))
        cls.addClassCleanup(shutil.rmtree, cls.tools, ignore_errors=True)
        cls.library = cls.tools / "fault_injection.so"
        source = pathlib.Path(__file__).with_name("fault_injection.cpp")
        subprocess.run([os.environ.get("KEENLINE_CXX", "c++"), "-std=c++20", "-O1", "-shared", "-fPIC", str(source), "-o", str(cls.library)],
                       check=True)

    def run_with(self, fault, arguments, number, folder="", error=errno.ENOMEM, repeat=False, count=""):
        environment = dict(os.environ, LD_PRELOAD=str(self.library), FAULT_CALL=fault, FAULT_NUMBER=str(number),
                           FAULT_REPEAT=str(int(repeat)), FAULT_ERROR=str(error), FAULT_FOLDER=str(folder))
        if count:
            environment["FAULT_COUNT"] = str(count)
        return run(*arguments, env=environment)

    def calls(self, fault, arguments, folder=""):
        """How many such calls a run without faults makes."""
        count = self.tools / "count"
        result = self.run_with(fault, arguments, 0, folder, count=count)
        self.assertEqual(result.returncode, 0, result.stderr)
        return int(count.read_text())


class Memory(FaultTest):
    def sweep(self, arguments, output, fault="alloc", most=80):
        """Lets the n-th call fail, and all from the n-th on, for n spread over the run."""
        total = self.calls(fault, [*arguments, *(["-o", self.path("all" + output)] if output else [])])
        complete = self.path("all" + output).read_bytes() if output else b""
        numbers = list(range(1, total + 1))
        if total > most:
            numbers = sorted({*numbers[:5], *numbers[-10:], *numbers[::max(1, total // most)]})

        def attempt(number, repeat):
            folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
            target = folder / ("out" + output)
            result = self.run_with(fault, [*arguments, *(["-o", target] if output else [])], number, repeat=repeat)
            return result, {path.name: path.read_bytes() for path in folder.iterdir()}

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            attempts = {(n, repeat): pool.submit(attempt, n, repeat) for n in numbers for repeat in (False, True)}
        crashes = 0
        for (number, repeat), future in attempts.items():
            result, left = future.result()
            # In one place glibc 2.36 crashes itself: in dlopen(), called by TBB as it starts, with no memory at all.
            if repeat and result.returncode == -signal.SIGSEGV and crashes == 0:
                crashes += 1
                continue
            with self.subTest(command=arguments[0], fault=fault, number=number, repeat=repeat):
                self.assertIn(result.returncode, (0, 4), result.stderr)
                if result.returncode == 0:
                    self.assertEqual(result.stderr, "")
                    self.assertEqual(left, {"out" + output: complete} if output else {})
                else:
                    self.expect_refusal(result, 4)
                    self.assertEqual(left, {})

    def test_detect_ply(self):
        self.sweep(["detect", self.cube(400), "--threads", "2"], ".ply")

    def test_detect_csv(self):
        self.sweep(["detect", self.cube(400, "cube.csv"), "--threads", "2", "--json"], ".csv")

    def test_synth(self):
        self.sweep(["synth", "cone", "--points", "300", "--sampling", "scan", "--threads", "2"], ".ply")

    def test_info(self):
        self.sweep(["info", self.cube(300, "cube.csv"), "--json"], "")

    def test_evaluate(self):
        labels = self.write("labels.csv", "x,y,z,feature,truth\n" + "".join(f"{i},0,0,{i % 2},{i % 3}\n" for i in range(300)))
        self.sweep(["evaluate", labels, "--json"], "")

    def test_address_space_and_threads(self):
        source = self.cube(400)
        for fault in ("mmap", "thread"):
            self.sweep(["detect", source, "--threads", "4"], ".ply", fault)
            self.sweep(["synth", "cube", "--points", "300", "--threads", "4"], ".ply", fault)


class Calls(FaultTest):
    def setUp(self):
        super().setUp()
        self.cube(400)
        self.cube(400, "cube.csv")

    def detect(self, fault, number, extension, error=0, repeat=False):
        """The result of a run that replaces an old file, and what is there afterwards."""
        target = self.write("out" + extension, "old")
        for name in temporary_files(self.folder):
            self.path(name).unlink()
        result = self.run_with(fault, ["detect", self.path("cube" + extension), "-o", target, "--quiet"], number, self.folder, error, repeat)
        return result, target.read_bytes()

    def test_every_call_that_fails(self):
        # call, errors, the exit codes that may follow
        cases = [
            ("open", ("EACCES", "EIO", "ENFILE"), {1, 3}), ("fstat", ("EIO",), {1}), ("map", ("EACCES", "EIO"), {1}), ("map", ("ENOMEM",), {4}),
            ("lstat", ("EIO", "EACCES"), {3}), ("access", ("EACCES", "EROFS"), {3}), ("write", ("EIO", "ENOSPC", "EDQUOT"), {3}),
            ("fsync", ("EIO", "ENOSPC"), {3}), ("fchmod", ("EPERM", "EIO"), {3}), ("close", ("EIO", "ENOSPC"), {0, 3}),
            ("rename", ("EIO", "EACCES", "EINVAL"), {0, 3}), ("unlink", ("EIO",), {0}), ("stat", ("EIO",), {0}),
            ("open", ("EINTR",), {0}), ("fsync", ("EINTR",), {0}), ("close", ("EINTR",), {0}), ("write", ("EINTR",), {0}),
        ]
        for extension in (".ply", ".csv"):
            arguments = ["detect", self.path("cube" + extension), "-o", self.path("out" + extension), "--quiet"]
            self.assertEqual(run(*arguments).returncode, 0)
            complete = self.path("out" + extension).read_bytes()
            for fault, names, codes in cases:
                self.write("out" + extension, "old")
                total = self.calls(fault, arguments, self.folder)
                self.assertGreater(total, 0, fault)
                for name in names if extension == ".ply" else names[:1]:
                    seen = set()
                    for number in range(1, total + 1):
                        for repeat in (False, True) if name != "EINTR" else (False,):
                            with self.subTest(call=fault, error=name, number=number, repeat=repeat, extension=extension):
                                result, found = self.detect(fault, number, extension, getattr(errno, name), repeat)
                                self.assertIn(result.returncode, codes, result.stderr)
                                seen.add(result.returncode)
                                if result.returncode == 0:
                                    self.assertEqual(result.stderr, "")
                                else:
                                    self.expect_refusal(result, result.returncode, os.strerror(getattr(errno, name)) if result.returncode != 4 else "")
                                self.assertEqual(found, complete if result.returncode == 0 else b"old")
                                if fault != "unlink":
                                    self.assertEqual(temporary_files(self.folder), [])
                    if fault != "stat":
                        self.assertEqual(seen, codes, (fault, name))

    def test_short_writes_are_continued(self):
        arguments = ["detect", self.path("cube.csv"), "-o", self.path("whole.ply"), "--quiet"]
        self.assertEqual(run(*arguments).returncode, 0)
        for number, repeat in ((1, False), (1, True)):
            result = self.run_with("write", [*arguments[:3], self.path("short.ply"), "--quiet"], number, self.folder, 0, repeat)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(self.path("short.ply").read_bytes(), self.path("whole.ply").read_bytes())

    def test_a_symbolic_link_that_cannot_be_followed(self):
        self.write("real.ply", "old")
        self.path("link.ply").symlink_to("real.ply")
        result = self.run_with("realpath", ["detect", self.path("cube.ply"), "-o", self.path("link.ply")], 1, self.folder, errno.EIO,
                               repeat=True)
        self.expect_refusal(result, 3, "symbolic link")
        self.assertEqual(self.path("real.ply").read_bytes(), b"old")

    def test_an_input_that_shrinks_while_it_is_read(self):
        for name in ("cube.ply", "cube.csv"):
            for command in (["detect", "-o", self.write("out.ply", "old")], ["info"], ["evaluate"]):
                source = self.path("shrinking" + name[-4:])
                shutil.copy(self.path(name), source)
                self.expect_refusal(self.run_with("shrink", [command[0], source, *command[1:]], 1, self.folder), 1, "while it was being read")
                self.assertEqual(source.stat().st_size, 0)
                self.assertEqual(self.path("out.ply").read_bytes(), b"old")
                self.assertEqual(temporary_files(self.folder), [])


class Outputs(FolderTest):
    def test_a_target_that_is_no_plain_file(self):
        source = self.cube(100)
        self.path("folder.ply").mkdir()
        os.mkfifo(self.path("pipe.ply"))
        self.path("dangling.ply").symlink_to("nowhere.ply")
        self.path("to-folder.ply").symlink_to("folder.ply")
        self.path("loop.ply").symlink_to("loop.ply")
        self.path("null.ply").symlink_to("/dev/null")
        self.path("full.ply").symlink_to("/dev/full")
        before = self.names()
        for name in ("folder", "pipe", "dangling", "to-folder", "loop", "null", "full"):
            with self.subTest(target=name):
                self.expect_refusal(run("detect", source, "-o", self.path(name + ".ply")), 3, name + ".ply")
                self.assertEqual(self.names(), before)
        self.assertTrue(pathlib.Path("/dev/null").is_char_device())

    def test_a_symbolic_link_stays_and_its_target_is_replaced(self):
        source = self.cube(100)
        self.path("elsewhere").mkdir()
        self.write("elsewhere/real.ply", "old")
        self.path("link.ply").symlink_to("elsewhere/real.ply")
        self.assertEqual(run("detect", source, "-o", self.path("link.ply")).returncode, 0)
        self.assertTrue(self.path("link.ply").is_symlink())
        self.assertTrue(self.path("elsewhere/real.ply").read_bytes().startswith(b"ply"))
        self.assertEqual(os.listdir(self.path("elsewhere")), ["real.ply"])

    def test_the_input_by_any_name_is_refused(self):
        source = self.cube(100)
        before = source.read_bytes()
        self.path("sub").mkdir()
        self.path("symbolic.ply").symlink_to(source)
        os.link(source, self.path("hard.ply"))
        for target in (source, self.path("sub/../cube.ply"), self.path("symbolic.ply"), self.path("hard.ply")):
            with self.subTest(target=str(target)):
                self.expect_refusal(run("detect", source, "-o", target), 2, "is the input")
        self.expect_refusal(run("detect", "cube.ply", "-o", "./cube.ply", cwd=self.folder), 2, "is the input")
        self.assertEqual(source.read_bytes(), before)

    def test_a_full_disk(self):
        source = self.cube(20000)
        disk = self.path("disk")
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "none", str(disk)], capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("cannot mount a small disk")
        self.addCleanup(subprocess.run, ["umount", str(disk)], check=True)
        (disk / "out.ply").write_bytes(b"old")
        for command in (["detect", source, "--neighbors", "4"], ["synth", "cube", "--points", "50000"]):
            self.expect_refusal(run(*command, "-o", disk / "out.ply"), 3, os.strerror(errno.ENOSPC))
            self.assertEqual((disk / "out.ply").read_bytes(), b"old")
            self.assertEqual(os.listdir(disk), ["out.ply"])
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        self.expect_refusal(run("detect", source, "-o", disk / "out.ply"), 3, os.strerror(errno.EROFS))

    def test_a_file_size_limit(self):
        source = self.cube(20000)
        for extension in ("ply", "csv"):
            target = self.write("out." + extension, "old")
            result = run("detect", source, "-o", target, "--neighbors", "4", **limited(FSIZE=100_000))
            self.expect_refusal(result, 3, os.strerror(errno.EFBIG))
            self.assertEqual(target.read_bytes(), b"old")
        self.assertEqual(temporary_files(self.folder), [])

    def test_a_folder_that_vanishes_during_the_run(self):
        source = self.cube(20000 if not SANITIZED else 2000, "noisy.ply", "--noise", "0.1h")
        self.path("sub").mkdir()
        process = subprocess.Popen([PROGRAM, "detect", str(source), "-o", str(self.path("sub/out.ply"))],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(0.1)
        self.path("sub").rmdir()
        _, errors = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 3, errors)
        self.assertEqual(len(errors.splitlines()), 1, errors)
        self.assertEqual(self.names(), ["noisy.ply"])

    def test_an_input_that_is_replaced_or_deleted_during_the_run(self):
        source = self.cube(5000 if not SANITIZED else 1000, "noisy.ply", "--noise", "0.1h")
        self.assertEqual(run("detect", source, "-o", self.path("expected.ply")).returncode, 0)
        for change in (lambda: source.unlink(), lambda: os.replace(self.cube(100, "other.ply"), source)):
            kept = source.read_bytes()
            process = subprocess.Popen([PROGRAM, "detect", str(source), "-o", str(self.path("out.ply")), "--quiet"])
            while process.poll() is None:  # until it is mapped
                if str(source) in pathlib.Path(f"/proc/{process.pid}/maps").read_text():
                    break
            time.sleep(0.02)
            change()
            self.assertEqual(process.wait(100), 0)
            self.assertEqual(self.path("out.ply").read_bytes(), self.path("expected.ply").read_bytes())
            source.unlink(missing_ok=True)
            source.write_bytes(kept)

    @needs_root
    def test_places_where_somebody_else_may_not_write(self):
        source = self.cube(100)
        os.chmod(self.folder, 0o755)
        self.path("mine").mkdir()
        self.path("theirs").mkdir()
        os.chown(self.path("theirs"), 65534, 65534)
        protected = self.write("theirs/protected.ply", "old")
        os.chmod(protected, 0o444)
        for target in ("mine/out.ply", "theirs/protected.ply"):
            try:
                result = run("detect", source, "-o", self.path(target), user=65534, group=65534)
            except PermissionError:
                self.skipTest("the program is out of reach for others")
            self.expect_refusal(result, 3, os.strerror(errno.EACCES))
        self.assertEqual(os.listdir(self.path("mine")), [])
        self.assertEqual(os.listdir(self.path("theirs")), ["protected.ply"])
        self.assertEqual(protected.read_bytes(), b"old")


class Signals(FolderTest):
    def start(self, *arguments):
        return subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def jobs(self):
        """Runs in which writing takes its share of the time, with their targets."""
        source = self.cube(30000)
        return [(["detect", source, "--neighbors", "4", "--quiet"], "out.csv"),
                (["synth", "sphere", "--points", "100000" if not SANITIZED else "20000", "--quiet"], "out.ply")]

    def complete(self, arguments, target):
        start = time.monotonic()
        self.assertEqual(run(*arguments, "-o", target).returncode, 0)
        return target.read_bytes(), time.monotonic() - start

    def test_killed_at_any_moment_the_target_is_old_or_complete(self):
        moments = random.Random(20100612)
        for arguments, name in self.jobs():
            complete, duration = self.complete(arguments, self.path(name))
            for _ in range(15):
                target = self.write(name, "old")
                process = self.start(*arguments, "-o", target)
                time.sleep(moments.uniform(0, 1.1 * duration))
                process.kill()
                process.communicate(timeout=60)
                self.assertIn(target.read_bytes(), (b"old", complete))
                for left in temporary_files(self.folder):
                    self.path(left).unlink()

    def test_interrupted_at_any_moment_nothing_is_left(self):
        moments = random.Random(19650417)
        numbers = [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)]
        for arguments, name in self.jobs():
            complete, duration = self.complete(arguments, self.path(name))
            for attempt in range(12):
                number, code = numbers[attempt % 3]
                target = self.write(name, "old")
                process = self.start(*arguments, "-o", target)
                time.sleep(moments.uniform(0, 1.1 * duration))
                process.send_signal(number)
                _, errors = process.communicate(timeout=60)
                with self.subTest(signal=number, attempt=attempt):
                    # Before the handlers are in place (the first milliseconds) the signal ends the program as always.
                    self.assertIn(process.returncode, (code, 0, -number), errors)
                    self.assertEqual(target.read_bytes(), complete if process.returncode == 0 else b"old")
                    self.assertEqual(errors, "keenline: interrupted\n" if process.returncode == code else "")
                    self.assertEqual(temporary_files(self.folder), [])

    def test_a_second_interruption_leaves_nothing_either(self):
        for arguments, name in self.jobs():
            complete, duration = self.complete(arguments, self.path(name))
            for part in (0.3, 0.6, 0.8, 0.9):
                target = self.write(name, "old")
                process = self.start(*arguments, "-o", target)
                time.sleep(part * duration)
                process.send_signal(signal.SIGINT)
                process.send_signal(signal.SIGTERM)
                process.communicate(timeout=60)
                # Before the handlers are in place (the first milliseconds) a signal ends the program as always.
                self.assertIn(process.returncode, (130, 143, 0, -signal.SIGINT, -signal.SIGTERM))
                self.assertIn(target.read_bytes(), (b"old", complete))
                self.assertEqual(temporary_files(self.folder), [])

    def test_every_stage_of_a_large_job_stops(self):
        points = 1_000_000 if not SANITIZED else 50_000
        large = self.cube(points, "large.ply", "--noise", "0.1h")
        text = self.cube(points // 4, "large.csv", "--noise", "0.1h")
        some = self.cube(points // 50, "some.ply", "--noise", "0.1h")  # soon in the clustering
        jobs = [(["info", text], (0.03, 0.1)),
                (["detect", large, "--quiet", "-o", self.path("out.ply")], (0.05, 0.2, 0.5, 0.9)),
                (["detect", large, "--neighbors", "128", "--threads", "2", "--quiet", "-o", self.path("out.ply")], (0.7,)),
                (["detect", text, "--neighbors", "3", "--quiet", "-o", self.path("out.csv")], (0.5,)),
                (["detect", some, "--neighbors", "128", "--threads", "2", "--quiet", "-o", self.path("out.csv")], (0.5,)),
                (["synth", "fandisk", "--points", 3 * points, "--sampling", "scan", "-o", self.path("out.csv")], (0.2, 0.7))]
        for arguments, delays in jobs:
            for delay in delays:
                process = self.start(*arguments)
                time.sleep(delay)
                process.send_signal(signal.SIGINT)
                start = time.monotonic()
                _, errors = process.communicate(timeout=60)
                with self.subTest(arguments=arguments, delay=delay):
                    self.assertIn(process.returncode, (130, 0, -signal.SIGINT), errors)
                    self.assertLess(time.monotonic() - start, 5 if not SANITIZED else 50)
                    if process.returncode != 0:
                        self.assertEqual(self.names(), ["large.csv", "large.ply", "some.ply"])
                for left in self.folder.glob("out.*"):
                    left.unlink()


class Limits(FolderTest):
    @needs_its_own_memory
    def test_little_address_space(self):
        source = self.cube(100_000, "large.ply")
        for mebibytes in (48, 64, 96, 128, 256):
            for threads in ("1", "16"):
                with self.subTest(mebibytes=mebibytes, threads=threads):
                    target = self.write("out.ply", "old")
                    result = run("detect", source, "-o", target, "--neighbors", "4", "--quiet", "--threads", threads,
                                 **limited(AS=mebibytes * MIB))
                    if result.returncode == 0:
                        self.assertTrue(target.read_bytes().startswith(b"ply"))
                    else:
                        self.expect_refusal(result, 4)
                        self.assertEqual(target.read_bytes(), b"old")
                    self.assertEqual(temporary_files(self.folder), [])
        small = self.cube(2000)
        for mebibytes in (256, 512):
            self.assertEqual(run("detect", small, "-o", self.path("out.ply"), "--threads", "2", **limited(AS=mebibytes * MIB)).returncode, 0)

    @needs_its_own_memory
    def test_a_header_that_claims_much_gets_nothing(self):
        many = 2 ** 32
        self.write("a.ply", f"ply\nformat binary_little_endian 1.0\nelement vertex {many}\nproperty float x\nproperty float y\n"
                            "property float z\nend_header\n" + 120 * "a")
        self.write("ascii.ply", f"ply\nformat ascii 1.0\nelement vertex {many}\nproperty float x\nproperty float y\n"
                                "property float z\nend_header\n1 2 3\n")
        for data in ("ascii", "binary", "binary_compressed"):
            self.write(f"{data}.pcd", f"VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {many}\nHEIGHT 1\n"
                                      f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {many}\nDATA {data}\n" + "\xff\xff\xff\xff" * 6)
        las = bytearray(227 + 4 * 20)  # LAS 1.2, point format 0
        struct.pack_into("<4s20xBB", las, 0, b"LASF", 1, 2)
        struct.pack_into("<HIIBHI", las, 94, 227, 227, 0, 0, 20, many - 1)
        struct.pack_into("<3d", las, 131, 1, 1, 1)
        self.write("a.las", bytes(las))
        self.write("a.off", f"OFF\n{many} 0 0\n1 2 3\n")
        stl = bytes(80) + struct.pack("<I", many - 1) + bytes(100)
        self.write("a.stl", stl)
        for name in self.names():
            with self.subTest(file=name):
                self.expect_refusal(run("info", self.path(name), **limited(AS=300 * MIB)), 1, name)

    @needs_root
    @needs_its_own_memory
    def test_without_further_threads_the_result_is_the_same(self):
        source = self.cube(5000)
        os.chmod(self.folder, 0o777)
        self.assertEqual(run("detect", source, "-o", self.path("expected.ply")).returncode, 0)
        try:
            result = run("detect", source, "-o", self.path("out.ply"), "--threads", "8", user=65534, group=65534, **limited(NPROC=1))
        except PermissionError:
            self.skipTest("the program is out of reach for others")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(self.path("out.ply").read_bytes(), self.path("expected.ply").read_bytes())

    @needs_its_own_memory
    def test_few_descriptors(self):
        source = self.cube(500)
        for count in range(4, 10):
            target = self.write("out.ply", "old")
            result = run("detect", source, "-o", target, "--quiet", **limited(NOFILE=count))
            with self.subTest(descriptors=count):
                if result.returncode != 0:
                    self.expect_refusal(result, result.returncode if result.returncode in (1, 3) else 1, os.strerror(errno.EMFILE))
                    self.assertEqual(target.read_bytes(), b"old")
                self.assertEqual(temporary_files(self.folder), [])

    @needs_its_own_memory
    def test_a_small_stack(self):
        # Ever smaller steps towards the origin: the search tree becomes as deep as it can be.
        spiral = self.write("spiral.ply", ply_bytes([(2.0 ** -i, 3.0 ** -i, 5.0 ** -i) for i in range(400)]))
        for source in (self.cube(5000), spiral):
            outputs = []
            for options in ({}, limited(STACK=256 << 10)):
                result = run("detect", source, "-o", self.path("out.ply"), "--quiet", **options)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                outputs.append(self.path("out.ply").read_bytes())
            self.assertEqual(outputs[0], outputs[1])


class Descriptors(FolderTest):
    def closing(self, *descriptors):
        return {"preexec_fn": lambda: [os.close(d) for d in descriptors]}

    def test_closed_descriptors_never_become_the_result(self):
        # The labels in the input are replaced, with a note on stderr.
        self.assertEqual(run("detect", self.cube(500), "-o", self.path("labelled.ply")).returncode, 0)
        source = self.path("labelled.ply")
        self.assertEqual(run("detect", source, "-o", self.path("expected.ply")).returncode, 0)
        expected = self.path("expected.ply").read_bytes()
        target = self.path("out.ply")
        for closed in ((0,), (2,), (0, 2), (0, 1, 2), (1,), (1, 2)):
            with self.subTest(closed=closed):
                target.unlink(missing_ok=True)
                told = run("detect", source, "-o", target, **self.closing(*closed))
                self.assertEqual(told.returncode, 3 if 1 in closed else 0, told.stderr)
                # Nobody was told of the result: a failure, and then nothing is left.
                self.assertEqual(target.exists(), 1 not in closed)
                self.assertEqual(run("detect", source, "-o", target, "--quiet", **self.closing(*closed)).returncode, 0)
                self.assertEqual(target.read_bytes(), expected)
                bad = run("detect", self.write("bad.xyz", "1 2\n"), "-o", self.path("bad.ply"), **self.closing(*closed))
                self.assertEqual(bad.returncode, 1)
        self.assertEqual(self.names(), ["bad.xyz", "cube.ply", "expected.ply", "labelled.ply", "out.ply"])

    def test_a_result_that_cannot_be_told_is_not_left(self):
        source = self.cube(500)
        target = self.write("out.ply", "old")
        reading, writing = os.pipe()
        os.close(reading)
        with open("/dev/full", "w") as full, os.fdopen(writing, "w") as broken:
            for stream, error in ((full, errno.ENOSPC), (broken, errno.EPIPE)):
                for command in (["detect", source], ["detect", source, "--json"], ["synth", "cube", "--points", "100"]):
                    result = run(*command, "-o", target, stdout=stream)
                    self.expect_refusal(result, 3, "standard output", os.strerror(error))
                    self.assertEqual(target.read_bytes(), b"old")
                self.expect_refusal(run("info", source, stdout=stream), 3, "standard output")
                self.expect_refusal(run("methods", stdout=stream), 3, "standard output")
                self.assertEqual(run("detect", source, "-o", target, "--quiet", stdout=stream).returncode, 0)
                target.write_bytes(b"old")
        self.assertEqual(self.names(), ["cube.ply", "out.ply"])

    def test_notes_that_nobody_reads_do_no_harm(self):
        self.assertEqual(run("detect", self.cube(500), "-o", self.path("labelled.ply")).returncode, 0)
        with open("/dev/full", "w") as full:
            code = subprocess.run([PROGRAM, "detect", str(self.path("labelled.ply")), "-o", str(self.path("out.ply"))],
                                  stdout=subprocess.DEVNULL, stderr=full, timeout=60).returncode
        self.assertEqual(code, 0)


if __name__ == "__main__":
    unittest.main()
