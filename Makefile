# The front door. `make demo` needs nothing but a Debian 12 with make; the rest follows from there.
# What each step took is printed behind it; a second call does only what has changed.

JOBS   ?= $(shell nproc)
PYTHON ?= /usr/bin/python3
WERROR ?= OFF
UNITY  ?= ON
PREFIX ?= /usr/local

STEP     := @tools/step
RELEASE  := build/release
TEST     := build/test
COVERAGE := build/coverage
PACKAGE  := build/package
SITE     := build/site
DEMO     := runs/flyer_al_cu

# Containers run as root and on fewer cores than ranks.
export OMPI_ALLOW_RUN_AS_ROOT = 1
export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM = 1

.PHONY: help build demo install deb test layers unit-tests coverage bench docs site format clean packages packages-test

help:
	@echo "make demo     install what is missing, build for this machine, run the flyer plate, draw its gauge"
	@echo "make install  copy the program, its data, manual page and Python package to PREFIX ($(PREFIX)); DESTDIR is obeyed"
	@echo "make deb      make Debian packages in $(PACKAGE)/"
	@echo "make test     build a portable binary, run the quick tests, check the layers and sizes of the source"
	@echo "make coverage run the tests and count the lines that they reach; results in $(COVERAGE)/coverage.json"
	@echo "make bench    build and run the timed kernels; results in build/bench.json"
	@echo "make docs     write docs/reference/ from the program's own registry of keys"
	@echo "make site     make a site of docs/: $(SITE)/html/index.html"
	@echo "make format   bring the C++ files into the form of .clang-format"
	@echo "make clean    remove build/ (runs/ stays)"

packages:
	$(STEP) "Debian packages to build and run" tools/install_packages build

packages-test:
	$(STEP) "Debian packages to build, run and test" tools/install_packages build test

build: packages
	$(STEP) "Configure $(RELEASE)" tools/configure $(RELEASE)
	$(STEP) "Build the program for this machine (some minutes the first time)" \
	  cmake --build $(RELEASE) -j $(JOBS) --target recoil

demo: build
	$(STEP) "Run an aluminium flyer against a copper target at 450 m/s" \
	  $(RELEASE)/recoil run cases/flyer_al_cu/case.toml -o $(DEMO) --force
	$(STEP) "Draw the velocity of the target's rear surface" \
	  $(RELEASE)/recoil plot $(DEMO) gauge.rear $(DEMO)/rear.png
	@echo
	@test ! -f $(DEMO)/report.html || echo "report    $(DEMO)/report.html"  # none where npm could not build the page
	@echo "results   $(DEMO)/"
	@echo "picture   $(DEMO)/rear.png"
	@echo "program   $(RELEASE)/recoil --help"

install: build
	$(STEP) "Install below $(DESTDIR)$(PREFIX)" sh -c 'cmake --install $(RELEASE) --prefix "$(PREFIX)" > $(RELEASE)/install.log'

deb: packages
	$(STEP) "Debian packages to make packages" tools/install_packages deb
	$(STEP) "Configure $(PACKAGE)" tools/configure $(PACKAGE)
	$(STEP) "Build a portable program (some minutes the first time)" cmake --build $(PACKAGE) -j $(JOBS) --target recoil
	@rm -f $(PACKAGE)/*.deb
	$(STEP) "Make packages of it" sh -c 'cd $(PACKAGE) && cpack > cpack.log || { cat cpack.log >&2; exit 1; }'
	@ls $(PACKAGE)/*.deb

test: layers unit-tests

layers: packages-test
	$(STEP) "Layers of the source" $(PYTHON) -B tools/check_layers.py
	$(STEP) "The checkers themselves" $(PYTHON) -B -m unittest discover -q -s tools -p 'test_*.py'
	$(STEP) "Headers of the standard names in use" $(PYTHON) -B tools/check_includes.py
	$(STEP) "Sizes of functions, files and folders" $(PYTHON) -B tools/check_sizes.py

unit-tests: packages-test
	$(STEP) "Configure $(TEST)" tools/configure $(TEST) -DRECOIL_WERROR=$(WERROR) -DRECOIL_UNITY=$(UNITY) \
	  -DRECOIL_REPORT=ON -DRECOIL_BENCH=ON
	$(STEP) "Build a portable program and its tests (some minutes the first time)" \
	  cmake --build $(TEST) -j $(JOBS)
	$(STEP) "Quick tests" ctest --test-dir $(TEST) -j $(JOBS) -LE slow --output-on-failure --no-tests=error \
	  --progress --output-junit ctest.xml

coverage: packages-test
	$(STEP) "Configure $(COVERAGE)" tools/configure $(COVERAGE)
	$(STEP) "Build tests that count the lines they reach" cmake --build $(COVERAGE) -j $(JOBS)
	$(STEP) "Forget earlier counts" find $(COVERAGE) -name '*.gcda' -delete
	$(STEP) "Unit tests and tests of the command line" ctest --preset coverage -j $(JOBS)
	$(STEP) "Lines reached" $(PYTHON) -B tools/coverage.py $(COVERAGE) -j $(JOBS)

bench: packages-test
	$(STEP) "Configure $(RELEASE)" tools/configure $(RELEASE) -DRECOIL_BENCH=ON
	$(STEP) "Build the timed kernels" cmake --build $(RELEASE) -j $(JOBS) --target recoil_bench
	$(STEP) "Run the timed kernels" $(RELEASE)/recoil_bench --benchmark_out=build/bench.json

docs: build
	@mkdir -p docs/reference
	$(STEP) "Reference of the case file" \
	  sh -c '$(RELEASE)/recoil schema --markdown > docs/reference/case.md'
	$(STEP) "Reference of the commands" \
	  sh -c '$(RELEASE)/recoil commands > docs/reference/commands.md'
	$(STEP) "Schema of the case file, for editors" \
	  sh -c '$(RELEASE)/recoil schema > docs/reference/recoil-case-1.schema.json'

site:
	$(STEP) "Debian packages to build the site" tools/install_packages site
	$(STEP) "Documentation as a site; warnings are errors" tools/build_site $(SITE)

format:
	$(STEP) "clang-format" tools/check_format --fix

clean:
	rm -rf build
