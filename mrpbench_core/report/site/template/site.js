// Filters the rows of the first table of a page.
"use strict";
const form = document.getElementById("filters");
if (form) {
  const rows = [...form.parentElement.querySelector("#filters ~ .wide").querySelectorAll("tbody tr")];
  const choices = [...form.querySelectorAll("select")];
  const search = document.getElementById("search");
  function filter() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      const fits = choices.every((choice) => choice.value === "" || row.dataset[choice.dataset.key] === choice.value);
      row.hidden = !fits || !words.every((word) => text.includes(word));
      shown += row.hidden ? 0 : 1;
    }
    document.getElementById("found").textContent = `${shown} of ${rows.length}`;
  }
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("input", filter);
  filter();
}
document.body.classList.add("ready");
