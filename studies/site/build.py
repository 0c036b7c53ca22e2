#!/usr/bin/env python3
"""Writes the site of a folder of reports: a first page, pages of scenes, studies and documents, and their search.

    build.py [REPORTS]        (default: reports)

What it writes depends on the reports, the documents and the scenes only: not on the commit, the machine or the time.
"""

import json
import os
import re
import shutil
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))
try:
    import jinja2
    from markupsafe import Markup

    import documents
    import study_page
    import theory
except ImportError as error:
    sys.exit(f"{error}: {sys.executable} lacks what the site is made with. Debian: apt-get install python3-markdown python3-jinja2, "
             "and call this with /usr/bin/python3")
from numbers_as_read import number, number_words, sentence, words

ROOT = Path(__file__).resolve().parents[2]
# What the papers print, beside ours: study, table, and rows to show.
PAPERS = [
    ("falling_beam", "table1", lambda row: True),
    ("falling_beam", "table2", lambda row: True),
    ("torsion", "claims", lambda row: True),
    ("rotating_load", "errors", lambda row: row["paper_error"] is not None),
]
# Documents that are pages of the site: file, what the menu calls it, and what the first page says of it.
DOCUMENTS = {
    "docs/own_scene.md": ("A scene of your own", "Print, run, draw; joints, winches, loads; how far a number can be trusted; sweeps."),
    "docs/ropes.md": ("Ropes", "Which law, which strain, slack, corners, winches, starts."),
    "docs/assemblies.md": ("Several beams and bodies", "Trolleys with hooks, platforms on ropes, frames, cranks: beams, bodies, links."),
    "docs/what_comes_out.md": ("What comes out", "Every quantity of a run: name, unit, meaning; places, extremes over time."),
    "docs/from_moorpy.md": ("From MoorPy and MoorDyn", "Their words and ours, two lines of MoorPy's tests, when to stay."),
    "docs/from_exudyn.md": ("From EXUDYN", "Its words and ours, a cantilever, when to stay."),
    "docs/from_chrono.md": ("From Chrono", "Its words and ours, the cable of its test, a bead on it, when to stay."),
    "docs/from_abaqus.md": ("From Abaqus and ANSYS", "Their words and ours, a bend, a slip ring, a buckled bar, when to stay."),
    "docs/judge_your_own_element.md": ("Judge your own element", "Twelve cases whose motion is known: compute them elsewhere, score the errors."),
    "docs/scene_keys.md": ("Keys of a scene", "Every key with its values, default, unit and meaning."),
    "docs/use.md": ("Program, library, Python", "Commands, exit codes, make, CMake, pip."),
    "docs/limits.md": ("Limits", "Where answers are wrong or get worse, the most dangerous first."),
    "docs/what_goes_together.md": ("Feature compatibility", "Which features go with which, cell by cell."),
    "docs/findings.md": ("Findings", "What each study found, with its numbers."),
    "docs/papers.md": ("The papers' numbers", "Beside ours and the exact ones."),
    "docs/faq.md": ("Questions", "What people ask of such codes."),
    "docs/glossary.md": ("Glossary", "Every term in a line."),
    theory.INDEX: ("Theory", "The equations, numbered, from kinematics to integration in time."),
    "core/README.md": ("The element library", "What each folder holds, and an hour's path through it."),
    "mechanics/README.md": ("A beam in motion", "The heart and its rooms, and an afternoon's path."),
    "io/README.md": ("Files", "Scenes, reports, schemas, tables: where each is read and written."),
    "tools/README.md": ("Tools", "Runs that tell their error, converge, sweep, influence lines, plots."),
    "studies/README.md": ("Writing a study", "A driver, a sweep as data, gates, claims."),
    "CONTRIBUTING.md": ("Contributing", "How to add a part, a scene, a study, an option."),
}
# Scenes of the first page: what people come for.
SHOWN = ["container_crane", "bridge", "zipline", "winch", "mooring_line", "cable_through_ring", "movable_pulley", "drill_stem", "lead_screw"]


def document_page(file):
    return "doc_" + re.sub(r"\W+", "_", file.removesuffix(".md").removesuffix("/README").removeprefix("docs/").lower()) + ".html"


def tutorials():
    """Files of the tutorials in their order, which is that of the list of their index."""
    index = ROOT / "docs/tutorials/README.md"
    if not index.exists():
        return {}
    found = re.findall(r"^\| \[(.*?)\]\((\w+\.md)\) \| (.*?) \|", index.read_text(encoding="utf-8"), re.M)
    return {f"docs/tutorials/{name}": (title, line) for title, name, line in found}


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
        self.tutorials = tutorials()
        self.documents = {file: text for file, text in DOCUMENTS.items() if (ROOT / file).exists()}
        self.readme = self.text("README.md")
        # One row a study: question, line, finding.
        self.overview = {}
        for rows in documents.tables(self.text("docs/findings.md")):
            if rows[0][0] == "study":
                for row in rows[1:]:
                    self.overview[re.match(r"\[(\w+)\]", row[0])[1]] = dict(zip(rows[0], row))
        self.index = []  # of the search: page, its title, section, words
        self.environment = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"), autoescape=True,
                                              trim_blocks=True, lstrip_blocks=True)
        self.environment.filters |= {"words": words, "bound": number_words, "slug": documents.anchor}
        self.environment.globals |= {"number": number, "to": lambda file: self.to(ROOT / file), "menus": self.menus()}

    def text(self, file):
        return (ROOT / file).read_text(encoding="utf-8")

    def menus(self):
        docs = [("index.html", "Start"), ("scenes.html", "Scenes")]
        docs += [(document_page(file), title) for file, (title, _) in self.tutorials.items()]
        docs += [(document_page(file), title) for file, (title, _) in self.documents.items()]
        return [("Documents", docs), ("Studies", [("studies.html", "All studies")] + [(f"{name}.html", words(name)) for name in self.reports])]

    def to(self, path):
        """Link to a file of the repository."""
        return os.path.relpath(path, self.out).replace(os.sep, "/")

    def linker(self, document):
        """Maps the links of a document: documents to their pages, other files to where they are."""

        def link(target):
            if re.match(r"^[a-z]+:|^#", target):
                return target
            target, _, anchor = target.partition("#")
            path = (document.parent / target).resolve()
            for file in [*self.documents, *self.chapters, *self.tutorials]:
                if path == (ROOT / file).resolve():
                    return document_page(file) + ("#" + anchor if anchor else "")
            if path.name == "README.md" and path.parent.name in self.reports and path.parent.parent.name == "studies":
                return f"{path.parent.name}.html"
            return self.to(path) + ("#" + anchor if anchor else "")

        return link

    def render(self, text, file, level=2, label="", anchors=False):
        return Markup(documents.render(text, self.linker(ROOT / file), level, label, anchors))

    def page(self, template, title, description, name, **given):
        return self.environment.get_template(template).render(title=title, description=description, current=name,
                                                              math="<math" in given.get("body", ""), **given)

    def remember(self, page, title, text):
        """Adds a document's sections to the search."""
        text = re.sub(r"^```math\n.*?^```|\$[^$\n]+\$", "", text, flags=re.S | re.M)
        for section, body in documents.sections(text):
            section = documents.plain(section) if section else ""
            anchor = f"#{documents.anchor(section)}" if section and page.startswith("doc_") else ""
            found = sorted(set(re.findall(r"[a-z][\w-]+", re.sub(r"\]\([^)]*\)", "]", body.lower()).replace("`", " "))))
            self.index.append([page + anchor, title, section, " ".join(found)])

    # Pages

    def size(self, source):
        path = self.out / source
        if not path.exists():
            return ""
        size = re.search(r'width="(\d+)(?:pt)?" height="(\d+)(?:pt)?"', path.read_text(encoding="utf-8")[:400])
        return Markup(f' width="{size[1]}" height="{size[2]}"') if size else ""

    def figure(self, figure):
        return {"file": figure["file"], "caption": figure["caption"], "box": self.size(figure["file"])}

    def scenes(self):
        guide = "docs/own_scene.md"
        answers = {a["scene"]: a for a in json.loads(self.text("reference/scenes.json"))["answers"]}
        link, found = self.linker(ROOT / guide), []
        for rows in documents.tables(self.text(guide)):
            if rows[0][0] != "scene":
                continue
            for row in rows[1:]:
                name = row[0].strip("`")
                path = ROOT / "scenes" / f"{name}.json"
                picture = link(re.search(r"\((.*)\)", row[3])[1])
                answer = answers.get(name)
                value = Markup(f"<code>{answer['quantity']}</code> = {number(answer['value'], 8)} at t = {number(answer['t'])} s") if answer else ""
                found.append({"name": name, "title": json.loads(path.read_text(encoding="utf-8"))["title"], "what": sentence(row[1]),
                              "known": row[2], "value": value, "picture": picture, "box": self.size(picture), "file": self.to(path)})
        return found

    def study(self, name):
        report, row = self.reports[name], self.overview.get(name, {})
        line = documents.inline(sentence(row.get("in one line", "")))
        return {"name": name, "href": f"{name}.html", "title": self.title(name), "gates": report["gates"],
                "tally": study_page.tally(report["gates"]), "question": documents.plain(row.get("question", "")),
                "line": Markup(line + "." if line else ""),
                "finding": Markup(documents.inline(sentence(row.get("finding", "")), self.linker(ROOT / "docs/findings.md"))),
                "alarm": "" if report["status"] == "completed" else report["status"]}

    def title(self, name):
        path = ROOT / "studies" / name / "README.md"
        return documents.title(path.read_text(encoding="utf-8")) if path.exists() else words(name)

    def lead(self, *leave_out):
        """What the README says before its first section."""
        leave_out += "#", "    ", "```"
        lead = [p for p in re.split(r"\n\s*\n", dict(documents.sections(self.readme))[""]) if not p.startswith(leave_out)]
        return self.render("\n\n".join(lead), "README.md")

    def front(self):
        parts = dict(documents.sections(self.readme))
        gates = [gate for report in self.reports.values() for gate in report["gates"]]
        counts = study_page.tally(gates)
        facts = [(len(self.reports), "studies"), (f"{sum(g['passed'] for g in gates)} of {len(gates)}", "gates hold"),
                 (counts["exact"], "rest on closed forms and identities"), (counts["independent"], "on other methods and programs"),
                 (counts["self"], "on convergence, with its uncertainty"), (counts["regression"], "only guard against change")]
        picture = next((self.figure(f) for f in self.reports.get("falling_beam", {}).get("figures", [])
                        if f["name"] == "figure9_variational"), None)
        scenes = self.scenes()
        reference = [(document_page(file), title, line) for file, (title, line) in self.documents.items()]
        return self.page(
            "index.html", "vlbeam: beams along which something slides", "Variable-length beam finite elements: install, run, trust.",
            "index.html", lead=self.lead("!"), picture=picture, facts=facts,
            guide=[(name, self.render(parts[name], "README.md", 3, name)) for name in ("Install", "Five minutes") if name in parts],
            scenes=scenes, shown=[s for name in SHOWN for s in scenes if s["name"] == name],
            tutorials=[(document_page(file), title, line) for file, (title, line) in self.tutorials.items()],
            studies=[self.study(name) for name in self.reports], reference=reference)

    def studies(self):
        studies = [self.study(name) for name in self.reports]
        gates = [gate for s in studies for gate in s["gates"]]
        speed, report = None, self.reports.get("work_precision")
        if report:
            figures = {figure["name"]: figure for figure in report["figures"]}
            table = next(t for t in report["tables"] if t["name"] == "advice_by_evaluations")
            speed = {"figures": [self.figure(figures[name]) for name in ("evaluations_falling", "evaluations_stiff") if name in figures],
                     "table": study_page.table(table["caption"], table["columns"], [row for row in table["rows"] if row[1] == "ALE-ANCF"],
                                               more="; ALE-ANCF")}
        papers = []
        for study, name, wanted in PAPERS:
            for table in self.reports.get(study, {}).get("tables", []):
                if table["name"] == name:
                    rows = [row for row in table["rows"] if wanted(dict(zip(table["columns"], row)))]
                    keep = [k for k, column in enumerate(table["columns"]) if column != "explanation"]
                    papers.append(study_page.table(table["caption"], [table["columns"][k] for k in keep], [[row[k] for k in keep] for row in rows])
                                  | {"study": {"href": f"{study}.html", "title": self.title(study)}})
        return self.page("studies.html", "All studies · vlbeam", "Studies, gates, speed against error, and the papers' numbers.", "studies.html",
                         studies=studies, gates=gates, tally=study_page.tally(gates), kinds=study_page.KINDS, speed=speed, papers=papers,
                         most=max((len(s["gates"]) for s in studies), default=1))

    def document(self, file):
        text = self.text(file)
        title = documents.title(text)
        of_tutorial = file in self.tutorials
        name = documents.plain(title) if of_tutorial else self.documents[file][0]
        contents = [(f"#{documents.anchor(documents.plain(part))}", documents.plain(part)) for part, _ in documents.sections(text) if part]
        page, around = document_page(file), []
        if of_tutorial:
            order = list(self.tutorials)
            k = order.index(file)
            around = [(document_page(order[i]), f"{word}: {self.tutorials[order[i]][0]}")
                      for word, i in (("Back", k - 1), ("Next", k + 1)) if 0 <= i < len(order)]
        self.remember(page, name, text)
        return self.page("document.html", f"{documents.plain(title)} · vlbeam", name, page, crumbs=[("", name)],
                         heading=Markup(documents.inline(title)), contents=contents, around=around,
                         body=self.render(re.sub(r"^# .*\n", "", text), file, 2, documents.plain(title), anchors=True))

    def theory(self, file):
        """A page of the theory: its index, or a chapter with a way to the next one."""
        where = lambda number, of: document_page(of) + f"#eq-{number}"  # noqa: E731
        title, names, body = theory.chapter(file, self.linker(ROOT / file), where)
        order = [theory.INDEX, *self.chapters]
        k = order.index(file)
        around = [(document_page(there), f"{word}: {documents.plain(documents.title(self.text(there)))}")
                  for word, there in (("Back", order[k - 1] if k else None), ("Next", order[k + 1] if k + 1 < len(order) else None)) if there]
        crumbs = [(document_page(theory.INDEX), "Theory"), ("", documents.plain(title))] if k else [("", "Theory")]
        self.remember(document_page(file), documents.plain(title), self.text(file))
        return self.page("document.html", f"{documents.plain(title)} · vlbeam", f"Theory of vlbeam: {documents.plain(title)}",
                         document_page(file), crumbs=crumbs, heading=Markup(documents.inline(title)),
                         contents=[(f"#{documents.anchor(documents.plain(name))}", documents.plain(name)) for name in names], around=around,
                         body=Markup(body))

    def write(self):
        folder = self.out / "site"
        folder.mkdir(exist_ok=True)
        for name in ("style.css", "equations.css", "enhance.js", "icon.svg"):
            shutil.copyfile(Path(__file__).parent / name, folder / name)
        scenes = self.scenes()
        pages = {"index.html": self.front(), "studies.html": self.studies(),
                 "scenes.html": self.page("scenes.html", "Scenes · vlbeam", "Scenes to copy, each with a number that is known.", "scenes.html",
                                          scenes=scenes)}
        pages |= {f"{name}.html": study_page.page(self, name) for name in self.reports}
        pages |= {document_page(file): self.document(file) for file in [*self.tutorials, *self.documents] if file != theory.INDEX}
        pages |= {document_page(file): self.theory(file) for file in [theory.INDEX, *self.chapters]}
        for scene in scenes:
            self.index.append(["scenes.html", "Scenes", scene["title"], f"{scene['name']} {scene['what']} {scene['known']}".lower()])
        pages["site/search.js"] = "window.searchIndex = " + json.dumps(self.index, ensure_ascii=False, separators=(",", ":")) + ";\n"
        for name, text in pages.items():
            part = self.out / f"{name}.part"
            part.write_text(text, encoding="utf-8")
            part.replace(self.out / name)
        return pages


def main():
    out = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "reports").resolve()
    site = Site(out)
    if not site.reports:
        sys.exit(f"{out}: no report of a study is there")
    pages = site.write()
    print(f"{out / 'index.html'}: {sum(name.endswith('.html') for name in pages)} pages, {len(site.reports)} studies")


if __name__ == "__main__":
    main()
