# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""python3 -m visp_direct.report OUT [OUT2...] [--paper] [--views]"""
import argparse
import importlib
import pathlib
import sys

from . import __doc__ as about
from .data import SCHEMA, DataError, read_results

OTHERS = {"visp-avoid-obstacle --replica": "detours", "visp-print-pattern --explore": "print_explore"}


def module_of(kind):
    """Of a Result.kind: visp-arm has arm.py, unless it is told otherwise."""
    return "visp_direct.report." + OTHERS.get(kind, kind.split(" ")[0].removeprefix("visp-").replace("-", "_"))


def main(arguments):
    parser = argparse.ArgumentParser(prog="python3 -m visp_direct.report", description=about.split("\n\n")[1])
    parser.add_argument("folders", metavar="OUT", nargs="+", type=pathlib.Path, help="result folder of a program")
    parser.add_argument("--paper", action="store_true", help="write each figure as PDF into OUT/paper, too")
    parser.add_argument("--views", action="store_true", help="write each 3D view as a page of its own, OUT/view-1.html..., too")
    options = parser.parse_args(arguments)
    results = read_results(options.folders)
    if results[0].kind not in SCHEMA:
        raise DataError(f"{options.folders[0]}: is a result of {results[0].program}, which makes its report itself")
    page = importlib.import_module(module_of(results[0].kind)).page(results)
    file = options.folders[0] / "report.html"
    file.write_text(page.html(), encoding="utf-8")
    if options.paper:
        page.write_paper(options.folders[0] / "paper")
    if options.views:
        views = page.views()
        if not views:
            raise DataError(f"{options.folders[0]}: its report has no 3D view")
        for i, view in enumerate(views, 1):
            (options.folders[0] / f"view-{i}.html").write_text(view, encoding="utf-8")
    print("Answer:", *page.answer, file, sep="\n")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except (DataError, OSError) as error:
        sys.exit(f"visp_direct.report: {error}")
    except ImportError as error:
        sys.exit(
            f"visp_direct.report: {error}; Debian has jinja2, matplotlib and numpy as python3-jinja2, python3-matplotlib and "
            "python3-numpy"
        )
