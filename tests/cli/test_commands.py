"""The command line as others rely on it."""
import json
import os
import pty
import signal
import subprocess
import time
import unittest

from keenline_program import PROGRAM, FolderTest, ply_bytes, read_csv, run, run_json


class Detect(FolderTest):
    def test_csv_has_the_labels_and_every_input_attribute(self):
        source = self.cube()
        self.assertEqual(run("detect", source, "-o", self.path("out.csv")).returncode, 0)
        columns = read_csv(self.path("out.csv"))
        self.assertEqual(list(columns), ["x", "y", "z", "truth_feature", "truth_kind", "truth_distance",
                                         "feature", "kind", "score", "clusters"])
        self.assertEqual({len(c) for c in columns.values()}, {2000})
        for feature, kind in zip(columns["feature"], columns["kind"]):
            self.assertEqual(feature, 1.0 if kind in (2, 3, 4) else 0.0)

    def test_json_is_one_object_with_everything_promised(self):
        report = run_json("detect", self.cube(), "-o", self.path("out.ply"), "--sigma", "25")
        for key in ("input", "points", "finite_points", "method", "options", "counts", "feature_points", "timings_s", "peak_memory_bytes"):
            self.assertIn(key, report)
        self.assertEqual(report["points"], 2000)
        self.assertEqual(report["method"], "gauss")
        self.assertEqual(report["options"], {"neighbors": 16, "sigma": 25, "min-cluster": "auto", "max-clusters": "auto",
                                             "min-sine": 0.001, "triangles": "auto", "persistence": "auto", "scales": 1, "min-support": 1, "thin": True, "plain": False, "spectrum": False})
        self.assertEqual(set(report["timings_s"]), {"read", "neighborhoods", "smooth", "detect", "write", "total"})
        self.assertEqual(sum(report["counts"].values()), 2000)
        self.assertEqual(report["counts"]["edge"] + report["counts"]["corner"] + report["counts"]["peak"], report["feature_points"])
        self.assertGreater(report["peak_memory_bytes"], 1_000_000)

    def test_sigma_auto_reports_what_was_chosen(self):
        report = run_json("detect", self.cube(), "-o", self.path("out.ply"), "--sigma", "auto")
        self.assertGreater(report["options"]["sigma"], 0)
        self.assertLessEqual(report["options"]["sigma"], 90)

    def test_plain_is_the_paper_without_refinements(self):
        source = self.cube(2000, "noisy.ply", "--noise", "0.05h")
        def labels(*arguments):
            self.assertEqual(run("detect", source, "-o", self.path("out.ply"), *arguments).returncode, 0)
            return self.path("out.ply").read_bytes()
        self.assertEqual(labels("--plain"), labels("--plain", "--no-thin", "--persistence", "7"))
        self.assertEqual(labels("--plain"), labels("--plain", "--sigma", "20", "--max-clusters", "4", "--min-cluster", "auto"))
        self.assertNotEqual(labels("--plain"), labels())

    def test_same_bytes_for_any_number_of_threads_and_every_time(self):
        source = self.cube(5000, "noisy.ply", "--noise", "0.05h")
        for extension in ("ply", "csv"):
            outputs = []
            for threads in ("1", "8", "8", "3"):
                path = self.path(f"out-{len(outputs)}.{extension}")
                self.assertEqual(run("detect", source, "-o", path, "--threads", threads).returncode, 0)
                outputs.append(path.read_bytes())
            self.assertEqual(len(set(outputs)), 1)

    def test_quiet_says_nothing(self):
        result = run("detect", self.cube(), "-o", self.path("out.ply"), "--quiet")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_summary_names_counts_and_result(self):
        result = run("detect", self.cube(), "-o", self.path("out.ply"))
        self.assertIn("2,000 points", result.stdout)
        self.assertIn("edge", result.stdout)
        self.assertIn("out.ply", result.stdout)
        self.assertEqual(result.stderr, "")


class WrongUsage(FolderTest):
    def test_exit_2_with_the_allowed_range(self):
        source = self.cube(100)
        cases = [
            (["--neighbors", "2"], "3 to 255"), (["--neighbors", "256"], "3 to 255"), (["--neighbors", "x"], "3 to 255"),
            (["--sigma", "0"], "up to 90"), (["--sigma", "-5"], "up to 90"), (["--sigma", "90.5"], "up to 90"),
            (["--sigma", "nan"], "up to 90"), (["--sigma", "wide"], "auto"), (["--min-cluster", "0"], "from 1"),
            (["--max-clusters", "1"], "2 to 255"), (["--min-sine", "2"], "0 to 1"), (["--threads", "-1"], "1024"),
            (["--threads", "many"], "many"), (["--method", "magic"], "gauss"), (["--persistence", "0.5"], "from 1 to 90"),
            (["--colour"], "colour"), (["another-file"], "another-file"),
        ]
        for arguments, part in cases:
            with self.subTest(arguments=arguments):
                self.expect_refusal(run("detect", source, "-o", self.path("out.ply"), *arguments), 2, part)
        self.assertEqual(self.names(), ["cube.ply"])

    def test_missing_and_unknown_words(self):
        self.expect_refusal(run(), 2)
        self.expect_refusal(run("detekt"), 2, "detekt")
        self.expect_refusal(run("detect"), 2)
        self.expect_refusal(run("detect", self.cube(100)), 2, "--output")
        self.expect_refusal(run("detect", self.path("cube.ply"), "-o", self.path("out.txt")), 2, ".ply or .csv")
        self.expect_refusal(run("synth", "teapot", "-o", self.path("out.ply")), 2, "teapot")
        self.expect_refusal(run("synth", "cube", "-o", self.path("out.ply"), "--noise", "1parsec"), 2, "parsec")
        self.expect_refusal(run("synth", "cube", "-o", self.path("out.ply"), "--sampling", "dense"), 2, "dense")
        self.expect_refusal(run("synth", "cube", "-o", self.path("out.ply"), "--points", "0"), 2, "points")

    def test_the_input_is_never_the_output(self):
        source = self.cube(100)
        before = source.read_bytes()
        self.expect_refusal(run("detect", source, "-o", source), 2, "is the input")
        self.assertEqual(source.read_bytes(), before)

    def test_help_and_version(self):
        for arguments in (["--help"], ["detect", "--help"], ["synth", "--help"], ["evaluate", "--help"], ["--version"]):
            result = run(*arguments)
            self.assertEqual((result.returncode, result.stderr), (0, ""), arguments)
        self.assertRegex(run("--version").stdout, r"^keenline \d+\.\d+\.\d+ \(\w+\)\n$")
        self.assertIn("icosahedron", run("synth", "--help").stdout)


class Outputs(FolderTest):
    def test_exit_3_when_the_output_cannot_be_written(self):
        source = self.cube(100)
        for target in ("no/such/folder/out.ply", "/proc/out.ply", "/dev/full/out.ply"):
            with self.subTest(target=target):
                self.expect_refusal(run("detect", source, "-o", self.path(target)), 3, "out.ply")
        (self.folder / "folder.ply").mkdir()
        self.expect_refusal(run("detect", source, "-o", self.path("folder.ply")), 3, "is a folder")

    def test_exit_3_on_a_full_disk_and_nothing_is_left(self):
        source = self.cube(5000)
        limited = ["bash", "-c", 'ulimit -f 8; exec "$@"', "-", PROGRAM, "detect", str(source), "-o", str(self.path("out.ply"))]
        result = subprocess.run(limited, capture_output=True, text=True)
        self.expect_refusal(result, 3, "out.ply")
        self.assertEqual(self.names(), ["cube.ply"])

    def test_an_old_result_stays_when_the_new_one_fails(self):
        old = self.write("out.csv", "old")
        bad = self.write("bad.xyz", "1 2 3\n4 5\n")
        self.expect_refusal(run("detect", bad, "-o", old), 1, "line 2")
        self.assertEqual(old.read_bytes(), b"old")

    def test_stdout_that_cannot_be_written_is_an_error(self):
        with open("/dev/full", "w") as full:
            result = run("info", self.cube(100), stdout=full)
        self.expect_refusal(result, 3, "standard output")


class Interruption(FolderTest):
    def test_ctrl_c_and_termination_stop_within_a_second_and_leave_nothing(self):
        source = self.cube(300000, "large.ply", "--noise", "0.1h")
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            for delay in (0.02, 0.1, 0.6):
                process = subprocess.Popen([PROGRAM, "detect", str(source), "-o", str(self.path("out.ply"))],
                                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                time.sleep(delay)
                process.send_signal(number)
                start = time.monotonic()
                _, errors = process.communicate(timeout=30)
                elapsed = time.monotonic() - start
                with self.subTest(signal=number, delay=delay):
                    # Before the handlers are in place (the first milliseconds) the signal ends the program as always.
                    self.assertIn(process.returncode, (code, -number), errors)
                    self.assertEqual(self.names(), ["large.ply"])
                    # A second on an idle machine.
                    self.assertLess(elapsed, 5 if "asan" not in os.environ.get("KEENLINE_BUILD_DIR", "") else 30)

    def test_progress_is_drawn_on_a_terminal_only(self):
        source = self.cube(100000, "large.ply", "--noise", "0.1h")
        leader, follower = pty.openpty()
        process = subprocess.Popen([PROGRAM, "detect", str(source), "-o", str(self.path("out.ply"))],
                                   stdout=subprocess.DEVNULL, stderr=follower)
        os.close(follower)
        drawn = b""
        while True:
            try:
                part = os.read(leader, 4096)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            drawn += part
        os.close(leader)
        self.assertEqual(process.wait(), 0)
        self.assertIn(b"%", drawn)
        self.assertIn(b"gauss", drawn)


class Others(FolderTest):
    def test_info_tells_what_was_understood(self):
        path = self.write("a b.CSV", "\ufeffx;y;z;class\r\n# comment\r\n1;2;3;7\r\n4;5;nan;8\r\n")
        info = run_json("info", path)
        self.assertEqual((info["format"], info["points"], info["finite_points"]), ("xyz", 2, 1))
        self.assertEqual([a["name"] for a in info["attributes"]], ["class"])
        self.assertEqual(info["bounding_box"], {"min": [1, 2, 3], "max": [1, 2, 3]})
        self.assertIn("2 points, 1 of them finite", run("info", path).stdout)

    def test_methods_lists_gauss_with_its_options_and_the_tracers(self):
        listing = run_json("methods")
        gauss = listing["methods"][0]
        self.assertEqual(gauss["name"], "gauss")
        self.assertEqual([o["name"] for o in gauss["options"]],
                         ["neighbors", "scales", "sigma", "min-cluster", "max-clusters", "min-sine", "triangles", "persistence", "min-support", "thin", "plain", "spectrum"])
        text = run("methods").stdout
        self.assertIn("Weber", text)
        self.assertEqual(listing["tracers"][0]["name"], "walk")
        for tracer in listing["tracers"]:
            self.assertIn(f"\n{tracer['name']}  {tracer['summary']}\n", text)
            self.assertIn(tracer["paper"], text)
        # The list is that of --trace.
        names = ", ".join(tracer["name"] for tracer in listing["tracers"])
        self.expect_refusal(run("lines", self.write("one.csv", "x,y,z\n1,2,3\n"), "-o", self.path("out.dxf"), "--trace", "magic"), 2, names)

    def test_synth_writes_truth_and_repeats_itself(self):
        for name in ("a.ply", "b.ply"):
            result = run("synth", "cone", "-o", self.path(name), "--points", 3000, "--seed", 5, "--noise", "0.02bbox", "--angle", "90")
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.path("a.ply").read_bytes(), self.path("b.ply").read_bytes())
        names = [a["name"] for a in run_json("info", self.path("a.ply"))["attributes"]]
        self.assertEqual(names, ["truth_feature", "truth_kind", "truth_distance"])

    def test_evaluate_prints_the_measures(self):
        # 3 true positives, 1 false positive, 2 false negatives, 4 true negatives
        rows = [(1, 1)] * 3 + [(1, 0)] + [(0, 1)] * 2 + [(0, 0)] * 4
        text = "x,y,z,feature,truth\n" + "".join(f"{i},0,0,{f},{t}\n" for i, (f, t) in enumerate(rows))
        path = self.write("labels.csv", text)
        result = run_json("evaluate", path, path)
        self.assertEqual(len(result["files"]), 2)
        for scores in (result["files"][0], result["macro_mean"], result["median"], result["micro"]):
            self.assertAlmostEqual(scores["precision"], 3 / 4)
            self.assertAlmostEqual(scores["recall"], 3 / 5)
            self.assertAlmostEqual(scores["f1"], 2 / 3)
            self.assertAlmostEqual(scores["iou"], 1 / 2)
            self.assertAlmostEqual(scores["mcc"], (3 * 4 - 1 * 2) / (4 * 5 * 5 * 6) ** 0.5)
        self.assertIn("0.667", run("evaluate", path).stdout)

    def test_evaluate_takes_truth_from_another_file(self):
        prediction = self.write("p.csv", "x,y,z,feature\n0,0,0,1\n1,0,0,0\n")
        truth = self.write("t.csv", "x,y,z,truth_feature\n0,0,0,1\n1,0,0,0\n")
        self.assertEqual(run_json("evaluate", prediction, "--truth", truth)["micro"]["f1"], 1)
        self.expect_refusal(run("evaluate", prediction), 1, "p.csv", "truth")
        self.expect_refusal(run("evaluate", truth), 1, "t.csv", "feature")
        shorter = self.write("s.csv", "x,y,z,truth\n0,0,0,1\n")
        self.expect_refusal(run("evaluate", prediction, "--truth", shorter), 1, "2", "1")

    def test_kinds_are_counted_by_truth_and_found(self):
        path = self.write("k.csv", "x,y,z,kind,truth_kind\n0,0,0,2,2\n0,0,1,3,2\n0,1,1,0,5\n")
        report = run_json("evaluate", path, path, "--kinds")
        self.assertEqual(report["files"], [str(path)] * 2)
        counts = {(truth, found): n for truth, row in report["kinds"].items() for found, n in row.items() if n}
        self.assertEqual(counts, {("edge", "edge"): 2, ("edge", "corner"): 2, ("border", "flat"): 2})
        table = [line.split() for line in run("evaluate", path, "--kinds").stdout.splitlines()]
        self.assertIn(["edge", "0", "0", "1", "1", "0", "0", "0"], table)
        self.expect_refusal(run("evaluate", self.cube(100), "--kinds"), 1, "cube.ply", "kind")
        self.expect_refusal(run("evaluate", self.write("9.csv", "x,y,z,kind,truth_kind\n0,0,0,9,2\n"), "--kinds"), 1, "9.csv", "kind")


if __name__ == "__main__":
    unittest.main()
