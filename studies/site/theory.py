#!/usr/bin/env python3
"""The pages of docs/theory, with their equations; as a program, all of them as one document to print.

    theory.py FOLDER        writes FOLDER/theory.html and, by Chromium, FOLDER/theory.pdf
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import equations  # noqa: E402
import documents  # noqa: E402

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


def printed():
    """All chapters as one page. Links within it stay; those to other files of the repository become words."""
    files = [INDEX, *chapters()]
    of = {file: f"chapter-{k}" for k, file in enumerate(files)}

    def linker(file):
        def link(target):
            if re.match(r"^[a-z]+:", target):
                return target
            path, _, anchor = target.partition("#")
            there = os.path.relpath(((ROOT / file).parent / path).resolve() if path else ROOT / file, ROOT)
            if there in of:
                return f"#{of[there]}"
            return str(ROOT / there) if there.endswith(".svg") else ""

        return link

    parts = []
    for file in files:
        title, _, page = chapter(file, linker(file), lambda number, _: f"#eq-{number}", 2)
        page = re.sub(r' id="(?!eq-)[^"]*"', "", page)
        page = re.sub(r'<a [^>]*href="(?:|/[^"]*)"[^>]*>(.*?)</a>', r"\1", page, flags=re.S)
        parts.append(f'<section id="{of[file]}"><h1>{documents.inline(title)}</h1>{page}</section>')
    style = "\n".join((Path(__file__).parent / name).read_text(encoding="utf-8") for name in ("equations.css", "print.css"))
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>vlbeam: theory</title><style>{style}</style></head>\n'
            f'<body>{"".join(parts)}</body></html>\n')


def main():
    folder = Path(sys.argv[1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    page, paper = folder / "theory.html", folder / "theory.pdf"
    page.write_text(printed(), encoding="utf-8")
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not browser:
        sys.exit("Chromium prints the theory, and is not there: apt-get install chromium")
    apart = ["--no-sandbox"] if os.geteuid() == 0 else []  # it refuses to be root in a sandbox
    paper.unlink(missing_ok=True)
    told = subprocess.run([browser, "--headless", *apart, "--disable-gpu", "--no-pdf-header-footer", f"--print-to-pdf={paper}",
                           page.as_uri()], capture_output=True, text=True, timeout=300, check=False)
    if not paper.exists():
        sys.exit(f"{browser} printed nothing:\n{told.stderr}")
    print(os.path.relpath(paper))


if __name__ == "__main__":
    main()
