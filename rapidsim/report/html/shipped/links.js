// Links of an arm at any joints, and the outlines of the bodies they are made of.

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

// Base, links and flange in turn: each the link before it, turned by its joints [deg, mm].
function framesOf(base, links, joints) {
  const frames = [base];
  for (const link of links) {
    const before = frames.at(-1);
    const angle = link.shares.reduce((sum, share, j) => sum + share * joints[j], 0) * Math.PI / 180;
    frames.push({ turn: after(after(before.turn, link.turn), about(link.axis, angle)), place: moved(before, placeInBefore(link, joints)) });
  }
  return frames;
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

// Where a point is in a picture, seen from far away in the direction `look`.
function seen(eye, point, width, height) {
  const ct = Math.cos(look.turn), st = Math.sin(look.turn), cl = Math.cos(look.lift), sl = Math.sin(look.lift);
  const right = -st * point[0] + ct * point[1];
  const depth = ct * point[0] + st * point[1];
  const up = cl * point[2] - sl * depth;
  return [width / 2 + (right - eye.x) * eye.scale, height / 2 - (up - eye.y) * eye.scale];
}
