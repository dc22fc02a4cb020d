# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""One style for all plots: matplotlib as SVG, legends above the axes and never over a curve."""
import functools
import io
import re

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402

from .page import number  # noqa: E402

# Okabe and Ito: also distinguishable for colour-blind readers.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
STYLE = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e3e7ec",
    "grid.linewidth": 0.6,
    "axes.edgecolor": "#888888",
    "axes.labelsize": 9,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "lines.linewidth": 1.5,
    "svg.fonttype": "none",
    "svg.hashsalt": "visp-direct",
    "pdf.fonttype": 42,
    "axes.axisbelow": True,
    "figure.constrained_layout.use": True,
}
WIDTH, COLUMN = 8.6, 3.4  # inch, of a page and of a column of a paper


def colour(i):
    return COLOURS[i % len(COLOURS)]


def plain(name):
    """A name from a file as it stands, in a figure: without formulas."""
    return name.replace("$", r"\$")


class Figure:
    """A figure that is drawn when its size is known. draw(axes) gets the axes from top to bottom."""

    _count = 0

    def __init__(self, draw, rows=1, height=2.6, shared=True):
        self.draw, self.rows, self.height, self.shared = draw, rows, height, shared
        self.name = self.alt = ""

    def named(self, name, alt):
        """Itself. name: of its PDF. alt: what it shows, for those who do not see it."""
        self.name, self.alt = name, alt
        return self

    def _render(self, width, **options):
        with matplotlib.rc_context(STYLE):
            scale = 1 if width == WIDTH else 0.62 if self.rows == 1 else 0.8
            size = (width, scale * (self.height * self.rows + 0.5))
            figure, axes = pyplot.subplots(self.rows, 1, sharex=self.shared, squeeze=False, figsize=size)
            try:
                self.draw([row[0] for row in axes])
                buffer = io.BytesIO()
                figure.savefig(buffer, **options)
                return buffer.getvalue()
            finally:
                pyplot.close(figure)

    def svg(self):
        """For a page: without prolog, with ids of its own."""
        text = self._render(WIDTH, format="svg", metadata={"Date": None}).decode()
        text = text[text.index("<svg") :]
        Figure._count += 1
        prefix = f"f{Figure._count}-"
        text = re.sub(r'\bid="', f'id="{prefix}', text)
        text = re.sub(r'(href="#|url\(#)', rf"\g<1>{prefix}", text)
        return re.sub(r"<metadata>.*?</metadata>\s*", "", text, flags=re.S)

    def pdf(self):
        return self._render(COLUMN, format="pdf", metadata={"CreationDate": None})


def figure(rows=1, height=2.6, shared=True):
    """Turns a function that draws data on axes, draw(axes, *data), or on a list of them from top to bottom, into one of the data that
    makes a Figure."""

    def made(draw):
        @functools.wraps(draw)
        def make(*data, **more):
            return Figure(lambda panels: draw(panels[0] if rows == 1 else panels, *data, **more), rows, height, shared)

        return make

    return made


def legend_above(axes, columns=4, **labels):
    """Labels and limits, and the legend between title and axes; half the columns in a narrow figure."""
    axes.set(**labels)
    handles, texts = axes.get_legend_handles_labels()
    columns = columns if axes.figure.get_figwidth() > 2 * COLUMN else max(1, columns // 2)
    if handles:
        place = {"loc": "lower left", "bbox_to_anchor": (0, 1.0), "ncol": min(columns, len(texts))}
        axes.legend(handles, texts, **place, borderaxespad=0.2, columnspacing=1.2, handlelength=1.8)


def logarithmic_if_flat(axes, *curves):
    """Logarithmic y, on both sides of zero, where one peak would flatten the rest: median below a fiftieth of the peak."""
    values = np.abs(np.concatenate([np.asarray(c, float).ravel() for c in curves]))
    values = values[np.isfinite(values) & (values > 0)]
    if len(values) and np.median(values) < values.max() / 50:
        axes.set_yscale("symlog", linthresh=float(f"{np.median(values):.0e}"))


def logarithmic(*axis):
    """Logarithmic axes (axes.xaxis, axes.yaxis) with plain numbers at 1, 2, 5 of each decade."""
    for each in axis:
        getattr(each.axes, f"set_{each.axis_name}scale")("log")
        each.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        each.set_major_formatter(ticker.FuncFormatter(lambda x, _: number(float(x))))
        each.set_minor_formatter(ticker.NullFormatter())


def marks(axes, times, label):
    """Grey vertical lines."""
    for i, t in enumerate(times):
        axes.axvline(t, color="#999999", linewidth=0.9, label=label if i == 0 else None)
