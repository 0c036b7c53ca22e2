#!/usr/bin/env python3
"""The verification report as one document to print: findings, a chapter a study, theory. All of it is what is committed.

    book.py FOLDER [REPORTS]        writes FOLDER/book.html and, by Chromium, FOLDER/book.pdf
"""

import itertools
import os
import re
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import build  # noqa: E402
import documents  # noqa: E402
import paper  # noqa: E402
import study_page  # noqa: E402
import theory  # noqa: E402
from markupsafe import Markup  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
FINDINGS = "docs/findings.md"
LONGEST = 100  # rows of a table that is printed
WIDE = 10  # columns of a table that takes pages across


def citation(text):
    """What CITATION.cff says: its lines of the first level, and the names of the authors."""
    said = {}
    for key, folded, line in re.findall(r"^([\w-]+):[ ]*(?:[>|]-?\n((?:[ ]+.*\n?)+)|(.+)$)", text, re.M):
        said[key] = " ".join((folded or line).split()).strip("\"'")
    said["authors"] = []
    for author in re.split(r"^ *- ", re.search(r"^authors:\n((?:[ -].*\n?)+)", text, re.M)[1], flags=re.M)[1:]:
        names = dict(re.findall(r"^ *([\w-]+): *[\"']?(.*?)[\"']?$", author, re.M))
        said["authors"].append(names.get("name") or f"{names.get('given-names', '')} {names.get('family-names', '')}".strip())
    return said


def newest():
    """The day of the newest change of what the book is made of."""
    told = subprocess.run(["git", "log", "-1", "--format=%cs", "--", "CITATION.cff", "README.md", "docs", "reports", "studies"],
                          cwd=ROOT, capture_output=True, text=True, check=False)
    return told.stdout.strip()


class Book(build.Site):
    """The site's pages of studies, whose links lead to places of the book."""

    def __init__(self, out):
        super().__init__(out)
        told = list(self.overview)  # the studies in the order of the findings
        self.order = sorted(self.reports, key=lambda name: told.index(name) if name in told else len(told))
        self.of = {FINDINGS: "findings"} | {f"studies/{name}/README.md": f"study-{name}" for name in self.order} | theory.anchors()

    def linker(self, document):
        return paper.linker(document.relative_to(ROOT), self.of)

    def figure(self, figure):
        return super().figure(figure) | {"file": str(self.out / figure["file"])}

    def fill(self, template, **given):
        return Markup(self.environment.get_template(template).render(**given))

    def chapter(self, k, name):
        """(title, HTML) of a study. Figures of its document stand there, the others behind it."""
        given = study_page.parts(self, name)
        number, left = (itertools.count(1), itertools.count(1)), {figure["file"]: figure for figure in given["figures"]}

        def numbered(word, what, text):
            text = re.sub(r"^(?=Figure \d)", "The paper's ", text)  # reports name these by its numbers
            return what | {"caption": f"{word} {k}.{next(number[word == 'Table'])}. {text}"}

        def shown(image):
            figure = left.pop(image[1], None)
            return self.fill("book_figure.html", figure=numbered("Figure", figure, figure["caption"])) if figure else image[0]

        prose = [(heading, Markup(re.sub(r'<p><img [^>]*src="([^"]*)"[^>]*></p>', shown, str(body))))
                 for _, heading, body in given["prose"]]
        tables = [table for table in given["tables"] if len(table["rows"]) <= LONGEST]
        out = [table for table in given["tables"] if len(table["rows"]) > LONGEST]
        tables = [numbered("Table", table, table["caption"]) | {"folded": False, "csv": ""} for table in tables + given["orders"]]
        return given["s"]["title"], self.fill(
            "book_study.html", **given | {"prose": prose, "figures": [numbered("Figure", f, f["caption"]) for f in left.values()],
                                          "tables": tables, "left_out": out, "folder": os.path.relpath(self.out, ROOT)})

    def parts(self):
        """Parts of the book: number, title, anchor, HTML, and its chapters, each an anchor, a title and HTML."""
        gates = [gate for report in self.reports.values() for gate in report["gates"]]
        studies = [(f"study-{name}", *self.chapter(k, name)) for k, name in enumerate(self.order, 1)]
        (_, title, index), *chapters = theory.parts(self.of)
        findings = documents.render(re.sub(r"^# .*\n", "", self.text(FINDINGS)), self.linker(ROOT / FINDINGS), 2, "Findings")
        intro = self.fill("book_studies.html", gates=gates, counts=study_page.tally(gates), kinds=study_page.KINDS, studies=studies)
        yield "I", "Findings", "findings", Markup(findings), []
        yield "II", "Studies", "studies", intro, [(anchor, f"{k}. {name}", body) for k, (anchor, name, body) in enumerate(studies, 1)]
        yield "III", documents.plain_html(title), "chapter-0", Markup(index), [
            (anchor, documents.plain_html(name), Markup(body)) for anchor, name, body in chapters]

    def heads(self, parts):
        """Style of the pages: what stands above their text, and the pages across."""
        rules = []
        for number, title, anchor, _, chapters in parts:
            for name, text in [(anchor, ""), *((name, text) for name, text, _ in chapters)]:
                left, right = (word.replace("\\", r"\\").replace('"', r"\"") for word in (f"Part {number}: {title}", text))
                head = f'@top-left {{ content: "{left}"; }} @top-right {{ content: "{right}"; }}'
                wide = f".scroll:has(thead > tr > :nth-child({WIDE + 1})), h2:has(+ .scroll thead > tr > :nth-child({WIDE + 1}))"
                rules.append(f"@page {name} {{ {head} }} @page {name}-across {{ size: A4 landscape; {head} }} "
                             f"#{name} {{ page: {name}; & :is({wide}) {{ page: {name}-across; }} }}")
        return "\n".join(rules)

    def page(self):
        """The book as HTML. Where the contents name a page, an empty mark stands."""
        said, parts = citation(self.text("CITATION.cff")), list(self.parts())
        abstract = self.render(said["abstract"], "README.md") if "abstract" in said else self.lead()
        body = self.fill("book.html", said=said, date=said.get("date-released") or newest(), abstract=abstract, parts=parts)
        return paper.document(said["title"], paper.linked(str(body)), paper.style("book.css") + self.heads(parts))


def main():
    folder = Path(sys.argv[1]).resolve()
    book = Book(Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "reports").resolve())
    if not book.reports:
        sys.exit(f"{book.out}: no report of a study is there")
    folder.mkdir(parents=True, exist_ok=True)
    page, pages, found = book.page(), {}, None
    while found != pages:  # numbers of pages are known when it has been printed
        pages = found or {}
        printed = paper.printed(re.sub(r'(?<=<b data-of=")([^"]*)">', lambda m: f'{m[1]}">{pages.get(m[1], "")}', page), folder, "book")
        found = paper.places(printed)
    print(os.path.relpath(printed))


if __name__ == "__main__":
    main()
