#!/usr/bin/env python3
# visp-direct: direct methods for vision-based robot control, for ViSP.
# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads the public headers of modules/ and writes what the bindings need of them, so that it is said once: the fields of
structs, the values of enums, and all docstrings. Usage: headers.py OUTPUT MODULES_FOLDER MODULE..."""
import keyword
import pathlib
import re
import sys

SCOPE = re.compile(r"(?:template\s*<[^>]*>\s*)?(struct|class|enum|namespace)\b(.*)", re.S)
TOKEN = re.compile(r"/\*.*?\*/|//[^\n]*|#[^\n]*(?:\\\n[^\n]*)*|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])'|.", re.S)


class Scope:
    """A namespace, class or enum: its declarations with their docstrings, in order."""

    def __init__(self, kind, name, doc):
        self.kind, self.name, self.doc = kind, name, doc
        self.public = kind != "class"
        self.isTemplate = False
        self.members = []  # [kind, name, doc] with kind "field", "function", "value"


def comment_text(comment):
    """Text of a doxygen comment without its marks; None for other comments."""
    if comment.startswith("/*!"):
        return "\n".join(re.sub(r"^\s*\* ?", "", line) for line in comment[3:-2].split("\n"))
    return re.sub(r"^//!<? ?", "", comment) if comment.startswith("//!") else None


def declaration(statement):
    """Kind and name of what a statement of a class declares, or None."""
    statement = re.sub(r"\[\[.*?\]\]|VISP_EXPORT|VP_OVERRIDE", "", statement).strip()
    head = re.split(r"=|\{", statement, maxsplit=1)[0]
    if re.match(r"(using|friend|typedef|static_assert|static\s+constexpr|constexpr\s+\w+\s+\w+\s*=|~)", statement):
        return None
    if "operator" in head:
        return None
    if "(" in head:
        return "function", re.search(r"([~\w]+)\s*\(", head).group(1)
    names = re.findall(r"\w+", head)
    return ("field", names[-1]) if len(names) > 1 else None


class Parser:
    """One pass over the tokens of a header; `scopes` are the results, by C++ name."""

    def __init__(self, scopes, text):
        self.scopes, self.stack = scopes, [scopes.setdefault("", Scope("namespace", "", ""))]
        self.statement, self.doc, self.ended_line = "", "", True
        self.skip = 0  # depth of braces of a function body or an initializer
        for token in TOKEN.findall(re.sub(r"\b(BEGIN|END)_VISP_NAMESPACE\b", "", text)):
            self.take(token)

    def take(self, token):
        if token.startswith(("/*", "//")) and len(token) > 1:
            self.comment(token)
        elif self.skip:
            self.skip += {"{": 1, "}": -1}.get(token, 0)
            if not self.skip and self.in_body:
                self.end()
        elif token.startswith("#"):
            pass
        elif token == "{":
            self.open()
        elif token == "}":
            if self.stack[-1].kind == "enum":
                self.end()
            if len(self.stack) > 1:
                self.stack.pop()
            self.statement = ""
        elif token == ";" or (token == "," and self.stack[-1].kind == "enum"):
            self.end()
        elif token == ":" and self.statement.strip() in ("public", "private", "protected"):
            self.stack[-1].public = self.statement.strip() == "public"
            self.statement = ""
        else:
            self.statement += token

    def comment(self, token):
        text = comment_text(token)
        if text is None or self.skip:
            return
        if token.startswith("//!<"):
            if self.statement.strip():
                self.doc += text + "\n"
            elif self.stack[-1].members:
                self.stack[-1].members[-1][2] += text + "\n"
        else:
            self.doc += text + "\n"

    def open(self):
        match = SCOPE.match(self.statement.strip())
        if not match or "(" in self.statement:
            self.skip = 1
            self.in_body = "(" in self.statement and self.statement.count("(") == self.statement.count(")")
            return
        name = re.sub(r"VISP_EXPORT|class\b|:.*", "", match.group(2), flags=re.S).strip().split(" ")[0]
        outer = self.stack[-1].name
        full = f"{outer}::{name}" if outer else name
        kind = match.group(1)
        if not self.stack[-1].public:
            full = "private::" + full
        scope = self.scopes.setdefault(full, Scope(kind, full, self.doc))
        scope.isTemplate = self.statement.strip().startswith("template")
        self.stack.append(scope)
        self.statement, self.doc = "", ""

    def end(self):
        scope = self.stack[-1]
        if scope.kind == "enum":
            name = re.match(r"\s*(\w+)", self.statement)
            found = ("value", name.group(1)) if name else None
        else:
            found = declaration(self.statement) if scope.public else None
        if found:
            scope.members.append([*found, self.doc])
        self.statement, self.doc = "", ""


def plain(doc):
    """Doxygen as plain text, in the names of Python."""
    doc = re.sub(r"\\code.*?\\endcode|\\cite \w+|\\f[$\[\]]", "", doc, flags=re.S)
    doc = re.sub(r"\\(ingroup|class|file|name) ?[^\n]*\n?|\\(brief|verbatim|endverbatim|overload)\b|@[{}]", "", doc)
    doc = re.sub(r"\\throws? (?:vp(?:Robot)?Exception )?", "Raises an exception ", doc)
    doc = re.sub(r"\\t?param ", "", re.sub(r"\\return ", "Returns: ", doc))
    doc = re.sub(r"\\(e|c|a|p|li|note|copydoc) ?", "", doc)
    doc = re.sub(r"#(?=\w)", "", re.sub(r"\bvp(?=[A-Z])", "", doc)).replace("::", ".")
    lines = [line.strip() for line in doc.strip().split("\n")]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).strip()


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", '\\n"\n    "') + '"'


def python_name(name):
    """Name in Python of a C++ name: without vp and without ::, with _ behind a keyword."""
    name = re.sub(r"^vp(?=[A-Z])", "", name.replace("::vp", "").replace("::", ""))
    return name + "_" if keyword.iskeyword(name) else name


def reflection(scope):
    """The C++ that lets a template visit the members of a struct or enum."""
    type_name = scope.name + "<Eigen::Dynamic>" if scope.isTemplate else scope.name
    kind = "value" if scope.kind == "enum" else "field"
    lines = [
        f"template <> struct Reflect<{type_name}> {{",
        f"  static constexpr const char *name = {quoted(python_name(scope.name))};",
        f"  static constexpr const char *doc = {quoted(plain(scope.doc))};",
        "  template <class Visit> static void each(Visit &&visit)",
        "  {",
    ]
    for what, name, doc in scope.members:
        if what == kind:
            pointer = f"{type_name}::{name}" if kind == "value" else f"&{type_name}::{name}"
            lines.append(f"    visit({quoted(python_name(name))}, {pointer}, {quoted(plain(doc))});")
    return "\n".join(lines + ["    (void)visit;", "  }", "};"])


def main(output, folder, modules):
    scopes, includes = {}, []
    for module in modules:
        for header in sorted((pathlib.Path(folder) / module / "include/visp3" / module).glob("*.h")):
            Parser(scopes, header.read_text())
            includes.append(f"#include <visp3/{module}/{header.name}>")
    documents = {}
    for scope in scopes.values():
        documents[scope.name] = plain(scope.doc)
        for _, name, doc in scope.members:
            key = f"{scope.name}::{name}" if scope.name else name
            documents[key] = documents.get(key) or plain(doc)
    shown = [s for s in scopes.values() if s.kind != "namespace" and "private" not in s.name and s.name != "vpField"]
    parts = [
        "// Generated by python/bind/headers.py from the headers of the modules.",
        "#pragma once",
        *includes,
        "",
        "template <class T> struct Reflect;",
        *(reflection(s) for s in shown),
        "#ifdef VISP_DIRECT_DOCSTRINGS",
        "static const char *const docstrings[][2] = {",
        *(f"  {{{quoted(name)}, {quoted(doc)}}}," for name, doc in sorted(documents.items()) if doc),
        "};",
        "#endif",
        "",
    ]
    text, file = "\n".join(parts), pathlib.Path(output)
    if not file.is_file() or file.read_text() != text:  # else nothing has to be compiled again
        file.write_text(text)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
