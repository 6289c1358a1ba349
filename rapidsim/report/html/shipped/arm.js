// The arm: its links at any joints, drawn as the bodies they are made of, or as a row of bones.

// Joints [deg, mm where one slides] of the robot under somebody's hand, instead of those of the run.
const hand = { robot: null, joints: [] };

function jointsAt(robot, t) {
  if (hand.robot === robot) return hand.joints;
  const i = placeOf(robot.t, t);
  return robot.joints.map(column => column[i]);
}

// Turns are nine numbers, row by row.
function turned(turn, [x, y, z]) {
  return [0, 3, 6].map(k => turn[k] * x + turn[k + 1] * y + turn[k + 2] * z);
}

function after(first, second) {
  const product = [];
  for (let row = 0; row < 9; row += 3)
    for (let k = 0; k < 3; k++)
      product.push(first[row] * second[k] + first[row + 1] * second[3 + k] + first[row + 2] * second[6 + k]);
  return product;
}

function about([x, y, z], angle) {
  const c = Math.cos(angle), s = Math.sin(angle), d = 1 - c;
  return [c + x * x * d, x * y * d - z * s, x * z * d + y * s,
    y * x * d + z * s, c + y * y * d, y * z * d - x * s,
    z * x * d - y * s, z * y * d + x * s, c + z * z * d];
}

function moved(frame, point) {
  const [x, y, z] = turned(frame.turn, point);
  return [frame.place[0] + x, frame.place[1] + y, frame.place[2] + z];
}

// Where a link stands in the one before it: some joints slide it.
function placeInBefore(link, joints) {
  if (!link.slide) return link.place;
  return link.place.map((at, k) => link.slide.reduce((sum, way, j) => sum + way[k] * joints[j], at));
}

// Base, links and flange as the page shows them: each the link before it, turned by its joints.
function linkFrames(robot, joints, t) {
  const k = Math.min(Math.round(t / (robot.stands.step || 1)), robot.stands.place[0].length - 1);
  let frame = { turn: robot.stands.turn.map(column => column[k]), place: robot.stands.place.map(column => column[k]) };
  const frames = [frame];
  for (const link of robot.arm.links) {
    const angle = link.shares.reduce((sum, share, j) => sum + share * joints[j], 0) * Math.PI / 180;
    frame = { turn: after(after(frame.turn, link.turn), about(link.axis, angle)), place: moved(frame, placeInBefore(link, joints)) };
    frames.push(frame);
  }
  return frames;
}

// The tool in the flange, as it is at an instant of the run.
function toolAt(robot, t) {
  const i = placeOf(robot.t, t);
  const flange = linkFrames(robot, robot.joints.map(column => column[i]), t).at(-1);
  const [x, y, z] = tcpAt(robot, i).map((value, k) => value - flange.place[k]);
  const [a, b, c, d, e, f, g, h, l] = flange.turn;
  return turned([a, d, g, b, e, h, c, f, l], [x, y, z]);
}

// A corner of each body: what a picture must have room for.
function cornersAt(robot, t) {
  if (!robot.arm || !robot.arm.bodies.length) return [];
  const frames = linkFrames(robot, jointsAt(robot, t), t);
  return robot.arm.bodies.map(({ link, corners }) => moved(frames[link], corners.slice(0, 3)));
}

function drawArm(robot, pen, at) {
  // All that stands in the cell is drawn with the first arm, what is far off first.
  const outlines = robot === robots[0] ? objectOutlines(at) : [];
  if (!robot.arm) { drawOutlines(pen, outlines); drawBones(pen, armAt(robot, view.now).map(at)); return; }
  const frames = linkFrames(robot, jointsAt(robot, view.now), view.now);
  const tcp = moved(frames.at(-1), toolAt(robot, view.now));
  outlines.push(...robot.arm.bodies.map(({ link, corners, colour }) => outlineOf(frames[link], corners, colour, at)));
  drawOutlines(pen, outlines);
  if (robot.arm.bodies.length) drawTool(pen, at(frames.at(-1).place), at(tcp));
  else drawBones(pen, [...frames.map(frame => frame.place), tcp].map(at));
}

// Where an object of the cell stands, or is carried, at an instant.
function objectFrame({ turn, place }, t) {
  const k = Math.min(Math.round(t / (run.pose_step || 1)), place[0].length - 1);
  return { turn: turn.map(column => column[k]), place: place.map(column => column[k]) };
}

function objectOutlines(at) {
  return objects.flatMap(object => {
    if (object.exists && !(object.exists[0] <= view.now && view.now < object.exists[1])) return [];
    const frame = objectFrame(object, view.now);
    // What is large lies under other things more often than over them: its farthest corner counts.
    return object.parts.map(corners => outlineOf(frame, corners, object.colour, at, depths => Math.min(...depths)));
  });
}

function objectCorners() {
  return objects.flatMap(object => object.parts.map(corners => moved(objectFrame(object, 0), corners.slice(0, 3))));
}

function mean(values) {
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}

function outlineOf(frame, places, fill, at, depthOf = mean) {
  const toEye = [Math.cos(look.turn) * Math.cos(look.lift), Math.sin(look.turn) * Math.cos(look.lift), Math.sin(look.lift)];
  const corners = [];
  for (let k = 0; k < places.length; k += 3) corners.push(moved(frame, places.slice(k, k + 3)));
  const depth = depthOf(corners.map(p => p[0] * toEye[0] + p[1] * toEye[1] + p[2] * toEye[2]));
  return { depth, fill, outline: hull(corners.map(at)) };
}

function drawOutlines(pen, outlines) {
  outlines.sort((a, b) => a.depth - b.depth);
  pen.lineJoin = "round";
  for (const { outline, fill } of outlines) {
    pen.beginPath();
    outline.forEach(([x, y], k) => (k ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.closePath();
    pen.fillStyle = fill;
    pen.fill();
    pen.strokeStyle = "rgba(0, 0, 0, 0.35)";
    pen.lineWidth = 1;
    pen.stroke();
  }
}

// An arm without shapes: bones that grow thinner, with a knob at each joint.
function drawBones(pen, points) {
  const bones = points.slice(0, -1).filter((point, k, all) => !k || Math.hypot(point[0] - all[k - 1][0], point[1] - all[k - 1][1]) > 1);
  pen.lineCap = "round";
  for (const [tint, more] of [["arm-edge", 3], ["arm", 0]]) {
    pen.strokeStyle = colour(tint);
    for (let k = 1; k < bones.length; k++) {
      pen.lineWidth = Math.max(5, 15 - 2 * k) + more;
      strip(pen, [bones[k - 1], bones[k]]);
    }
  }
  pen.lineCap = "butt";
  bones.forEach((bone, k) => { disc(pen, bone, Math.max(3, 6 - k), colour("panel")); });
  drawTool(pen, points.at(-2), points.at(-1));
}

function drawTool(pen, flange, tcp) {
  pen.strokeStyle = colour("soft");
  pen.lineWidth = 3;
  pen.lineCap = "round";
  strip(pen, [flange, tcp]);
  pen.lineCap = "butt";
  disc(pen, tcp, 4.5, colour("cursor"));
}

// The convex outline of points in the picture.
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const side = way => {
    const kept = [];
    for (const p of way) {
      while (kept.length > 1) {
        const [a, b] = kept.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        kept.pop();
      }
      kept.push(p);
    }
    return kept.slice(0, -1);
  };
  return [...side(sorted), ...side(sorted.reverse())];
}

// A slider for each joint; what they show is the run again as soon as it is played.
function handTools(place, robot) {
  const rows = robot.arm.limits.map(([low, high], j) => {
    const row = document.createElement("label"), slider = document.createElement("input"), value = document.createElement("output");
    Object.assign(slider, { type: "range", min: low, max: high, step: 0.1 });
    slider.addEventListener("input", () => {
      if (hand.robot !== robot) Object.assign(hand, { robot, joints: rows.map(one => Number(one.slider.value)) });
      hand.joints[j] = Number(slider.value);
      redraw();
    });
    row.append("J" + (j + 1), slider, value);
    place.append(row);
    return { slider, value };
  });
  const where = document.createElement("p");
  where.className = "aside";
  place.append(where);
  button(place, "back to the run", release);
  view.listeners.push(() => {
    const joints = jointsAt(robot, view.now);
    rows.forEach(({ slider, value }, j) => { slider.value = joints[j]; value.textContent = joints[j].toFixed(1) + robot.arm.units[j]; });
    const tcp = moved(linkFrames(robot, joints, view.now).at(-1), toolAt(robot, view.now));
    where.textContent = "TCP at " + tcp.map(x => x.toFixed(1)).join(", ") + " mm" + (hand.robot === robot ? ", by hand" : "");
  });
}

function release() {
  hand.robot = null;
  redraw();
}
