#!/usr/bin/env python3
"""The site of the committed reports: every link leads somewhere, and it can be read by everybody.

    site_test.py SOURCES
"""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from unittest import mock
from urllib.parse import unquote, urldefrag

sys.dont_write_bytecode = True
SOURCES = Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCES / "studies" / "site"))
import book  # noqa: E402
import documents  # noqa: E402
import equations  # noqa: E402
import paper  # noqa: E402
import theory  # noqa: E402

VOID = {"meta", "link", "img", "br", "hr", "input", "wbr"}
HEAVIEST = 3_000_000  # bytes of a page with all that it shows


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.path, self.ids, self.headings, self.links, self.shown = path, [], [], [], []
        self.problems, self.tags, self.refers, self.open, self.title = [], [], [], [], ""
        self.text_of_link = None
        self.feed(path.read_text(encoding="utf-8"))
        self.close()
        if self.open:
            self.problems.append(f"not closed: {self.open}")

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.tags.append((tag, given))
        if tag not in VOID:
            self.open.append(tag)
        if "id" in given:
            self.ids.append(given["id"])
        for key in ("aria-labelledby", "aria-describedby"):
            self.refers += given.get(key, "").split()
        if re.fullmatch("h[1-6]", tag):
            self.headings.append(int(tag[1]))
        if tag == "a":
            self.links.append(given.get("href", ""))
            self.text_of_link = ""
        if tag == "img":
            if "alt" not in given:
                self.problems.append(f"no alt text: {given.get('src')}")
            elif self.text_of_link is not None:
                self.text_of_link += given["alt"]
        source = given.get("src") or (given.get("href") if tag == "link" else None)
        if source:
            self.shown.append(source)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.problems.append(f"{tag} closes nothing at {self.getpos()}")
        if tag == "a":
            if not self.text_of_link.strip():
                self.problems.append(f"a link without text: {self.links[-1]}")
            self.text_of_link = None

    def handle_data(self, data):
        if self.text_of_link is not None:
            self.text_of_link += data
        if self.open and self.open[-1] == "title":
            self.title += data


def luminance(colour):
    channels = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


class TheSite(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        # Beside copies of what its pages lead to, as it stands in the sources.
        root = Path(cls.folder.name)
        cls.out = root / "reports"
        shutil.copytree(SOURCES / "reports", cls.out, ignore=shutil.ignore_patterns("*.html", "site", "*.timing.*"))
        subprocess.run([sys.executable, SOURCES / "studies/site/build.py", cls.out], check=True, cwd=root,
                       stdout=subprocess.DEVNULL)
        cls.pages = {path.name: Page(path) for path in sorted(cls.out.glob("*.html"))}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    where = ""  # the page that is looked at

    def _formatMessage(self, message, standard):
        return f"{self.where}: {super()._formatMessage(message, standard)}"

    def each(self):
        for self.where, page in self.pages.items():
            yield page

    def test_has_a_page_a_study(self):
        studies = {path.parent.name for path in SOURCES.glob("studies/*/gates.json")}
        named = {name for name in self.pages if not name.startswith("doc_")}
        self.assertEqual({"index.html", "scenes.html", "studies.html"} | {f"{study}.html" for study in studies}, named)
        self.assertGreaterEqual(len(self.pages) - len(named), 5)

    def test_is_well_formed(self):
        for page in self.each():
            self.assertEqual([], page.problems)
            self.assertEqual(len(page.ids), len(set(page.ids)), "ids are unique")
            self.assertLessEqual(set(page.refers), set(page.ids))

    def test_has_landmarks_a_language_and_a_title(self):
        titles = [page.title for page in self.pages.values()]
        self.assertEqual(len(titles), len(set(titles)))
        for page in self.each():
            tags = [tag for tag, _ in page.tags]
            for landmark in ("header", "nav", "main", "footer", "title"):
                self.assertIn(landmark, tags)
            self.assertEqual(1, tags.count("main"))
            self.assertIn(("html", {"lang": "en"}), page.tags)

    def test_has_headings_in_order(self):
        for page in self.each():
            self.assertEqual(1, page.headings.count(1))
            self.assertEqual(1, page.headings[0])
            for above, below in zip(page.headings, page.headings[1:]):
                self.assertLessEqual(below, above + 1)

    def test_leads_somewhere(self):
        for page in self.each():
            for link in page.links + page.shown:
                target, anchor = urldefrag(unquote(link))
                self.assertNotRegex(target, r"^/", "links are relative")
                if target.startswith(("http:", "https:")):
                    self.assertNotIn(link, page.shown, "nothing is fetched from the network")
                    continue
                path = Path(os.path.normpath(page.path.parent / target)) if target else page.path
                self.assertTrue(path.exists(), f"{link} leads nowhere")
                if anchor:
                    self.assertIn(anchor, self.pages[path.name].ids, link)

    def test_tables_have_heads(self):
        for page in self.each():
            for tag, given in page.tags:
                if tag == "th":
                    self.assertIn(given.get("scope"), ("col", "row"))

    def test_can_be_scrolled_by_keyboard(self):
        for page in self.each():
            for tag, given in page.tags:
                if given.get("class") == "scroll" or tag == "pre":
                    self.assertEqual("0", given.get("tabindex"))
                if given.get("class") == "scroll":
                    self.assertTrue(given.get("aria-label"))

    def test_is_light_enough(self):
        for page in self.each():
            files = {page.path} | {page.path.parent / source for source in page.shown}
            self.assertLessEqual(sum(path.stat().st_size for path in files), HEAVIEST)

    def test_shows_every_gate_and_every_figure(self):
        for path in sorted(self.out.glob("*.json")):
            report = json.loads(path.read_text(encoding="utf-8"))
            page = self.pages[f"{path.stem}.html"]
            text = documents.html.unescape(page.path.read_text(encoding="utf-8"))
            for gate in report["gates"]:
                self.assertIn(f">{gate['name']}<", text)
            for figure in report["figures"]:
                self.assertIn(figure["file"], page.shown)
            for table in report["tables"]:
                self.assertIn(table["file"], page.links)

    def test_says_what_fails(self):
        path = self.out / "torsion.json"
        text = path.read_text(encoding="utf-8")
        page = self.out / "torsion.html"
        before = page.read_text(encoding="utf-8")
        report = json.loads(text)
        report["gates"][0] |= {"passed": False, "failure": "too large"}
        try:
            path.write_text(json.dumps(report), encoding="utf-8")
            subprocess.run([sys.executable, SOURCES / "studies/site/build.py", self.out], check=True,
                           stdout=subprocess.DEVNULL)
            self.assertIn("✗ 1 of 13 gates fail", page.read_text(encoding="utf-8"))
            self.assertIn("too large", page.read_text(encoding="utf-8"))
            self.assertIn("gates fail", (self.out / "studies.html").read_text(encoding="utf-8"))
        finally:
            path.write_text(text, encoding="utf-8")
            subprocess.run([sys.executable, SOURCES / "studies/site/build.py", self.out], check=True,
                           cwd="/", env={"LC_ALL": "C", "TZ": "Asia/Tokyo", "PATH": os.environ["PATH"]},
                           stdout=subprocess.DEVNULL)
        self.assertEqual(before, page.read_text(encoding="utf-8"), "and nothing of the place or the language it is written in")

    def test_colours_can_be_read(self):
        css = (SOURCES / "studies/site/style.css").read_text(encoding="utf-8")
        light, dark = (dict(re.findall(r"--([\w-]+): (#\w{6});", block)) for block in re.findall(r":root \{(.*?)\}", css, re.S))
        self.assertEqual(set(light), set(dark))
        for theme in (light, dark):
            for ground in ("page", "card", "shade"):
                for ink in ("text", "soft", "accent", "holds", "fails"):
                    self.assertGreaterEqual(contrast(theme[ink], theme[ground]), 4.5, f"{ink} on {ground}")
            for kind in ("exact", "independent", "self", "regression"):
                self.assertGreaterEqual(contrast(theme["on-kind"], theme[kind]), 4.5, kind)


class Markdown(unittest.TestCase):
    def test_marks(self):
        self.assertEqual('<strong>a</strong> <em>b</em> <code class="whole">c_*d*</code>', documents.inline("**a** *b* `c_*d*`"))
        self.assertEqual("a &lt; b &amp; |x|", documents.inline(r"a < b & |x|"))
        self.assertEqual('<a href="X/y.md"><code class="whole">a</code> b</a>', documents.inline("[`a` b](y.md)", lambda t: "X/" + t))

    def test_blocks(self):
        html = documents.render("# A\n\ntext\nmore\n\n* one\n  goes on\n* two\n\nmore\n\n    code < 1\n\n| a | b |\n|---|---|\n| `x|y` | 2e-5 |\n")
        self.assertIn("<h1>A</h1>", html)
        self.assertIn("<p>text\nmore</p>", html)
        self.assertIn("<li>one\n  goes on</li>", html)
        self.assertIn('<pre tabindex="0"><code>code &lt; 1\n</code></pre>', html)
        self.assertRegex(html, r'<th scope="row"><code class="whole">x\|y</code></th>\s*<td class="number"><span class="whole">2e-5</span></td>')
        self.assertIn('<div aria-label="Table in “A”" class="scroll" role="group" tabindex="0">', html.replace("&ldquo;", "“"))

    def test_tables_as_lists(self):
        self.assertEqual([[["a", "b"], [r"\|r_x\|", "`x|y`"]]], documents.tables("| a | b |\n|---|---|\n| \\|r_x\\| | `x|y` |\n"))

    def test_long_code_breaks_at_its_joints(self):
        self.assertEqual("<code>studies/<wbr>harness/<wbr>observed_<wbr>order.<wbr>hpp</code>", documents.inline("`studies/harness/observed_order.hpp`"))


class Theory(unittest.TestCase):
    """The chapters of docs/theory. That each equation can be set is seen where the site is written."""

    def documents(self):
        for file in [theory.INDEX, *theory.chapters()]:
            yield file, (SOURCES / file).read_text(encoding="utf-8")

    def test_every_chapter_is_listed(self):
        there = {f"docs/theory/{path.name}" for path in (SOURCES / "docs/theory").glob("*.md")}
        self.assertEqual(there, {theory.INDEX, *theory.chapters()})

    def test_titles_have_the_numbers_of_the_list(self):
        for k, file in enumerate(theory.chapters(), 1):
            self.assertRegex((SOURCES / file).read_text(encoding="utf-8"), rf"\A# {k}\. ")

    def test_equations_are_numbered_one_after_another(self):
        self.assertGreater(len(theory.places()), 100)

    def test_equations_that_are_named_exist(self):
        there = theory.places()
        for file, text in self.documents():
            for number in re.findall(r"\(([1-9]\d*\.\d+)\)", equations.part(text)[0]):
                self.assertIn(number, there, file)

    def test_figures_are_numbered_one_after_another(self):
        found = [int(k) for _, text in self.documents() for k in re.findall(r"^\*Figure (\d+)\. ", text, re.M)]
        self.assertEqual(list(range(1, len(found) + 1)), found)

    def test_pages_are_short(self):
        for file, text in self.documents():
            self.assertLessEqual(len(text.splitlines()), 400, file)

    def test_drawings_are_what_their_program_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, SOURCES / "docs/theory/drawings.py", folder], check=True)
            for path in sorted(Path(folder).iterdir()):
                self.assertEqual(path.read_bytes(), (SOURCES / "docs/theory" / path.name).read_bytes(), path.name)

    @unittest.skipUnless(importlib.util.find_spec("mpmath"), "python3-mpmath is not there")
    def test_equations_hold(self):
        subprocess.run([sys.executable, SOURCES / "docs/theory/check.py"], check=True, stdout=subprocess.DEVNULL)


class TheBook(unittest.TestCase):
    """The page that `make book` prints, without its equations, which are those of the site."""

    @classmethod
    def setUpClass(cls):
        cls.book = book.Book(SOURCES / "reports")
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(equations, "mathml", lambda tex, display: "<math></math>"):
            path = Path(folder) / "book.html"
            path.write_text(cls.book.page(), encoding="utf-8")
            cls.page, text = Page(path), path.read_text(encoding="utf-8")
        sections = re.split(r'<section id="([^"]*)">', text)
        cls.chapters = {name: documents.html.unescape(body) for name, body in zip(sections[1::2], sections[2::2])}
        cls.contents = re.findall(r'<b data-of="([^"]*)">', text)

    def test_is_well_formed(self):
        self.assertEqual([], self.page.problems)
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)), "ids are unique")

    def test_leads_somewhere(self):
        for link in self.page.links:
            self.assertRegex(link, "^(#|https?:)")
            if link.startswith("#"):
                self.assertIn(link[1:], self.page.ids)
        for source in self.page.shown:
            self.assertTrue(Path(source).is_file(), source)

    def test_has_all_chapters_in_its_contents(self):
        self.assertEqual(list(self.chapters), self.contents)
        studies = {f"study-{path.parent.name}" for path in SOURCES.glob("studies/*/gates.json")}
        self.assertEqual({"findings", "studies"} | studies | set(theory.anchors().values()), set(self.contents))

    def test_shows_what_reports_have(self):
        for k, name in enumerate(self.book.order, 1):
            report, chapter = self.book.reports[name], self.chapters[f"study-{name}"]
            for figure in report["figures"]:
                self.assertEqual(1, chapter.count(f"{figure['file']}\""), figure["file"])
            for word, count in (("Figure", len(report["figures"])), ("Table", chapter.count("<caption>") - 1)):
                found = [int(n) for n in re.findall(rf">{word} {k}\.(\d+)\. ", chapter)]
                self.assertEqual(list(range(1, count + 1)), found, f"{name}: {word}")
            for gate in report["gates"]:
                self.assertIn(f">{gate['name']}<", chapter)
                self.assertIn(gate["reason"] if gate.get("reason") else gate["guards"], chapter)
            for of in report["fits"] + report.get("grid_convergence", []):
                self.assertIn(f">{of['quantity']}<", chapter)
            for table in report["tables"]:
                printed = 0 < len(table.get("rows") or []) <= book.LONGEST
                self.assertIn(f". {table['caption'][:1].upper()}{table['caption'][1:]}" if printed else f"reports/{table['file']}", chapter)

    def test_names_what_it_is(self):
        said = book.citation('title: "a: b"\nabstract: >\n  one\n  two\nauthors:\n  - given-names: A\n    family-names: B\n  - name: C\n')
        self.assertEqual({"title": "a: b", "abstract": "one two", "authors": ["A B", "C"]}, said)

    def test_pages_of_places_are_found(self):
        with tempfile.NamedTemporaryFile() as file:
            file.write(b"2 0 obj\n<</Type /Page\n>>\nendobj\n4 0 obj\n<</Type /Page\n>>\nendobj\n")
            file.write(b"5 0 obj\n<</a [2 0 R /XYZ 6 8 0]\n/b-1.2 [4 0 R /XYZ 6 8 0]>>\nendobj\n")
            file.flush()
            self.assertEqual({"a": 1, "b-1.2": 2}, paper.places(Path(file.name)))


class Equations(unittest.TestCase):
    def test_are_parted_from_text_and_put_back(self):
        text, found = equations.part("a $x_1*y*$ `$b$`\n\n```math\nx=1\n\\tag{2.1}\n```\n")
        self.assertEqual([("x_1*y*", "", False), ("x=1", "2.1", True)], found)
        page = equations.put_back(documents.render(text), found)
        self.assertIn('<code class="whole">$b$</code>', page)
        self.assertIn('<div class="equation" id="eq-2.1">', page)
        self.assertEqual(2, page.count("<math"))
        self.assertNotRegex(page, "[\ue000\ue001]")

    def test_say_what_browsers_know(self):
        self.assertEqual('<math><mover><mi mathvariant="normal" class="bold">r</mi><mo accent="true">\u00a8</mo></mover></math>',
                         equations.mathml(r"\ddot{\mathbf r}", False))
        self.assertIn(">\u2212</mo>", equations.mathml("a-b", False))

    def test_that_cannot_be_set_are_named(self):
        with self.assertRaisesRegex(SystemExit, "nonsense"):
            equations.mathml(r"\nonsense", False)

    def test_are_referred_to_in_text_alone(self):
        page = equations.refer("<p>(2.1) <code>(2.1)</code> (9.9)</p>", lambda number: "#here" if number == "2.1" else "")
        self.assertEqual('<p>(<a href="#here">2.1</a>) <code>(2.1)</code> (9.9)</p>', page)


if __name__ == "__main__":
    unittest.main()
