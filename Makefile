# One entry per chore, the same here and in CI.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMPS := .stamps
export CARGO_TERM_COLOR ?= never
export PIP_DISABLE_PIP_VERSION_CHECK := 1
export PIP_QUIET := 1

RUST_SOURCES := $(shell find crates -name '*.rs' -o -name Cargo.toml) Cargo.toml
ASSET_SOURCES := $(shell find tools/assets -name '*.py' 2>/dev/null)

.PHONY: help setup core assets demo test test-full test-lowest lint fmt bench eval docs pictures clean
help: ## what can be made
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14

setup: $(STAMPS)/core $(STAMPS)/assets $(STAMPS)/node ## virtual environment, compiled core, built assets, web tools
core: $(STAMPS)/core ## virtual environment and compiled core
assets: $(STAMPS)/assets ## head model and networks, from the two wheels they come in

$(STAMPS)/venv: pyproject.toml
	@mkdir -p $(STAMPS)
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install -q 'maturin>=1.9,<2'
	$(BIN)/python tools/requirements.py dev docs > $(STAMPS)/requirements.txt
	$(BIN)/python -m pip install -q -r $(STAMPS)/requirements.txt
	touch $@

$(STAMPS)/core: $(STAMPS)/venv $(RUST_SOURCES)
	VIRTUAL_ENV=$(CURDIR)/$(VENV) $(BIN)/maturin develop --release --quiet
	touch $@

$(STAMPS)/assets: $(ASSET_SOURCES) | $(STAMPS)/core
	$(BIN)/python -m tools.assets
	touch $@

$(STAMPS)/node: tests/web/package.json tests/web/package-lock.json
	@mkdir -p $(STAMPS)
	cd tests/web && npm ci --no-audit --no-fund --silent
	touch $@

test: setup ## every test but the slow walks, in every language
	PROPTEST_RNG_SEED=1 cargo test --release --workspace --quiet
	$(BIN)/python -m pytest -m "not slow"

test-full: setup ## every test, slow walks too, on examples drawn anew
	cargo test --release --workspace --quiet
	$(BIN)/python -m pytest --hypothesis-profile default

lint: $(STAMPS)/venv ## format, lint, types, directions of imports
	cargo fmt --all --check
	cargo clippy --release --workspace --all-targets --quiet -- -D warnings
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(MAKE) core
	$(BIN)/pyright
	$(BIN)/lint-imports

fmt: $(STAMPS)/venv ## format everything
	cargo fmt --all
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean: ## remove what was built
	rm -rf $(VENV) .venv-lowest $(STAMPS) target out site python/tress/head/data python/tress/_core*.so

test-lowest: setup ## the Python tests against the lower bounds of the requirements
	test -x .venv-lowest/bin/python || $(PYTHON) -m venv .venv-lowest
	$(BIN)/python tools/requirements.py --lowest > $(STAMPS)/lowest.txt
	.venv-lowest/bin/python -m pip install -q -r $(STAMPS)/lowest.txt 'pytest>=8.2' 'hypothesis>=6.100' 'pymatting>=1.1.12' 'rhino3dm>=8.17'
	PYTHONPATH=python .venv-lowest/bin/python -m pytest -m "not slow"

bench: setup ## speed, as ratios against public references in the same run
	$(BIN)/python -m benches

eval: setup ## quality on the open data
	$(BIN)/python -m benches.eval

demo: setup ## the main job on a real photograph, into out/demo/
	$(BIN)/python examples/portrait_astronaut.py out/demo

docs: setup ## the documentation, into site/
	$(BIN)/python -m tools.parameters_page
	$(BIN)/mkdocs build --quiet

pictures: setup ## the pictures of README and documentation anew
	$(BIN)/python -m tools.pictures
