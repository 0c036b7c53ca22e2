// What the pages can do besides: tables sort by a column, figures open over the page, words are found. Without it everything
// is still there.
for (const table of document.querySelectorAll("table.sortable")) {
  const body = table.tBodies[0];
  const given = [...body.rows];
  for (const head of table.tHead.rows[0].cells) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const was = head.getAttribute("aria-sort");
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      const next = was === null ? "ascending" : was === "ascending" ? "descending" : null;
      if (next) head.setAttribute("aria-sort", next);
      const key = (row) => row.cells[head.cellIndex].textContent.trim();
      const rows = [...given];
      const compare = (a, b) => {
        const [x, y] = [key(a), key(b)];
        if (x === "" || y === "") return (x === "") - (y === "");
        const difference = parseFloat(x) - parseFloat(y);
        const order = Number.isNaN(difference) ? x.localeCompare(y, "en") : difference;
        return next === "descending" ? -order : order;
      };
      if (next) rows.sort(compare);
      body.append(...rows);
    });
  }
}

const dialog = document.createElement("dialog");
dialog.className = "viewer";
dialog.setAttribute("aria-label", "Figure");
dialog.innerHTML = '<form method="dialog"><button>Close</button></form><div></div>';
document.body.append(dialog);
dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close(); });
for (const link of document.querySelectorAll("a.enlarge")) {
  link.addEventListener("click", (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    const picture = new Image();
    picture.src = link.href;
    picture.alt = link.querySelector("img").alt;
    dialog.querySelector("div").replaceChildren(picture);
    dialog.showModal();
  });
}

// Only one menu is open, and a click elsewhere or Escape closes it.
const menus = [...document.querySelectorAll(".top details")];
document.addEventListener("click", (event) => {
  for (const menu of menus) if (!menu.contains(event.target)) menu.open = false;
});
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") for (const menu of menus) menu.open = false;
});

// The search: sections that have all words, those that have them in a heading first. Its index is fetched when it is used.
const form = document.querySelector(".search");
const [field, list] = [form.querySelector("input"), form.querySelector(".found")];
form.hidden = false;
let asked = false;
const look = () => {
  const words = field.value.toLowerCase().match(/[\w-]+/g) ?? [];
  const found = [];
  for (const [href, page, section, text] of window.searchIndex ?? []) {
    const heading = ` ${page} ${section}`.toLowerCase();
    const rank = words.map((word) => (heading.includes(` ${word}`) ? 2 : ` ${text}`.includes(` ${word}`) ? 1 : 0));
    if (words.length && rank.every((r) => r > 0)) found.push([rank.reduce((a, b) => a + b), href, page, section]);
  }
  found.sort((a, b) => b[0] - a[0]);
  list.replaceChildren(...found.slice(0, 12).map(([, href, page, section]) => {
    const item = document.createElement("li");
    const link = document.createElement("a");
    link.href = href;
    link.textContent = section ? `${page}: ${section}` : page;
    item.append(link);
    return item;
  }));
  if (words.length && window.searchIndex && !found.length) {
    list.innerHTML = "<li>Nothing is found.</li>";
  }
  list.hidden = !words.length || !window.searchIndex;
};
field.addEventListener("focus", () => {
  if (asked) return;
  asked = true;
  const script = document.createElement("script");
  script.src = "site/search.js";
  script.addEventListener("load", look);
  document.head.append(script);
});
field.addEventListener("input", look);
form.addEventListener("submit", (event) => {
  event.preventDefault();
  list.querySelector("a")?.click();
});
document.addEventListener("click", (event) => { if (!form.contains(event.target)) list.hidden = true; });
document.addEventListener("keydown", (event) => { if (event.key === "Escape") list.hidden = true; });
