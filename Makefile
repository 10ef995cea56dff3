# Two commands matter: `make demo` makes a collage into out/, `make test` checks everything.

ifeq ($(OS),Windows_NT)
PYTHON ?= python
BIN := .venv/Scripts
else
PYTHON ?= python3
BIN := .venv/bin
endif

.PHONY: demo gallery figures site test check format clean

demo: .venv/installed
	$(BIN)/packwork demo

gallery: .venv/installed
	$(BIN)/python examples/gallery.py

figures: .venv/installed
	$(BIN)/python tools/draw_figures.py
	$(BIN)/python tools/draw_tutorial.py

site: .venv/installed
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[docs]"
	$(BIN)/python tools/build_site.py

test: .venv/installed-dev
	$(BIN)/ruff format --check src tests benchmarks examples tools
	$(BIN)/ruff check src tests benchmarks examples tools
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python -m pytest -q -n auto
	NUMBA_DISABLE_JIT=1 $(BIN)/python -m pytest -q -n auto tests/raster tests/losses tests/fields

check: test

format: .venv/installed-dev
	$(BIN)/ruff format src tests benchmarks examples tools
	$(BIN)/ruff check --fix src tests benchmarks examples tools

clean:
	rm -rf .venv out build dist .pytest_cache .mypy_cache .ruff_cache

.venv/python:
	$(PYTHON) -c "import sys; sys.exit(sys.version_info < (3, 11) and 'Packwork needs Python 3.11 or newer; this is ' + sys.version)"
	$(PYTHON) -m venv .venv
	touch .venv/python

.venv/installed: .venv/python pyproject.toml
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e .
	touch .venv/installed

.venv/installed-dev: .venv/python pyproject.toml
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[dev]"
	touch .venv/installed .venv/installed-dev
