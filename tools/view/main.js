// Puts the page together: stages, what is drawn in each, pointer and keys.
'use strict';

function start() {
  const meta = JSON.parse(byId('meta').textContent);
  const grid = new Grid(meta.frame);
  const raw = readSurface(embedded('surface-data'), grid);
  const surface = shadedSurface(raw);
  const featureBytes = embedded('features-data'), arcBytes = embedded('arcs-data'), deviationBytes = embedded('deviation-data');
  const lines = {};
  if (featureBytes) {
    lines.raw = readLines(featureBytes, grid, true);
    lines.chosen = readLines(featureBytes, grid, false);
    lines.network = readLines(featureBytes, grid, false);
  }
  lines.arcs = readLines(arcBytes, grid, false);
  let deviation = null;
  if (deviationBytes) {
    deviation = new Float32Array(surface.count);
    for (let i = 0; i < surface.count; ++i) deviation[i] = deviationBytes.data[surface.source[i]] / 255;
  }

  const scene = new Scene(byId('canvas'));
  scene.setSurface(surface, !lines.arcs.kind.includes(3), meta.colours, deviation, meta.deviation ? meta.deviation.ramp : [[90, 120, 200], [230, 90, 60]]);
  const sets = {};
  for (const [name, of] of Object.entries(lines)) sets[name] = scene.lineSet(of);

  let radius = 0;
  for (let i = 0; i < raw.position.length; i += 3) radius = Math.max(radius, Math.hypot(raw.position[i], raw.position[i + 1], raw.position[i + 2]));
  const camera = new Camera(meta.view);
  function fit(first) {
    const width = innerWidth, height = innerHeight, wide = width > 900;
    const left = wide && !byId('filter').hidden ? 316 : 0, right = wide ? 358 : 0, bottom = wide ? 118 : 0.28 * height + 130, top = wide ? 30 : 80;
    camera.fit(radius, width / height, {
      middle: [(left - right) / width, (bottom - top) / height],
      half: [1 - (left + right) / width, 1 - (bottom + top) / height],
    }, first);
  }
  fit(true);

  const count = (n, one, many) => `${n.toLocaleString('en')} ${n === 1 ? one : many}`;
  const stages = [{ key: 'input', title: 'Input', caption: `${count(meta.triangles, 'triangle', 'triangles')}, ${count(meta.vertices, 'vertex', 'vertices')}` }];
  if (featureBytes) {
    stages.push({ key: 'raw', title: 'Raw curves', line: 'raw', caption: '' });
    stages.push({ key: 'filtered', title: 'Filtered', line: 'chosen', caption: count(lines.chosen.count, 'curve stands out', 'curves stand out') });
    stages.push({ key: 'network', title: 'Network', line: 'network', caption: 'filtered curves, extended until every region is closed' });
  }
  stages.push({ key: 'patches', title: 'Patches', line: 'arcs', tint: 1,
                caption: `${count(meta.colours.length, 'patch', 'patches')}, ${count(lines.arcs.count, 'arc', 'arcs')}` });
  if (deviation) stages.push({ key: 'deviation', title: 'Deviation', line: 'arcs', heat: 1, caption: meta.deviation.caption });

  const state = { stage: stages.findIndex(s => s.key === 'patches'), hover: -1, selected: -1, kinds: false, tint: 1, heat: 0,
                  alpha: Object.fromEntries(Object.keys(sets).map(k => [k, 0])) };
  state.alpha.arcs = 1;
  let wanted = false, last = 0, slow = 0;
  const request = () => {
    if (!wanted) wanted = true, requestAnimationFrame(frame);
  };
  const dark = () => document.documentElement.classList.contains('dark');

  // Colours of lines: their kinds, or one dark line where patches show.
  function styleOf(set) {
    const lift = dark() && set !== 'arcs';
    return meta.kinds.map(k => {
      const c = set === 'arcs' && !state.kinds ? (dark() ? [18, 20, 26] : [44, 44, 50]) : k.colour;
      const up = lift ? c.map(x => x + (255 - x) * (k.name === 'extension' || k.name === 'subdivision' ? 0.72 : 0.34)) : c;
      return [...up, (set === 'arcs' && !state.kinds ? 1.9 : k.width * (set === 'raw' ? 0.8 : 1.05))];
    });
  }
  function frame(time) {
    wanted = false;
    const seconds = Math.min(0.5, last ? (time - last) / 1000 : 0.016);
    slow = last ? 0.5 * slow + 0.5 * (time - last) : slow;  // milliseconds a frame
    last = time;
    const stage = stages[state.stage], share = 1 - Math.exp(-11 * seconds);
    let moving = camera.step(seconds);
    const towards = (now, goal) => {
      if (Math.abs(goal - now) < 0.004) return goal;
      moving = true;
      return now + share * (goal - now);
    };
    state.tint = towards(state.tint, stage.tint || 0);
    state.heat = towards(state.heat, stage.heat || 0);
    for (const name of Object.keys(sets)) state.alpha[name] = towards(state.alpha[name], stage.line === name ? 1 : 0);
    scene.draw(camera, { clay: dark() ? [0.60, 0.62, 0.66] : [0.83, 0.835, 0.85], tint: state.tint, heat: state.heat,
                         hover: state.hover, selected: state.selected, dark: dark() ? 1 : 0 },
               Object.keys(sets).map(name => ({ set: sets[name], alpha: state.alpha[name], style: styleOf(name),
                                                least: name === 'raw' ? histograms.map(h => h.least) : null })));
    if (moving || scene.quality < 1) request();
    else last = 0;
    scene.quality = !moving || slow < 60 ? 1 : slow < 160 ? 0.6 : 0.4;
    if (!window.firstPicture) requestAnimationFrame(() => { window.firstPicture = performance.now(); });
  }

  const table = new PatchTable(meta, {
    hover: p => setPatch(p, state.selected),
    select: p => setPatch(state.hover, p === state.selected ? -1 : p),
    fly: p => { setPatch(state.hover, p); flyTo(p); },
  });
  function setPatch(hover, selected, scroll) {
    if (hover === state.hover && selected === state.selected) return;
    state.hover = hover, state.selected = selected;
    table.show(hover, selected, scroll);
    request();
  }
  function flyTo(p) {
    const low = [9, 9, 9], high = [-9, -9, -9];
    for (let c = 3 * raw.patchStart[p]; c < 3 * raw.patchStart[p + 1]; ++c)
      for (let k = 0; k < 3; ++k) {
        const x = raw.position[3 * raw.corner[c] + k];
        low[k] = Math.min(low[k], x), high[k] = Math.max(high[k], x);
      }
    camera.flyTo(low.map((x, k) => (x + high[k]) / 2), Math.hypot(...low.map((x, k) => high[k] - x)) / 2);
    request();
  }

  // Thresholds of the raw lines.
  const histograms = [];
  function refilter() {
    const m = lines.raw.measure, n = lines.raw.count, kept = new Uint8Array(n);
    let some = 0, length = 0, all = 0;
    for (let i = 0; i < n; ++i) {
      kept[i] = histograms.every((h, k) => m[k][i] >= h.least) ? 1 : 0;
      some += kept[i], length += kept[i] * m[0][i], all += m[0][i];
    }
    for (const h of histograms) h.draw(kept);
    byId('kept').textContent = `${some.toLocaleString('en')} of ${count(n, 'line', 'lines')}, ${(100 * length / (all || 1)).toFixed(0)} % of their length`;
    const flags = ['--length', '--curvature', '--strength'].map((f, k) => histograms[k].least > 0 ? ` ${f} ${+histograms[k].least.toPrecision(3)}` : '').join('');
    byId('flags').textContent = '--mode paper' + flags;
    stages.find(s => s.key === 'raw').caption = count(some, 'line', 'lines');
    if (stages[state.stage].key === 'raw') byId('caption').textContent = count(some, 'line', 'lines');
    request();
  }
  if (lines.raw) {
    [['L', 'length'], ['R', 'RMS curvature'], ['T', 'strength']].forEach(([letter, name], k) => {
      histograms.push(new Histogram(letter, name, lines.raw.measure[k], refilter));
      byId('histograms').append(histograms[k].element);
    });
  }

  function legend(stage) {
    const box = byId('legend');
    box.replaceChildren();
    if (stage.heat) {
      const bar = make('div', { className: 'ramp' }), d = meta.deviation;
      bar.style.background = `linear-gradient(to right, ${d.ramp.map(css).join(',')})`;
      box.append(d.label, bar, make('div', { className: 'ends' }, make('span', { textContent: '0' }), make('span', { textContent: figure(d.top) })));
      return;
    }
    if (!stage.line || (stage.line === 'arcs' && !state.kinds)) return;
    const seen = new Set(lines[stage.line].kind), style = styleOf(stage.line);
    meta.kinds.forEach((k, i) => {
      if (!seen.has(i)) return;
      const dash = make('i');
      dash.style.cssText = `height:${Math.max(2, style[i][3])}px;background:${css(style[i].map(Math.round))}`;
      box.append(make('div', {}, dash, k.name));
    });
  }
  function setStage(i) {
    state.stage = Math.max(0, Math.min(stages.length - 1, i));
    const stage = stages[state.stage];
    [...byId('stages').children].forEach((b, k) => b.setAttribute('aria-checked', k === state.stage));
    byId('slider').value = state.stage;
    byId('caption').textContent = stage.caption;
    byId('filter').hidden = stage.key !== 'raw';
    fit();
    byId('kinds').style.visibility = stage.line === 'arcs' ? 'visible' : 'hidden';
    if (stage.key === 'raw') refilter();
    legend(stage);
    request();
  }
  function toggle(what) {
    if (what === 'theme') {
      document.documentElement.classList.toggle('dark');
      if (!byId('filter').hidden) refilter();
    } else {
      state.kinds = !state.kinds;
      byId('kinds').classList.toggle('on', state.kinds);
    }
    legend(stages[state.stage]);
    request();
  }

  // The view for intarsia render.
  function copyCamera() {
    const { toward, above } = camera.axes();
    const text = '--camera ' + [...toward, ...above].map(x => x.toFixed(4)).join(',');
    const done = byId('caption');
    done.textContent = text;
    if (navigator.clipboard) navigator.clipboard.writeText(text).then(() => { done.textContent = 'copied: ' + text; }, () => {});
  }

  byId('name').textContent = meta.name;
  byId('counts').textContent = [count(meta.triangles, 'triangle', 'triangles'), count(meta.colours.length, 'patch', 'patches'),
                                `diagonal ${figure(meta.diagonal, 4)}`].join(' \u00b7 ') + (meta.coarse ? ' \u00b7 shown coarser' : '');
  stages.forEach((s, i) => {
    const b = make('button', { textContent: s.title, onclick: () => setStage(i) });
    b.setAttribute('role', 'radio');
    byId('stages').append(b);
  });
  byId('slider').max = stages.length - 1;
  byId('slider').addEventListener('input', e => setStage(+e.target.value));
  byId('theme').onclick = () => toggle('theme');
  byId('kinds').onclick = () => toggle('kinds');
  byId('reset').onclick = () => { camera.reset(); request(); };

  listen(byId('canvas'), { camera, scene, request, pick: (x, y) => scene.pick(camera, x, y), name: p => `patch ${p}`,
                           hover: p => setPatch(p, state.selected), select: p => setPatch(p, p === state.selected ? -1 : p, true), fly: flyTo });
  window.addEventListener('resize', () => { fit(); request(); });
  window.addEventListener('keydown', e => {
    if (e.ctrlKey || e.metaKey || e.altKey || e.target.tagName === 'INPUT') return;
    const act = { ArrowRight: () => setStage(state.stage + 1), ArrowLeft: () => setStage(state.stage - 1), r: () => byId('reset').click(),
                  d: () => toggle('theme'), k: () => toggle('kinds'), c: copyCamera, Escape: () => setPatch(-1, -1) }[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (act) act(), e.preventDefault();
  });
  setStage(state.stage);
  table.fill();
  window.intarsia = { camera, scene, state, stages, setStage, meta, lines };
}

// Pointers on the canvas: one turns, with shift or the right button moves, two pinch; a click selects.
function listen(canvas, on) {
  const active = new Map();
  let moved = 0, pending = null, lastClick = 0;
  const tip = byId('tip');
  const aspect = () => canvas.clientWidth / canvas.clientHeight;
  function look(x, y) {
    if (pending === null) requestAnimationFrame(() => {
      const [px, py] = pending;
      pending = null;
      if (active.size > 0) return;
      const p = on.pick(px, py);
      on.hover(p);
      canvas.classList.toggle('over', p >= 0);
      tip.hidden = p < 0;
      if (p >= 0) tip.textContent = on.name(p), tip.style.left = px + 'px', tip.style.top = py + 'px';
    });
    pending = [x, y];
  }
  canvas.addEventListener('pointerdown', e => {
    canvas.setPointerCapture(e.pointerId);
    active.set(e.pointerId, [e.clientX, e.clientY]);
    if (active.size === 1) moved = 0;
    tip.hidden = true;
  });
  canvas.addEventListener('pointermove', e => {
    const before = active.get(e.pointerId);
    if (!before) return look(e.clientX, e.clientY);
    const dx = e.clientX - before[0], dy = e.clientY - before[1], h = canvas.clientHeight;
    moved += Math.abs(dx) + Math.abs(dy);
    if (moved > 4) canvas.classList.add('dragging');
    if (active.size === 2) {
      const other = [...active].find(([id]) => id !== e.pointerId)[1];
      const was = Math.hypot(before[0] - other[0], before[1] - other[1]), is = Math.hypot(e.clientX - other[0], e.clientY - other[1]);
      on.camera.zoom(was / (is || 1), 0, 0, aspect());
      on.camera.pan(dx / 2 / h, dy / 2 / h);
    } else if (e.shiftKey || e.buttons & 6) {
      on.camera.pan(dx / h, dy / h);
    } else {
      on.camera.turn(dx * 3.6 / h, dy * 3.6 / h);
    }
    active.set(e.pointerId, [e.clientX, e.clientY]);
    on.request();
  });
  const release = e => {
    if (!active.delete(e.pointerId)) return;
    canvas.classList.remove('dragging');
    if (e.type !== 'pointerup' || moved > 4 || active.size > 0 || e.button !== 0) return;
    const p = on.pick(e.clientX, e.clientY), twice = e.timeStamp - lastClick < 350;
    lastClick = e.timeStamp;
    if (twice && p >= 0) on.fly(p);
    else on.select(p);
  };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('pointerleave', () => { tip.hidden = true; on.hover(-1); });
  canvas.addEventListener('contextmenu', e => e.preventDefault());
  canvas.addEventListener('wheel', e => {
    const steps = e.deltaY * (e.deltaMode === 1 ? 16 : 1) / 500;
    on.camera.zoom(Math.exp(Math.max(-1, Math.min(1, steps))), 2 * e.clientX / canvas.clientWidth - 1, 1 - 2 * e.clientY / canvas.clientHeight, aspect());
    on.request();
    e.preventDefault();
  }, { passive: false });
}

if (matchMedia('(prefers-color-scheme: dark)').matches) document.documentElement.classList.add('dark');
try {
  start();
} catch (error) {
  byId('trouble').hidden = false;
  byId('trouble').textContent = error.message;
  console.error(error);
}
