// Drawing with WebGL 2: the surface with its patches, the curves as ribbons of constant width, and picking.
'use strict';

const kSurfaceVertex = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in float patchId;
layout(location = 3) in float deviation;
uniform mat4 view, projection;
out vec3 vNormal, vEye;
out float vCavity, vDeviation;
flat out float vPatch;
void main() {
  vec4 p = view * vec4(position, 1.0);
  vEye = p.xyz;
  vNormal = mat3(view) * normal.xyz;
  vCavity = normal.w;
  vPatch = patchId;
  vDeviation = deviation;
  gl_Position = projection * p;
}`;

const kSurfaceFragment = `#version 300 es
precision highp float;
in vec3 vNormal, vEye;
in float vCavity, vDeviation;
flat in float vPatch;
uniform sampler2D palette, ramp;
uniform vec3 clay;
uniform float tint, heat, hover, selected, dark;
out vec4 colour;
void main() {
  vec3 n = normalize(vNormal), eye = normalize(-vEye);
  bool back = dot(n, eye) < 0.0;
  if (back) n = -n;
  int width = textureSize(palette, 0).x, id = int(vPatch + 0.5);
  vec3 base = mix(clay, texelFetch(palette, ivec2(id % width, id / width), 0).rgb, tint);
  if (heat > 0.0) base = mix(base, texture(ramp, vec2(clamp(vDeviation, 0.0, 1.0) * 0.97 + 0.015, 0.5)).rgb, heat);
  if (selected >= 0.0 && abs(vPatch - selected) > 0.5) base = mix(base, vec3(dot(base, vec3(0.3, 0.6, 0.1))), 0.6) * 0.95;
  if (abs(vPatch - hover) < 0.5 || abs(vPatch - selected) < 0.5) base = mix(base, vec3(1.0), 0.16) * 1.03;
  base *= base;  // light adds up in linear values; a gamma of 2 is near enough
  float key = clamp(0.5 + 0.5 * dot(n, vec3(-0.449, 0.648, 0.615)), 0.0, 1.0);
  float light = 0.34 + 0.11 * n.y + 0.80 * key * key + 0.11 * max(dot(n, vec3(0.867, 0.108, 0.487)), 0.0);
  light *= 1.0 - 0.42 * max(vCavity, 0.0) - 0.16 * min(vCavity, 0.0);
  float rim = 1.0 - clamp(dot(n, eye), 0.0, 1.0), gloss = max(dot(reflect(vec3(0.354, -0.607, -0.711), n), eye), 0.0);
  rim *= rim * rim;
  gloss *= gloss, gloss *= gloss, gloss *= gloss, gloss *= gloss;
  vec3 c = base * light + 0.05 * gloss * gloss;
  c = mix(c * (1.0 - 0.42 * rim), c + vec3(0.10, 0.12, 0.16) * rim, dark);
  if (back) c *= vec3(0.62, 0.56, 0.54);
  colour = vec4(sqrt(clamp(c, 0.0, 1.0)), 1.0);
}`;

const kPickFragment = `#version 300 es
precision highp float;
flat in float vPatch;
out vec4 colour;
void main() {
  int id = int(vPatch + 0.5) + 1;
  colour = vec4(float(id & 255), float((id >> 8) & 255), float((id >> 16) & 255), 255.0) / 255.0;
}`;

const kLineVertex = `#version 300 es
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in float kind;
layout(location = 3) in vec3 measure;
uniform mat4 view, projection;
uniform vec2 pixels;
uniform float near;
uniform vec3 least;
uniform vec4 style[7];
out vec4 vColour;
void main() {
  vec4 s = style[int(kind + 0.5)];
  vec4 a = view * vec4(from, 1.0), b = view * vec4(to, 1.0);
  a.xyz *= 0.9985, b.xyz *= 0.9985;
  if (any(lessThan(measure, least)) || (a.z > -near && b.z > -near) || s.w == 0.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    vColour = vec4(0.0);
    return;
  }
  if (a.z > -near) a = mix(a, b, (-near - a.z) / (b.z - a.z));
  if (b.z > -near) b = mix(b, a, (-near - b.z) / (a.z - b.z));
  vec4 p = projection * a, q = projection * b;
  vec2 along = (q.xy / q.w - p.xy / p.w) * pixels;
  along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
  vec2 side = vec2(-along.y, along.x);
  bool last = (gl_VertexID & 1) == 1;
  float up = (gl_VertexID & 2) == 0 ? -1.0 : 1.0;
  vec4 c = last ? q : p;
  c.xy += (side * up + along * (last ? 0.5 : -0.5)) * s.w / pixels * c.w;
  gl_Position = c;
  vColour = vec4(s.rgb, 1.0);
}`;

const kLineFragment = `#version 300 es
precision highp float;
in vec4 vColour;
uniform float alpha;
out vec4 colour;
void main() { colour = vec4(vColour.rgb * alpha, alpha); }`;

class Scene {
  constructor(canvas) {
    const gl = canvas.getContext('webgl2', { antialias: true, alpha: true, premultipliedAlpha: true });
    if (!gl) throw new Error('This page needs WebGL 2, which this browser does not offer.');
    this.gl = gl;
    this.canvas = canvas;
    this.quality = 1;  // less while a slow machine turns a large surface
    this.surfaceProgram = this.program(kSurfaceVertex, kSurfaceFragment);
    this.pickProgram = this.program(kSurfaceVertex, kPickFragment);
    this.lineProgram = this.program(kLineVertex, kLineFragment);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }
  program(vertex, fragment) {
    const gl = this.gl, p = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(p, shader);
    }
    gl.linkProgram(p);
    if (!gl.getProgramParameter(p, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(p));
    const at = {};
    for (let i = 0; i < gl.getProgramParameter(p, gl.ACTIVE_UNIFORMS); ++i) {
      const name = gl.getActiveUniform(p, i).name.replace('[0]', '');
      at[name] = gl.getUniformLocation(p, name);
    }
    return { p, at };
  }
  buffer(data, target = this.gl.ARRAY_BUFFER) {
    const b = this.gl.createBuffer();
    this.gl.bindBuffer(target, b);
    this.gl.bufferData(target, data, this.gl.STATIC_DRAW);
    return b;
  }
  attribute(place, data, size, type, normalised, stride = 0, offset = 0) {
    const gl = this.gl;
    if (data) this.buffer(data);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, normalised, stride, offset);
  }
  texture(width, height, bytes, filter) {
    const gl = this.gl, t = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, t);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    for (const [name, value] of [['MIN_FILTER', filter], ['MAG_FILTER', filter], ['WRAP_S', gl.CLAMP_TO_EDGE], ['WRAP_T', gl.CLAMP_TO_EDGE]])
      gl.texParameteri(gl.TEXTURE_2D, gl['TEXTURE_' + name], value);
    return t;
  }
  setSurface(surface, closed, colours, deviation, ramp) {
    const gl = this.gl;
    this.closed = closed;
    this.triangles = surface.index.length / 3;
    this.surface = gl.createVertexArray();
    gl.bindVertexArray(this.surface);
    this.attribute(0, surface.position, 3, gl.FLOAT, false);
    this.attribute(1, surface.normal, 4, gl.BYTE, true);
    this.attribute(2, surface.patch, 1, gl.FLOAT, false);
    if (deviation) this.attribute(3, deviation, 1, gl.FLOAT, false);
    this.buffer(surface.index, gl.ELEMENT_ARRAY_BUFFER);
    gl.bindVertexArray(null);
    const width = Math.min(1024, Math.max(1, colours.length)), height = Math.max(1, Math.ceil(colours.length / width));
    const bytes = new Uint8Array(4 * width * height).fill(255);
    colours.forEach((c, i) => bytes.set(c, 4 * i));
    this.palette = this.texture(width, height, bytes, gl.NEAREST);
    const steps = new Uint8Array(4 * ramp.length).fill(255);
    ramp.forEach((c, i) => steps.set(c, 4 * i));
    this.ramp = this.texture(ramp.length, 1, steps, gl.LINEAR);
  }
  // What draws the segments of readLines(): four vertices each, told apart by their number.
  lineSet(lines) {
    const gl = this.gl, n = lines.segments, set = { count: n, array: gl.createVertexArray() };
    const ends = new Float32Array(24 * n), kind = new Uint8Array(4 * n), index = new Uint32Array(6 * n);
    const measure = lines.measure ? new Float32Array(12 * n) : null;
    for (let s = 0; s < n; ++s) {
      const line = lines.line[s];
      for (let v = 4 * s; v < 4 * s + 4; ++v) {
        for (let k = 0; k < 6; ++k) ends[6 * v + k] = lines.ends[6 * s + k];
        kind[v] = lines.kind[line];
        if (measure) for (let k = 0; k < 3; ++k) measure[3 * v + k] = lines.measure[k][line];
      }
      index.set([4 * s, 4 * s + 1, 4 * s + 2, 4 * s + 2, 4 * s + 1, 4 * s + 3], 6 * s);
    }
    gl.bindVertexArray(set.array);
    this.attribute(0, ends, 3, gl.FLOAT, false, 24, 0);
    this.attribute(1, null, 3, gl.FLOAT, false, 24, 12);
    this.attribute(2, kind, 1, gl.UNSIGNED_BYTE, false);
    if (measure) this.attribute(3, measure, 3, gl.FLOAT, false);
    this.buffer(index, gl.ELEMENT_ARRAY_BUFFER);
    gl.bindVertexArray(null);
    return set;
  }
  resize() {
    const ratio = Math.min(2, window.devicePixelRatio || 1) * this.quality;
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio)), height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) this.canvas.width = width, this.canvas.height = height;
    this.ratio = ratio;
    return width / height;
  }
  drawSurface(program, matrices) {
    const gl = this.gl, { at } = program;
    gl.uniformMatrix4fv(at.view, false, matrices.view);
    gl.uniformMatrix4fv(at.projection, false, matrices.projection);
    gl.bindVertexArray(this.surface);
    if (this.closed) gl.enable(gl.CULL_FACE);  // the far side of a closed surface is never seen
    gl.drawElements(gl.TRIANGLES, 3 * this.triangles, gl.UNSIGNED_INT, 0);
    gl.disable(gl.CULL_FACE);
  }
  // look: { clay, tint, heat, hover, selected, dark }; sets: [{ set, alpha, least, style }], style: per kind r g b width.
  draw(camera, look, sets) {
    const gl = this.gl, aspect = this.resize(), matrices = camera.matrices(aspect);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const { p, at } = this.surfaceProgram;
    gl.useProgram(p);
    gl.activeTexture(gl.TEXTURE0), gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.activeTexture(gl.TEXTURE1), gl.bindTexture(gl.TEXTURE_2D, this.ramp);
    gl.uniform1i(at.palette, 0), gl.uniform1i(at.ramp, 1);
    gl.uniform3fv(at.clay, look.clay);
    for (const name of ['tint', 'heat', 'hover', 'selected', 'dark']) gl.uniform1f(at[name], look[name]);
    this.drawSurface(this.surfaceProgram, matrices);
    gl.useProgram(this.lineProgram.p);
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    const line = this.lineProgram.at;
    gl.uniformMatrix4fv(line.view, false, matrices.view);
    gl.uniformMatrix4fv(line.projection, false, matrices.projection);
    gl.uniform2f(line.pixels, this.canvas.width / 2, this.canvas.height / 2);
    gl.uniform1f(line.near, matrices.near);
    for (const { set, alpha, least, style } of sets) {
      if (alpha < 0.01 || set.count === 0) continue;
      gl.uniform1f(line.alpha, alpha);
      gl.uniform3fv(line.least, least || [-1e30, -1e30, -1e30]);  // sets without measures read 0
      gl.uniform4fv(line.style, style.flatMap(s => [s[0] / 255, s[1] / 255, s[2] / 255, s[3] * this.ratio / 2]));
      gl.bindVertexArray(set.array);
      gl.drawElements(gl.TRIANGLES, 6 * set.count, gl.UNSIGNED_INT, 0);
    }
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    gl.bindVertexArray(null);
  }
  // The patch at (x, y) in pixels of the page, or -1.
  pick(camera, x, y) {
    const gl = this.gl, width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!this.pickTarget) {
      this.pickTarget = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.pickTarget);
      const colour = gl.createRenderbuffer(), depth = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, colour);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, 1, 1);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, colour);
      gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, 1, 1);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.pickTarget);
    gl.viewport(0, 0, 1, 1);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const l = 2 * x / width - 1, u = 1 - 2 * y / height;
    gl.useProgram(this.pickProgram.p);
    this.drawSurface(this.pickProgram, camera.matrices(width / height, [l, u - 2 / height, l + 2 / width, u]));
    const pixel = new Uint8Array(4);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.bindVertexArray(null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
  }
}
