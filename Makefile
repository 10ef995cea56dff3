# Two commands matter: `make demo` makes a collage into out/, `make test` checks everything.

ifeq ($(OS),Windows_NT)
PYTHON ?= python
BIN := .venv/Scripts
LOWEST_BIN := .lowest/Scripts
else
PYTHON ?= python3
BIN := .venv/bin
LOWEST_BIN := .lowest/bin
endif

# Python keeps what it has read of the sources, whatever is set around: each process that a test
# starts would read all of them.
export PYTHONDONTWRITEBYTECODE :=

# As in the program itself: threads of linear algebra wait for work by keeping a core busy, which
# other workers need.
export OPENBLAS_NUM_THREADS := 1

.PHONY: demo gallery figures site check-site setup-browser setup-jupyter setup-page check-page test test-lowest check format clean

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

# Links, the size of the first page, and axe-core where make setup-page has fetched it.
check-site: .venv/installed-dev
	$(BIN)/python tools/check_site.py

# A Chromium for the studio's tests in a browser; without one they are skipped. Debian and Ubuntu.
setup-browser:
	command -v chromium || apt-get install --yes --no-install-recommends chromium

# JupyterLab, for the test of the canvas in a real notebook; without it that is skipped.
setup-jupyter: .venv/installed-dev
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -e ".[notebook]" "jupyterlab>=4.2"

# What checks the studio's page in development, with Node: types, and axe-core for the tests.
PAGE_TOOLS := typescript@7 axe-core@4

setup-page:
	npm install --silent --no-audit --no-fund --no-save --prefix .page $(PAGE_TOOLS)

check-page: setup-page
	.page/node_modules/.bin/tsc -p tools/page

test: .venv/installed-dev
	$(BIN)/ruff format --check src tests benchmarks examples tools
	$(BIN)/ruff check src tests benchmarks examples tools
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python -m pytest -q -n auto --dist worksteal
	NUMBA_DISABLE_JIT=1 $(BIN)/python -m pytest -q -n auto --dist worksteal -m "not compiled" \
	  tests/raster tests/losses tests/fields

# What reads, draws, asks and writes, with the lowest version of each dependency. Old libraries
# warn of each other's ways.
LOWEST := tests/readers tests/writers tests/display tests/recipe tests/scene tests/geometry \
  tests/cli/test_help.py tests/cli/test_usage.py tests/cli/test_bad_input.py tests/test_api.py \
  tests/test_api_values.py tests/test_errors.py tests/typed

test-lowest: .lowest/installed
	$(LOWEST_BIN)/python -m pytest -q -n auto --dist worksteal -W ignore::DeprecationWarning $(LOWEST)

.lowest/installed: pyproject.toml
	$(PYTHON) -c "import sys; sys.exit(sys.version_info[:2] != (3, 11) and 'The lowest versions are those of Python 3.11: make test-lowest PYTHON=python3.11')"
	$(PYTHON) -m venv .lowest
	$(LOWEST_BIN)/python -m pip install --quiet --disable-pip-version-check uv
	$(LOWEST_BIN)/uv pip install --quiet --python .lowest --resolution lowest-direct --only-binary :all: -r pyproject.toml --extra dev
	$(LOWEST_BIN)/uv pip install --quiet --python .lowest --no-deps -e .
	touch .lowest/installed

check: test

format: .venv/installed-dev
	$(BIN)/ruff format src tests benchmarks examples tools
	$(BIN)/ruff check --fix src tests benchmarks examples tools

clean:
	rm -rf .venv .lowest out build dist .pytest_cache .mypy_cache .ruff_cache

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
