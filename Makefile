# A thin front end to CMake's presets and to scripts/. `make` alone lists the targets.
BUILD := build/release
FUZZ_SECONDS ?= 60

.PHONY: help deps build demo web web-tool python windows test test-long test-arm test-windows test-web-tool bench fuzz format clean

help:
	@echo 'make build      build the tool, build/release/sweepface'
	@echo 'make demo       install what is missing, build, and show the tool on a sample face'
	@echo 'make web        build the page in web/ and what it shows'
	@echo 'make web-tool   build the tool in WebAssembly, the npm package in web/tool/'
	@echo 'make python     build the package for Python'
	@echo 'make windows    build the tool and the libraries for Windows'
	@echo 'make test       install what is missing, build everything, run the tests'
	@echo 'make test-long  the long tests, the benchmarks briefly, and all tests under sanitizers and with clang'
	@echo 'make test-arm   the tests of what plays, built for 64-bit ARM and run in an emulator'
	@echo 'make test-windows   the tests but those of the tool, built for Windows and run in Wine'
	@echo 'make test-web-tool  the tests of the tool in WebAssembly'
	@echo 'make bench      build and run the benchmarks'
	@echo 'make fuzz       run each fuzz target for FUZZ_SECONDS (60)'
	@echo 'make format     format the sources'
	@echo 'make deps       only install what is missing (Debian packages)'
	@echo 'make clean      remove build/'

deps:
	scripts/install-deps

build:
	cmake --preset release
	cmake --build $(BUILD) --target sweepface examples/all

demo: deps
	$(MAKE) build
	scripts/demo

# The WebAssembly module, three.js and a sample face, beside the page.
web:
	scripts/install-deps wasm web
	cmake --preset release
	cmake --build $(BUILD) --target sample_face
	cmake --workflow --preset wasm
	web/test/install-packages
	$(BUILD)/examples/sample_face $(BUILD)/sample
	cp $(BUILD)/sample/sample.sweep web/
	@echo 'Now: python3 -m http.server --directory web, and open http://localhost:8000/'

# The module of the npm package sweepface-tool, with which the page converts models.
web-tool:
	scripts/install-deps wasm wasi
	scripts/wasi-root
	cmake --preset wasi
	cmake --build --preset wasi

python:
	scripts/install-deps python
	cmake --preset release
	cmake --build $(BUILD) --target sweepface_python
	@sed -n 's|^SWEEPFACE_PYTHON:FILEPATH=|Now: PYTHONPATH=$(BUILD)/python |p' $(BUILD)/CMakeCache.txt

windows:
	scripts/install-deps windows
	scripts/windows-root
	cmake --preset windows
	cmake --build --preset windows --target sweepface sweepface_shared sweepface_shared_clips

# What the tests with other people's tools need; without it they are skipped.
tests/web/node_modules/.package-lock.json: tests/web/package-lock.json
	scripts/install-deps wasm web || \
	  echo 'Some packages could not be installed: the tests that need them are skipped.'
	npm ci --prefix tests/web --no-audit --no-fund && touch $@ || \
	  echo 'The npm packages could not be installed: the tests that need them are skipped.'

test: deps tests/web/node_modules/.package-lock.json
	scripts/install-deps python csharp || \
	  echo 'Some packages could not be installed: the tests in Python and C# that need them are skipped.'
	cmake --preset release
	cmake --build $(BUILD)
	ctest --preset release --label-exclude '^long$$'
	@if [ -z "$$SWEEPFACE_DATA" ]; then \
	  echo 'SWEEPFACE_DATA is not set: the tests on real faces were skipped.'; fi

test-long: tests/web/node_modules/.package-lock.json
	scripts/install-deps clang blender bench
	cmake --preset release
	cmake --build $(BUILD)
	ctest --preset release --label-regex '^long$$'
	cmake --preset bench && cmake --build build/bench
	build/bench/bench/sweepface_bench --benchmark_min_time=0.01
	for preset in clang asan tsan; do \
	  cmake --preset $$preset && cmake --build build/$$preset && \
	  ctest --preset $$preset --label-exclude '^long$$' || exit 1; done

test-arm:
	scripts/install-deps arm
	scripts/arm-root
	cmake --workflow --preset arm

test-windows: windows
	cmake --build --preset windows
	ctest --preset windows

test-web-tool: web web-tool
	cmake --build $(BUILD) --target sweepface
	cd web && node --test tool/test/*.test.js

bench:
	scripts/install-deps bench
	cmake --preset bench
	cmake --build build/bench
	FACE="$(FACE)" NEUTRAL="$(NEUTRAL)" TARGETS="$(TARGETS)" TOLERANCE="$(TOLERANCE)" scripts/bench build/bench \
	  --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true

fuzz:
	scripts/install-deps clang
	cmake --preset fuzz
	cmake --build build/fuzz --target fuzzers
	fuzz/run $(FUZZ_SECONDS)

format:
	scripts/install-deps format
	scripts/format

clean:
	rm -rf build
