"use strict";
// Shows the state of a controller twice a second, and asks for what its buttons say.
const $ = (id) => document.getElementById(id);
const PERIOD_MS = 500, PICTURE_MS = 80;
let state = null;
let shown = { task: "", module: "" };   // Whose text is on the page.
let editing = null;                      // The name of the signal whose number is being typed.
let drawn = { unit: "", picture: null, jog: null };   // Whose arm is drawn, and its panel.
let dated = "";                          // The task and module whose data are on the page.

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
  await refresh(true);
}

function options(select, names, chosen) {
  const old = [...select.options].map((one) => one.value).join("\n");
  if (old !== names.join("\n")) select.replaceChildren(...names.map((one) => new Option(one)));
  if (names.includes(chosen)) select.value = chosen;
}

function shownTask() {
  return state.tasks.find((one) => one.name === $("task").value) || state.tasks[0];
}

const WORDS = {
  motoron: "motors on", guardstop: "guard stop", emergencystop: "emergency stop",
  emergencystopreset: "emergency stop released",
};

function showHead() {
  const runs = state.executes ? ["running", "on"] : ["stopped", "off"];
  const motors = state.motors === "motoron";
  $("state").replaceChildren(
    element("b", runs[0], runs[1]), ` · ${WORDS[state.motors] || "motors off"} · ${state.mode} · ${state.speed} % · ${state.time.toFixed(1)} s`,
  );
  $("start").disabled = state.executes || !motors;
  $("stop").disabled = !state.executes;
  for (const id of ["step", "over"]) $(id).disabled = $("start").disabled;
  for (const id of ["main", "go", "upload", "unload"]) $(id).disabled = state.executes;
  $("emergency").textContent = state.pressed ? "Release emergency stop" : "Emergency stop";
  if (document.activeElement !== $("mode")) $("mode").value = state.mode;
  if (document.activeElement !== $("speed")) { $("speed").value = state.speed; $("percent").textContent = `${state.speed} %`; }
  $("speed").disabled = state.mode !== "AUTO";
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
  const broken = new Set(task.breakpoints.filter((one) => one[0] === module.toLowerCase()).map((one) => one[1]));
  [...lines].forEach((line, k) => line.classList.toggle("break", broken.has(k + 1)));
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

function robotTask() {
  return shownTask().joints ? shownTask() : state.tasks.find((one) => one.joints);
}

async function drawRobot(task) {
  if (drawn.unit !== task.mechunit) {
    drawn = { unit: task.mechunit, picture: null, jog: null };
    const { arm } = await ask(`arm?${new URLSearchParams({ mechunit: task.mechunit })}`);
    $("arm").hidden = !arm;
    if (arm) drawn.picture = armPicture($("arm"), arm);
    drawn.jog = jogPanel($("jog"), {
      read: (chosen) => ask(`jog?${new URLSearchParams({ mechunit: task.mechunit, ...chosen })}`),
      move: (step) => act("/rw/motionsystem", "jog", { mechunit: task.mechunit, ...step }),
      held: true,
      units: task.measures.map((one) => (one === "mm" ? " mm" : "°")),
    });
  }
  if (drawn.picture) drawn.picture.show(task.joints);
  if ($("jogging").open) await drawn.jog.refresh();
}

async function showRobot() {
  const task = robotTask();
  if (!task) { $("robot").hidden = true; return; }
  await drawRobot(task);
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
    if (one.remedy) title.append(element("small", `Help: ${one.remedy}`, "remedy"));
    if (one.place) {
      const button = element("button", `Line ${one.place[2]} of ${one.place[1]}`, "link");
      button.onclick = () => showLine(...one.place);
      title.append(button);
    }
    if (one.rule) {
      const button = element("button", `Explain ${one.rule}`, "link");
      button.onclick = () => explain(one.rule);
      title.append(button);
    }
    row.append(element("td", one.clock, "clock"), element("td", String(one.code), "code"), title);
    return row;
  }));
}

function toggleBreak(line) {
  const row = [...$("text").children].indexOf(line) + 1;
  if (row) act(`/rw/rapid/tasks/${shown.task}/breakpoints`, line.classList.contains("break") ? "clear" : "set", { module: shown.module, row });
}

function markLine(line) {
  for (const one of $("text").querySelectorAll(".found")) one.classList.remove("found");
  if (!line) return;
  line.classList.add("found");
  line.scrollIntoView({ block: "nearest" });
}

function textKey(event) {
  const now = $("text").querySelector(".found") || $("text").querySelector(".pointer") || $("text").firstElementChild;
  const next = { ArrowDown: now && now.nextElementSibling, ArrowUp: now && now.previousElementSibling }[event.key];
  if (next) { event.preventDefault(); markLine(next); }
  if (event.key === "Enter" && now) toggleBreak(now);
}

async function showLine(task, module, line) {
  $("follow").checked = false;
  $("task").value = task;
  options($("module"), shownTask().modules, module);
  await refresh();
  markLine($("text").children[line - 1]);
  $("text").focus();
}

async function explain(code) {
  try {
    const rule = await ask(`rule?${new URLSearchParams({ code })}`);
    $("rule").textContent = `${rule.code} ${rule.name}\n\n${rule.text}`;
    $("explanation").showModal();
  } catch (error) {
    trouble(error.message);
  }
}

async function showData() {
  const task = shownTask(), module = $("module").value;
  $("download").href = `/ui/module?${new URLSearchParams({ task: task.name, module })}`;
  $("download").setAttribute("download", `${module}.mod`);
  const of = `${task.name}/${module}/${task.modules.join()}`;
  const open = $("values").open;
  if (dated === of && (!open || $("data").contains(document.activeElement))) return;
  const found = await ask(`task?${new URLSearchParams({ task: task.name, module })}`);
  dated = of;
  options($("routine"), found.routines, $("routine").value);
  $("data").replaceChildren(...found.data.map((one) => {
    const row = element("tr"), value = element("td", undefined, "value");
    row.dataset.name = one.name;
    if (one.settable) {
      const input = element("input");
      input.value = one.value;
      input.setAttribute("aria-label", one.name);
      input.onchange = () => { input.blur(); act(`/rw/rapid/symbol/data/RAPID/${task.name}/${module}/${one.name}`, "set", { value: input.value }); };
      value.append(input);
    } else {
      value.textContent = one.value === null ? "" : one.value;
    }
    row.append(element("td", `${one.storage} ${one.type}`, "kind"), element("td", one.name), value);
    return row;
  }));
}

async function upload() {
  const [file] = $("upload").files;
  if (!file) return;
  try {
    const response = await fetch(`${location.origin}/ui/upload?${new URLSearchParams({ name: file.name })}`, { method: "POST", body: file, credentials: "same-origin" });
    if (!response.ok) throw new Error((await response.text()).trim() || `answer ${response.status}`);
    await act(`/rw/rapid/tasks/${shownTask().name}`, "loadmod", { modulepath: `$HOME/${file.name}`, replace: "true" });
    shown.module = "";
  } catch (error) {
    trouble(error.message);
  }
  $("upload").value = "";
}

// One after the other: an older state must not be shown over a newer one.
let refreshed = Promise.resolve();

function refresh(isAnswer) {
  refreshed = refreshed.then(() => showState(isAnswer));
  return refreshed;
}

async function showState(isAnswer) {
  try {
    state = await ask("state");
    if (!isAnswer && $("trouble").dataset.lost) { trouble(""); delete $("trouble").dataset.lost; }
    showHead();
    await showRobot();
    showPendant();
    showSignals();
    showLog();
    await showProgram();
    await showData();
  } catch (error) {
    $("trouble").dataset.lost = "1";
    trouble(`The controller does not answer: ${error.message}`);
  }
}

$("start").onclick = () => act("/rw/rapid/execution", "start", { cycle: "asis" });
$("stop").onclick = () => act("/rw/rapid/execution", "stop", { stopmode: "stop" });
for (const [id, execmode] of [["step", "stepin"], ["over", "stepover"]])
  $(id).onclick = () => act("/rw/rapid/execution", "start", { cycle: "asis", execmode });
$("main").onclick = () => act("/rw/rapid/execution", "resetpp");
$("go").onclick = () => act(`/rw/rapid/tasks/${shownTask().name}/pcp`, "set-pp-routine", { routine: $("routine").value });
$("unload").onclick = () => act(`/rw/rapid/tasks/${shownTask().name}`, "unloadmod", { module: $("module").value });
$("upload").onchange = upload;
$("mode").onchange = () => { const opmode = $("mode").value; $("mode").blur(); act("/rw/panel/opmode", "setopmode", { opmode }); };
$("speed").oninput = () => { $("percent").textContent = `${$("speed").value} %`; };
$("speed").onchange = () => { const ratio = $("speed").value; $("speed").blur(); act("/rw/panel/speedratio", "setspeedratio", { "speed-ratio": ratio }); };
$("emergency").onclick = () => act("/rw/panel", "emergencystop", { "emergency-stop": state.pressed ? "released" : "pressed" });
$("text").onclick = (event) => { const line = event.target.closest("li"); if (line && !String(getSelection())) toggleBreak(line); };
$("text").onkeydown = textKey;
$("jogging").ontoggle = () => refresh();
$("values").ontoggle = () => refresh();
$("motors").onclick = () => act("/rw/panel/ctrlstate", "setctrlstate", { "ctrl-state": state.motors === "motoron" ? "motoroff" : "motoron" });
$("filter").oninput = () => showSignals();
$("task").onchange = () => refresh();
$("module").onchange = () => { $("follow").checked = false; refresh(); };
$("follow").onchange = () => refresh();

async function live() {
  if (!document.hidden) await refresh();
  setTimeout(live, PERIOD_MS);
}
live();

// The picture of an arm that moves is drawn more often than the rest of the page.
async function picture() {
  if (!document.hidden && drawn.picture && (state.executes || $("jogging").open)) {
    try {
      const { joints } = await ask(`joints?${new URLSearchParams({ mechunit: drawn.unit })}`);
      drawn.picture.show(joints);
    } catch { /* `refresh` says that the controller does not answer. */ }
  }
  setTimeout(picture, PICTURE_MS);
}
picture();
