"""Documents to print: one page of HTML, whose links stay within it, and Chromium, which makes a PDF of it."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent


def linker(file, of):
    """Maps the links of a document. `of` is where each document that is printed stands; a link to another file is nothing."""

    def link(target):
        if re.match(r"^[a-z]+:", target):
            return target
        path, _, _ = target.partition("#")
        there = os.path.relpath(((ROOT / file).parent / path).resolve() if path else ROOT / file, ROOT)
        if there in of:
            return f"#{of[there]}"
        return str(ROOT / there) if there.endswith(".svg") else ""

    return link


def linked(page):
    """The page without links that lead out of it to files, whose words stay."""
    return re.sub(r'<a [^>]*href="(?:|/[^"]*)"[^>]*>(.*?)</a>', r"\1", page, flags=re.S)


def style(*names):
    return "\n".join((HERE / name).read_text(encoding="utf-8") for name in ("equations.css", "print.css", *names))


def document(title, body, styles):
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title><style>{styles}</style></head>\n'
            f'<body>{body}</body></html>\n')


def printed(text, folder, name):
    """Writes FOLDER/NAME.html and prints it, as FOLDER/NAME.pdf."""
    page, paper = folder / f"{name}.html", folder / f"{name}.pdf"
    page.write_text(text, encoding="utf-8")
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not browser:
        sys.exit("Chromium prints it, and is not there: apt-get install chromium")
    apart = ["--no-sandbox"] if os.geteuid() == 0 else []  # it refuses to be root in a sandbox
    paper.unlink(missing_ok=True)
    told = subprocess.run([browser, "--headless", *apart, "--disable-gpu", "--no-pdf-header-footer", "--generate-pdf-document-outline",
                           f"--print-to-pdf={paper}", page.as_uri()], capture_output=True, text=True, timeout=900, check=False)
    if not paper.exists():
        sys.exit(f"{browser} printed nothing:\n{told.stderr}")
    return paper


def places(paper):
    """The page of each place of a PDF that a link leads to."""
    text = paper.read_bytes().decode("latin-1")
    pages = {number: k for k, number in enumerate(re.findall(r"^(\d+) 0 obj\n<</Type /Page\n", text, re.M), 1)}
    return {name: pages[number] for name, number in re.findall(r"/([\w.-]+) \[(\d+) 0 R\s+/XYZ ", text) if number in pages}
