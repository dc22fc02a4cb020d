# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Filters a Markdown page for doxygen: markdown.py FILE. The same text reads well on a forge and in the documentation."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Pages of which the links that begin a row of a table or an item of a list go to the pages below them.
PARENTS = ("CONTRIBUTING.md", "data/README.md", "doc/guides.md", "doc/thesis.md", "modules/README.md", "tutorial/README.md")


def label(page):
    """The name of a page, which is that of its HTML file: tutorial-01-first-law, real-time."""
    parts = page.resolve().relative_to(ROOT).with_suffix("").parts
    name = "-".join(part for part in parts if part not in ("README", "doc")).lower()
    return "module-pages" if name == "modules" else name  # modules.html is doxygen's


def link(page, start, text, target):
    """A link to a page goes by its label."""
    path = page.parent / target.partition("#")[0]
    if path.suffix != ".md" or not path.is_file() or path.resolve() == ROOT / "README.md":
        return f"{start}[{text}]({target})"
    is_parent = start and page.resolve().relative_to(ROOT).as_posix() in PARENTS
    text = text.replace("`", "")
    return f'{start}\\{"subpage" if is_parent else "ref"} {label(path)} "{text}"'


def figure(page, alt, target):
    """A picture, or its 3D view where scripts/gallery.sh made one; build.cmake puts that beside the pages."""
    name = target.removesuffix(".jpg")
    if page.parent.name == "gallery" and (ROOT / f"out/gallery/live/{name}.html").is_file():
        return f'\\htmlonly <iframe class="live" src="live-{name}.html" title="{alt}" loading="lazy"></iframe> \\endhtmlonly'
    return f"![{alt}]({target})"


def code(span):
    """A name of ours in <code>, which looks like a code span and gets links; with an apostrophe, which would end a span, two backticks."""
    if re.fullmatch(r"vp[A-Z]\w*(::\w+)?(\(\))?|vispDirect\w+\(\)", span):
        return f"<code>{span}</code>"
    return f"``{span}``" if "'" in span else f"`{span}`"


def prose(page, text):
    text = re.sub(r"^\[!\[.*/badge[.]svg\).*\n", "", text, flags=re.M)  # badges are of the forge
    text = re.sub(r"!\[([^\]]*)\]\(([^)]*)\)", lambda m: figure(page, m[1], m[2]), text)
    text = re.sub(r"(!\[[^\]]*\]\()(?:\.\./)+", r"\1", text)  # doxygen looks up a figure by the end of its path
    text = re.sub(r'(<img src=")[^"]*/', r"\1", text)  # and puts all into one folder
    text = re.sub(r"(^(?:\| |[-*] ))?(?<!!)\[([^\]]+)\]\(([^()\s]+)\)", lambda m: link(page, m[1] or "", m[2], m[3]), text, flags=re.M)
    return re.sub(r"`([^`]+)`", lambda m: code(m[1]), text)


def main(page):
    parts = re.split(r"(^```.*?^```)", page.read_text(encoding="utf-8"), flags=re.S | re.M)
    text = "".join(part if i % 2 else prose(page, part) for i, part in enumerate(parts))
    if page.resolve() == ROOT / "README.md":  # its sections are no pages
        text = re.sub(r"^## (.*)", r"<h1>\1</h1>", text, flags=re.M)
    else:
        text = re.sub(r"\A# (.*)", lambda m: f"# {m[1]} {{#{label(page)}}}", text)
    sys.stdout.write(text)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
