# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Result folders: summary.json, JSON and CSV, checked against schema.json, which describes each file once."""
import csv
import fnmatch
import itertools
import json
import math
import os
import pathlib


class DataError(Exception):
    """A result that cannot be read: one sentence with the file and the field."""


SCHEMA = json.loads((pathlib.Path(__file__).parent / "schema.json").read_text(encoding="utf-8"))
for _files in SCHEMA.values():  # "like visp-arm/arm.json": the same fields
    for _name, _fields in _files.items():
        if isinstance(_fields, str):
            _files[_name] = SCHEMA[_fields.removeprefix("like ").split("/")[0]][_fields.split("/", 1)[1]]
KINDS = {
    "number": (int, float),
    "text": str,
    "yes or no": bool,
    "list": list,
    "object": dict,
    "number or null": (int, float, type(None)),
    "text or null": (str, type(None)),
    "any": object,
}


def check(value, schema, place):
    """Requires a value to be as its schema says: a kind, a list of one schema, or an object of schemas; "?" ends an optional name, "*" is any other."""
    if isinstance(schema, str):
        kind = schema.split(":")[0]
        right = isinstance(value, KINDS[kind]) and not (isinstance(value, bool) and kind.startswith("number"))
        if not right:
            raise DataError(f"{place} is {json.dumps(value)[:60]}, must be {kind}")
    elif isinstance(schema, list):
        check(value, "list", place)
        for i, element in enumerate(value):
            check(element, schema[0], f"{place}[{i}]")
    else:
        check(value, "object", place)
        others = schema.get("*")
        schema = {name: sub for name, sub in schema.items() if name != "*"}
        names = {name.rstrip("?"): sub for name, sub in schema.items()}
        for name, sub in schema.items():
            if name.rstrip("?") in value:
                check(value[name.rstrip("?")], sub, f"{place}.{name.rstrip('?')}")
            elif not name.endswith("?"):
                raise DataError(f"{place}.{name} is missing")
        for name in value:
            if name not in names and others is not None:
                check(value[name], others, f"{place}.{name}")
            elif name not in names:
                raise DataError(f"{place}.{name} is not in the schema")


MODES = {"objectives": "--explore", "replica": "--replica", "recording": "--replay"}  # field of summary.json and option


class Result:
    """One result folder of a program."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.summary = self._load("summary.json")
        said = self.summary if isinstance(self.summary, dict) else {}
        self.program = said.get("program", "an unknown program")
        mode = [word for key, word in MODES.items() if key in said]
        self.kind = " ".join([self.program, *mode])
        self.schema = SCHEMA.get(self.kind, {})
        if "summary.json" in self.schema:
            own = {k: v for k, v in self.summary.items() if k not in ("program", "status", "files")}
            check(own, self.schema["summary.json"], str(self.folder / "summary.json"))
        place = self.folder.resolve()
        self.name = place.parent.name if place.name == "unfinished-run" else place.name  # while the program writes

    def _load(self, name):
        path = self.folder / name
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except OSError as error:
            raise DataError(f"{path}: cannot be read: {error.strerror}") from None
        except ValueError as error:
            raise DataError(f"{path}: is not valid JSON: {error}") from None

    def json(self, name):
        value = self._load(name)
        check(value, self.described(name), str(self.folder / name))
        return value

    def described(self, name):
        """The schema of a file, whose name may stand for several (*) or be optional (?)."""
        return next(fields for key, fields in self.schema.items() if fnmatch.fnmatchcase(name, key.rstrip("?")))

    def files(self):
        """Names of the described files that are there, without summary.json. Raises DataError for one that is missing."""
        names = []
        for key in self.schema:
            found = sorted(str(path.relative_to(self.folder)) for path in self.folder.glob(key.rstrip("?")))
            if not found and not key.endswith("?"):
                raise DataError(f"{self.folder / key}: is missing")
            names += [name for name in found if name != "summary.json"]
        return names

    def table(self, name, columns=None, most=None):
        """Columns of a CSV file as lists of numbers, NaN where a cell is empty or no number; of text where the schema says so.
        most: of a longer file without line breaks in its cells only every k-th row, about so many."""
        path = self.folder / name
        try:
            with open(path, encoding="utf-8", newline="") as file:
                step = max(1, sum(1 for _ in file) // most) if most else 1
                file.seek(0)
                rows = list(csv.reader(itertools.chain(itertools.islice(file, 1), itertools.islice(file, 0, None, step))))
        except OSError as error:
            raise DataError(f"{path}: cannot be read: {error.strerror}") from None
        schema = dict.fromkeys(columns, "number") if columns else _expanded(self.described(name), rows[0] if rows else [])
        wanted = list(schema)
        if not rows or rows[0] != wanted:
            raise DataError(f"{path}: has the columns {','.join(rows[0]) if rows else ''}, must have {','.join(wanted)}")
        read = {key: [] for key in wanted}
        for number, row in enumerate(rows[1:], 2):
            if len(row) != len(wanted):
                raise DataError(f"{path}:{number}: has {len(row)} cells, must have {len(wanted)}")
            for key, cell in zip(wanted, row):
                read[key].append(cell if schema[key].startswith("text") else _number(cell))
        return read

    def beside(self, other, name):
        """A file as it is called from the page of another result."""
        return name if other is self else os.path.relpath((self.folder / name).resolve(), other.folder.resolve())

    def bytes(self, name):
        """A file as it is; None when there is none."""
        path = self.folder / name
        return path.read_bytes() if path.is_file() else None


def _expanded(schema, header):
    """The columns that a header should have: "q_*" stands for one of each joint, "x_um?" may be missing."""
    columns = {}
    for key, kind in schema.items():
        if "*" in key:
            columns |= {name: kind for name in header if fnmatch.fnmatchcase(name, key) and name not in schema}
        elif not key.endswith("?") or key[:-1] in header:
            columns[key.rstrip("?")] = kind
    return columns


def _number(cell):
    try:
        return float(cell)
    except ValueError:
        return math.nan


def read_results(folders):
    """The results of one program. Raises DataError when they are of several."""
    results = [Result(folder) for folder in folders]
    for result in results[1:]:
        if result.program != results[0].program:
            raise DataError(f"{result.folder}: is a result of {result.program}, {results[0].folder} is one of {results[0].program}")
    return results
