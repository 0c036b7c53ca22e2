"""The part of Markdown that the documents of this repository use, as HTML."""

import html
import re

_TOKEN = re.compile(
    r"(?P<code>`[^`]+`)"
    r"|!\[(?P<alt>[^\]]*)\]\((?P<src>[^)\s]+)\)"
    r"|\[(?P<label>(?:[^\[\]`]|`[^`]*`)+)\]\((?P<href>[^)\s]+)\)"
    r"|\*\*(?P<bold>.+?)\*\*"
    r"|(?<![\w*])\*(?P<emphasis>[^\s*](?:[^*]*[^\s*])?)\*(?![\w*])"
    r"|(?P<escaped>\\[\\`*_|<>\[\]])"
)
_ITEM = re.compile(r"^(?P<indent> *)(?P<mark>[*-]|\d+\.) +(?P<text>.*)$")
_RULE = re.compile(r"^\|?[ :|-]*-[ :|-]*\|?$")
_NUMBER = re.compile(r"^[-+−]?[\d.]+(?:e[-+]?\d+)?(?: ?%)?$|^$")
_POWER = re.compile(r"(\d(?:\.\d+)?e-\d+)")


def _words(text):
    """Text without marks; numbers like 1.5e-5 are not broken at their sign."""
    return _POWER.sub(r'<span class="whole">\1</span>', html.escape(text, quote=False))


def inline(text, link=lambda target: target):
    """HTML of one run of text; `link` maps the target of a link or an image."""
    parts, end = [], 0
    for match in _TOKEN.finditer(text):
        parts.append(_words(text[end : match.start()]))
        end = match.end()
        if match["code"]:
            parts.append(f"<code>{html.escape(match['code'][1:-1], quote=False)}</code>")
        elif match["src"]:
            parts.append(f'<img src="{html.escape(link(match["src"]))}" alt="{html.escape(match["alt"])}">')
        elif match["label"]:
            parts.append(f'<a href="{html.escape(link(match["href"]))}">{inline(match["label"], link)}</a>')
        elif match["bold"]:
            parts.append(f"<strong>{inline(match['bold'], link)}</strong>")
        elif match["emphasis"]:
            parts.append(f"<em>{inline(match['emphasis'], link)}</em>")
        else:
            parts.append(html.escape(match["escaped"][1], quote=False))
    parts.append(_words(text[end:]))
    return "".join(parts)


def plain(text):
    """The text without its marks."""
    return html.unescape(re.sub(r"<[^>]+>", "", inline(text)))


def cells(line):
    """The cells of a line of a table; a bar in `code` or behind a backslash parts none."""
    parts, cell, code = [], "", False
    body = line.strip().removeprefix("|")
    body = body[:-1] if body.endswith("|") and not body.endswith("\\|") else body
    for k, c in enumerate(body):
        code ^= c == "`"
        if c == "|" and not code and (k == 0 or body[k - 1] != "\\"):
            parts.append(cell.strip())
            cell = ""
        else:
            cell += c
    return [*parts, cell.strip()]


def tables(text):
    """All tables of a document, each a list of rows of cells, the first the head."""
    found, rows = [], []
    for line in [*text.splitlines(), ""]:
        if line.startswith("|"):
            if not _RULE.match(line):
                rows.append(cells(line))
        elif rows:
            found.append(rows)
            rows = []
    return found


def sections(text, level=2):
    """(title, body) of the sections below headings of this level, what stands before the first with the title ""."""
    mark = "#" * level + " "
    found, title, body, fenced = [], "", [], False
    for line in text.splitlines():
        fenced ^= line.startswith("```")
        if line.startswith(mark) and not fenced:
            found.append((title, "\n".join(body).strip()))
            title, body = line[len(mark) :].strip(), []
        else:
            body.append(line)
    return [*found, (title, "\n".join(body).strip())]


def _table(lines, link, label):
    rows = [cells(line) for line in lines if not _RULE.match(line)]
    # A column of numbers is set to the right.
    right = [' class="number"' if k and all(len(row) <= k or _NUMBER.match(row[k]) for row in rows[1:]) else ""
             for k in range(len(rows[0]))]
    head = "".join(f'<th scope="col"{right[k]}>{inline(cell, link)}</th>' if cell else "<td></td>"
                   for k, cell in enumerate(rows[0]))
    body = []
    for row in rows[1:]:
        columns = [f"<td{right[k]}>{inline(cell, link)}</td>" for k, cell in enumerate(row) if k]
        body.append(f'<tr><th scope="row">{inline(row[0], link)}</th>{"".join(columns)}</tr>')
    name = html.escape(f"Table in “{label}”" if label else "Table")
    return (f'<div class="scroll" tabindex="0" role="group" aria-label="{name}"><table><thead><tr>{head}</tr></thead>'
            f'<tbody>{"".join(body)}</tbody></table></div>')


def _list(lines, link, label):
    ordered = _ITEM.match(lines[0])["mark"][0].isdigit()
    items, current = [], []
    for line in lines:
        match = _ITEM.match(line)
        if match and not match["indent"]:
            if current:
                items.append(current)
            current = [match["text"]]
        else:
            current.append(re.sub(r"^ {1,3}", "", line))
    items.append(current)
    body = []
    for item in items:
        text = []
        while item and not _ITEM.match(item[0]):
            text.append(item.pop(0).strip())
        inner = inline(" ".join(text), link) + (render("\n".join(item), link, 2, label) if item else "")
        body.append(f"<li>{inner}</li>")
    kind = "ol" if ordered else "ul"
    return f"<{kind}>{''.join(body)}</{kind}>"


def anchor(heading):
    """What a link to a heading names after its #."""
    return re.sub(r"[^\w\- ]", "", plain(heading).lower()).strip().replace(" ", "-")


def render(text, link=lambda target: target, level=2, label="", anchors=False):
    """HTML of a document whose headings of the second level become those of `level`. `label` names its tables until a
    heading does; with `anchors` headings can be linked to."""
    lines, out, i = text.splitlines(), [], 0

    def block(belongs):
        nonlocal i
        start = i
        while i < len(lines) and belongs(lines[i], i == start):
            i += 1
        return lines[start:i]

    while i < len(lines):
        line = lines[i]
        heading = re.match(r"^(#+) +(.*)$", line)
        if not line.strip():
            i += 1
        elif line.startswith("```"):
            i += 1
            body = block(lambda l, _: not l.startswith("```"))
            i += 1
            out.append(f'<pre tabindex="0"><code>{html.escape(chr(10).join(body), quote=False)}</code></pre>')
        elif line.startswith("    "):
            body = block(lambda l, _: l.startswith("    ") or not l.strip())
            text_of = "\n".join(l[4:] for l in body).strip("\n")
            out.append(f'<pre tabindex="0"><code>{html.escape(text_of, quote=False)}</code></pre>')
        elif heading:
            rank = min(6, max(1, len(heading[1]) + level - 2))
            label = plain(heading[2])
            name = f' id="{html.escape(anchor(heading[2]))}"' if anchors else ""
            out.append(f"<h{rank}{name}>{inline(heading[2], link)}</h{rank}>")
            i += 1
        elif line.startswith("|"):
            out.append(_table(block(lambda l, _: l.startswith("|")), link, label))
        elif _ITEM.match(line):
            out.append(_list(block(lambda l, first: bool(l.strip()) and (bool(_ITEM.match(l)) or l.startswith("  "))),
                             link, label))
        else:
            body = block(lambda l, first: first or (bool(l.strip()) and not l.startswith(("|", "#", "```"))
                                                    and not _ITEM.match(l)))
            out.append(f"<p>{inline(' '.join(l.strip() for l in body), link)}</p>")
    return "\n".join(out)
