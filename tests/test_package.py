"""What is published: its page, its licences, its commands."""

from __future__ import annotations

import ast
import os
import pickle
import re
import subprocess
import sys
import tomllib
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import packwork as pw
from packwork import writers
from packwork.installed import EXTRAS

ROOT = Path(__file__).parents[1]
ASKED: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = ASKED["project"]


def page() -> str:
    """The README as the package shows it."""
    hook = ASKED["tool"]["hatch"]["metadata"]["hooks"]["fancy-pypi-readme"]
    text = "".join((ROOT / part["path"]).read_text(encoding="utf-8") for part in hook["fragments"])
    for change in hook["substitutions"]:
        text = re.sub(change["pattern"], change["replacement"], text)
    return text


def test_the_page_leads_nowhere_but_to_addresses() -> None:
    links = re.findall(r"\]\(([^)]+)\)|(?:src|href)=\"([^\"]+)\"", page())
    assert [a or b for a, b in links if not (a or b).startswith("https://")] == []
    assert "Each leads to" not in page()


def test_the_page_keeps_its_commands() -> None:
    assert "packwork fill heart" in page()
    assert "import packwork as pw" in page()


def test_the_licence_of_the_font_is_named_and_travels() -> None:
    assert PROJECT["license"] == "MIT AND OFL-1.1"
    texts = [(ROOT / name).read_text(encoding="utf-8") for name in PROJECT["license-files"]]
    assert any("MIT License" in text for text in texts)
    assert any("SIL OPEN FONT LICENSE Version 1.1" in text for text in texts)


@pytest.mark.parametrize("entry", PROJECT["scripts"].values())
def test_commands_are_functions(entry: str) -> None:
    module, function = entry.split(":")
    assert callable(getattr(import_module(module), function))


def test_every_dependency_has_a_lower_bound() -> None:
    several = [PROJECT["dependencies"], *PROJECT["optional-dependencies"].values()]
    named = [one for group in several for one in group if not one.startswith("packwork[")]
    assert [one for one in named if ">=" not in one] == []


def test_messages_name_the_extra_that_brings_a_package() -> None:
    brought = {
        re.split("[>=]", one)[0]: extra
        for extra, group in PROJECT["optional-dependencies"].items()
        for one in group
        if extra not in {"docs", "bench", "dev"} and not one.startswith("packwork[")
    }
    assert {**brought, "traitlets": "notebook"} == EXTRAS


USE = "import packwork as pw\nassert pw.finish.__module__ == 'packwork.api.judging'"
IMPORTED = (
    "import packwork.finish.options as y",
    "from packwork.finish import options as y",
    "import packwork.finish.options; y = sys.modules['packwork.finish.options']",
)
FORKED = """
import os, sys
import numba, numpy, pydantic, scipy, shapely
assert "packwork" not in sys.modules
for program in sys.argv[1:]:
    if (child := os.fork()) == 0:
        exec(program)
        os._exit(0)
    assert os.waitpid(child, 0)[1] == 0, program
"""
"""Each program in a process that has loaded no more than libraries."""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs processes of one that has loaded most")
def test_the_verb_finish_hides_no_module_of_that_package() -> None:
    orders = [f"{USE}\n{one}" for one in IMPORTED] + [f"{one}\n{USE}" for one in IMPORTED]
    checked = [f"{one}\nassert y.__name__ == 'packwork.finish.options'\n{USE}" for one in orders]
    done = subprocess.run(
        [sys.executable, "-c", FORKED, *checked], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_functions_that_name_the_package_travel_to_other_processes() -> None:
    """As joblib, Dask, Ray and Spark send them."""
    cloudpickle = pytest.importorskip("cloudpickle")
    sent = cloudpickle.dumps(lambda: (pw.fill.__name__, pw.Poses([1], [2])))
    program = "import pickle, sys\nprint(pickle.loads(bytes.fromhex(sys.argv[1]))()[0])"
    done = subprocess.run(
        [sys.executable, "-c", program, sent.hex()], capture_output=True, text=True, check=False
    )
    assert (done.stdout.strip(), done.stderr) == ("fill", "")


def test_the_package_and_all_that_it_offers_are_pickled_by_name() -> None:
    assert pickle.loads(pickle.dumps(pw)) is pw  # noqa: S301
    for name in pw.__all__:
        one = getattr(pw, name)
        assert pickle.loads(pickle.dumps(one)) == one  # noqa: S301


@pytest.mark.parametrize("package", [pw, writers], ids=["packwork", "writers"])
def test_checkers_are_told_of_the_very_names_that_are_loaded(package: ModuleType) -> None:
    tree = ast.parse(Path(str(package.__file__)).with_suffix(".pyi").read_text(encoding="utf-8"))
    homes = {
        alias.asname or alias.name: (str(node.module), alias.name)
        for node in tree.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    (listed,) = (ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    assert set(listed) - {"__version__"} == homes.keys()
    assert sorted(listed) == sorted(package.__all__)
    for name, (module, own) in homes.items():
        assert getattr(package, name) is getattr(import_module(module), own)
