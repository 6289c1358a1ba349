"use strict";
// A panel that jogs an arm by steps. Before a step is tried it says whether the arm can make it.

const JOG_FRAMES = [["joints", "axes"], ["base", "base"], ["world", "world"], ["tool", "tool"], ["wobj", "work object"]];
const DIRECTIONS = ["x", "y", "z", "rx", "ry", "rz"];
const LENGTHS_MM = [1, 10, 50, 200], ANGLES_DEG = [0.1, 1, 5, 30];

// `read(query)` gives the steps of a frame, `move(step)` makes one; `units` are those of the axes.
function jogPanel(place, { read, move, units }) {
  const chosen = { frame: "joints", length: 10, angle: 5 };
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
  choice("length", "step", LENGTHS_MM.map((one) => [one, one + " mm"]));
  choice("angle", "turn", ANGLES_DEG.map((one) => [one, one + "°"]));
  place.replaceChildren(choices, refusal, grid, stands);

  function button(step, sign, reason, name) {
    const text = sign < 0 ? "−" : "+", key = made("button", text, "step");
    key.type = "button";
    key.dataset.step = `${name}${text}`;
    key.disabled = !!reason;
    key.title = reason || `${name} ${sign < 0 ? "−" : "+"}${step.size}`;
    key.setAttribute("aria-label", reason ? `${name} ${text}: ${reason}` : `${name} ${text}`);
    key.onclick = async () => { await move({ frame: chosen.frame, axis: step.axis, by: sign * step.size }); refresh(); };
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
    show(await read(chosen));
  }
  return { refresh };
}
