#!/usr/bin/env python3
"""Writes the site of a folder of reports: index.html, and a page for each study.

    build.py [REPORTS]        (default: reports)

What it writes depends on the reports, the documents and the scenes only: not on the commit, the machine or the time.
"""

import html
import json
import os
import re
import shutil
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
import markdown  # noqa: E402
import theory  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
KINDS = {
    "exact": "a closed form or an identity",
    "independent": "another formulation, another method or another program",
    "self": "finer meshes or steps of the same, judged with their uncertainty",
    "regression": "the value measured before: it tells a change, and is no evidence",
}
# What the papers print, beside ours: study, table, and rows to show.
PAPERS = [
    ("falling_beam", "table1", lambda row: True),
    ("falling_beam", "table2", lambda row: True),
    ("torsion", "claims", lambda row: True),
    ("rotating_load", "errors", lambda row: row["paper_error"] is not None),
]
# Documents that are pages of the site: file, and what the menu calls it.
DOCUMENTS = {"docs/own_scene.md": "A scene of one's own", "docs/use.md": "Program, library, Python", "docs/limits.md": "Limits",
             "docs/what_goes_together.md": "What goes together", "docs/papers.md": "The papers' numbers",
             "docs/glossary.md": "Glossary", theory.INDEX: "Theory", "core/README.md": "The core library", "studies/README.md": "Writing a study",
             "CONTRIBUTING.md": "Contributing"}
LONG = 30  # rows of a table that is folded


def esc(text):
    return html.escape(str(text))


def words(name):
    return name.replace("_", " ")


def sentence(text):
    return text[:1].upper() + text[1:]


def number(value, digits=5):
    """A number as a table shows it: 5 digits, 1.5e-5."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    if isinstance(value, int):
        return str(value)
    text = f"{value:.{digits}g}"
    return re.sub(r"e([+-])0*(\d)", lambda m: "e" + m[1].replace("+", "") + m[2], text)


def document_page(file):
    return "doc_" + re.sub(r"\W+", "_", file.removesuffix(".md").removesuffix("/README").removeprefix("docs/").lower()) + ".html"


class Site:
    def __init__(self, out):
        self.out = out
        self.reports = {}
        for path in sorted(out.glob("*.json")):
            if path.name.endswith((".timing.json", ".failed.json", ".interrupted.json")):
                continue
            report = json.loads(path.read_text(encoding="utf-8"))
            if str(report.get("schema_version", "")).startswith("vlbeam.study/"):
                self.reports[report["study"]] = report
        self.chapters = theory.chapters()
        self.readme = (ROOT / "README.md").read_text(encoding="utf-8")
        # One line a study: link, question, ..., finding.
        self.overview = {}
        for rows in markdown.tables(self.readme):
            if rows[0][0] == "study":
                for row in rows[1:]:
                    name = re.match(r"\[(\w+)\]", row[0])[1]
                    self.overview[name] = dict(zip(rows[0], row))

    def to(self, path):
        """Link to a file of the repository."""
        return os.path.relpath(path, self.out).replace(os.sep, "/")

    def linker(self, document):
        """Maps the links of a document: READMEs of studies to their pages, other files to where they are."""

        def link(target):
            if re.match(r"^[a-z]+:|^#", target):
                return target
            target, _, anchor = target.partition("#")
            path = (document.parent / target).resolve()
            for file in [*DOCUMENTS, *self.chapters]:
                if path == (ROOT / file).resolve():
                    return document_page(file) + ("#" + anchor if anchor else "")
            if path.name == "README.md" and path.parent.name in self.reports and path.parent.parent.name == "studies":
                return f"{path.parent.name}.html"
            return self.to(path) + ("#" + anchor if anchor else "")

        return link

    # Pieces

    def page(self, title, description, body, current):
        pages = [("index.html", "Overview")] + [(f"{name}.html", words(name)) for name in self.reports]
        here = ' aria-current="page"'
        guides = [(document_page(file), text) for file, text in DOCUMENTS.items()]

        sheet = '<link rel="stylesheet" href="site/equations.css">\n' if "<math" in body else ""

        def menu(name, entries):
            items = "".join(f'<li><a href="{href}"{here if href == current else ""}>{esc(text)}</a></li>'
                            for href, text in entries)
            return f"<details><summary>{name}</summary><ul>{items}</ul></details>"

        return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{esc(title)}</title>
<meta name="description" content="{esc(description)}">
<link rel="icon" href="site/icon.svg" type="image/svg+xml">
<link rel="stylesheet" href="site/style.css">
{sheet}<script src="site/enhance.js" defer></script>
</head>
<body>
<a class="skip" href="#content">Skip to the content</a>
<header class="top">
<a class="brand" href="index.html"><img src="site/icon.svg" alt="" width="28" height="28">vlbeam</a>
<nav aria-label="Pages">{menu("Studies", pages)}{menu("Documents", guides)}</nav>
</header>
<main id="content">
{body}
</main>
<footer><p>Written by <code>make studies</code> from the reports beside this page and the documents of the studies.
<a href="{self.to(ROOT / "README.md")}">README</a> ·
<a href="{document_page("docs/own_scene.md")}">user guide</a> ·
<a href="{self.to(ROOT / "LICENSE")}">MIT licence</a></p></footer>
</body>
</html>
"""

    def figure(self, study, figure, large=False):
        caption = figure["caption"]
        source = figure["file"]
        size = re.search(r'width="(\d+)" height="(\d+)"', (self.out / source).read_text(encoding="utf-8")[:400])
        box = f' width="{size[1]}" height="{size[2]}"' if size else ""
        lazy = "" if large else ' loading="lazy"'
        return (f'<figure><a class="plate enlarge" href="{esc(source)}"><img src="{esc(source)}" '
                f'alt="{esc("Plot: " + caption)}"{box}{lazy}></a><figcaption>{esc(caption)}</figcaption></figure>')

    def table(self, caption, columns, rows, more=""):
        """A table of a report. Columns of numbers are set to the right."""
        numeric = [all(isinstance(row[k], (int, float)) or row[k] is None for row in rows) for k in range(len(columns))]
        wide = [max((len(str(row[k])) for row in rows), default=0) > 32 for k in range(len(columns))]
        right = [' class="number"' if n else ' class="text"' if w else ' class="word"' for n, w in zip(numeric, wide)]
        head = "".join(f'<th scope="col"{right[k]}>{esc(words(c))}</th>' for k, c in enumerate(columns))
        body = "\n".join(
            "<tr>" + "".join(f"<td{right[k]}>{esc(number(cell))}</td>" for k, cell in enumerate(row)) + "</tr>"
            for row in rows
        )
        grid = (f'<div class="scroll" tabindex="0" role="group" aria-label="{esc(caption)}"><table class="sortable">'
                f'<caption><span>{esc(sentence(caption))}{more}</span></caption><thead><tr>{head}</tr></thead>'
                f"<tbody>{body}</tbody></table></div>")
        if len(rows) <= LONG:
            return grid
        return f"<details><summary>{esc(sentence(caption))}: {len(rows)} rows</summary>{grid}</details>"

    def kind(self, name):
        return f'<span class="kind {name}">{name}</span>'

    def tally(self, gates):
        return {kind: sum(gate["kind"] == kind for gate in gates) for kind in KINDS}

    def bar(self, counts, whole):
        """How many gates of each kind, as a bar; the numbers stand beside it."""
        pieces = "".join(
            f'<span class="{kind}" style="width:{100 * count / whole:.4g}%"></span>' for kind, count in counts.items()
            if count
        )
        return f'<span class="bar" aria-hidden="true">{pieces}</span>'

    def verdict(self, gates):
        failed = sum(not gate["passed"] for gate in gates)
        if failed:
            return f'<span class="verdict fails">✗ {failed} of {len(gates)} gates fail</span>'
        return f'<span class="verdict holds">✓ all {len(gates)} gates hold</span>'

    # Pages

    def index(self):
        intro = markdown.sections(self.readme)[0][1]
        paragraphs = [p for p in re.split(r"\n\s*\n", intro) if not p.startswith(("#", "!", "    ", "```"))]
        readme_link = self.linker(ROOT / "README.md")
        lead = "\n".join(f"<p>{markdown.inline(' '.join(p.split()), readme_link)}</p>" for p in paragraphs)

        gates = [gate for report in self.reports.values() for gate in report["gates"]]
        counts = self.tally(gates)
        facts = "".join(
            f'<li><strong>{value}</strong> {label}</li>'
            for value, label in [
                (len(self.reports), "studies"),
                (f"{sum(g['passed'] for g in gates)} of {len(gates)}", "gates hold"),
                (counts["exact"], "rest on closed forms and identities"),
                (counts["independent"], "on other methods and programs"),
                (counts["self"], "on convergence, with its uncertainty"),
                (counts["regression"], "only guard against change"),
            ]
        )
        figure9 = ""
        for figure in self.reports.get("falling_beam", {}).get("figures", []):
            if figure["name"] == "figure9_variational":
                figure9 = self.figure("falling_beam", figure, large=True)

        most = max((len(report["gates"]) for report in self.reports.values()), default=1)
        rows = []
        for name, report in self.reports.items():
            tally = self.tally(report["gates"])
            cells = "".join(f'<td class="number">{tally[kind] or "–"}</td>' for kind in KINDS)
            rows.append(f'<tr><th scope="row"><a href="{name}.html#gates">{esc(words(name))}</a></th>{cells}'
                        f"<td>{self.bar(tally, most)}</td><td>{self.verdict(report['gates'])}</td></tr>")
        total = "".join(f'<td class="number">{counts[kind]}</td>' for kind in KINDS)
        legend = "".join(f"<dt>{self.kind(kind)}</dt><dd>{esc(what)}</dd>" for kind, what in KINDS.items())
        heads = "".join(f'<th scope="col" class="number">{kind}</th>' for kind in KINDS)
        state = f"""<dl class="legend">{legend}</dl>
<div class="scroll" tabindex="0" role="group" aria-label="Gates by study and kind"><table>
<caption><span>Gates by study and by what their bounds rest on</span></caption>
<thead><tr><th scope="col">study</th>{heads}<td></td><th scope="col">state</th></tr></thead>
<tbody>{"".join(rows)}</tbody>
<tfoot><tr><th scope="row">all</th>{total}<td></td><td>{self.verdict(gates)}</td></tr></tfoot>
</table></div>"""

        body = f"""<div class="hero">
<h1>Variable-length beam elements, <span>and how far they can be trusted</span></h1>
{lead}
</div>
{figure9}
<ul class="facts" aria-label="In numbers">{facts}</ul>
<section aria-labelledby="studies"><h2 id="studies">The studies</h2>
<p>Each answers one question by a sweep of runs, and its numbers are compared with its report by a test.</p>
<div class="cards">{"".join(self.card(name) for name in self.reports)}</div></section>
<section aria-labelledby="gates"><h2 id="gates">The state of all gates</h2>
<p>A gate is a bound that a number of a report must keep. Each says what it rests on.</p>
{state}</section>
<section aria-labelledby="speed"><h2 id="speed">Speed against error</h2>{self.speed()}</section>
<section aria-labelledby="papers"><h2 id="papers">The papers’ numbers beside ours</h2>{self.papers()}</section>
<section aria-labelledby="scenes"><h2 id="scenes">Scenes to copy</h2>{self.gallery()}</section>
"""
        return self.page("vlbeam: variable-length beam elements, and how far they can be trusted",
                         "Studies, gates and figures of variable-length beam finite elements.", body, "index.html")

    def card(self, name):
        report, row = self.reports[name], self.overview.get(name, {})
        picture = ""
        if report["figures"]:
            first = next((f for f in report["figures"] if f["name"] == "figure9_variational"), report["figures"][0])
            picture = f'<span class="plate"><img src="{esc(first["file"])}" alt="" loading="lazy"></span>'
        link = self.linker(ROOT / "README.md")
        finding = markdown.inline(sentence(row.get("finding", "")), link)
        question = sentence(markdown.plain(row.get("question", "")))
        return (f'<article class="card">{picture}<h3><a href="{name}.html">{esc(self.title(name))}</a></h3>'
                f'<p class="question">{esc(question)}</p><p>{finding}.</p>'
                f'<p class="foot">{self.verdict(report["gates"])}</p></article>')

    def title(self, name):
        document = ROOT / "studies" / name / "README.md"
        match = re.match(r"# (.*)", document.read_text(encoding="utf-8")) if document.exists() else None
        return match[1] if match else words(name)

    def speed(self):
        report = self.reports.get("work_precision")
        if not report:
            return "<p>The study of work and precision has no report here.</p>"
        figures = {figure["name"]: figure for figure in report["figures"]}
        pictures = "".join(self.figure("work_precision", figures[name])
                           for name in ("evaluations_falling", "evaluations_stiff") if name in figures)
        table = next(t for t in report["tables"] if t["name"] == "advice_by_evaluations")
        return ("<p>Which integrator and step give a wanted error for the fewest evaluations of the equations. "
                'The <a href="work_precision.html">study of work and precision</a> has every run.</p>'
                f'<div class="pair">{pictures}</div>' +
                self.table(table["caption"], table["columns"],
                           [row for row in table["rows"] if row[1] == "ALE-ANCF"], "; ALE-ANCF"))

    def papers(self):
        parts = ["<p>The setting of Tables 1 and 2 (end time, clamp, Gauss points, hysteresis) was fitted to them: their "
                 "agreement says that the paper’s procedure is understood, and is no evidence that its motion is right. "
                 'The <a href="falling_beam.html">study of the falling beam</a> shows what other settings give.</p>']
        for study, name, wanted in PAPERS:
            for table in self.reports.get(study, {}).get("tables", []):
                if table["name"] == name:
                    rows = [row for row in table["rows"] if wanted(dict(zip(table["columns"], row)))]
                    keep = [k for k, c in enumerate(table["columns"]) if c != "explanation"]
                    parts.append(self.table(table["caption"], [table["columns"][k] for k in keep],
                                            [[row[k] for k in keep] for row in rows]))
                    parts.append(f'<p class="source"><a href="{study}.html">Study: {esc(self.title(study))}</a></p>')
        return "".join(parts)

    def gallery(self):
        guide = ROOT / "docs" / "own_scene.md"
        answers = {a["scene"]: a for a in json.loads((ROOT / "reference" / "scenes.json").read_text(encoding="utf-8"))["answers"]}
        link, cards = self.linker(guide), []
        for rows in markdown.tables(guide.read_text(encoding="utf-8")):
            if rows[0][0] != "scene":
                continue
            for row in rows[1:]:
                name = row[0].strip("`")
                path = ROOT / "scenes" / f"{name}.json"
                title = json.loads(path.read_text(encoding="utf-8"))["title"]
                picture = link(re.search(r"\((.*)\)", row[3])[1])
                answer = answers.get(name)
                value = (f'<code>{esc(answer["quantity"])}</code> = {number(answer["value"], 8)} at '
                         f't = {number(answer["t"])} s' if answer else "")
                cards.append(
                    f'<article class="card"><a class="plate enlarge" href="{esc(picture)}"><img src="{esc(picture)}" '
                    f'alt="{esc("Plot: " + title)}" loading="lazy"></a><h3>{esc(title)}</h3>'
                    f"<p>{esc(sentence(row[1]))}: {value}, known by {esc(row[2])}.</p>"
                    f'<p class="foot"><a href="{esc(self.to(path))}">Scene file {esc(name)}.json</a></p></article>')
        return ("<p>Each is a file to copy, and each has a number that is known otherwise; "
                "<code>vlbeam scene NAME</code> prints it, <code>vlbeam run</code> runs it.</p>"
                f'<div class="cards scenes">{"".join(cards)}</div>')

    def study(self, name):
        report = self.reports[name]
        folder = ROOT / "studies" / name
        document = folder / "README.md"
        link = self.linker(document)
        parts = {title: body for title, body in markdown.sections(document.read_text(encoding="utf-8"))} if document.exists() else {}
        title = self.title(name)
        gates = report["gates"]
        tally = self.tally(gates)

        prose = []
        lead = re.sub(r"^# .*\n?", "", parts.pop("", "")).strip()
        if lead:
            prose.append(f'<div class="lead">{markdown.render(lead, link, 2, title)}</div>')
        for heading, body in parts.items():
            identifier = re.sub(r"\W+", "-", heading.lower())
            prose.append(f'<section aria-labelledby="{identifier}"><h2 id="{identifier}">{esc(heading)}</h2>'
                         f"{markdown.render(body, link, 3, heading)}</section>")

        contents = [(re.sub(r"\W+", "-", h.lower()), h) for h in parts]
        contents += [("figures", "Figures")] if report["figures"] else []
        contents += [("tables", "Tables")] if report["tables"] else []
        contents += [("gates", "Gates"), ("files", "Files")]
        toc = "".join(f'<li><a href="#{identifier}">{esc(text)}</a></li>' for identifier, text in contents)

        figures = "".join(self.figure(name, figure) for figure in report["figures"])
        if figures:
            figures = (f'<section aria-labelledby="figures"><h2 id="figures">Figures</h2>'
                       f'<div class="pair">{figures}</div></section>')

        tables = []
        for table in report["tables"]:
            csv = f' <a class="csv" href="{esc(table["file"])}">CSV</a>'
            if table.get("rows"):
                tables.append(self.table(table["caption"], table["columns"], table["rows"], csv))
        curves = [t for t in report["tables"] if not t.get("rows")]
        if curves:
            items = "".join(f'<li><a href="{esc(t["file"])}">{esc(t["file"])}</a>: {esc(t["caption"])}</li>'
                            for t in curves)
            tables.append(f"<h3>Data of the figures</h3><ul>{items}</ul>")
        tables += self.orders(report)
        if tables:
            tables = [f'<section aria-labelledby="tables"><h2 id="tables">Tables</h2>{"".join(tables)}</section>']

        rows = []
        for gate in sorted(gates, key=lambda gate: gate["passed"]):
            value = number(gate["value"], 4)
            if gate.get("uncertainty"):
                value += f" ± {number(gate['uncertainty'], 2)}"
            state = ('<span class="verdict holds">✓ holds</span>' if gate["passed"]
                     else f'<span class="verdict fails">✗ fails</span> {esc(gate.get("failure", ""))}')
            bound = number_words(gate["bound"])
            rows.append(f'<tr><th scope="row">{esc(gate["name"])}</th><td>{self.kind(gate["kind"])}</td>'
                        f'<td class="number">{esc(value)}</td><td class="bound">{esc(bound)}</td><td>{state}</td>'
                        f'<td class="reason">{esc(gate.get("reason") or gate.get("guards", ""))}</td></tr>')
        counts = ", ".join(f"{count} {kind}" for kind, count in tally.items() if count)
        judged = f"""<section aria-labelledby="gates"><h2 id="gates">Gates</h2>
<p>{self.verdict(gates)}: {counts}. <a href="index.html#gates">What the kinds mean.</a></p>
<div class="scroll" tabindex="0" role="group" aria-label="Gates"><table class="sortable gates">
<caption><span>What must hold, what was found, and why this bound</span></caption>
<thead><tr><th scope="col">gate</th><th scope="col">kind</th><th scope="col" class="number">value</th>
<th scope="col">bound</th><th scope="col">state</th><th scope="col">what the bound rests on</th></tr></thead>
<tbody>{"".join(rows)}</tbody></table></div></section>"""

        files = [(f"{name}.json", "the report: every case, number, fit and gate")]
        files += [(t["file"], t["caption"]) for t in report["tables"] if t.get("rows")]
        for path, what in [(folder / f"study.{report['profile']}.json", "the sweep as data: scene, meshes, settings"),
                           (folder / "gates.json", "the gates"), (folder / "study.cpp", "the driver"), (document, "the document")]:
            if path.exists():
                files.append((self.to(path), what))
        for scene in sorted((ROOT / "scenes").glob(f"{name}*.json")):
            files.append((self.to(scene), "the scene, to run and to copy"))
        items = "".join(f'<li><a href="{esc(href)}">{esc(href)}</a>: {esc(what)}</li>' for href, what in files)
        measured = "".join(f'<tr><th scope="row"><code>{esc(key)}</code></th><td class="number">{esc(number(v, 8))}</td></tr>'
                           for key, v in sorted(report["measured"].items()))
        if measured:
            measured = (f'<details><summary>All {len(report["measured"])} numbers that gates and prose look at</summary>'
                        f'<div class="scroll" tabindex="0" role="group" aria-label="Measured numbers"><table>'
                        f'<thead><tr><th scope="col">name</th><th scope="col" class="number">value</th></tr></thead>'
                        f"<tbody>{measured}</tbody></table></div></details>")

        ran = "" if report["status"] == "completed" else f'<p class="alarm">This study did not complete: {esc(report["status"])}.</p>'
        body = f"""<p class="crumbs"><a href="index.html">Overview</a> › {esc(words(name))}</p>
<h1>{esc(title)}</h1>
{ran}<nav class="toc" aria-label="On this page"><ul>{toc}</ul></nav>
{"".join(prose)}
{figures}
{"".join(tables)}
{judged}
<section aria-labelledby="files"><h2 id="files">Files</h2><ul>{items}</ul>{measured}</section>"""
        question = markdown.plain(self.overview.get(name, {}).get("question", title))
        return self.page(f"{title} · vlbeam", question, body, f"{name}.html")

    def orders(self, report):
        rows = []
        for fit in report.get("fits", []):
            slope = f"{number(fit['slope'], 3)} ± {number(fit['slope_uncertainty'], 2)}" if fit.get("slope") else ""
            pairs = ", ".join(number(p, 3) for p in fit.get("pairwise_orders", []))
            finest = number(fit["errors"][-1], 3) if fit.get("errors") else ""
            rows.append([fit["quantity"], ", ".join(number(l) for l in fit["levels"]), finest, slope, pairs,
                         shortened(fit.get("refusal", ""))])
        parts = []
        if rows:
            parts.append(self.table("observed orders: the fit of all levels, and of each pair", [
                "quantity", "levels", "finest error", "order", "orders of pairs", "what speaks against it"], rows))
        rows = []
        for limit in report.get("grid_convergence", []):
            rows.append([limit["quantity"], ", ".join(number(l) for l in limit["levels"]), number(limit["values"][-1], 9),
                         number(limit.get("limit"), 9), number(limit.get("uncertainty"), 2), number(limit.get("order"), 3),
                         shortened(limit.get("refusal", ""))])
        if rows:
            parts.append(self.table("limits by Richardson and the grid convergence index", [
                "quantity", "levels", "finest value", "limit", "uncertainty", "order", "what speaks against it"], rows))
        return parts

    def document(self, file):
        text = (ROOT / file).read_text(encoding="utf-8")
        title = re.match(r"# (.*)", text)[1]
        body = markdown.render(re.sub(r"^# .*\n", "", text), self.linker(ROOT / file), 2, title, anchors=True)
        contents = [name for name, _ in markdown.sections(text) if name]
        toc = "".join(f'<li><a href="#{esc(markdown.anchor(name))}">{esc(markdown.plain(name))}</a></li>' for name in contents)
        nav = f'<nav class="toc" aria-label="On this page"><ul>{toc}</ul></nav>' if toc else ""
        return self.page(f"{markdown.plain(title)} · vlbeam", DOCUMENTS[file],
                         f'<p class="crumbs"><a href="index.html">Overview</a> › {esc(DOCUMENTS[file])}</p>'
                         f'<h1>{markdown.inline(title)}</h1>{nav}<div class="document">{body}</div>', document_page(file))

    def theory(self, file):
        """A page of the theory: its index, or a chapter with a way to the next one."""
        where = lambda number, of: document_page(of) + f"#eq-{number}"  # noqa: E731
        title, names, body = theory.chapter(file, self.linker(ROOT / file), where)
        contents = "".join(f'<li><a href="#{esc(markdown.anchor(name))}">{esc(markdown.plain(name))}</a></li>' for name in names)
        order = [theory.INDEX, *self.chapters]
        k = order.index(file)
        ways = [(f"{word}: {self.heading(there)}", document_page(there))
                for word, there in (("Back", order[k - 1] if k else None), ("Next", order[k + 1] if k + 1 < len(order) else None)) if there]
        around = "".join(f'<li><a href="{href}">{esc(text)}</a></li>' for text, href in ways)
        up = f' › <a href="{document_page(theory.INDEX)}">Theory</a> › {esc(title)}' if k else " › Theory"
        return self.page(f"{markdown.plain(title)} · vlbeam", f"Theory of vlbeam: {markdown.plain(title)}",
                         f'<p class="crumbs"><a href="index.html">Overview</a>{up}</p><h1>{markdown.inline(title)}</h1>'
                         f'<nav class="toc" aria-label="On this page"><ul>{contents}</ul></nav><div class="document">{body}</div>'
                         f'<nav class="toc around" aria-label="Chapters"><ul>{around}</ul></nav>', document_page(theory.INDEX))

    def heading(self, file):
        return markdown.plain(re.match(r"# (.*)", (ROOT / file).read_text(encoding="utf-8"))[1])

    def write(self):
        folder = self.out / "site"
        folder.mkdir(exist_ok=True)
        for name in ("style.css", "equations.css", "enhance.js", "icon.svg"):
            shutil.copyfile(Path(__file__).parent / name, folder / name)
        pages = {"index.html": self.index()} | {f"{name}.html": self.study(name) for name in self.reports}
        pages |= {document_page(file): self.document(file) for file in DOCUMENTS if file != theory.INDEX}
        pages |= {document_page(file): self.theory(file) for file in [theory.INDEX, *self.chapters]}
        for name, text in pages.items():
            part = self.out / f"{name}.part"
            part.write_text(text, encoding="utf-8")
            part.replace(self.out / name)
        return pages


def number_words(text):
    """A gate's bound with its signs as they are printed."""
    return shortened(text).replace("<=", "≤").replace(">=", "≥")


def shortened(text):
    """A sentence whose numbers have at most six digits."""
    return re.sub(r"\d+\.\d+(?:e[-+]\d+)?", lambda m: number(float(m[0]), 6), str(text or "").replace("e-0", "e-"))


def main():
    out = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "reports").resolve()
    site = Site(out)
    if not site.reports:
        sys.exit(f"{out}: no report of a study is there")
    pages = site.write()
    print(f"{out / 'index.html'}: {len(pages)} pages, {len(site.reports)} studies")


if __name__ == "__main__":
    main()
