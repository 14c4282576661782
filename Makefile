# A thin front to CMakePresets.json: `make` lists what there is. Every target first sees to the packages.
JOBS ?= $(shell nproc)
PREFIX ?= /usr/local
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(JOBS)

.DEFAULT_GOAL := help
.PHONY: help setup build play demo test soak web web-serve web-test web-bench npm web-examples bench peers savings report docs package install format tidy clean FORCE

help: ## this list
	@echo "gnomon: exact hard shadows. Targets:"
	@sed -nE 's/^([a-z-]+):.*## (.*)/  make \1\t\2/p' Makefile | expand -t 18

setup: ## install the packages that are missing (Debian 12)
	@scripts/setup

# The script touches its stamp only when it had to look, so that nothing is configured again without a reason.
build/.setup: FORCE
	@scripts/setup

# Ninja configures again by itself when a CMakeLists.txt changes; the presets and the packages are not its business.
build/build.ninja: CMakePresets.json build/.setup
	@cmake --preset release
	@touch $@

build/%/build.ninja: CMakePresets.json build/.setup
	@cmake --preset $*
	@touch $@

build: build/build.ninja ## libraries, programs and examples; programs lie in build/bin
	@cmake --build build --target modules/all backends/all apps/all examples/all

play: build ## play the game in a window
	@build/bin/gnomon-game $(PLAY_OPTIONS)

demo: build ## draw the demonstration pictures
	@scripts/demo

# All suites run whatever becomes of the first, and the closing line is the main suite's.
test: build/build.ninja build/asan/build.ninja ## build and run all tests, under ASan and UBSan too, and fuzz for half a minute a target
	@cmake --build --preset release
	@cmake --build --preset asan
	@status=0; \
	JOBS=$(JOBS) scripts/fuzz || status=$$?; \
	ctest --preset asan -j$(JOBS) || status=$$?; \
	ctest --preset release -j$(JOBS) || status=$$?; \
	[ $$status -eq 0 ] || echo "make test: a test failed, see above"; \
	exit $$status

soak: build/build.ninja build/asan-full/build.ninja build/tsan/build.ninja ## the long tests, every sanitizer, and an hour of fuzzing
	@scripts/setup --soak
	@cmake --build --preset release
	@ctest --preset soak
	@cmake --build --preset asan-full
	@ctest --preset asan-full -j$(JOBS)
	@cmake --build --preset tsan
	@ctest --preset tsan -j$(JOBS)
	@JOBS=$(JOBS) scripts/fuzz 720

# Emscripten and the browser are in no other build's way.
build/web/build.ninja: CMakePresets.json
	@scripts/setup --web
	@cmake --preset web
	@touch $@

web: build/web/build.ninja ## viewer and game as pages, by Emscripten: build/web/site, to be served
	@cmake --build build/web --target gnomon_web gnomon_web_game
	@echo "pages: build/web/site; make web-serve shows it on http://127.0.0.1:8080/"

web-serve: web ## serve the page on this machine's loopback until interrupted
	@node tests/web/server.mjs build/web/site 8080

npm: build/web/build.ninja ## the package for pages with a WebGPU renderer of their own: build/web/npm, for `npm pack`
	@cmake --build build/web --target gnomon_npm
	@echo "package: build/web/npm; cd there and npm pack"

web-examples: npm ## serve the package's examples on this machine's loopback until interrupted
	@[ -d build/web/examples/node_modules/three ] || echo "three/ needs three.js: npm install --prefix build/web/examples"
	@node tests/web/server.mjs build/web/examples 8080

# The browser draws first; then what it drew is judged by the tests of the ordinary build.
web-test: build/web/build.ninja build/build.ninja ## the tests in a real browser, and its masks against Vulkan's and the truth
	@cmake --build build/web
	@ctest --preset web
	@cmake --build build --target test_web_masks
	@GNOMON_WEB_MASKS=$(CURDIR)/build/web/masks.bin ctest --test-dir build -R '^web_masks$$' --output-on-failure

# Rounds of the comparison of frames in a browser with native ones.
WEB_ROUNDS ?= 7

web-bench: web build ## frames in a browser against native ones, and the page's size: bench/results/web.json and its tables
	@cmake --build build/web --target gnomon-frame-times
	@cmake --build build --target gnomon-frame-times
	@bench/web/gnomon-web-frames --program build/bin/gnomon-frame-times --web build/web/bin --site build/web/site \
		--rounds $(WEB_ROUNDS) --out bench/results/web.json
	@scripts/performance-tables --web bench/results/web.json --document docs/performance.md

# How long the strategies are compared; all the rest takes some minutes more.
BENCH_SECONDS ?= 240

bench: build ## run the benchmarks, and write bench/results/*.json and the tables of docs/performance.md
	@build/bin/gnomon-bench --paired --seconds $(BENCH_SECONDS) --out bench/results/strategies.json
	@build/bin/gnomon-bench --benchmark_min_time=0.05 --benchmark_out=build/bench.json --benchmark_out_format=json
	@scripts/performance-tables bench/results/strategies.json --micro build/bench.json \
		--micro-out bench/results/functions.json --document docs/performance.md

# Rounds of the comparison. Fewer for a first look: where the processor draws, some frames take seconds.
PEERS_ROUNDS ?= 9

peers: build/build.ninja ## compare with OGRE's and Irrlicht's shadows, and write bench/results/peers.json and its tables
	@scripts/setup --peers
	@cmake --preset release
	@cmake --build build --target peers
	@bench/peers/gnomon-peers --programs build/bin --rounds $(PEERS_ROUNDS) --out bench/results/peers.json --pictures build/peers
	@scripts/performance-tables --peers bench/results/peers.json --document docs/performance.md

savings: build ## measure what each saving of fill saves, and write bench/results/savings.json and its table
	@bench/savings/gnomon-savings --program build/bin/gnomon --models ../shared/models --out bench/results/savings.json
	@scripts/performance-tables --savings bench/results/savings.json --document docs/performance.md

report: build ## speed against error of every technique: build/report/report.html and the tables of docs/speed-and-error.md
	@build/bin/gnomon report --out build/report $(REPORT_OPTIONS)
	@scripts/report-tables build/report/report.json --document docs/speed-and-error.md
	@plot=build/report/plots/linz-old-town.gl.png; [ ! -f $$plot ] || cp $$plot docs/images/speed-and-error.png

docs: build/.setup ## the documentation site, guides and reference: build/docs/html/index.html
	@scripts/site build/docs
	@echo "site: build/docs/html/index.html"

package: build ## Debian packages, in build/packages
	@cd build && cpack -B packages

install: build ## install under PREFIX (DESTDIR is respected)
	@cmake --install build --prefix $(PREFIX)

SOURCES = $(shell git ls-files '*.cpp' '*.hpp')

format: ## run clang-format over every source
	@scripts/setup --tools
	@clang-format -i $(SOURCES)

tidy: build/build.ninja ## run clang-tidy over the libraries and programs
	@scripts/setup --tools
	@cmake --build build --target modules/all backends/all apps/all examples/all
	@run-clang-tidy -quiet -p build -j $(JOBS) "$(CURDIR)/(modules|backends|apps|examples)/.*"

clean: ## remove everything that was built
	@rm -rf build
