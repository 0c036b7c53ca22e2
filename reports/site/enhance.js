// What the pages can do besides: tables sort by a column, figures open over the page. Without it everything is still there.
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
