// The table of patches and the histograms of the raw lines' measures.
'use strict';

const byId = id => document.getElementById(id);
function make(tag, properties = {}, ...children) {
  const e = Object.assign(document.createElement(tag), properties);
  e.append(...children);
  return e;
}
function figure(value, digits = 3) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(2);
  return value.toLocaleString('en', { maximumSignificantDigits: Math.max(digits, size >= 1000 ? 7 : digits), maximumFractionDigits: size >= 1000 ? 0 : 6 });
}
const css = colour => `rgb(${colour[0]},${colour[1]},${colour[2]})`;

const kRow = 26;

class PatchTable {
  // on: { hover(patch), select(patch), fly(patch) }
  constructor(meta, on) {
    this.meta = meta, this.on = on;
    const p = meta.patches, total = p.area.reduce((a, b) => a + b, 0) || 1;
    this.columns = [
      { title: 'patch', value: i => i, up: true },
      { title: 'triangles', value: i => p.triangles[i], text: i => p.triangles[i].toLocaleString('en') },
      { title: 'area %', value: i => p.area[i], text: i => (100 * p.area[i] / total).toFixed(2) },
      { title: 'sides', value: i => p.sides[i], text: i => p.sides[i] },
      { title: 'flatness', value: i => p.flatness[i], text: i => p.flatness[i].toFixed(3) },
    ];
    this.order = p.area.map((_, i) => i);
    this.by = 0, this.up = true, this.hovered = -1, this.selected = -1;
    this.columns.forEach((c, k) => byId('head').append(make('button', { textContent: c.title, onclick: () => this.sort(k) })));
    const rows = byId('rows');
    rows.addEventListener('scroll', () => this.fill());
    rows.addEventListener('mouseleave', () => on.hover(-1));
    rows.addEventListener('keydown', e => this.key(e));
    new ResizeObserver(() => this.fill()).observe(rows);
    byId('space').style.height = kRow * this.order.length + 'px';
    this.mark();
  }
  sort(k) {
    this.up = this.by === k ? !this.up : !!this.columns[k].up;
    this.by = k;
    const value = this.columns[k].value, sign = this.up ? 1 : -1;
    this.order.sort((a, b) => sign * (value(a) - value(b)) || a - b);
    this.mark();
    byId('rows').scrollTop = 0;
    this.fill();
  }
  mark() {
    [...byId('head').children].forEach((b, k) => {
      b.classList.toggle('by', k === this.by);
      b.textContent = this.columns[k].title + (k === this.by ? (this.up ? ' \u2191' : ' \u2193') : '');
    });
  }
  fill() {
    const rows = byId('rows'), first = Math.max(0, Math.floor(rows.scrollTop / kRow) - 4);
    const last = Math.min(this.order.length, Math.ceil((rows.scrollTop + rows.clientHeight) / kRow) + 4);
    byId('space').replaceChildren(...this.order.slice(first, last).map((p, i) => this.row(p, first + i)));
  }
  row(p, at) {
    const row = make('div', { className: 'row', onmouseenter: () => this.on.hover(p), onclick: () => this.on.select(p),
                              ondblclick: () => this.on.fly(p) });
    row.style.top = at * kRow + 'px';
    row.dataset.patch = p;
    const swatch = make('i', { className: 'swatch' });
    swatch.style.background = css(this.meta.colours[p]);
    row.append(make('span', {}, swatch, String(p)));
    for (const c of this.columns.slice(1)) row.append(make('span', { textContent: c.text(p) }));
    row.classList.toggle('hover', p === this.hovered);
    row.classList.toggle('selected', p === this.selected);
    return row;
  }
  key(e) {
    const step = { ArrowDown: 1, ArrowUp: -1 }[e.key];
    if (!step) return;
    const at = this.order.indexOf(this.selected) + step;
    if (at >= 0 && at < this.order.length) this.on.select(this.order[at]);
    e.preventDefault();
    e.stopPropagation();
  }
  show(hovered, selected, scroll) {
    const changed = selected !== this.selected;
    this.hovered = hovered, this.selected = selected;
    if (changed) this.detail(selected);  // first: it takes room from the rows
    if (scroll && selected >= 0 && changed) {
      const rows = byId('rows'), y = this.order.indexOf(selected) * kRow;
      if (y < rows.scrollTop || y > rows.scrollTop + rows.clientHeight - kRow) {
        rows.scrollTop = y - rows.clientHeight / 2;
        this.fill();
      }
    }
    for (const row of byId('space').children) {
      row.classList.toggle('hover', +row.dataset.patch === hovered);
      row.classList.toggle('selected', +row.dataset.patch === selected);
    }
  }
  detail(p) {
    const box = byId('detail'), of = this.meta.patches;
    box.hidden = p < 0;
    if (p < 0) return;
    const chip = q => {
      const i = make('i', { className: 'swatch' });
      i.style.background = css(this.meta.colours[q]);
      return i;
    };
    const facts = [['area', figure(of.area[p], 4)], ['perimeter', figure(of.perimeter[p], 4)],
                   ['perimeter\u00b2 / 4\u03c0 area', figure(of.compactness[p])], ['border loops', of.loops[p]]];
    if (this.meta.deviation) facts.push(['RMS distance', figure(this.meta.deviation.patch_rms[p]) + ' %']);
    box.replaceChildren(
      make('h2', {}, chip(p), `Patch ${p}`, make('button', { textContent: 'esc', title: 'select nothing', onclick: () => this.on.select(-1) })),
      make('dl', {}, ...facts.flatMap(([name, value]) => [make('dt', { textContent: name }), make('dd', { textContent: value })])),
      make('div', { className: 'links' }, ...of.neighbours[p].map(q => make('button', {
        title: `neighbour ${q}`, onclick: () => this.on.select(q), onmouseenter: () => this.on.hover(q), onmouseleave: () => this.on.hover(-1),
      }, chip(q), String(q)))));
  }
}

const kBins = 44;

class Histogram {
  // values of all lines; on() after a change of `least`.
  constructor(letter, name, values, on) {
    this.values = values, this.on = on, this.least = -1e30;
    let low = Infinity, high = 0;
    for (const v of values) if (v > 0) low = Math.min(low, v), high = Math.max(high, v);
    if (!(high > 0)) low = high = 1;
    this.low = Math.log10(Math.max(low, high * 1e-5)), this.high = Math.max(this.low + 0.1, Math.log10(high) + 1e-6);
    this.bin = Uint8Array.from(values, v => Math.max(0, Math.min(kBins - 1, Math.floor(this.place(v) * kBins))));
    this.number = make('span');
    this.canvas = make('canvas');
    this.input = make('input', { type: 'range', min: 0, max: 1000, value: 0, title: `least ${name}` });
    this.input.setAttribute('aria-label', `least ${name}`);
    this.input.addEventListener('input', () => this.set(this.input.value / 1000));
    const drag = e => { if (e.buttons & 1) this.set((e.offsetX) / this.canvas.clientWidth); };
    this.canvas.addEventListener('pointerdown', e => { this.canvas.setPointerCapture(e.pointerId); drag(e); });
    this.canvas.addEventListener('pointermove', drag);
    this.element = make('div', { className: 'histogram' },
                        make('label', {}, make('span', {}, make('b', { textContent: letter }), ` ${name}`), this.number), this.canvas, this.input);
  }
  place(v) { return v > 0 ? (Math.log10(v) - this.low) / (this.high - this.low) : 0; }
  set(share) {
    share = Math.max(0, Math.min(1, share));
    this.input.value = Math.round(1000 * share);
    this.least = share === 0 ? -1e30 : 10 ** (this.low + share * (this.high - this.low));
    this.on();
  }
  // kept: per line
  draw(kept) {
    const ratio = Math.min(2, devicePixelRatio || 1), w = this.canvas.clientWidth, h = this.canvas.clientHeight;
    if (!w) return;
    this.canvas.width = w * ratio, this.canvas.height = h * ratio;
    const all = new Uint32Array(kBins), some = new Uint32Array(kBins);
    for (let i = 0; i < this.bin.length; ++i) ++all[this.bin[i]], some[this.bin[i]] += kept[i];
    const most = Math.max(1, ...all), c = this.canvas.getContext('2d'), style = getComputedStyle(document.documentElement);
    c.scale(ratio, ratio);
    const bar = (k, n, colour) => {
      if (!n) return;
      const y = Math.max(1.5, Math.sqrt(n / most) * (h - 3));
      c.fillStyle = colour;
      c.beginPath();
      c.roundRect(k * w / kBins + 0.5, h - y, w / kBins - 1, y, [1.5, 1.5, 0, 0]);
      c.fill();
    };
    for (let k = 0; k < kBins; ++k) {
      c.globalAlpha = 0.5;
      bar(k, all[k], style.getPropertyValue('--faint'));
      c.globalAlpha = 1;
      bar(k, some[k], style.getPropertyValue('--accent'));
    }
    if (this.least > 0) {
      c.fillStyle = style.getPropertyValue('--ink');
      c.fillRect(this.place(this.least) * w - 0.75, 0, 1.5, h);
    }
    this.number.textContent = this.least > 0 ? '\u2265 ' + figure(this.least) : 'all';
  }
}
