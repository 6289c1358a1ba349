"use strict";
// The arm in a picture that turns under mouse, finger and arrow keys. Needs links.js.

const look = { turn: -0.9, lift: 0.35 };
const TURN_OF_KEY = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
const GRID_MM = 500;

// A picture of an arm (`links`, `bodies`) on a canvas: `show` draws it at joints [deg, mm], with
// objects (`parts` at `turn` and `place` in base) and the TCP [mm] if it is not the flange.
function armPicture(canvas, arm) {
  const base = { turn: [1, 0, 0, 0, 1, 0, 0, 0, 1], place: [0, 0, 0] };
  const reach = arm.reach || Math.max(300, arm.links.reduce((sum, link) => sum + Math.hypot(...link.place), 0));
  let shown = arm.limits.map(() => 0), objects = [], tip = null;

  function draw() {
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width) return;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    const style = getComputedStyle(canvas);
    const eye = { x: 0, y: 0.4 * reach, scale: Math.min(width, height) / (1.35 * reach) };
    const at = (point) => seen(eye, point, width, height);
    drawGrid(pen, at, style.getPropertyValue("--rule"));
    const frames = framesOf(base, arm.links, shown);
    drawOutlines(pen, [
      ...arm.bodies.map(({ link, corners, colour }) => outlineOf(frames[link], corners, colour, at)),
      ...objects.flatMap((one) => one.parts.map((corners) => outlineOf(one, corners, one.colour, at))),
    ]);
    if (!arm.bodies.length) line(pen, frames.map((frame) => at(frame.place)), style.getPropertyValue("--accent"), 6);
    const [x, y] = at(tip || frames.at(-1).place);
    pen.beginPath();
    pen.arc(x, y, 4, 0, 7);
    pen.fillStyle = style.getPropertyValue("--accent");
    pen.fill();
  }

  function drawGrid(pen, at, colour) {
    const end = GRID_MM * Math.ceil(reach / GRID_MM);
    for (let k = -end; k <= end; k += GRID_MM) {
      line(pen, [at([k, -end, 0]), at([k, end, 0])], colour, 1);
      line(pen, [at([-end, k, 0]), at([end, k, 0])], colour, 1);
    }
  }

  function line(pen, points, colour, width) {
    pen.beginPath();
    points.forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.lineJoin = "round";
    pen.stroke();
  }

  function turnBy(turn, lift) {
    look.turn -= turn;
    look.lift = Math.min(1.5, Math.max(-0.2, look.lift + lift));
    draw();
  }

  canvas.onpointerdown = (event) => canvas.setPointerCapture(event.pointerId);
  canvas.onpointermove = (event) => { if (event.buttons) turnBy(event.movementX / 120, event.movementY / 120); };
  canvas.onkeydown = (event) => {
    const turn = TURN_OF_KEY[event.key];
    if (turn) { event.preventDefault(); turnBy(...turn); }
  };
  new ResizeObserver(draw).observe(canvas);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  return { show(joints, around = [], tcp = null) { [shown, objects, tip] = [joints, around, tcp]; draw(); } };
}
