# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Result folders: summary.json, JSON and CSV, checked against schema.json, which describes each file once."""
import csv
import json
import math
import pathlib


class DataError(Exception):
    """A result that cannot be read: one sentence with the file and the field."""


SCHEMA = json.loads((pathlib.Path(__file__).parent / "schema.json").read_text(encoding="utf-8"))
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
    """Requires a value to be as its schema says: a kind, a list of one schema, or an object of schemas; "?" ends an optional name."""
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
        names = {name.rstrip("?"): sub for name, sub in schema.items()}
        for name, sub in schema.items():
            if name.rstrip("?") in value:
                check(value[name.rstrip("?")], sub, f"{place}.{name.rstrip('?')}")
            elif not name.endswith("?"):
                raise DataError(f"{place}.{name} is missing")
        for name in value:
            if name not in names:
                raise DataError(f"{place}.{name} is not in the schema")


class Result:
    """One result folder of a program."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.summary = self._load("summary.json")
        self.program = (
            self.summary.get("program", "an unknown program")
            if isinstance(self.summary, dict)
            else "an unknown program"
        )
        explored = self.program == "visp-print-pattern" and "objectives" in self.summary
        self.kind = f"{self.program} --explore" if explored else self.program
        self.schema = SCHEMA.get(self.kind, {})
        if "summary.json" in self.schema:
            own = {k: v for k, v in self.summary.items() if k not in ("program", "status", "files")}
            check(own, self.schema["summary.json"], str(self.folder / "summary.json"))
        self.name = self.folder.name or str(self.folder)

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
        check(value, self.schema[name], str(self.folder / name))
        return value

    def table(self, name, columns=None):
        """Columns of a CSV file as lists of numbers, NaN where a cell is empty or no number; of text where the schema says so."""
        path = self.folder / name
        try:
            with open(path, encoding="utf-8", newline="") as file:
                rows = list(csv.reader(file))
        except OSError as error:
            raise DataError(f"{path}: cannot be read: {error.strerror}") from None
        schema = columns or self.schema[name]
        wanted = list(schema)
        if not rows or rows[0] != wanted:
            raise DataError(
                f"{path}: has the columns {','.join(rows[0]) if rows else ''}, must have {','.join(wanted)}"
            )
        read = {key: [] for key in wanted}
        for number, row in enumerate(rows[1:], 2):
            if len(row) != len(wanted):
                raise DataError(f"{path}:{number}: has {len(row)} cells, must have {len(wanted)}")
            for key, cell in zip(wanted, row):
                read[key].append(cell if schema is not columns and schema[key].startswith("text") else _number(cell))
        return read

    def bytes(self, name):
        """A file as it is; None when there is none."""
        path = self.folder / name
        return path.read_bytes() if path.is_file() else None


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
            raise DataError(
                f"{result.folder}: is a result of {result.program}, {results[0].folder} is one of {results[0].program}"
            )
    return results
