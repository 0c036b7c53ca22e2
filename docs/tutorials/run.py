#!/usr/bin/env python3
"""Runs the tutorials: the code of each page in its order, and compares what it prints with the page.

    run.py [--write] [--quick] [--pictures FOLDER] [NAME ...]

A page is NAME.md: blocks of `python`, each followed by a block of `text` with what it prints, if it prints anything, and by a picture
for each figure that it shows. NAME.ipynb is the same page as a notebook; its code cells are what is run. With --write outputs,
pictures and notebooks are written anew; else pictures go to FOLDER, if one is given. --quick does not run pages that take over 10 s.
"""

import argparse
import contextlib
import io
import json
import os
import re
import sys
import time
from pathlib import Path

SLOW = {"falling_beam"}  # it converges: a minute on two cores
FOLDER = Path(__file__).resolve().parent
PART = re.compile(r"^```(?P<language>python|text)\n(?P<code>.*?)^```\n|^!\[(?P<caption>[^\]]*)\]\((?P<picture>[^)]*)\)\n", re.S | re.M)


def parts(text):
    """(kind, text) of a page: prose, python, text, and pictures as (caption, file)."""
    found, end = [], 0
    for match in PART.finditer(text):
        found.append(("prose", text[end : match.start()]))
        if match["language"]:
            found.append((match["language"], match["code"]))
        else:
            found.append(("picture", (match["caption"], match["picture"])))
        end = match.end()
    return [part for part in [*found, ("prose", text[end:])] if part[0] != "prose" or part[1].strip()]


def notebook(page):
    """The page as a notebook: pictures are made where it is run."""
    cells = []

    def cell(kind, text, **more):
        cells.append({"cell_type": kind, "id": f"part-{len(cells)}", "metadata": {}, "source": text.strip().splitlines(keepends=True), **more})

    for kind, text in page:
        if kind == "prose":
            cell("markdown", text)
        elif kind == "python":
            cell("code", text, execution_count=None, outputs=[])
        elif kind == "text" and text:
            cells[-1]["outputs"] = [{"name": "stdout", "output_type": "stream", "text": text.splitlines(keepends=True)}]
    return {"cells": cells, "metadata": {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
                                         "language_info": {"name": "python"}}, "nbformat": 4, "nbformat_minor": 5}


def text_of(page):
    """The page as Markdown."""
    made = []
    for kind, text in page:
        if kind == "picture":
            made.append(f"![{text[0]}]({text[1]})\n")
        else:
            made.append(text if kind == "prose" else f"```{kind}\n{text}```\n")
    return "".join(made)


def run(cells, pictures):
    """What each code cell prints, and how many figures it shows. Figures go to `pictures`(number), if that is a path."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "vlbeam"
    from matplotlib import pyplot

    names, given, number = {"__name__": "__main__"}, [], 0
    for source in cells:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(source, "cell", "exec"), names)
        shown = pyplot.get_fignums()
        for figure in map(pyplot.figure, shown):
            number += 1
            figure.set_size_inches(6, 3.6)
            if pictures(number):
                figure.savefig(pictures(number), metadata={"Date": None}, bbox_inches="tight")
        pyplot.close("all")
        given.append((printed.getvalue(), len(shown)))
    return given


def tutorial(name, write, pictures, only_compare=False):
    """Runs a page, or only compares it with its notebook. Returns what is wrong with it, as sentences."""
    page_file, notebook_file, wrong = FOLDER / f"{name}.md", FOLDER / f"{name}.ipynb", []
    page = parts(page_file.read_text(encoding="utf-8"))
    if write:
        cells = [text for kind, text in page if kind == "python"]
        folder = FOLDER
    else:
        kept = json.loads(notebook_file.read_text(encoding="utf-8"))
        if kept != json.loads(json.dumps(notebook(page))):
            wrong.append(f"{notebook_file.name} is not the notebook of {page_file.name}: run.py --write {name}")
        if only_compare:
            return wrong
        cells = ["".join(cell["source"]) for cell in kept["cells"] if cell["cell_type"] == "code"]
        folder = pictures
    given = run(cells, lambda number: folder and folder / f"{name}_{number}.svg")

    # Each piece of code with what the page says of it.
    blocks, figures = [], 0
    for kind, text in page:
        if kind == "python":
            blocks.append({"code": text, "text": None, "pictures": []})
        elif kind == "text":
            blocks[-1]["text"] = text
        elif kind == "picture":
            blocks[-1]["pictures"].append(text[1])
    for block, (printed, shown) in zip(blocks, given):
        if write and printed and block["text"] is None:
            wrong.append(f"{page_file.name}: a block of text is missing behind\n{block['code']}")
        if not write and printed != (block["text"] or ""):
            wrong.append(f"{page_file.name} says\n{block['text'] or ''}and it is\n{printed}")
        expected = [f"{name}_{figures + k + 1}.svg" for k in range(shown)]
        figures += shown
        if block["pictures"] != expected:
            wrong.append(f"{page_file.name}: {block['pictures']} should be {expected}")
        block["printed"] = printed
    if write:
        outputs = iter(blocks)
        for k, (kind, _) in enumerate(page):
            if kind == "python":
                block = next(outputs)
            elif kind == "text":
                page[k] = ("text", block["printed"])
        page_file.write_text(text_of(page_with_blanks(page)), encoding="utf-8")
        page = parts(page_file.read_text(encoding="utf-8"))
        notebook_file.write_text(json.dumps(notebook(page), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return wrong


def page_with_blanks(page):
    """Parts apart from each other by a blank line."""
    made = []
    for kind, text in page:
        if made:
            made.append(("prose", "\n"))
        made.append((kind, text.strip("\n") + "\n" if kind == "prose" else text))
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    os.environ.setdefault("MPLBACKEND", "Agg")
    names = arguments.names or re.findall(r"\]\((\w+)\.md\)", (FOLDER / "README.md").read_text(encoding="utf-8"))
    wrong = []
    for name in dict.fromkeys(names):
        start = time.perf_counter()
        found = tutorial(name, arguments.write, arguments.pictures, arguments.quick and name in SLOW)
        print(f"{name}: {time.perf_counter() - start:.1f} s{', wrong' if found else ''}", flush=True)
        wrong += found
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
