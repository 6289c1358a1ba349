"use strict";
// A panel that jogs an arm, by steps or while a button is held. Before a step is tried it says whether the arm can make it.

const JOG_FRAMES = [["joints", "axes"], ["base", "base"], ["world", "world"], ["tool", "tool"], ["wobj", "work object"]];
const DIRECTIONS = ["x", "y", "z", "rx", "ry", "rz"];
const LENGTHS_MM = [1, 10, 50, 200], ANGLES_DEG = [0.1, 1, 5, 30];
const HELD = "while held", AGAIN_MS = 250;

// `read(query)` gives the steps of a frame, `move(step)` makes one; `units` are those of the axes. Where the arm can be
// `held`, a step that is held is as long as it may be, and one by 0 halts the arm.
function jogPanel(place, { read, move, units, held }) {
  const chosen = { frame: "joints", length: 10, angle: 5 };
  let timer = 0;   // Of the button that is held.
  const made = (name, text, classes) => Object.assign(document.createElement(name), { textContent: text || "", className: classes || "" });
  const choices = made("div", "", "choices");
  const refusal = made("p", "", "refusal"), grid = made("div", "", "steps"), stands = made("p", "", "stands");
  refusal.setAttribute("role", "status");

  function choice(name, title, values) {
    const label = made("label", title + " "), select = made("select");
    select.dataset.choice = name;
    for (const [value, text] of values) select.append(new Option(text, value, false, String(value) === String(chosen[name])));
    select.onchange = () => { chosen[name] = select.value; refresh(); };
    label.append(select);
    choices.append(label);
  }

  choice("frame", "Along", JOG_FRAMES);
  const ways = held ? [[HELD, HELD]] : [];
  choice("length", "step", [...LENGTHS_MM.map((one) => [one, one + " mm"]), ...ways]);
  choice("angle", "turn", [...ANGLES_DEG.map((one) => [one, one + "°"]), ...ways]);
  place.replaceChildren(choices, refusal, grid, stands);

  function button(step, sign, reason, name) {
    const text = sign < 0 ? "−" : "+", key = made("button", text, "step");
    key.type = "button";
    key.dataset.step = `${name}${text}`;
    key.disabled = !!reason;
    key.title = reason || `${name} ${sign < 0 ? "−" : "+"}${step.size}`;
    key.setAttribute("aria-label", reason ? `${name} ${text}: ${reason}` : `${name} ${text}`);
    const ask = (by, more) => move({ frame: chosen.frame, axis: step.axis, by, ...more });
    if (!step.held) {
      key.onclick = async () => { await ask(sign * step.size); refresh(); };
    } else {
      const on = () => ask(sign * step.size, { held: 1 });
      key.onpointerdown = key.onkeydown = (event) => {
        if (timer || (event.key && event.key !== " " && event.key !== "Enter")) return;
        if (event.pointerId !== undefined) key.setPointerCapture(event.pointerId);
        timer = setInterval(on, AGAIN_MS);
        on();
      };
      key.onpointerup = key.onpointercancel = key.onkeyup = key.onblur = async () => {
        if (!timer) return;
        clearInterval(timer);
        timer = 0;
        await ask(0);
        refresh();
      };
      key.oncontextmenu = (event) => event.preventDefault();
    }
    return key;
  }

  function show(panel) {
    const focused = document.activeElement && document.activeElement.dataset.step;
    refusal.textContent = panel.reason || "";
    grid.replaceChildren(...panel.steps.map((step, k) => {
      const name = chosen.frame === "joints" ? `J${k + 1}` : DIRECTIONS[k];
      const reasons = step.reasons.map((one) => panel.reason || one);
      const row = made("div", "", "axis"), why = panel.reason ? "" : [...new Set(step.reasons.filter(Boolean))].join("; ");
      row.append(button(step, -1, reasons[0], name), made("b", name), button(step, 1, reasons[1], name), made("small", why));
      return row;
    }));
    if (focused) { const again = grid.querySelector(`[data-step="${focused}"]`); if (again) again.focus(); }
    const room = panel.stands.room.map(([low, high], k) => [Math.min(low ?? Infinity, high ?? Infinity), k]).sort((a, b) => a[0] - b[0])[0];
    const near = panel.stands.singularities.length ? ` · near a singularity: ${panel.stands.singularities.join(", ")}` : "";
    const limit = room && Number.isFinite(room[0]) ? ` · J${room[1] + 1} is ${room[0].toFixed(1)}${units[room[1]]} from its limit` : "";
    stands.textContent = `Configuration [${panel.stands.configuration.join(", ")}]${limit}${near}`;
  }

  async function refresh() {
    if (timer) return;
    // While a button is held the arm goes as far as it can, so the least step says whether it can at all.
    const least = { length: LENGTHS_MM[0], angle: ANGLES_DEG[0] }, longest = { length: LENGTHS_MM.at(-1), angle: ANGLES_DEG.at(-1) };
    const asked = { ...chosen };
    for (const name of ["length", "angle"]) if (chosen[name] === HELD) asked[name] = least[name];
    const panel = await read(asked);
    for (const step of panel.steps) {
      const name = chosen.frame !== "joints" && step.axis <= 3 ? "length" : "angle";
      step.held = chosen[name] === HELD;
      if (step.held) step.size = longest[name];
    }
    if (!timer) show(panel);
  }
  return { refresh };
}
