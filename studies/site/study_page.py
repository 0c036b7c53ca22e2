"""The page of a study: its document, figures, tables, orders and gates."""

import re
from pathlib import Path

import documents
from numbers_as_read import number, sentence, shortened, words

ROOT = Path(__file__).resolve().parents[2]
KINDS = {
    "exact": "a closed form or an identity",
    "independent": "another formulation, another method or another program",
    "self": "finer meshes or steps of the same, judged with their uncertainty",
    "regression": "the value measured before: it tells a change, and is no evidence",
}
LONG = 30  # rows of a table that is folded


def tally(gates):
    return {kind: sum(gate["kind"] == kind for gate in gates) for kind in KINDS}


def table(caption, columns, rows, csv="", more=""):
    """A table of a report. Columns of numbers are set to the right, long texts get room."""
    numeric = [all(isinstance(row[k], (int, float)) or row[k] is None for row in rows) for k in range(len(columns))]
    wide = [max((len(str(row[k])) for row in rows), default=0) > 32 for k in range(len(columns))]
    kinds = ["number" if n else "text" if w else "word" for n, w in zip(numeric, wide)]
    return {"caption": sentence(caption), "more": more, "csv": csv, "folded": len(rows) > LONG,
            "columns": [(words(name), kind) for name, kind in zip(columns, kinds)],
            "rows": [[(number(cell), kind) for cell, kind in zip(row, kinds)] for row in rows]}


def orders(report):
    """Tables of the observed orders, and of the limits by Richardson."""
    rows = []
    for fit in report.get("fits", []):
        slope = f"{number(fit['slope'], 3)} ± {number(fit['slope_uncertainty'], 2)}" if fit.get("slope") else ""
        pairs = ", ".join(number(p, 3) for p in fit.get("pairwise_orders", []))
        finest = number(fit["errors"][-1], 3) if fit.get("errors") else ""
        rows.append([fit["quantity"], ", ".join(number(l) for l in fit["levels"]), finest, slope, pairs, shortened(fit.get("refusal", ""))])
    parts = []
    if rows:
        parts.append(table("observed orders: the fit of all levels, and of each pair",
                           ["quantity", "levels", "finest error", "order", "orders of pairs", "what speaks against it"], rows))
    rows = []
    for limit in report.get("grid_convergence", []):
        rows.append([limit["quantity"], ", ".join(number(l) for l in limit["levels"]), number(limit["values"][-1], 9),
                     number(limit.get("limit"), 9), number(limit.get("uncertainty"), 2), number(limit.get("order"), 3),
                     shortened(limit.get("refusal", ""))])
    if rows:
        parts.append(table("limits by Richardson and the grid convergence index",
                           ["quantity", "levels", "finest value", "limit", "uncertainty", "order", "what speaks against it"], rows))
    return parts


def files(site, name, report, folder):
    """What the study has read and written, with what each file is."""
    found = [(f"{name}.json", "the report: every case, number, fit and gate")]
    found += [(t["file"], t["caption"]) for t in report["tables"] if t.get("rows")]
    for path, what in [(folder / "study.json", "the sweep as data: scene, meshes, settings"),
                       (folder / "gates.json", "the gates"), (folder / "study.cpp", "the driver"), (folder / "README.md", "the document")]:
        if path.exists():
            found.append((site.to(path), what))
    return found + [(site.to(scene), "the scene, to run and to copy") for scene in sorted((ROOT / "scenes").glob(f"{name}*.json"))]


def parts(site, name):
    """What the page of a study shows of its document and its report, and so does its chapter of the book."""
    report, study = site.reports[name], site.study(name)
    file = f"studies/{name}/README.md"
    text = site.text(file) if (ROOT / file).exists() else f"# {words(name)}\n"
    sections = dict(documents.sections(text))
    lead = re.sub(r"^# .*\n?", "", sections.pop("", "")).strip()
    prose = [(re.sub(r"\W+", "-", heading.lower()), heading, site.render(body, file, 3, heading)) for heading, body in sections.items()]
    return {
        "s": study, "lead": site.render(lead, file, 2, study["title"]) if lead else "", "text": text, "prose": prose,
        "figures": [site.figure(f) for f in report["figures"]],
        "tables": [table(t["caption"], t["columns"], t["rows"], csv=t["file"]) for t in report["tables"] if t.get("rows")],
        "curves": [t for t in report["tables"] if not t.get("rows")], "orders": orders(report),
        "counts": ", ".join(f"{count} {kind}" for kind, count in study["tally"].items() if count)}


def page(site, name):
    given, report = parts(site, name), site.reports[name]
    title = given["s"]["title"]
    contents = [(f"#{identifier}", heading) for identifier, heading, _ in given["prose"]]
    contents += [("#figures", "Figures")] if report["figures"] else []
    contents += [("#tables", "Tables")] if report["tables"] else []
    contents += [("#gates", "Gates"), ("#files", "Files")]
    site.remember(f"{name}.html", title, given.pop("text"))
    return site.page("study.html", f"{title} · vlbeam", given["s"]["question"] or title, f"{name}.html", contents=contents,
                     files=files(site, name, report, ROOT / "studies" / name), measured=sorted(report["measured"].items()), **given)
