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


class Cell:
    """Text or number of a table; numbers are shown with three digits and sorted by all of them."""

    def __init__(self, value, style=""):
        self.sort = value if isinstance(value, (int, float)) and not isinstance(value, bool) else None
        self.text = (
            {True: "yes", False: "no"}[value]
            if isinstance(value, bool)
            else (str(value) if isinstance(value, (str, int)) else number(value))
        )
        self.style = style or (
            "" if self.sort is not None or value is None else "text wrap" if len(self.text) > 45 else "text"
        )


class Page:
    """Built from top to bottom, then html()."""

    def __init__(self, title, lead):
        self.title, self.lead = title, lead
        self.answer, self.sections, self.figures = [], [], []
        self.scripts, self.arms = [], []

    def answers(self, *sentences):
        self.answer += sentences

    def section(self, title):
        self.sections.append({"title": title, "id": f"s{len(self.sections) + 1}", "parts": []})

    def _add(self, **part):
        self.sections[-1]["parts"].append(part)

    def heading(self, text):
        """Below that of a section; not in the navigation."""
        self._add(kind="heading", text=text)

    def paragraph(self, text):
        self._add(kind="paragraph", text=text)

    def items(self, texts):
        self._add(kind="items", texts=list(texts))

    def table(self, header, rows, caption=""):
        """Rows of values or Cells; a click on a header sorts."""
        cells = [[value if isinstance(value, Cell) else Cell(value) for value in row] for row in rows]
        self._add(kind="table", header=header, rows=cells, caption=caption)

    def facts(self, facts, caption=""):
        """Names and values below each other."""
        self._add(
            kind="facts",
            rows=[(name, value if isinstance(value, str) else number(value)) for name, value in facts],
            caption=caption,
        )

    def figure(self, figure, name, alt, caption):
        """A Figure of plots.py. name: of its PDF."""
        self.figures.append((name, figure))
        self._add(kind="figure", svg=figure.svg(), alt=alt, caption=caption)

    def picture(self, data, mime, alt, caption, width=None):
        """A picture as wide as the page, or at most so many px."""
        uri = f"data:{mime};base64,{base64.b64encode(data).decode()}"
        self._add(kind="picture", uri=uri, alt=alt, caption=caption, width=width)

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
        environment = jinja2.Environment(
            loader=jinja2.FileSystemLoader(HERE),
            autoescape=True,
            trim_blocks=True,
            lstrip_blocks=True,
            undefined=jinja2.StrictUndefined,
        )
        scripts = ""
        if self.scripts:
            from .view3d import scripts as view_scripts

            scripts = view_scripts()
        return environment.get_template("template.html").render(page=self, scripts=scripts)

    def write_paper(self, folder):
        """Each figure as PDF, 3.4 inch wide."""
        folder.mkdir(exist_ok=True)
        for name, figure in self.figures:
            (folder / f"{name}.pdf").write_bytes(figure.pdf())
