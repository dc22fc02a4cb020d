# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""One page: answer first, then sections with text, tables, figures and a 3D view, parameters last. All text is escaped."""
import base64
import math
import pathlib

import jinja2

HERE = pathlib.Path(__file__).parent


def number(value, digits=3):
    """At most three significant digits and never 2.43e+04: "24300", "0.00123", "1.2e-9" as "1.2·10⁻⁹"."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–" if value is None or math.isnan(value) else ("∞" if value > 0 else "−∞")
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    rounded = round(value, digits - 1 - exponent)
    exponent = math.floor(math.log10(abs(rounded)))
    if -5 <= exponent < 7:
        text = f"{rounded:.{max(0, digits - 1 - exponent)}f}"
        return (text.rstrip("0").rstrip(".") if "." in text else text).replace("-", "−")
    power = str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{number(rounded / 10.0**exponent, digits)}·10{power}"


def counted(count, word):
    """ "1 motion", "2 motions"."""
    return f"{count} {word}" + ("" if count == 1 else "s")


def data_uri(data, mime="image/jpeg"):
    return f"data:{mime};base64,{base64.b64encode(data).decode()}"


class Cell:
    """Text or number of a table; numbers are shown with three digits and sorted by all of them."""

    def __init__(self, value, style=""):
        self.sort = value if isinstance(value, (int, float)) and not isinstance(value, bool) else None
        text = {True: "yes", False: "no"}[value] if isinstance(value, bool) else value
        self.text = str(text) if isinstance(text, (str, int)) else number(text)
        self.style = style or ("" if self.sort is not None or value is None else "text wrap" if len(self.text) > 45 else "text")

    @staticmethod
    def of(value):
        return value if isinstance(value, Cell) else Cell(value)


def columns_of(described):
    """Headers and functions of a record, for Page.records(). described: (header, key or function), or texts of several columns:
    "header = key; name; mm = 1000 size.x_m". A name alone is both, a number is a factor; what is not there is None."""
    for column in described:
        texts = [each.rpartition(" = ")[::2] for each in column.split("; ")] if isinstance(column, str) else []
        for header, value in [(header or path, path) for header, path in texts] or [column]:
            yield header, value if callable(value) else getter(value)


def getter(path):
    """Of "1000 size.x_m"."""
    *factors, path = path.split(" ")

    def get(record):
        for key in path.split("."):
            record = None if record is None else record.get(key)
        for factor in factors:
            record = None if record is None else (int if factor.isdigit() else float)(factor) * record
        return record

    return get


class Page:
    """Built from top to bottom, then html(). results: those that it shows, whose findings are its answer; of several each is called by
    its name."""

    def __init__(self, title, lead, results=()):
        self.title, self.lead, self.results, self.several = title, lead, results, len(results) > 1
        self.answer, self.sections, self.figures, self.scripts, self.arms = [], [], [], [], []
        for result in results:
            self.answers(*result.summary.get("findings", ()), of=result)

    def name(self, result, alone=""):
        """Of a result among several; else what one alone is called."""
        return result.name if self.several else alone

    def answers(self, *sentences, of=None):
        """of: the result that they are about."""
        start = f"{of.name}: " if of and self.several else ""
        self.answer += [start + sentence for sentence in sentences]

    def section(self, title, among=None):
        """among: among several results, its title, or the one that it is of."""
        if among and self.several:
            title = among if isinstance(among, str) else f"{title} of {among.name}"
        self.sections.append({"title": title, "id": f"s{len(self.sections) + 1}", "parts": []})

    def _add(self, **part):
        self.sections[-1]["parts"].append(part)

    def heading(self, text):
        """Below that of a section; not in the navigation."""
        self._add(kind="heading", text=text)

    def paragraph(self, text):
        self._add(kind="paragraph", text=text)

    def items(self, *texts):
        self._add(kind="items", texts=texts)

    def table(self, header, rows, caption=""):
        """Rows of values or Cells; a click on a header sorts."""
        cells = [[Cell.of(value) for value in row] for row in rows]
        self._add(kind="table", header=header, rows=cells, caption=caption)

    def records(self, records, columns, caption="", best=lambda record: False):
        """A table with a row for each record. columns: as for columns_of(). best: whether a row is green."""
        columns = list(columns_of(columns))
        rows = [[Cell.of(get(record)) for _, get in columns] for record in records]
        for cell in (cell for record, row in zip(records, rows) if best(record) for cell in row):
            cell.style += " best"
        self.table([header for header, _ in columns], rows, caption)

    def facts(self, facts, caption=""):
        """Names and values below each other."""
        rows = [(name, value if isinstance(value, str) else number(value)) for name, value in facts]
        self._add(kind="facts", rows=rows, caption=caption)

    def figure(self, figure, caption):
        """A Figure of plots.py."""
        self.figures.append(figure)
        self._add(kind="figure", svg=figure.svg(), alt=figure.alt, caption=caption)

    def picture(self, data, mime, alt, caption, width=None):
        """A picture as wide as the page, or at most so many px."""
        self._add(kind="picture", uri=data_uri(data, mime), alt=alt, caption=caption, width=width)

    def pictures(self, pictures, caption):
        """Small ones beside each other: (label, data URI)."""
        self._add(kind="pictures", pictures=pictures, caption=caption)

    def video(self, file, caption):
        """A video beside the page: too large to be in it."""
        self._add(kind="video", file=file, caption=caption)

    def videos(self, videos):
        """Several beside each other: (file, caption)."""
        self._add(kind="videos", videos=videos)

    def view(self, scene, caption):
        """A 3D view, see view3d.py. An arm of several views is in the page once."""
        scene = {**scene, "arms": [self._shared(arm) for arm in scene["arms"]]}
        self._add(kind="view", scene=scene, caption=caption, id=f"view{len(self.scripts)}")
        self.scripts.append(scene)

    def _shared(self, arm):
        if not any(arm is other for other in self.arms):
            self.arms.append(arm)
        return next(i for i, other in enumerate(self.arms) if arm is other)

    def html(self):
        return self._rendered(self.sections)

    def views(self):
        """Each 3D view as a page of its own, for a frame in another page."""
        return [self._rendered([{**s, "parts": [p]}], alone=True) for s in self.sections for p in s["parts"] if p["kind"] == "view"]

    def _rendered(self, sections, alone=False):
        strict = {"autoescape": True, "undefined": jinja2.StrictUndefined}
        environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), trim_blocks=True, lstrip_blocks=True, **strict)
        scripts = ""
        if self.scripts:
            from .view3d import scripts as view_scripts

            scripts = view_scripts()
        return environment.get_template("template.html").render(page=self, sections=sections, alone=alone, scripts=scripts)

    def write_paper(self, folder):
        """Each figure as PDF, 3.4 inch wide."""
        folder.mkdir(exist_ok=True)
        for figure in self.figures:
            (folder / f"{figure.name}.pdf").write_bytes(figure.pdf())
