"use strict";
// Moves an arm by hand: the page keeps the joints, and asks what they mean.
const $ = (id) => document.getElementById(id);
const BRANCHES_MS = 250, TIGHT = 5;
let cell = null, joints = [], picture = null, panel = null;
let asking = false, stale = false, branchTimer = 0, passed = [];

function element(name, text, classes) {
  return Object.assign(document.createElement(name), { textContent: text ?? "", className: classes || "" });
}

async function ask(path, fields, method = "GET") {
  const query = new URLSearchParams(fields);
  const response = await (method === "GET" ? fetch(`${path}?${query}`) : fetch(path, { method, body: query }));
  if (!response.ok) throw new Error((await response.text()).trim() || `answer ${response.status}`);
  return response.json();
}

function trouble(text) {
  $("trouble").hidden = !text;
  $("trouble").textContent = text || "";
}

const posture = () => ({ joints: joints.join(","), tool: $("tool").value, wobj: $("wobj").value });
const unit = (k) => (cell.measures[k] === "mm" ? " mm" : "°");

// One question at a time: what changes meanwhile is asked about afterwards.
async function refresh() {
  stale = true;
  if (asking) return;
  asking = true;
  try {
    while (stale) {
      stale = false;
      show(await ask("standing", posture()));
      await panel.refresh();
    }
    trouble("");
  } catch (error) {
    trouble(error.message);
  } finally {
    asking = false;
  }
  clearTimeout(branchTimer);
  branchTimer = setTimeout(showBranches, BRANCHES_MS);
}

function moveTo(values, touched = []) {
  joints = [...values];
  passed = touched;
  cell.sliders.forEach(({ range, number }, k) => { range.value = joints[k]; if (document.activeElement !== number) number.value = joints[k].toFixed(2); });
  return refresh();
}

function show(stands) {
  const touching = new Set([...stands.contacts, ...passed].filter((one) => !one.distance).flatMap((one) => [one.first, one.second]).map((one) => one.replaceAll("`", "")));
  const objects = cell.objects.map((one, k) => ({ ...one, ...stands.objects[k], colour: touching.has(one.name) ? "#d33a2c" : one.colour }));
  picture.show(joints, objects, stands.tip);
  $("pose").textContent = `${$("tool").value} in ${$("wobj").value}: ${stands.trans.map((one) => one.toFixed(1)).join(", ")} mm · [${stands.rot.map((one) => one.toFixed(4)).join(", ")}] · conf [${stands.configuration.join(", ")}]`;
  cell.sliders.forEach(({ row }, k) => {
    const room = Math.min(...stands.room[k].map((one) => one ?? Infinity));
    row.classList.toggle("tight", room < TIGHT);
    row.title = Number.isFinite(room) ? `${room.toFixed(1)}${unit(k)} from its limit` : "";
  });
  $("singularities").replaceChildren(...stands.singularMeasures.map((one) => {
    const row = element("div", "", one.near ? "measure near" : "measure"), bar = element("meter");
    Object.assign(bar, { min: 0, max: 1, value: Math.min(1, one.distance) });
    row.title = one.reason;
    row.append(element("span", one.name), bar, element("span", one.distance.toFixed(3)));
    return row;
  }), element("small", `manipulability ${stands.manipulability}`, "none"));
  const lines = [...stands.contacts, ...passed.filter((one) => !stands.contacts.some((now) => !now.distance && now.first === one.first && now.second === one.second)).map((one) => ({ ...one, onTheWay: true }))];
  $("contacts").replaceChildren(...lines.map((one) => {
    const both = `${one.first} and ${one.second}`.replaceAll("`", "");
    if (one.onTheWay) return element("li", `${both} touched during the step`, "touch");
    return one.distance ? element("li", `${both}: ${one.distance.toFixed(1)} mm apart`) : element("li", `${both} touch`, "touch");
  }));
  $("robtarget").textContent = stands.robtarget;
}

async function showBranches() {
  let found;
  try { found = (await ask("branches", posture())).branches; } catch (error) { trouble(error.message); return; }
  $("branches").replaceChildren(...found.map((one) => {
    const key = element("button", `[${one.confdata.join(", ")}]  ${one.joints.map((v, k) => v.toFixed(1) + unit(k)).join("  ")}`, one.here ? "here" : "");
    key.disabled = !one.within;
    key.title = one.within ? "" : "outside the limits";
    key.setAttribute("aria-pressed", one.here);
    key.onclick = () => moveTo(one.joints);
    return key;
  }), ...(found.length ? [] : [element("p", "none", "none")]));
}

function makeSlider(k) {
  const row = element("div", "", "slider"), range = element("input"), number = element("input");
  const [low, high] = cell.limits[k];
  Object.assign(range, { type: "range", min: low, max: high, step: 0.1 });
  Object.assign(number, { type: "number", min: low, max: high, step: 0.1 });
  range.setAttribute("aria-label", `Joint ${k + 1}`);
  number.setAttribute("aria-label", `Value of joint ${k + 1} in ${cell.measures[k]}`);
  const turn = (text) => {
    const value = Math.min(high, Math.max(low, Number(text)));
    if (text !== "" && Number.isFinite(value)) moveTo(joints.map((one, j) => (j === k ? value : one)));
  };
  range.oninput = () => turn(range.value);
  number.onchange = () => turn(number.value);
  row.append(element("b", `J${k + 1}`), range, number);
  return { row, range, number };
}

async function teach(event) {
  event.preventDefault();
  try {
    const done = await ask("teach", { ...posture(), name: $("name").value, module: $("module").value }, "POST");
    $("written").textContent = `${done.file}:${done.line}`;
    $("name").value = "";
    trouble("");
  } catch (error) {
    $("written").textContent = "";
    trouble(error.message);
  }
}

async function copy() {
  await navigator.clipboard.writeText($("robtarget").textContent);
  $("copied").textContent = "copied";
  setTimeout(() => { $("copied").textContent = ""; }, 1500);
}

async function begin() {
  cell = await ask("start", {});
  $("title").textContent = cell.title;
  document.title = `${cell.title}: rapidsim jog`;
  for (const name of ["tool", "wobj"]) {
    $(name).replaceChildren(...cell[`${name}s`].map((one) => new Option(one)));
    $(name).onchange = refresh;
  }
  $("module").replaceChildren(...cell.modules.map((one) => new Option(one)));
  $("teach").hidden = !cell.modules.length;
  $("remarks").textContent = cell.remarks.join("; ");
  cell.sliders = cell.limits.map((_, k) => makeSlider(k));
  $("sliders").replaceChildren(...cell.sliders.map((one) => one.row));
  picture = armPicture($("arm"), cell.arm);
  panel = jogPanel($("jog"), {
    read: (chosen) => ask("steps", { ...posture(), ...chosen }),
    move: async (step) => {
      try {
        const moved = await ask("move", { ...posture(), ...step });
        await moveTo(moved.joints, moved.contacts);
      } catch (error) {
        trouble(error.message);
      }
    },
    units: cell.measures.map((_, k) => unit(k)),
  });
  $("home").onclick = () => moveTo(cell.joints);
  $("copy").onclick = () => copy().catch((error) => trouble(error.message));
  $("teach").onsubmit = teach;
  await moveTo(cell.joints);
}

begin().catch((error) => trouble(error.message));
