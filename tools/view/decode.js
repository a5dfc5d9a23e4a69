// The page's data: base64 of little-endian bytes, whole numbers in groups of seven bits, signed ones folded (0 -1 1 ..).
'use strict';

class Bytes {
  constructor(text) {
    const raw = atob(text.trim());
    this.data = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) this.data[i] = raw.charCodeAt(i);
    this.view = new DataView(this.data.buffer);
    this.at = 0;
  }
  get done() { return this.at >= this.data.length; }
  whole() {
    let value = 0, shift = 0, byte;
    do {
      byte = this.data[this.at++];
      value |= (byte & 127) << shift;
      shift += 7;
    } while (byte > 127);
    return value >>> 0;
  }
  signed() {
    const folded = this.whole();
    return folded & 1 ? -((folded + 1) / 2) : folded / 2;
  }
  real() {
    const value = this.view.getFloat32(this.at, true);
    this.at += 4;
    return value;
  }
}

function embedded(id) {
  const element = document.getElementById(id);
  const text = element ? element.textContent : '';
  if (element) element.remove();
  return text.trim() ? new Bytes(text) : null;
}

// Positions are steps of a grid; the page works in [-1, 1] around its middle.
class Grid {
  constructor(frame) {
    this.half = frame.size.map(s => s / 2);
    this.scale = 2 / Math.max(...frame.size);
    this.last = [0, 0, 0];
  }
  start() { this.last = [0, 0, 0]; }
  next(bytes, out, at) {
    for (let i = 0; i < 3; ++i) {
      this.last[i] += bytes.signed();
      out[at + i] = (this.last[i] - this.half[i]) * this.scale;
    }
  }
}

// Faces come patch by patch; a corner is told by how many vertices ago it was new, 0 is the next new one.
function readSurface(bytes, grid) {
  const vertices = bytes.whole(), faces = bytes.whole(), patches = bytes.whole();
  const patchStart = new Uint32Array(patches + 1);
  for (let p = 0; p < patches; ++p) patchStart[p + 1] = patchStart[p] + bytes.whole();
  const corner = new Uint32Array(3 * faces);
  for (let c = 0, known = 0; c < corner.length; ++c) {
    const back = bytes.whole();
    corner[c] = back === 0 ? known++ : known - back;
  }
  const position = new Float32Array(3 * vertices);
  grid.start();
  for (let v = 0; v < vertices; ++v) grid.next(bytes, position, 3 * v);
  return { vertices, faces, patches, patchStart, corner, position };
}

// Polylines as segments: start and end of each, its line, and for each line its kind and measures.
function readLines(bytes, grid, measured) {
  const count = bytes.whole(), total = bytes.whole();
  const segments = total - count;
  const ends = new Float32Array(6 * segments), line = new Uint32Array(segments), kind = new Uint8Array(count);
  const measure = measured ? [0, 1, 2].map(() => new Float32Array(count)) : null;
  const point = new Float32Array(3);
  let s = 0;
  grid.start();
  for (let l = 0; l < count; ++l) {
    kind[l] = bytes.whole();
    const points = bytes.whole();
    if (measured) for (const m of measure) m[l] = bytes.real();
    for (let i = 0; i < points; ++i) {
      grid.next(bytes, point, 0);
      if (i > 0) {
        ends.set(point, 6 * s + 3);
        line[s++] = l;
      }
      if (i + 1 < points) ends.set(point, 6 * s);
    }
  }
  return { count, segments, ends, line, kind, measure };
}

// Vertices split so that each belongs to one patch; normals smooth inside a patch and across borders that do not bend;
// `cavity` is above 0 in hollows and below on crests.
function shadedSurface(surface) {
  const { vertices, faces, patches, patchStart, corner, position } = surface;
  const faceNormal = new Float32Array(3 * faces), whole = new Float32Array(3 * vertices);
  for (let f = 0; f < faces; ++f) {
    const a = 3 * corner[3 * f], b = 3 * corner[3 * f + 1], c = 3 * corner[3 * f + 2];
    const ux = position[b] - position[a], uy = position[b + 1] - position[a + 1], uz = position[b + 2] - position[a + 2];
    const vx = position[c] - position[a], vy = position[c + 1] - position[a + 1], vz = position[c + 2] - position[a + 2];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (let k = 0; k < 3; ++k) {
      faceNormal[3 * f + k] = n[k];
      whole[a + k] += n[k], whole[b + k] += n[k], whole[c + k] += n[k];
    }
  }
  const number = new Int32Array(vertices).fill(-1), touched = [];
  const source = [], index = new Uint32Array(corner.length), patchOf = [];
  const normal = [];
  for (let p = 0; p < patches; ++p) {
    touched.length = 0;
    for (let c = 3 * patchStart[p]; c < 3 * patchStart[p + 1]; ++c) {
      const v = corner[c], f = (c / 3) | 0;
      if (number[v] < 0) {
        number[v] = source.length;
        source.push(v), patchOf.push(p), normal.push(0, 0, 0), touched.push(v);
      }
      const i = number[v];
      index[c] = i;
      for (let k = 0; k < 3; ++k) normal[3 * i + k] += faceNormal[3 * f + k];
    }
    for (const v of touched) number[v] = -1;
  }
  const count = source.length;
  const out = { count, index, source: Uint32Array.from(source), patch: Float32Array.from(patchOf),
                position: new Float32Array(3 * count), normal: new Int8Array(4 * count) };
  const cavity = cavityOf(surface, whole);
  for (let i = 0; i < count; ++i) {
    const v = 3 * source[i], n = 3 * i;
    const own = Math.hypot(normal[n], normal[n + 1], normal[n + 2]) || 1;
    const all = Math.hypot(whole[v], whole[v + 1], whole[v + 2]) || 1;
    let dot = 0;
    for (let k = 0; k < 3; ++k) dot += normal[n + k] / own * whole[v + k] / all;
    for (let k = 0; k < 3; ++k) {
      out.position[n + k] = position[v + k];
      out.normal[4 * i + k] = Math.round(127 * (dot > 0.9 ? whole[v + k] / all : normal[n + k] / own));
    }
    out.normal[4 * i + 3] = Math.round(127 * cavity[source[i]]);
  }
  return out;
}

// How far a vertex lies below the mean of its neighbours, in mean edge lengths, smoothed and squeezed into -1 .. 1.
function cavityOf(surface, whole) {
  const { vertices, corner, position } = surface;
  let value = new Float32Array(vertices), weight = new Float32Array(vertices);
  for (let c = 0; c < corner.length; ++c) {
    const f = c - c % 3, a = corner[c], b = corner[f + (c + 1) % 3];
    const dx = position[3 * b] - position[3 * a], dy = position[3 * b + 1] - position[3 * a + 1],
          dz = position[3 * b + 2] - position[3 * a + 2];
    const long = Math.hypot(dx, dy, dz) || 1;
    const na = Math.hypot(whole[3 * a], whole[3 * a + 1], whole[3 * a + 2]) || 1;
    const nb = Math.hypot(whole[3 * b], whole[3 * b + 1], whole[3 * b + 2]) || 1;
    value[a] += (dx * whole[3 * a] + dy * whole[3 * a + 1] + dz * whole[3 * a + 2]) / (long * na);
    value[b] -= (dx * whole[3 * b] + dy * whole[3 * b + 1] + dz * whole[3 * b + 2]) / (long * nb);
    ++weight[a], ++weight[b];
  }
  for (let v = 0; v < vertices; ++v) value[v] /= weight[v] || 1;
  for (let round = 0; round < 2; ++round) {
    const sum = new Float32Array(vertices);
    for (let c = 0; c < corner.length; ++c) sum[corner[c]] += value[corner[c - c % 3 + (c + 1) % 3]];
    for (let v = 0; v < vertices; ++v) value[v] = (value[v] + 2 * sum[v] / (weight[v] || 1)) / 2;
  }
  for (let v = 0; v < vertices; ++v) value[v] = Math.tanh(6 * value[v]);
  return value;
}
