const { compare } = new Intl.Collator("en", { numeric: true });
for (const button of document.querySelectorAll("th button")) {
  button.addEventListener("click", () => {
    const head = button.closest("th");
    const table = head.closest("table");
    const order = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    for (const other of table.querySelectorAll("th[aria-sort]")) other.removeAttribute("aria-sort");
    head.setAttribute("aria-sort", order > 0 ? "ascending" : "descending");
    const key = (row) => row.cells[head.cellIndex].dataset.key;
    const [body] = table.tBodies;
    body.append(...[...body.rows].sort((a, b) => order * compare(key(a), key(b))));
  });
}
