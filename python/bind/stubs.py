#!/usr/bin/env python3
# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the type stubs of visp_direct._core from the compiled module. Usage: stubs.py FOLDER/visp_direct/_core.pyi"""
import ast
import inspect
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(sys.argv[1]).resolve().parents[1]))
import visp_direct._core as core  # noqa: E402

OBJECT = re.compile(r"<[^<>]*>|array\([^()]*\)(?:, dtype=\w+)?|\b[A-Z]\w+\((?:[^()]|\([^()]*\))*\)")


def annotation(text):
    """A type of pybind11 as Python writes it."""
    return re.sub(r"visp_direct\._core\.", "", text).replace("numpy.dtype[void]", "numpy.dtype")


def without_defaults(line):
    """A signature with ... in place of each default, which pybind11 shows as repr() does."""
    result, depth, skipped = "", 0, False
    for i, character in enumerate(line):
        depth += (character in "([{") - (character in ")]}")
        if skipped and ((character == "," and depth == 1) or (character == ")" and depth == 0)):
            skipped = False
        if character == "=" and depth == 1 and not skipped:
            result, skipped = result + "= ...", True
        if not skipped:
            result += character
    return result


def signatures(function):
    """The signatures that pybind11 puts into a docstring, as `def` lines without the name of the class."""
    name = function.__name__
    lines = [line for line in (function.__doc__ or "").split("\n") if re.match(rf"(\d+\. )?{name}\(", line)]
    lines = [re.sub(r"^\d+\. ", "", line) for line in lines if "*args, **kwargs) -> Any" not in line]
    result = []
    for line in lines or [f"{name}(*args, **kwargs)"]:
        line = without_defaults(annotation(line))
        try:
            ast.parse(f"def {line}: ...")
        except SyntaxError:
            line = f"{name}(*args: Any, **kwargs: Any) -> Any"
        result.append(line)
    return result


def docstring(thing, indent):
    """The docstring without signatures, as a statement."""
    lines = [
        line for line in (inspect.getdoc(thing) or "").split("\n") if not re.match(r"(\d+\. )?\w+\(.*\) -> ", line)
    ]
    text = "\n".join(lines).strip().replace("\\", "\\\\").replace('"""', "'''")
    return f'{indent}"""{text}"""' if text else ""


def function_stub(name, function, indent, decorator=""):
    found = signatures(function)
    lines = []
    for line in found:
        if len(found) > 1:
            lines.append(f"{indent}@overload")
        if decorator:
            lines.append(f"{indent}{decorator}")
        body = docstring(function, indent + "    ")
        lines.append(f"{indent}def {line}:" + (f"\n{body}\n{indent}    ..." if body else " ..."))
    return lines


def property_stub(name, member, indent):
    getter = re.search(r"-> (.+)", member.fget.__doc__ or "")
    kind = annotation(getter.group(1)) if getter else "Any"
    lines = [
        f"{indent}@property",
        f"{indent}def {name}(self) -> {kind}:",
        docstring(member, indent + "    ") or f"{indent}    ...",
    ]
    if member.fset:
        lines += [f"{indent}@{name}.setter", f"{indent}def {name}(self, value: Any) -> None: ..."]
    return lines


def class_stub(name, cls):
    bases = [base.__name__ for base in cls.__bases__ if base.__module__ == core.__name__]
    lines = [f"class {name}{'(' + bases[0] + ')' if bases else ''}:", docstring(cls, "    ")]
    values = getattr(cls, "__members__", None)
    if values:
        return [
            *lines,
            *(f"    {value}: ClassVar[{name}]" for value in values),
            "    name: str",
            "    value: int",
            "    def __init__(self, value: int) -> None: ...",
            "",
        ]
    for key, member in vars(cls).items():
        if hasattr(type(member), "__members__"):
            lines.append(f"    {key}: ClassVar[{type(member).__name__}]")
        elif isinstance(member, property):
            lines += property_stub(key, member, "    ")
        elif isinstance(member, staticmethod):
            lines += function_stub(key, member.__func__, "    ", "@staticmethod")
        elif callable(member) and (not key.startswith("_") or key in ("__init__", "__len__", "__copy__")):
            lines += function_stub(key, member, "    ")
    return [*lines, "    ...", ""]


def main(output):
    lines = [
        '"""Types of visp_direct, made from the compiled module."""',
        "from typing import Any, Callable, ClassVar, Dict, List, " "Optional, Tuple, overload",
        "import numpy",
        "",
    ]
    for name, thing in vars(core).items():
        if name.startswith("_"):
            continue
        if inspect.isclass(thing):
            lines += class_stub(name, thing)
        elif callable(thing):
            lines += function_stub(name, thing, "")
        else:
            lines.append(f"{name}: numpy.dtype")
    text = "\n".join(line for line in lines if line is not None) + "\n"
    ast.parse(text)
    with open(output, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main(sys.argv[1])
