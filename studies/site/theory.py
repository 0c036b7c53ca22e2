#!/usr/bin/env python3
"""The pages of docs/theory, with their equations; as a program, all of them as one document to print.

    theory.py FOLDER        writes FOLDER/theory.html and, by Chromium, FOLDER/theory.pdf
"""

import os
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import equations  # noqa: E402
import documents  # noqa: E402
import paper  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
INDEX = "docs/theory/README.md"


def chapters(root=ROOT):
    """Files of the chapters in their order, which is that of the links of the index's table."""
    text = (root / INDEX).read_text(encoding="utf-8")
    return [f"docs/theory/{name}" for name in dict.fromkeys(re.findall(r"^\| \d+ \| \[[^\]]*\]\((\w+\.md)\)", text, re.M))]


def numbers(file, root=ROOT):
    """Numbers of the equations of a document, in their order."""
    return [number for _, number, _ in equations.part((root / file).read_text(encoding="utf-8"))[1] if number]


def places(root=ROOT):
    """File of each number. Equations of chapter k are k.1, k.2 and so on, none left out."""
    found = {}
    for k, file in enumerate(chapters(root), 1):
        here = numbers(file, root)
        if here != [f"{k}.{i}" for i in range(1, len(here) + 1)]:
            sys.exit(f"{file}: its equations are not {k}.1, {k}.2, ... one after another: {', '.join(here)}")
        found |= dict.fromkeys(here, file)
    return found


def chapter(file, link, where, level=2):
    """(title, names of the sections, HTML) of a document without its heading. `where` maps a number and its file to a link."""
    text, found = equations.part((ROOT / file).read_text(encoding="utf-8"))
    title = re.match(r"# (.*)", text)[1]
    of = places()
    page = documents.render(re.sub(r"^# .*\n", "", text), link, level, documents.plain(title), anchors=True)
    page = re.sub(r"<p>(<img[^>]*>)</p>\s*<p><em>(Figure.*?)</em></p>", figure, page, flags=re.S)
    page = equations.put_back(page, found)
    page = equations.refer(page, lambda number: where(number, of[number]) if number in of else "")
    return title, [name for name, _ in documents.sections(text) if name], page


def figure(match):
    source = re.search(r'src="([^"]*)"', match[1])[1]
    return (f'<figure><a class="plate enlarge" href="{source}">{match[1]}</a>'
            f"<figcaption>{match[2]}</figcaption></figure>")


def anchors(root=ROOT):
    """Where each document of the theory stands, where it is printed."""
    return {file: f"chapter-{k}" for k, file in enumerate([INDEX, *chapters(root)])}


def parts(of):
    """(anchor, title, HTML) of all documents to print. `of` has what their links may lead to, their own anchors among it."""
    for file, anchor in anchors().items():
        title, _, page = chapter(file, paper.linker(file, of), lambda number, _: f"#eq-{number}", 2)
        yield anchor, documents.inline(title), re.sub(r' id="(?!eq-)[^"]*"', "", page)


def main():
    folder = Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    body = "".join(f'<section id="{anchor}"><h1>{title}</h1>{page}</section>' for anchor, title, page in parts(anchors()))
    text = paper.document("vlbeam: theory", paper.linked(body), paper.style())
    print(os.path.relpath(paper.printed(text, folder, "theory")))


if __name__ == "__main__":
    main()
