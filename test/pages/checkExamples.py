# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""That the examples of the public headers compile: checkExamples.py [--compiler CXX] [--print] ROOT INCLUDE_FOLDER...

An example is a block \\code ... \\endcode of a docstring, without a language or {.cpp}. Each is a function of its own; a block that defines
functions or classes is taken as it is. All are one program text, in the namespace of their module, so that the compiler tells the line of
the header. Its headers are those of all modules, and ViSP's that the examples name. What an example takes as given, such as the reader's
robot, is declared in examples.h. An example must not drop a result that is [[nodiscard]].
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

EXAMPLE = re.compile(r"^ *\* \\code(?:\{\.cpp\})?\n(.*?)^ *\* \\endcode$", re.S | re.M)
DEFINITION = re.compile(r'^(?:extern "C"|class |struct |template |[\w:<>*& ]+\w\([^;\[]*\)(?: const)?(?: noexcept)?(?: override)?\s*\{)', re.M)
FLAGS = ["-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-Wno-unused", "-Werror=unused-result"]


def examples_of(header):
    """Line and text of each example of a header."""
    text = header.read_text(encoding="utf-8")
    for found in EXAMPLE.finditer(text):
        line = text.count("\n", 0, found.start()) + 2
        yield line, re.sub(r"^ *\* ?", "", found[1], flags=re.M)


def program_of(root, folders):
    """The program text, and how many examples of how many headers are in it; ends at braces that would hide the faults behind them."""
    headers = sorted(root.glob("modules/*/include/visp3/*/*.h"))
    known = {header.stem for header in headers}
    includes, body, counted, number = [f"#include <{h.parent.parent.name}/{h.parent.name}/{h.name}>\n" for h in headers], [], 0, 0
    for header in headers:
        examples = list(examples_of(header))
        counted += bool(examples)
        for line, text in examples:
            number += 1
            if text.count("{") != text.count("}"):
                sys.exit(f"{header.relative_to(root)}:{line}: the braces of the example do not match")
            includes += re.findall(r"^#include .*\n", text, re.M)
            for name in re.findall(r"\bvp[A-Z]\w*", text):
                paths = [p.relative_to(f) for f in folders for p in f.glob(f"visp3/*/{name}.h")] if name not in known else []
                includes += [f"#include <{paths[0].as_posix()}>\n"] if paths else []
                known.add(name)
            text = re.sub(r"^#include .*", "", text, flags=re.M)
            before, after = ("", "") if DEFINITION.search(text) else (f"void example{number}()\n{{\n", "}\n")
            body.append(f"namespace {header.parent.name}\n{{\n{before}#line {line} \"{header.relative_to(root).as_posix()}\"\n"
                        f"{text}#line 1 \"<after the example>\"\n{after}}}\n")
    return "".join([*dict.fromkeys(includes), '#include "examples.h"\n', *body]), number, counted


def main(arguments):
    parser = argparse.ArgumentParser()
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--print", action="store_true", help="the program text, for use by hand")
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    options = parser.parse_args(arguments)
    text, examples, headers = program_of(options.root, options.folders)
    if options.print:
        print(text)
        return 0
    places = [f"-I{path}" for path in [pathlib.Path(__file__).resolve().parent, *options.root.resolve().glob("modules/*/include")]]
    places += [part for folder in options.folders if folder != pathlib.Path("/usr/include") for part in ("-isystem", str(folder))]
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "examples.cpp"
        program.write_text(text, encoding="utf-8")
        failed = subprocess.run([options.compiler, *FLAGS, *places, str(program)], cwd=options.root).returncode
    print(f"{examples} examples of {headers} headers " + ("do not all compile" if failed else "compile"))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
