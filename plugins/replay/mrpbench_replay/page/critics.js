// The table of critics in the card of the chosen robot.

import { make } from "replay/list.js";

export class CriticsTable {
  constructor(run, trajectories) {
    this.run = run;
    this.trajectories = trajectories;
    this.table = make("table", "critics");
    this.table.append(make("caption", "unseen", "What each critic adds to the cost of the chosen trajectory"));
    this.body = this.table.appendChild(make("tbody"));
    this.table.hidden = true;
    document.getElementById("card").append(this.table);
  }

  /** Show the scores of a robot now, as bars beside numbers. */
  refresh(robot, wanted) {
    const scores = wanted ? this.trajectories.scores(robot) : [];
    this.table.hidden = !scores.length;
    const most = Math.max(...scores.map(([, score]) => Math.abs(score)), 1e-9);
    while (this.body.rows.length > scores.length) this.body.lastChild.remove();
    scores.forEach(([name, score], index) => {
      const row = this.body.rows[index] ?? this.#add();
      row.cells[0].textContent = name;
      row.cells[1].firstChild.style.width = `${(100 * Math.abs(score)) / most}%`;
      row.cells[2].textContent = text(score);
    });
  }

  #add() {
    const name = make("th");
    name.scope = "row";
    return this.body.appendChild(make("tr", "", name, make("td", "", make("i")), make("td")));
  }
}

function text(score) {
  return Math.abs(score) >= 1e5 ? score.toExponential(1) : score.toFixed(Math.abs(score) < 100 ? 2 : 0);
}
