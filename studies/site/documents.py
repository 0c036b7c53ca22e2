"""Documents in Markdown as parts of pages: python3-markdown, and what a page of the site asks of its HTML besides."""

import html
import re
import xml.etree.ElementTree as etree

import markdown
from markdown.extensions import Extension
from markdown.treeprocessors import Treeprocessor

_RULE = re.compile(r"^\|?[ :|-]*-[ :|-]*\|?$")
_NUMBER = re.compile(r"^[-+−]?[\d.]+(?:e[-+]?\d+)?(?: ?%)?$|^$")
_POWER = re.compile(r"(\d(?:\.\d+)?e-\d+)")
_HYPHEN = re.compile(r"(?<!\S)([^\s<>]{0,24}-[^\s<>]{0,24})(?!\S)")  # where browsers would break a word
_LONG, _JOINT = re.compile(r"[^\s<>]{25,}"), re.compile(r"([/_.]|\[\])(?=[^<>]{3})")
_BAR = re.compile(r"(?<!\\)\|(?=(?:[^`]*`[^`]*`)*[^`]*$)")  # one that is neither in `code` nor behind a backslash


class _Pages(Treeprocessor):
    """Links that lead from the site, tables with heads that can be scrolled, headings of the rank they have on the page."""

    def __init__(self, md, link, level, label, anchors):
        super().__init__(md)
        self._link, self._level, self._label, self._anchors = link, level, label, anchors

    def run(self, root):
        label = self._label
        for parent, child in [(parent, child) for parent in root.iter() for child in parent]:
            if re.fullmatch("h[1-6]", child.tag):
                label = self._text(child)
                child.tag = f"h{min(6, max(1, int(child.tag[1]) + self._level - 2))}"
                if self._anchors:
                    child.set("id", anchor(label))
            elif child.tag == "a":
                child.set("href", self._link(child.get("href", "")))
            elif child.tag == "img":
                child.set("src", self._link(child.get("src", "")))
            elif child.tag == "table":
                self._table(parent, child, label)

    def _text(self, element):
        return plain_html(self.md.serializer(element)).strip()

    def _table(self, parent, table, label):
        rows = list(table.iter("tr"))
        texts = [["" if cell.find("img") is not None else self._code_kept(cell) for cell in row] for row in rows]
        for k in range(1, len(texts[0])):
            if all(len(row) <= k or _NUMBER.match(row[k]) for row in texts[1:]):
                for row in rows:
                    if k < len(row):
                        row[k].set("class", "number")
        for cell in rows[0]:
            cell.attrib.pop("style", None)
            if cell.text or len(cell):
                cell.set("scope", "col")
            else:
                cell.tag = "td"
        for row in rows[1:]:
            row[0].tag = "th"
            row[0].set("scope", "row")
        frame = etree.Element("div", {"class": "scroll", "tabindex": "0", "role": "group",
                                      "aria-label": f"Table in “{label}”" if label else "Table"})
        frame.tail, table.tail = table.tail, None
        parent[list(parent).index(table)] = frame
        frame.append(table)

    def _code_kept(self, cell):
        return "".join(cell.itertext()).strip()


class _OnPages(Extension):
    def __init__(self, *given):
        super().__init__()
        self._given = given

    def extendMarkdown(self, md):
        md.treeprocessors.register(_Pages(md, *self._given), "pages", 5)  # after what is in a line


def render(text, link=lambda target: target, level=2, label="", anchors=False):
    """HTML of a document whose headings of the second level become those of `level`. `label` names its tables until a
    heading does; with `anchors` headings can be linked to. `link` maps the target of a link or an image."""
    made = markdown.markdown(text, extensions=["tables", "fenced_code", "sane_lists", _OnPages(link, level, label, anchors)],
                             output_format="html")
    made = re.sub(r"<pre><code[^>]*>", '<pre tabindex="0"><code>', made)
    pieces = re.split(r"(<pre.*?</pre>|<code.*?</code>|<math.*?</math>|<[^>]+>)", made, flags=re.S)
    for k in range(0, len(pieces), 2):  # numbers like 1.5e-5 are not broken at their sign
        pieces[k] = _POWER.sub(r'<span class="whole">\1</span>', pieces[k])
    for k in range(1, len(pieces), 2):
        if pieces[k].startswith("<code>"):
            pieces[k] = _code(pieces[k][6:-7])
    return "".join(pieces)


def _code(code):
    """Code in a line: a short word of it stays whole, a long one breaks at its joints."""
    if not re.search(r"\s", code) and len(html.unescape(code)) < 25:
        return f'<code class="whole">{code}</code>'
    code = _LONG.sub(lambda word: _JOINT.sub(r"\1<wbr>", word[0]), code)
    return "<code>" + _HYPHEN.sub(r'<span class="whole">\1</span>', code) + "</code>"


def inline(text, link=lambda target: target):
    """HTML of one run of text, which is no list where it begins with a number."""
    return re.sub(r"^<p>|</p>$", "", render(re.sub(r"^(\d+)\.", r"\1\\.", text.strip()), link))


def plain_html(made):
    return html.unescape(re.sub(r"<[^>]+>", "", made))


def plain(text):
    """The text without its marks."""
    return plain_html(inline(text))


def anchor(heading):
    """What a link to a heading names after its #."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


def tables(text):
    """All tables of a document, each a list of rows of cells, the first the head."""
    found, rows = [], []
    for line in [*text.splitlines(), ""]:
        if line.startswith("|"):
            if not _RULE.match(line):
                rows.append([cell.strip() for cell in _BAR.split(line.strip())[1:-1]])
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


def title(text):
    """The heading of a document."""
    return re.match(r"# (.*)", text)[1]
