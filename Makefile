# make demo    set up, build, find the sharp features of a real model
# make build   set up, build the program: build/release/bin/keenline
# make test    set up, build, run the tests
# make check   the slower checks: sanitizers, fuzzing, format, lint, the installed package
# make figures   the paper's figures as PNG, in build/figures
# make bench       speed: neighbours, detection, rivals, as ratios in one run
# make benchmark   accuracy on the benchmark clouds, where they are present
# make benchmark-lines   lines against the true lines of the shapes
# make benchmark-report   what the report of a million points costs a browser

.PHONY: build demo test check figures bench benchmark benchmark-lines benchmark-report format clean
.DEFAULT_GOAL := build

build:
	scripts/setup.sh build
	cmake --preset release
	cmake --build --preset release

demo: build
	scripts/demo.sh build/release/bin/keenline build/demo

test:
	scripts/setup.sh test
	cmake --preset test
	cmake --build --preset test
	ctest --preset test

check:
	scripts/setup.sh check
	scripts/check.sh

figures: build
	scripts/setup.sh figures
	scripts/figures.sh build/release/bin/keenline build/figures
	scripts/models.sh build/models
	scripts/report_figures.sh build/release/bin/keenline build/models build/figures

bench:
	scripts/setup.sh bench
	cmake --preset bench
	cmake --build --preset bench
	build/bench/bin/keenline_bench
	build/bench/bin/neighbors_bench all
	scripts/models.sh build/models
	build/bench/bin/speed_bench 3 build/models/data/points_3/building.ply

benchmark: build
	bench/edge_benchmark.sh build/release/bin/keenline ../shared/data/edge-benchmark build/benchmark

benchmark-lines: build
	bench/lines_benchmark.sh build/release/bin/keenline build/lines

benchmark-report: build
	scripts/setup.sh figures
	bench/report_benchmark.sh build/release build/report

format:
	scripts/setup.sh check
	scripts/format.sh

clean:
	rm -rf build
