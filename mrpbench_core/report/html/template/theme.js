// Light and dark, sections that unfold when a link leads to them, and print, which unfolds everything.
"use strict";
{
  const root = document.documentElement;
  const button = document.getElementById("theme");
  const set = (dark) => {
    root.dataset.theme = dark ? "dark" : "light";
    button.textContent = dark ? "Light" : "Dark";
  };
  set(matchMedia("(prefers-color-scheme: dark)").matches);
  button.addEventListener("click", () => set(root.dataset.theme !== "dark"));

  const unfold = () => {
    const section = location.hash.length > 1 && document.getElementById(location.hash.slice(1));
    const only = section ? section.querySelectorAll(":scope > details") : [];
    if (only.length === 1) only[0].open = true;
  };
  addEventListener("hashchange", unfold);
  unfold();

  let folded = [];
  let dark = false;
  addEventListener("beforeprint", () => {
    dark = root.dataset.theme === "dark";
    set(false);
    folded = [...document.querySelectorAll("details:not([open])")];
    for (const details of folded) details.open = true;
  });
  addEventListener("afterprint", () => {
    set(dark);
    for (const details of folded) details.open = false;
  });
}
