// Where the names of bodies stand on a picture: inside their largest part, and not on each other.

/** A line of an outline, in pixels. */
export interface PixelLine {
  closed: boolean;
  x: number[];
  y: number[];
}

/** A body with a name, and the size of its text in pixels. */
export interface NamedBody {
  name: string;
  width: number;
  height: number;
  lines: PixelLine[];
}

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** The middle of a name, and a place inside its body: the same, unless it had to move away from another name. */
export interface PlacedName {
  name: string;
  x: number;
  y: number;
  inside: [number, number];
}

const ALONG = 21; // places to choose from, each way
const GAP = 3; // pixels around a name

/** Calls back with the ends of every piece; the piece that closes a line as well if asked for. */
function forPieces(line: PixelLine, closed: boolean, on: (ax: number, ay: number, bx: number, by: number) => void): void {
  const n = line.x.length;
  for (let k = closed ? 0 : 1; k < n; ++k) {
    const before = k > 0 ? k - 1 : n - 1;
    on(line.x[before] ?? 0, line.y[before] ?? 0, line.x[k] ?? 0, line.y[k] ?? 0);
  }
}

function areaOf(line: PixelLine): number {
  let sum = 0;
  forPieces(line, true, (ax, ay, bx, by) => (sum += ax * by - bx * ay));
  return Math.abs(sum) / 2;
}

/** Whether a place lies inside; lines that end at the edge of the field are closed straight. */
export function holds(lines: PixelLine[], x: number, y: number): boolean {
  let inside = false;
  for (const line of lines)
    forPieces(line, true, (ax, ay, bx, by) => {
      if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
    });
  return inside;
}

/** Distance from the outlines in parts of half the name: from about 1 on it stands free of them. */
function clearance(body: NamedBody, x: number, y: number): number {
  const [sx, sy] = [2 / body.width, 2 / body.height];
  let least = Infinity;
  for (const line of body.lines)
    forPieces(line, line.closed, (ax, ay, bx, by) => {
      const [px, py] = [(x - ax) * sx, (y - ay) * sy];
      const [dx, dy] = [(bx - ax) * sx, (by - ay) * sy];
      const size = dx * dx + dy * dy;
      const t = size > 0 ? Math.min(1, Math.max(0, (px * dx + py * dy) / size)) : 0;
      least = Math.min(least, (px - t * dx) ** 2 + (py - t * dy) ** 2);
    });
  return Math.sqrt(least);
}

function boxAt(body: NamedBody, x: number, y: number): Box {
  return { left: x - body.width / 2 - GAP, top: y - body.height / 2, width: body.width + 2 * GAP, height: body.height };
}

function apart(a: Box, b: Box): boolean {
  return (
    a.left + a.width <= b.left || b.left + b.width <= a.left || a.top + a.height <= b.top || b.top + b.height <= a.top
  );
}

/** The best place inside the largest part of a body that is seen and that a condition allows. */
function insidePlace(body: NamedBody, seen: Box, allowed: (x: number, y: number) => boolean): [number, number] | null {
  const largest = body.lines.reduce<PixelLine | null>((a, b) => (a && areaOf(a) >= areaOf(b) ? a : b), null);
  if (!largest) return null;
  const left = Math.max(Math.min(...largest.x), seen.left);
  const right = Math.min(Math.max(...largest.x), seen.left + seen.width);
  const top = Math.max(Math.min(...largest.y), seen.top);
  const bottom = Math.min(Math.max(...largest.y), seen.top + seen.height);
  let best: [number, number] | null = null;
  let most = -Infinity;
  for (let k = 0; k < ALONG * ALONG; ++k) {
    const [u, v] = [((k % ALONG) + 0.5) / ALONG, (Math.floor(k / ALONG) + 0.5) / ALONG];
    const [x, y] = [left + u * (right - left), top + v * (bottom - top)];
    if (right <= left || bottom <= top || !allowed(x, y) || !holds(body.lines, x, y)) continue;
    const off = Math.hypot(u - 0.5, v - 0.5); // where there is room in many places: in the middle
    const worth = Math.min(3, clearance(body, x, y)) - 0.1 * off;
    if (worth > most) [most, best] = [worth, [x, y]];
  }
  return best;
}

/** The nearest place for a name beside a point that touches no name placed before. */
function placeBeside(body: NamedBody, at: [number, number], free: (x: number, y: number) => boolean): [number, number] {
  const ways = [[0, -1], [0, 1], [1, 0], [-1, 0], [1, -1], [-1, -1], [1, 1], [-1, 1]] as const; // prettier-ignore
  for (let far = 1; far < 8; ++far)
    for (const [wx, wy] of ways) {
      const x = at[0] + wx * (body.width / 2 + GAP + far * body.height * 0.5);
      const y = at[1] + wy * (far * body.height + GAP);
      if (free(x, y)) return [x, y];
    }
  return at;
}

/** Places the names of bodies that are seen within a box; those of the first have the choice. */
export function placedNames(bodies: NamedBody[], seen: Box): PlacedName[] {
  const taken: Box[] = [];
  const placed: PlacedName[] = [];
  for (const body of bodies) {
    const fits = (box: Box) =>
      box.left >= seen.left &&
      box.top >= seen.top &&
      box.left + box.width <= seen.left + seen.width &&
      box.top + box.height <= seen.top + seen.height;
    const free = (x: number, y: number) => {
      const box = boxAt(body, x, y);
      return fits(box) && taken.every((other) => apart(box, other));
    };
    let inside = insidePlace(body, seen, free);
    let [x, y] = inside ?? [0, 0];
    if (!inside) {
      inside = insidePlace(body, seen, () => true);
      if (!inside) continue;
      [x, y] = placeBeside(body, inside, free);
    }
    taken.push(boxAt(body, x, y));
    placed.push({ name: body.name, x, y, inside });
  }
  return placed;
}
