# The two commands are `make forest` and `make test`; `make` alone lists the others.
# PRESET=release|debug|ci|asan|tsan chooses the build (CMakePresets.json), JOBS the number of
# parallel jobs; INSTALL=no keeps hands off the system's packages.
SHELL := /bin/bash
.DEFAULT_GOAL := help
MAKEFLAGS += --no-print-directory

PRESET ?= release
JOBS ?= $(shell nproc)
INSTALL ?= yes
BENCH ?= OFF
TIDY_SECONDS ?= 0
FUZZ_SECONDS ?= 60
SIZE ?= 200x112

BUILD := build/$(PRESET)
WOLD := $(BUILD)/bin/wold

# $(call install,GROUPS): installs what is missing of these groups of packages.
install = $(if $(filter no,$(INSTALL)),true,tools/install_dependencies $(1))

.PHONY: forest program test check format tidy includes bench measures fuzz docs clean help

forest: program ## install what is missing, build, render scenes/forest.toml to out/forest.png
	@mkdir -p out
	@echo "Rendering scenes/forest.toml: about a minute on 2 cores."
	@$(WOLD) render scenes/forest.toml -o out/forest.exr -o out/forest.png
	@echo "Done. The picture is out/forest.png; with all its light and layers, out/forest.exr."

program: ## install what is missing, build the program wold
	@$(call install,build)
	@test -f $(BUILD)/build.ninja || { echo "Configuring in $(BUILD)." && \
	  cmake --preset $(PRESET) -DWOLD_TESTS=OFF -DWOLD_BENCH=OFF --log-level=NOTICE; }
	@echo "Building $(WOLD): some minutes the first time."
	@cmake --build $(BUILD) --target wold --parallel $(JOBS)

test: ## install what is missing, build, run all tests (BENCH=ON builds the benchmarks as well)
	@$(call install,build test)
	@echo "Configuring in $(BUILD), with tests."
	@cmake --preset $(PRESET) -DWOLD_TESTS=ON -DWOLD_BENCH=$(BENCH) --log-level=NOTICE
	@echo "Building the program and its tests: some minutes the first time."
	@cmake --build $(BUILD) --parallel $(JOBS)
	@echo "Testing."
	@ctest --test-dir $(BUILD) --parallel $(JOBS) --output-on-failure --no-tests=error --timeout 300

check: includes format tidy ## all checks of the source: includes, format, tidy

includes: ## check that no room includes one above it, and a few other rules
	@$(call install,test)
	@tools/check_includes

format: ## check the layout of the source (tools/check_format --fix mends it)
	@$(call install,check)
	@tools/check_format

tidy: ## lint with clang-tidy (TIDY_SECONDS=N: stop after N seconds)
	@$(call install,build test check)
	@cmake --preset $(PRESET) -DWOLD_TESTS=ON -DWOLD_BENCH=ON --log-level=NOTICE >/dev/null
	@tools/check_tidy --build $(BUILD) --seconds $(TIDY_SECONDS) --jobs $(JOBS)

bench: ## build and run the benchmarks, write docs/benchmarks.md
	@$(call install,build test)
	@cmake --preset $(PRESET) -DWOLD_BENCH=ON --log-level=NOTICE
	@cmake --build $(BUILD) --parallel $(JOBS)
	@tools/run_benchmarks $(BUILD)/bin

measures: ## measure the landscape shader anew into docs/realtime.md (SIZE=WxH: of its pictures)
	@$(call install,build test)
	@cmake --preset $(PRESET) -DWOLD_BENCH=ON --log-level=NOTICE
	@cmake --build $(BUILD) --target realtime_measures --parallel $(JOBS)
	@echo "Measuring: about 5 minutes without a graphics card."
	@$(BUILD)/bin/realtime_measures docs/realtime.md --size $(SIZE)

fuzz: ## feed the readers of files with what no file should hold (FUZZ_SECONDS=N for each)
	@$(call install,build fuzz)
	@cmake --preset fuzz --log-level=NOTICE
	@cmake --build build/fuzz --target fuzz_targets --parallel $(JOBS)
	@tools/run_fuzz build/fuzz $(FUZZ_SECONDS)

docs: program ## write docs/reference and the schema of scene files, from the program
	@tools/make_docs $(WOLD)

clean: ## remove build/ and out/
	rm -rf build out

help: ## this list
	@echo "wold: grows a landscape from a text file and shows it. Commands:"
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/\1\t\2/p' Makefile | while IFS=$$'\t' read -r name text; do \
	  printf '  make %-10s%s\n' "$$name" "$$text"; done
