// Tables sort by a click on a heading, are filtered by words, and are saved as CSV.
"use strict";

// A cell as RFC 4180 quotes it; text that a spreadsheet would take for a formula begins with an apostrophe.
function csvCell(text) {
  const safe = /^\s*[=+\-@\t\r＝＋－＠]/.test(text) && !/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? `'${text}` : text;
  return /[",\n\r]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

function saveCsv(name, rows) {
  const text = rows.map((row) => row.map(csvCell).join(",")).join("\r\n");
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text + "\r\n"], { type: "text/csv" }));
  link.download = `${name}.csv`;
  link.click();
  URL.revokeObjectURL(link.href);
}

function enliven(table) {
  const body = table.tBodies[0];
  const heads = [...table.tHead.rows[0].cells];
  const words = document.createElement("input");
  words.type = "search";
  words.placeholder = "rows with these words";
  words.ariaLabel = "Filter rows";
  const save = document.createElement("button");
  save.type = "button";
  save.textContent = "CSV";
  const tools = document.createElement("div");
  tools.className = "tools";
  tools.append(words, save);
  table.parentElement.before(tools);

  words.addEventListener("input", () => {
    const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const row of body.rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !wanted.every((word) => text.includes(word));
    }
  });
  save.addEventListener("click", () => {
    const shown = [...body.rows].filter((row) => !row.hidden);
    const cells = shown.map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
    saveCsv(table.dataset.name, [heads.map((head) => head.textContent.trim()), ...cells]);
  });

  const key = (row, column) => {
    const { dataset, textContent } = row.cells[column];
    if (dataset.value !== undefined) return Number(dataset.value);
    return textContent === "–" ? null : textContent;
  };
  for (const [column, head] of heads.entries()) {
    head.tabIndex = 0;
    const sort = () => {
      const down = head.ariaSort === "ascending";
      for (const other of heads) other.ariaSort = "none";
      head.ariaSort = down ? "descending" : "ascending";
      const rows = [...body.rows].map((row) => [key(row, column), row]);
      rows.sort(([one], [other]) => {
        if (one === null || other === null) return (one === null) - (other === null);
        const order = typeof one === "number" && typeof other === "number" ? one - other : String(one).localeCompare(other, undefined, { numeric: true });
        return down ? -order : order;
      });
      body.append(...rows.map(([, row]) => row));
    };
    head.addEventListener("click", sort);
    head.addEventListener("keydown", (event) => event.key === "Enter" && sort());
  }
}

document.querySelectorAll("table.data").forEach(enliven);
