"""Equations of a document: TeX between dollars and in fenced blocks of language math, as MathML by blahtexml.

A document is parted from its equations before its Markdown is read, and gets them back in the HTML:

    text, found = part(text)
    html = put_back(documents.render(text), found)
"""

import functools
import html
import re
import shutil
import subprocess
import sys

# Code is looked at first: a dollar in it is none of ours.
_PIECE = re.compile(
    r"^```math\n(?P<block>.*?)^```$"
    r"|(?P<code>^```.*?^```$|`[^`\n]+`)"
    r"|(?<!\\)\$(?P<inline>[^$\n]+)\$",
    re.M | re.S,
)
_TAG = re.compile(r"\\tag\{([\w.]+)\}\s*")
_OPEN, _CLOSE = "\ue000", "\ue001"  # of a place where an equation stood; private, so in no text
_PLACE = re.compile(f"{_OPEN}(\\d+){_CLOSE}")
_ACCENTS = {"\u00b7": "\u02d9", "\u00b7\u00b7": "\u00a8"}


@functools.cache
def mathml(tex, display):
    """MathML of an equation. What browsers do not know of MathML 2 is said as they know it."""
    program = shutil.which("blahtexml")
    if not program:
        sys.exit("blahtexml sets the equations of the theory, and is not there: apt-get install blahtexml")
    options = ["--mathml", "--mathml-encoding", "raw", "--other-encoding", "raw", *(["--displaymath"] if display else [])]
    told = subprocess.run([program, *options], input=tex, capture_output=True, text=True, encoding="utf-8", check=False)
    markup = re.search(r"<markup>\s*(.*?)\s*</markup>", told.stdout, re.S)
    if not markup:
        message = re.search(r"<message>(.*?)</message>", told.stdout)
        sys.exit(f"blahtexml cannot set  {tex.strip()}\n{html.unescape(message[1]) if message else told.stdout + told.stderr}")
    body = re.sub(r'\n\s*|<mspace width="0"/>', "", markup[1])
    body = body.replace('mathvariant="bold-italic"', 'class="bold"').replace('mathvariant="bold"', 'mathvariant="normal" class="bold"')
    body = re.sub(r"(<mo[^>]*>)-(</mo>)", "\\1\u2212\\2", body)
    body = body.replace('lspace="0" rspace="0" stretchy="false">|<', 'lspace="0.1em" rspace="0.1em" stretchy="false">|<')
    body = re.sub(r"<mo([^>]*>\u222b</mo>)", r'<mo class="integral"\1', body)
    body = re.sub(r'(<mo accent="true">)(\u00b7+)</mo>', lambda m: f"{m[1]}{_ACCENTS[m[2]]}</mo>", body)
    return f'<math{" display=" + chr(34) + "block" + chr(34) if display else ""}>{body}</math>'


def part(text):
    """The text with a mark for each equation, and the equations: (TeX, number or "", whether it stands by itself)."""
    found = []

    def replace(match):
        if match["code"]:
            return match[0]
        tex, block = match["block"] or match["inline"], match["block"] is not None
        tag = _TAG.search(tex) if block else None
        found.append((" ".join(_TAG.sub("", tex).split()), tag[1] if tag else "", block))
        return f"{_OPEN}{len(found) - 1}{_CLOSE}"

    return _PIECE.sub(replace, text), found


def _display(tex, number):
    label = f"Equation {number}" if number else "Equation"
    name = f' id="eq-{number}"' if number else ""
    link = f'<a class="tag" href="#eq-{number}">({number})</a>' if number else ""
    return (f'<div class="equation"{name}><div class="scroll" tabindex="0" role="group" aria-label="{label}">'
            f"{mathml(tex, True)}</div>{link}</div>")


def put_back(page, found):
    """HTML with its equations: those that stand by themselves are paragraphs of their own."""
    page = re.sub(f"<p>{_OPEN}(\\d+){_CLOSE}</p>", lambda m: _display(*found[int(m[1])][:2]), page)
    return _PLACE.sub(lambda m: mathml(found[int(m[1])][0], False), page)


def plain(text, found):
    """Text with the TeX of its equations, where there is no place for them."""
    return _PLACE.sub(lambda m: found[int(m[1])][0], text)


def refer(page, where):
    """Makes links of the numbers of equations in a text; `where` says where one stands, or nothing."""
    pieces = re.split(r"(<math.*?</math>|<code.*?</code>|<a .*?</a>|<[^>]+>)", page, flags=re.S)
    for k in range(0, len(pieces), 2):
        pieces[k] = re.sub(r"\((\d+\.\d+)\)",
                           lambda m: f'(<a href="{where(m[1])}">{m[1]}</a>)' if where(m[1]) else m[0], pieces[k])
    return "".join(pieces)
