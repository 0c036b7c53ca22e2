#!/usr/bin/env python3
"""The site in a browser: nothing overflows on a phone, all pictures are there, all words can be read, the search finds.

    browser_test.py SOURCES
"""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
SOURCES = Path(sys.argv.pop(1)).resolve()
import browser  # noqa: E402

PICTURES = """(async () => {
  const pictures = [...document.images];
  for (const picture of pictures) picture.loading = "eager";
  await Promise.all(pictures.map((p) => p.complete ? 0 : new Promise((done) => { p.onload = p.onerror = done; })));
  return pictures.filter((p) => !p.naturalWidth).map((p) => p.src);
})()"""
CROPPED = """[...document.querySelectorAll("main img")].filter((picture) => {
  const own = picture.getBoundingClientRect(), frame = picture.parentElement.getBoundingClientRect();
  return !picture.closest(".scroll") && (own.right > frame.right + 1 || own.left < frame.left - 1 || own.right > innerWidth + 1);
}).map((picture) => picture.src)"""
# Words of code outside of what scrolls that are set in two lines, but for long ones at a joint that is marked.
BROKEN = """[...document.querySelectorAll("main code")].filter((code) => !code.closest("pre")).flatMap((code) => {
  const found = [], walker = document.createTreeWalker(code, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    for (const word of node.data.matchAll(/[^\\s\\/_.\\[\\]]+/g)) {
      const range = document.createRange();
      range.setStart(node, word.index);
      range.setEnd(node, word.index + word[0].length);
      if (new Set([...range.getClientRects()].map((box) => Math.round(box.top))).size > 1) found.push(word[0]);
    }
  }
  return found;
})"""
FAINT = """(() => {
  const parse = (text) => text.match(/[\\d.]+/g).map(Number);
  const linear = (c) => { c /= 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };
  const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const ground = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const colour = parse(getComputedStyle(e).backgroundColor);
      if (colour.length < 4 || colour[3] > 0) return colour;
    }
    return [255, 255, 255];
  };
  const faint = [], walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (!node.data.trim() || !element.checkVisibility() || element.closest("script, style")) continue;
    const style = getComputedStyle(element), size = parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.66 && style.fontWeight >= 700);
    const [a, b] = [luminance(parse(style.color)), luminance(ground(element))].sort((x, y) => y - x);
    const contrast = (a + 0.05) / (b + 0.05);
    if (contrast < (large ? 3 : 4.5)) faint.push(`${node.data.trim().slice(0, 40)}: ${contrast.toFixed(2)}`);
  }
  return faint;
})()"""


@unittest.skipUnless(browser.program(), "Chromium is not there")
class InABrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        root = Path(cls.folder.name)
        for name in ("docs", "scenes"):  # pictures that pages show
            shutil.copytree(SOURCES / name, root / name)
        cls.out = root / "reports"
        shutil.copytree(SOURCES / "reports", cls.out, ignore=shutil.ignore_patterns("*.html", "site", "*.timing.*"))
        subprocess.run([sys.executable, SOURCES / "studies/site/build.py", cls.out], check=True, stdout=subprocess.DEVNULL)
        cls.pages = sorted(cls.out.glob("*.html"))
        cls.browser = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    def complaints(self, questions, **how):
        """What is wrong with each page: answers other than an empty list, or a width beyond the window's."""
        found = []
        for path in self.pages:
            self.browser.show(path, **how)
            found += [f"{path.name}, {what}: {answer}" for what, question in questions.items()
                      for answer in [self.browser.ask(question)] if answer not in ([], None)]
        return found

    def test_on_a_phone_nothing_overflows_and_nothing_is_cropped_or_broken(self):
        wide = "document.documentElement.scrollWidth > 360 ? document.documentElement.scrollWidth : null"
        self.assertEqual([], self.complaints({"not loaded": PICTURES, "wide": wide, "cropped": CROPPED, "broken": BROKEN}, width=360))

    def test_all_words_can_be_read(self):
        for dark in (False, True):
            self.assertEqual([], self.complaints({"faint": FAINT}, dark=dark))

    def test_pictures_are_dark_on_dark_pages(self):
        self.browser.show(self.out / "index.html", dark=True)
        pictures = "[...document.querySelectorAll('.plate img')]"
        self.assertGreater(self.browser.ask(f"{pictures}.length"), 5)
        self.assertEqual([], self.browser.ask(f"{pictures}.filter((p) => !getComputedStyle(p).filter.includes('invert')).map((p) => p.src)"))
        self.browser.show(self.out / "index.html", dark=False)
        self.assertEqual([], self.browser.ask(f"{pictures}.filter((p) => getComputedStyle(p).filter != 'none').map((p) => p.src)"))

    def test_the_search_finds(self):
        self.browser.show(self.out / "index.html", width=360)
        found = self.browser.ask("""(async () => {
          const field = document.querySelector(".search input");
          field.focus();
          while (!window.searchIndex) await new Promise((done) => setTimeout(done, 20));
          field.value = "winch";
          field.dispatchEvent(new Event("input"));
          return [...document.querySelectorAll(".found a")].map((link) => link.getAttribute("href"));
        })()""")
        self.assertTrue(any(href.startswith("doc_own_scene.html#") for href in found), found)
        self.assertLessEqual(self.browser.ask("document.documentElement.scrollWidth"), 360)

    def test_tables_sort_and_figures_open(self):
        self.browser.show(self.out / "torsion.html")
        self.assertTrue(self.browser.ask("""(() => {
          const table = document.querySelector("table.gates"), button = table.querySelector("thead button");
          button.click();
          const names = [...table.tBodies[0].rows].map((row) => row.cells[0].textContent);
          return names.every((name, k) => !k || names[k - 1].localeCompare(name, "en") <= 0);
        })()"""))
        self.assertTrue(self.browser.ask("(document.querySelector('a.enlarge').click(), document.querySelector('dialog').open)"))

    def test_zz_the_console_has_no_complaint(self):
        self.assertEqual([], self.browser.complaints)


if __name__ == "__main__":
    unittest.main()
