// The list of runs: filtered, sorted, a part at a time. Data as `listing.py` packs it.
"use strict";
const PART = 200;
const element = (id) => document.getElementById(id);

async function read() {
  const letters = atob(element("data").textContent.trim());
  const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).json();
}

function list(runs) {
  const count = runs.id.length;
  const columns = [
    { name: "run", of: (i) => runs.id[i] },
    { name: "configuration", of: (i) => runs.groups[runs.group[i]] },
    { name: "seed", number: true, of: (i) => runs.seed[i] },
    { name: "repeat", number: true, of: (i) => runs.repeat[i] },
    { name: "status", of: (i) => runs.statuses[runs.status[i]] },
    ...runs.columns.map((name, column) => ({ name, number: true, measured: true, of: (i) => runs.values[column][i] })),
    { name: "message", of: (i) => runs.messages[runs.message[i]] },
  ];
  const state = { sort: -1, down: false, shown: PART, found: [], open: -1 };

  function matches(i, group, status, words) {
    if (group !== "" && runs.group[i] !== Number(group)) return false;
    if (status !== "" && runs.status[i] !== Number(status)) return false;
    return words.every((word) => {
      if (word.startsWith("seed:")) return String(runs.seed[i]) === word.slice(5);
      return runs.id[i].startsWith(word) || runs.messages[runs.message[i]].toLowerCase().includes(word);
    });
  }

  function select() {
    const [group, status] = [element("group").value, element("status").value];
    const words = element("search").value.toLowerCase().split(/\s+/).filter(Boolean);
    state.found = [];
    for (let i = 0; i < count; i++) if (matches(i, group, status, words)) state.found.push(i);
    if (state.sort >= 0) {
      const { of } = columns[state.sort];
      const keys = new Map(state.found.map((i) => [i, of(i)]));
      const turn = state.down ? -1 : 1;
      state.found.sort((a, b) => {
        const [one, other] = [keys.get(a), keys.get(b)];
        if (one === null || other === null) return (one === null) - (other === null); // null last
        return one < other ? -turn : one > other ? turn : a - b;
      });
    }
    state.shown = PART;
    state.open = -1;
    draw();
  }

  function cell(row, text, name) {
    const made = row.insertCell();
    made.textContent = text;
    if (name) made.className = name;
    return made;
  }

  function detail(body, i) {
    const row = body.insertRow();
    row.className = "detail";
    const made = row.insertCell();
    made.colSpan = columns.length;
    const folder = runs.folders[runs.folder[i]];
    const message = runs.messages[runs.message[i]];
    for (const text of [message, `scenario no. ${runs.scenario[i]} of this report`].filter(Boolean)) {
      made.append(text, document.createElement("br"));
    }
    const replay = runs.replays[runs.id[i]];
    if (replay) {
      const link = document.createElement("a");
      link.href = replay;
      link.textContent = "Replay of this run";
      made.append(link, document.createElement("br"));
    }
    const command = document.createElement("code");
    command.textContent = `mrpbench view '${`${folder}:${runs.id[i]}`.replaceAll("'", "'\\''")}'`; // for a POSIX shell
    made.append(replay ? "Made by " : "Its replay, if its recording was kept: ", command);
  }

  function draw() {
    const body = element("list").tBodies[0];
    body.replaceChildren();
    for (const i of state.found.slice(0, state.shown)) {
      const row = body.insertRow();
      row.className = "entry";
      row.tabIndex = 0;
      row.dataset.run = i;
      for (const { name, number, measured, of } of columns) {
        const value = of(i);
        const kind = number ? "number" : name === "status" ? runs.tones[runs.status[i]] : name === "message" ? "message" : "words";
        const made = cell(row, value === null ? "–" : name === "status" ? value.replaceAll("_", " ") : `${value}${measured && runs.partial[runs.status[i]] ? " (partial)" : ""}`, kind);
        made.dataset.label = name;
      }
      if (i === state.open) detail(body, i);
    }
    const rest = state.found.length - state.shown;
    element("more").hidden = rest <= 0;
    element("more").textContent = `Show ${Math.min(PART, rest)} more of ${rest}`;
    element("found").textContent = `${state.found.length} of ${count} runs${runs.total > count ? ` in this list, of ${runs.total} in all` : ""}`;
    for (const [index, head] of [...element("list").tHead.rows[0].cells].entries()) {
      head.ariaSort = index === state.sort ? (state.down ? "descending" : "ascending") : "none";
    }
  }

  function toggle(row) {
    const i = Number(row.dataset.run);
    state.open = state.open === i ? -1 : i;
    draw();
    element("list").querySelector(`[data-run="${i}"]`).focus({ preventScroll: true });
  }

  for (const [index, { name, number }] of columns.entries()) {
    const head = document.createElement("th");
    head.scope = "col";
    head.append(...name.split(/(?<=[._])/).flatMap((part) => [document.createElement("wbr"), part])); // may break there
    head.tabIndex = 0;
    head.className = number ? "number" : "words";
    const sort = () => {
      state.down = state.sort === index && !state.down;
      state.sort = index;
      select();
    };
    head.addEventListener("click", sort);
    head.addEventListener("keydown", (event) => event.key === "Enter" && sort());
    element("list").tHead.rows[0].append(head);
  }
  for (const [id, names] of [["group", runs.groups], ["status", runs.statuses]]) {
    names.forEach((name, value) => element(id).append(new Option(name || "all runs", value)));
    element(id).addEventListener("change", select);
  }
  element("search").addEventListener("input", select);
  element("filters").addEventListener("submit", (event) => event.preventDefault());
  element("export").addEventListener("click", () => {
    const text = (value) => (value === null ? "" : String(value));
    saveCsv("runs", [columns.map(({ name }) => name), ...state.found.map((i) => columns.map(({ of }) => text(of(i))))]);
  });
  element("more").addEventListener("click", () => {
    state.shown += PART;
    draw();
  });
  const body = element("list").tBodies[0];
  body.addEventListener("click", (event) => {
    const row = event.target.closest("tr.entry");
    if (row) toggle(row);
  });
  body.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && event.target.matches("tr.entry")) toggle(event.target);
  });
  select();
}

read().then((runs) => {
  list(runs);
  document.body.classList.add("ready");
});
