"use strict";
// Shows the state of a controller twice a second, and asks for what its buttons say.
const $ = (id) => document.getElementById(id);
const PERIOD_MS = 500;
let state = null;
let shown = { task: "", module: "" };   // Whose text is on the page.
let editing = null;                      // The name of the signal whose number is being typed.

function element(name, text, classes) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (classes) made.className = classes;
  return made;
}

async function ask(path, form) {
  const options = form ? { method: "POST", body: new URLSearchParams(form) } : {};
  // The address of the page may hold a password, which a request must not.
  const response = await fetch(`${location.origin}/ui/${path}`, { credentials: "same-origin", ...options });
  if (!response.ok) throw new Error((await response.text()).trim() || `answer ${response.status}`);
  return response.status === 204 ? null : response.json();
}

function trouble(text) {
  $("trouble").hidden = !text;
  $("trouble").textContent = text;
}

async function act(path, action, form = {}) {
  try {
    await ask("do", { path, action, ...form });
    trouble("");
  } catch (error) {
    trouble(error.message);
  }
  if (action === "resetpp") shown.module = "";
  await look(true);
}

function options(select, names, chosen) {
  const old = [...select.options].map((one) => one.value).join("\n");
  if (old !== names.join("\n")) select.replaceChildren(...names.map((one) => new Option(one)));
  if (names.includes(chosen)) select.value = chosen;
}

function shownTask() {
  return state.tasks.find((one) => one.name === $("task").value) || state.tasks[0];
}

function showHead() {
  const runs = state.executes ? ["running", "on"] : ["stopped", "off"];
  const motors = state.motors === "motoron";
  $("state").replaceChildren(
    element("b", runs[0], runs[1]), ` · motors ${motors ? "on" : "off"} · ${state.mode} · ${state.speed} % · ${state.time.toFixed(1)} s`,
  );
  $("start").disabled = state.executes || !motors;
  $("stop").disabled = !state.executes;
  $("main").disabled = state.executes;
  $("motors").textContent = motors ? "Motors off" : "Motors on";
}

async function showProgram() {
  const names = state.tasks.map((one) => one.name);
  options($("task"), names, $("task").value || names[0]);
  const task = shownTask();
  const follows = $("follow").checked && task.pointer;
  options($("module"), task.modules, follows ? task.pointer[0] : $("module").value);
  const module = $("module").value;
  if (module && (shown.task !== task.name || shown.module !== module)) {
    const found = await ask(`text?${new URLSearchParams({ task: task.name, module })}`);
    shown = { task: task.name, module };
    $("text").replaceChildren(...found.text.replace(/\n$/, "").split("\n").map((line) => element("li", line)));
  }
  const lines = $("text").children;
  for (const kind of ["pointer", "motion"]) {
    const place = task[kind];
    const line = place && place[0] === module ? lines[place[1] - 1] : null;
    const before = $("text").querySelector(`li.${kind}`);
    if (before !== line) {
      if (before) before.classList.remove(kind);
      if (line) line.classList.add(kind);
      if (line && kind === "pointer" && follows) {
        $("text").scrollTop = line.offsetTop - $("text").offsetTop - $("text").clientHeight / 2;
      }
    }
  }
}

function showRobot() {
  const task = shownTask().joints ? shownTask() : state.tasks.find((one) => one.joints);
  if (!task) { $("robot").hidden = true; return; }
  $("frames").textContent = `${task.tool} in ${task.wobj}`;
  const axes = [...task.joints.map((one, k) => [`J${k + 1} ${task.measures[k] === "mm" ? "mm" : "°"}`, one]), ...Object.entries(task.external)];
  $("joints").replaceChildren(...axes.map(([name, value]) => {
    const tile = element("div");
    tile.append(element("span", name), value.toFixed(2));
    return tile;
  }));
  $("tcp").textContent = `TCP ${task.position.map((one) => one.toFixed(1)).join(", ")} mm · [${task.orientation.join(", ")}]`;
}

function showPendant() {
  $("pendant").hidden = !state.screen.length && !state.questions.length;
  const screen = state.screen.join("\n");
  if ($("screen").textContent !== screen) {
    $("screen").textContent = screen;
    $("screen").scrollTop = $("screen").scrollHeight;
  }
  const asked = JSON.stringify(state.questions);
  if ($("questions").dataset.asked === asked) return;
  $("questions").dataset.asked = asked;
  $("questions").replaceChildren(...state.questions.map((one) => {
    const form = element("form");
    const answer = (value) => act(`/rw/rapid/uiinstr/active/param/RAPID/${one.task}/value`, "set", { value });
    form.append(element("p", `${one.task}: ${one.prompt}`));
    if (one.choices.length) {
      for (const key of one.choices) {
        const button = element("button", key);
        button.type = "button";
        button.onclick = () => answer(key);
        form.append(button);
      }
    } else {
      const input = element("input");
      input.value = one.proposal;
      input.setAttribute("aria-label", "Answer");
      form.append(input, " ", element("button", "Answer"));
      form.onsubmit = (event) => { event.preventDefault(); answer(input.value); };
    }
    return form;
  }));
}

function control(signal) {
  const set = (lvalue) => act(`/rw/iosystem/signals/${signal.name}`, "set", { lvalue });
  const isDigital = signal.kind === "di" || signal.kind === "do";
  if (!signal.settable) return element("span", String(signal.value));
  if (isDigital) {
    const button = element("button", String(signal.value), signal.value ? "on" : "");
    button.setAttribute("aria-label", `Set ${signal.name} to ${signal.value ? 0 : 1}`);
    button.onclick = () => set(signal.value ? 0 : 1);
    return button;
  }
  const input = element("input");
  input.type = "number";
  input.step = "any";
  input.value = signal.value;
  input.setAttribute("aria-label", signal.name);
  input.onfocus = () => { editing = signal.name; };
  input.onblur = () => { editing = null; };
  input.onchange = () => { editing = null; set(input.value); };
  return input;
}

function showSignals() {
  const wanted = $("filter").value.toLowerCase();
  const found = state.signals.filter((one) => one.name.toLowerCase().includes(wanted));
  const rows = new Map([...$("signals").children].map((row) => [row.dataset.name, row]));
  const kept = found.map((one) => {
    const row = rows.get(one.name);
    if (row && (row.dataset.value === String(one.value) || editing === one.name)) return row;
    const made = element("tr");
    made.dataset.name = one.name;
    made.dataset.value = String(one.value);
    const value = element("td", undefined, "value");
    value.append(control(one));
    made.append(element("td", one.kind.toUpperCase(), "kind"), element("td", one.name), value);
    return made;
  });
  if (!kept.length) kept.push(element("tr", state.signals.length ? "no signal of this name" : "the station has no signals", "none"));
  const now = [...$("signals").children];
  if (now.length !== kept.length || now.some((row, k) => row !== kept[k])) {
    const focused = document.activeElement && document.activeElement.getAttribute("aria-label");
    const row = document.activeElement && document.activeElement.closest("#signals tr");
    $("signals").replaceChildren(...kept);
    if (focused && row) {
      const again = $("signals").querySelector(`tr[data-name="${CSS.escape(row.dataset.name)}"] button, tr[data-name="${CSS.escape(row.dataset.name)}"] input`);
      if (again) again.focus();
    }
  }
}

function showLog() {
  const newest = state.log.length ? state.log[0].number : 0;
  if ($("log").dataset.newest === String(newest) && $("log").children.length === state.log.length) return;
  $("log").dataset.newest = String(newest);
  $("log").replaceChildren(...state.log.map((one) => {
    const row = element("tr", undefined, ["", "", "warning", "error"][one.type] || "");
    const title = element("td");
    title.append(element("span", one.title, "title"));
    if (one.text) title.append(element("small", one.text));
    row.append(element("td", one.clock, "clock"), element("td", String(one.code), "code"), title);
    return row;
  }));
}

async function look(isAnswer) {
  try {
    state = await ask("state");
    if (!isAnswer && $("trouble").dataset.lost) { trouble(""); delete $("trouble").dataset.lost; }
    showHead();
    showRobot();
    showPendant();
    showSignals();
    showLog();
    await showProgram();
  } catch (error) {
    $("trouble").dataset.lost = "1";
    trouble(`The controller does not answer: ${error.message}`);
  }
}

$("start").onclick = () => act("/rw/rapid/execution", "start", { cycle: "asis" });
$("stop").onclick = () => act("/rw/rapid/execution", "stop", { stopmode: "stop" });
$("main").onclick = () => act("/rw/rapid/execution", "resetpp");
$("motors").onclick = () => act("/rw/panel/ctrlstate", "setctrlstate", { "ctrl-state": state.motors === "motoron" ? "motoroff" : "motoron" });
$("filter").oninput = () => showSignals();
$("task").onchange = () => look();
$("module").onchange = () => { $("follow").checked = false; look(); };
$("follow").onchange = () => look();

async function live() {
  if (!document.hidden) await look();
  setTimeout(live, PERIOD_MS);
}
live();
