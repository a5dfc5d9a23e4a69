// Looking around: a turntable about the model's vertical, with glide; small matrices, column by column.
'use strict';

const Vec = {
  add: (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]],
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  unit: a => { const n = Math.hypot(...a) || 1; return [a[0] / n, a[1] / n, a[2] / n]; },
};

class Camera {
  constructor(view) {
    this.up = Vec.unit(view.up);
    const toward = Vec.unit(view.toward);
    const across = Math.abs(Vec.dot(this.up, [0, 0, 1])) < 0.9 ? [0, 0, 1] : [1, 0, 0];
    this.east = Vec.unit(Vec.cross(across, this.up));
    this.north = Vec.cross(this.up, this.east);
    this.home = {
      azimuth: Math.atan2(Vec.dot(toward, this.north), Vec.dot(toward, this.east)),
      elevation: Math.asin(Math.max(-1, Math.min(1, Vec.dot(toward, this.up)))),
      target: [0, 0, 0], distance: 4,
    };
    this.reach = 1.8;
    this.now = { ...this.home };
    this.goal = { ...this.home };
    this.shift = [0, 0];
  }
  // Chooses the distance at which a ball around the origin fills the part of the picture that no panel covers.
  // free: its middle and half its size, in -1 .. 1 of the picture.
  fit(radius, aspect, free, first) {
    this.reach = radius;
    this.free = free.middle;
    const room = Math.min(free.half[1], free.half[0] * aspect);
    const distance = radius / Math.sin(Camera.angle / 2) / room * 0.86;
    this.goal.distance *= distance / this.home.distance;
    this.home.distance = distance;
    if (first) this.now.distance = this.goal.distance = distance, this.shift = [...this.free];
  }
  turn(dx, dy) {
    this.goal.azimuth -= dx;
    this.goal.elevation = Math.max(-1.55, Math.min(1.55, this.goal.elevation + dy));
  }
  pan(dx, dy) {
    const { right, above } = this.axes();
    const s = 2 * Math.tan(Camera.angle / 2) * this.now.distance;
    this.goal.target = Vec.add(Vec.add(this.goal.target, right, -dx * s), above, dy * s);
  }
  // Towards the point of the picture at (x, y), both in -1 .. 1.
  zoom(factor, x, y, aspect) {
    const next = Math.max(0.02 * this.reach, Math.min(30 * this.reach, this.goal.distance * factor));
    const { right, above } = this.axes(), s = Math.tan(Camera.angle / 2) * (this.goal.distance - next);
    x -= this.shift[0], y -= this.shift[1];
    this.goal.target = Vec.add(Vec.add(this.goal.target, right, x * aspect * s), above, y * s);
    this.goal.distance = next;
  }
  flyTo(target, radius) {
    this.goal.target = target;
    this.goal.distance = Math.max(0.05, radius / Math.sin(Camera.angle / 2) * 1.3);
  }
  reset() { this.goal = { ...this.home, azimuth: this.home.azimuth + this.turns() }; }
  turns() { return 2 * Math.PI * Math.round((this.goal.azimuth - this.home.azimuth) / (2 * Math.PI)); }
  // Comes closer to the goal; true while it moves.
  step(seconds) {
    const share = 1 - Math.exp(-14 * seconds);
    let moved = 0;
    for (const key of ['azimuth', 'elevation', 'distance']) {
      const d = this.goal[key] - this.now[key];
      this.now[key] += share * d;
      moved = Math.max(moved, Math.abs(d) / (key === 'distance' ? this.now.distance : 1));
    }
    for (let i = 0; i < 2; ++i) {
      const d = this.free[i] - this.shift[i];
      this.shift[i] += share * d;
      moved = Math.max(moved, Math.abs(d));
    }
    const d = Vec.add(this.goal.target, this.now.target, -1);
    this.now.target = Vec.add(this.now.target, d, share);
    moved = Math.max(moved, Math.hypot(...d) / this.now.distance);
    if (moved > 1e-4) return true;
    this.now = { ...this.goal };
    this.shift = [...this.free];
    return false;
  }
  toward() {
    const { azimuth, elevation } = this.now, c = Math.cos(elevation);
    return Vec.add(Vec.add([0, 0, 0].map((_, i) => this.east[i] * c * Math.cos(azimuth)), this.north, c * Math.sin(azimuth)),
                   this.up, Math.sin(elevation));
  }
  axes() {
    const toward = this.toward(), right = Vec.unit(Vec.cross(this.up, toward));
    return { toward, right, above: Vec.cross(toward, right) };
  }
  // View and projection; window: a part of the picture, [left, bottom, right, top] in -1 .. 1.
  matrices(aspect, window = [-1, -1, 1, 1]) {
    const { toward, right, above } = this.axes();
    const eye = Vec.add(this.now.target, toward, this.now.distance);
    const view = new Float32Array([right[0], above[0], toward[0], 0, right[1], above[1], toward[1], 0,
                                   right[2], above[2], toward[2], 0,
                                   -Vec.dot(right, eye), -Vec.dot(above, eye), -Vec.dot(toward, eye), 1]);
    const middle = Vec.dot(toward, eye);
    const near = Math.max(this.now.distance * 0.005, middle - this.reach * 1.05), far = Math.max(near * 1.01, middle + this.reach * 1.05);
    const t = near * Math.tan(Camera.angle / 2), [x, y] = this.shift;
    const l = (window[0] - x) * t * aspect, r = (window[2] - x) * t * aspect;
    const b = (window[1] - y) * t, u = (window[3] - y) * t;
    const projection = new Float32Array([2 * near / (r - l), 0, 0, 0, 0, 2 * near / (u - b), 0, 0, (r + l) / (r - l),
                                         (u + b) / (u - b), -(far + near) / (far - near), -1,
                                         0, 0, -2 * far * near / (far - near), 0]);
    return { view, projection, near, far };
  }
}
Camera.angle = 30 * Math.PI / 180;
