"""Examples run, stubs tell the truth, everything public is documented."""

import ast
import doctest
import importlib
import inspect
import re
import subprocess
import sys
from pathlib import Path

import conftest
import numpy as np
import pytest
import remesh
from remesh import _remesh

PACKAGE = Path(remesh.__file__).parent
MODULES = sorted(path.stem for path in PACKAGE.glob("*.py"))
NAMES = {"remesh": remesh, "np": np}


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings_run(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # Some write files.
    if name == "_pyvista":
        pytest.importorskip("pyvista")
    module = remesh if name == "__init__" else importlib.import_module(f"remesh.{name}")
    failed, _ = doctest.testmod(module, extraglobs=NAMES)
    assert failed == 0


def is_error(thing):
    return inspect.isclass(thing) and issubclass(thing, Exception)


def test_every_function_and_class_has_an_example():
    things = [getattr(remesh, name) for name in remesh.__all__]
    things = [x for x in things if (inspect.isfunction(x) or inspect.isclass(x)) and not is_error(x)]
    things += [remesh.examples.sphere, remesh.examples.torus]
    assert len(things) == 25
    for thing in things:
        assert ">>> " in thing.__doc__, thing.__name__


def test_every_method_is_documented():
    classes = [getattr(remesh, name) for name in remesh.__all__]
    methods = [(c, name) for c in classes if inspect.isclass(c) and not is_error(c)
               for name, method in vars(c).items()
               if inspect.isfunction(method) and not name.startswith("_")]
    assert len(methods) >= 2
    for kind, name in methods:
        assert inspect.getdoc(getattr(kind, name)), f"{kind.__name__}.{name}"


def test_every_public_name_is_documented():
    for name in remesh.__all__:
        if name != "__version__":
            assert inspect.getdoc(getattr(remesh, name)), name


def snippets(path):
    return re.findall(r"```python\n(.*?)```", (conftest.ROOT / path).read_text(), re.DOTALL)


@pytest.mark.parametrize("path", ["docs/python.md", "docs/cookbook.md", "docs/switching.md", "README.md"])
def test_snippets_of_the_documentation_run(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = snippets(path)
    assert len(found) >= (5 if path == "docs/python.md" else 1)
    for snippet in found:
        exec(compile(snippet, path, "exec"), {"__name__": "__main__"})


def test_the_documentation_names_every_option():
    text = inspect.getdoc(remesh.remesh)
    for name in list(inspect.signature(remesh.remesh).parameters)[2:]:
        assert f"``{name}``" in text or f"{name}:" in text, name


def arguments_of_stubs():
    tree = ast.parse((PACKAGE / "_remesh.pyi").read_text())
    return {node.name: [a.arg for a in node.args.args] for node in tree.body
            if isinstance(node, ast.FunctionDef)}


def test_stubs_have_the_functions_of_the_extension():
    def arguments(function):
        (inside,) = re.findall(r"^\w+\((.*)\) -> ", function.__doc__.strip().split("\n")[0])
        return re.findall(r"(\w+): ", inside)

    stubs = arguments_of_stubs()
    functions = {name: f for name, f in vars(_remesh).items() if inspect.isbuiltin(f)}
    assert set(stubs) == set(functions) and len(stubs) == 30
    for name, function in functions.items():
        assert arguments(function) == stubs[name], name


def test_stubs_have_the_classes_of_the_extension():
    tree = ast.parse((PACKAGE / "_remesh.pyi").read_text())
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    assert set(classes) == {name for name, c in vars(_remesh).items() if inspect.isclass(c)}
    for name, node in classes.items():
        bases = [base.id for base in node.bases] or ["pybind11_object"]
        assert [base.__name__ for base in getattr(_remesh, name).__bases__] == bases
    fields = {part.target.id for part in classes["Options"].body if isinstance(part, ast.AnnAssign)}
    methods = {part.name for part in classes["Options"].body if isinstance(part, ast.FunctionDef)}
    found = {name for name in vars(_remesh.Options) if not name.startswith("_")}
    assert fields | methods - {"__init__"} == found


def test_types_are_consistent():
    if subprocess.run([sys.executable, "-c", "import mypy"], capture_output=True).returncode != 0:
        pytest.skip("no mypy")
    sources = conftest.ROOT / "tools" / "python" / "remesh"
    check = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir=/dev/null",
                            str(sources)], capture_output=True, text=True)
    assert check.returncode == 0, check.stdout


def test_errors_have_one_base():
    for name in ("InvalidOption", "InvalidInput", "InvalidSites", "ConstraintUnmet", "Cancelled",
                 "OutOfMemory", "FileError"):
        error = getattr(remesh, name)
        assert issubclass(error, remesh.Error) and error.__module__ == "remesh" and error.__doc__


def test_every_argument_is_named():
    functions = [(name, getattr(remesh, name)) for name in remesh.__all__]
    functions += [(f"tiles.{name}", getattr(remesh.tiles, name)) for name in ("split", "mesh", "join")]
    for name, function in functions:
        if not inspect.isfunction(function):
            continue
        text = function.__doc__ + remesh.__doc__
        for parameter in inspect.signature(function).parameters:
            assert re.search(rf"\b{parameter}\b", text), f"{name}: {parameter}"
