'use strict';
// The player: its controls, and all on the page that follows its instant.

carom.Viewer = class {
  constructor(motion, second, textures) {
    this.motion = motion;
    this.second = second;
    this.t = 0;
    this.playing = false;
    this.element = (name) => document.getElementById('v-' + name);
    const canvas = this.element('canvas');
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true});
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.stage = new carom.Stage(motion, second, textures);
    this.stage.changed = () => this.draw();
    this.eye = new carom.Eye(this.stage, canvas, () => this.draw());
    this.names = this.spans(Math.min(motion.balls.length, 40));
    this.heights = this.spans(8);
    // Names would cover a small picture.
    if (canvas.getBoundingClientRect().width < 600) this.element('names').checked = false;
    this.listen(canvas);
    const dark = matchMedia('(prefers-color-scheme: dark)');
    dark.addEventListener('change', () => this.draw());
    this.is_dark = () => dark.matches;
    new ResizeObserver(() => this.draw()).observe(canvas);
    this.show(0);
  }

  spans(count) {
    const layer = this.element('labels');
    return Array.from({length: count}, () => layer.appendChild(document.createElement('span')));
  }

  get speed() { return 1 / Number(this.element('speed').value); }

  listen(canvas) {
    const on = (name, what) => this.element(name).addEventListener('click', what);
    on('play', () => this.play(!this.playing));
    on('before', () => this.step(-1));
    on('after', () => this.step(1));
    on('camera', () => this.eye.back_to_scene());
    for (const name of ['trails', 'peaks', 'arrows', 'names', ...(this.second ? ['second'] : [])])
      this.element(name).addEventListener('change', () => this.show(this.t));
    const scrub = this.element('scrub');
    scrub.max = this.motion.duration;
    scrub.addEventListener('input', () => {
      this.play(false);
      this.show(Number(scrub.value));
    });
    canvas.addEventListener('keydown', (event) => this.key(event));
    this.rows = [...document.querySelectorAll('#bounces tbody tr')];
    this.rows.forEach((row, i) => row.querySelector('button').addEventListener('click', () => {
      this.play(false);
      this.show(this.motion.impacts[i][0]);
    }));
    this.cursors = [...document.querySelectorAll('svg[data-end]')].map((svg) => this.cursor(svg));
  }

  // The line in a plot that stands at the viewer's instant, and is dragged to another.
  cursor(svg) {
    const {left, right, end} = svg.dataset, line = svg.querySelector('.cursor');
    const go = (event) => {
      const box = svg.getBoundingClientRect();
      const x = (event.clientX - box.left) / box.width * svg.viewBox.baseVal.width;
      this.play(false);
      this.show((x - left) / (right - left) * end);
    };
    svg.addEventListener('pointerdown', (event) => {
      svg.setPointerCapture(event.pointerId);
      go(event);
    });
    svg.addEventListener('pointermove', (event) => { if (event.buttons) go(event); });
    line.removeAttribute('visibility');
    return (t) => {
      const x = Number(left) + t / end * (right - left);
      line.setAttribute('x1', x);
      line.setAttribute('x2', x);
    };
  }

  key(event) {
    const act = {
      ' ': () => this.play(!this.playing), ArrowRight: () => this.step(1), ArrowLeft: () => this.step(-1),
      Home: () => this.jump(0), End: () => this.jump(this.motion.duration),
      '+': () => this.eye.orbit(0, 0, 0.9), '-': () => this.eye.orbit(0, 0, 1 / 0.9),
      a: () => this.eye.orbit(-0.1, 0), d: () => this.eye.orbit(0.1, 0),
      w: () => this.eye.orbit(0, 0.1), s: () => this.eye.orbit(0, -0.1),
      c: () => this.eye.back_to_scene(),
    }[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  }

  play(on) {
    if (on === this.playing) return;
    this.playing = on;
    this.element('play').textContent = on ? 'Pause' : 'Play';
    if (!on) return;
    if (this.t >= this.motion.duration) this.t = 0;
    let last = null;
    const tick = (now) => {
      if (!this.playing) return;
      if (last !== null) this.show(this.t + 1e-3 * Math.min(now - last, 100) * this.speed);
      last = now;
      if (this.t >= this.motion.duration) this.play(false);
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  jump(t) {
    this.play(false);
    this.show(t);
  }

  // To the next impact, or the one before.
  step(direction) {
    const {instants} = this.motion;
    const next = direction > 0 ? instants.find((t) => t > this.t)
                               : [...instants].reverse().find((t) => t < this.t);
    this.jump(next === undefined ? (direction > 0 ? this.motion.duration : 0) : next);
  }

  show(t) {
    this.t = Math.min(Math.max(t, 0), this.motion.duration);
    for (const name of ['trails', 'arrows']) this.stage[name].visible = this.element(name).checked;
    this.stage.marks.visible = this.element('peaks').checked;
    this.stage.ghosts.visible = Boolean(this.second) && this.element('second').checked;
    this.stage.show(this.t, 2);
    if (!this.eye.free) this.eye.follow(this.t);
    this.element('scrub').value = this.t;
    const digits = this.speed < 0.05 ? 6 : 3;
    this.element('time').textContent = `${this.t.toFixed(digits)} s`;
    this.element('event').textContent = [this.event_text(), this.apart_text()].filter(Boolean).join('; ');
    for (const move of this.cursors) move(this.t);
    this.draw();
  }

  event_text() {
    const event = this.motion.last_event(this.t);
    if (!event) return '';
    const [time, ball, other, kind] = event, speed = event[10];
    const text = `${time.toFixed(4)} s: ${kind}, ${ball} and ${other}`;
    return speed === undefined ? text : `${text}, ${speed.toPrecision(4)} m/s`;
  }

  // How far balls of equal names are apart in the two runs, the farthest ones.
  apart_text() {
    if (!this.stage.ghosts.visible) return '';
    let most = -1, name = '';
    for (const ball of this.motion.balls) {
      const other = this.second.balls.find((one) => one.name === ball.name);
      if (!other) continue;
      const [a, b] = [ball.position(this.t), other.position(this.t)];
      const metres = Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      if (metres > most) [most, name] = [metres, ball.name];
    }
    return most < 0 ? '' : `${name} is ${most.toPrecision(4)} m from its ghost`;
  }

  draw() {
    const canvas = this.element('canvas'), {width} = canvas.getBoundingClientRect();
    const {aspect} = this.motion.camera, ratio = Math.min(devicePixelRatio || 1, 2);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, width / aspect, false);
    const color = this.is_dark() ? '#262b33' : '#d5dde4';
    this.stage.scene.background = new THREE.Color(color);
    const far = this.stage.size + this.eye.camera.position.distanceTo(this.stage.middle);
    this.stage.scene.fog = this.eye.camera.isPerspectiveCamera ? new THREE.Fog(color, far, 5 * far) : null;
    if (!this.eye.free) this.eye.follow(this.t);
    this.renderer.render(this.stage.scene, this.eye.camera);
    this.write(width, width / aspect);
  }

  // Names of balls and heights of the latest peaks, at their places in the picture.
  write(width, height) {
    const put = (span, text, place, below) => {
      const p = carom.vector(place).project(this.eye.camera);
      span.hidden = !text || Math.abs(p.x) > 1 || Math.abs(p.y) > 1 || p.z > 1;
      if (span.hidden) return;
      span.textContent = text;
      const x = 0.5 * (1 + p.x) * width, y = 0.5 * (1 - p.y) * height;
      span.style.transform = `translate(${x.toFixed(1)}px,${y.toFixed(1)}px) translate(-50%,${below})`;
    };
    const named = this.element('names').checked;
    this.names.forEach((span, i) => {
      const ball = this.motion.balls[i], [x, y, z] = ball.position(this.t);
      put(span, named ? ball.name : '', [x, y, z + ball.radius], '-110%');
    });
    const count = this.element('peaks').checked ? this.stage.shown_peaks : 0;
    this.heights.forEach((span, i) => {
      const peak = this.stage.peaks[count - 1 - i];
      const [x, y, z] = peak ? peak.place : [0, 0, 0], r = peak ? peak.ball.radius : 0;
      put(span, peak && i < count ? `${peak.height.toPrecision(4)} m` : '', [x, y, z - r], '20%');
    });
  }

  // Where a point of the scene is in the picture, px from its top left corner.
  project(place) {
    const {width} = this.element('canvas').getBoundingClientRect();
    const p = carom.vector(place).project(this.eye.camera);
    return [0.5 * (1 + p.x) * width, 0.5 * (1 - p.y) * width / this.motion.camera.aspect];
  }
};

(async () => {
  const note = document.getElementById('v-note');
  try {
    if (!window.DecompressionStream) throw new Error('it is too old to unpack the motion');
    const script = document.createElement('script');
    script.textContent = await carom.unpacked('three');
    document.head.append(script);
    if (!window.THREE) throw new Error('it does not run three.js');
    const motion_of = async (id) => new carom.Motion(JSON.parse(await carom.unpacked(id)));
    const motion = await motion_of('motion');
    const second = document.getElementById('second') ? await motion_of('second') : null;
    const textures = JSON.parse(document.getElementById('textures').textContent);
    document.getElementById('viewer').hidden = false;
    carom.viewer = new carom.Viewer(motion, second, textures);
    window.carom = carom;
  } catch (error) {
    document.getElementById('viewer').hidden = true;
    note.textContent = `This browser cannot show the motion in three dimensions: ${error.message}. ` +
        'Film, pictures and tables are below.';
    note.hidden = false;
  }
})();
