'use strict';
// The bodies of a motion on a stage of three.js, z upwards, metres.

carom.vector = (a) => new THREE.Vector3(a[0], a[1], a[2]);

// Axes across a direction: first x second = axis.
carom.frame = (along) => {
  const axis = carom.vector(along).normalize();
  const other = Math.abs(axis.x) < 0.6 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
  const second = axis.clone().cross(other).normalize();
  return {first: second.clone().cross(axis), second, axis};
};
carom.turn_to = ({first, second, axis}) =>
  new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(first, second, axis));

// A ball of radius 1 with the places of its texture in longitude and latitude.
carom.sphere = () => {
  const rows = 32, columns = 64, corners = [], places = [], triangles = [];
  for (let i = 0; i <= rows; ++i)
    for (let k = 0; k <= columns; ++k) {
      const up = Math.PI * (i / rows - 0.5), around = Math.PI * (2 * k / columns - 1);
      corners.push(Math.cos(up) * Math.cos(around), Math.cos(up) * Math.sin(around), Math.sin(up));
      places.push(k / columns, i / rows);
    }
  for (let i = 0; i < rows; ++i)
    for (let k = 0; k < columns; ++k) {
      const a = i * (columns + 1) + k, b = a + columns + 1;
      triangles.push(a, a + 1, b + 1, a, b + 1, b);
    }
  const geometry = new THREE.BufferGeometry();
  geometry.setIndex(triangles);
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
  geometry.setAttribute('normal', new THREE.Float32BufferAttribute(corners, 3));
  geometry.setAttribute('uv', new THREE.Float32BufferAttribute(places, 2));
  return geometry;
};

// A checker or a grid of squares, `tile` metres wide, as a texture of 2 x 2 squares.
carom.pattern = (look) => {
  if (look.style !== 'checker' && look.style !== 'grid') return null;
  const canvas = document.createElement('canvas'), size = 256;
  canvas.width = canvas.height = size;
  const draw = canvas.getContext('2d');
  draw.fillStyle = look.color;
  draw.fillRect(0, 0, size, size);
  draw.fillStyle = draw.strokeStyle = look.second_color;
  if (look.style === 'checker') {
    draw.fillRect(0, 0, size / 2, size / 2);
    draw.fillRect(size / 2, size / 2, size / 2, size / 2);
  } else {
    draw.lineWidth = 4;
    for (const x of [0, size / 2, size]) {
      draw.strokeRect(x, -9, 0, size + 18);
      draw.strokeRect(-9, x, size + 18, 0);
    }
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.anisotropy = 8;
  return texture;
};

carom.Stage = class {
  // `second`: the motion of the run that is shown as ghosts, or null.
  constructor(motion, second, textures) {
    this.motion = motion;
    this.second = second;
    this.scene = new THREE.Scene();
    this.measure();
    this.add_lights();
    for (const surface of motion.surfaces) this.add_surface(surface);
    const sphere = carom.sphere(), materials = new Map();
    this.balls = motion.balls.map((ball) => {
      const key = JSON.stringify(ball.look), picture = textures[key];
      if (!materials.has(key)) {
        const map = picture ? new THREE.TextureLoader().load(picture, () => this.changed()) : null;
        if (map) map.anisotropy = 8;
        materials.set(key, new THREE.MeshPhongMaterial(
          {map, color: map ? '#ffffff' : ball.look.color, shininess: 24, specular: '#222222'}));
      }
      const mesh = new THREE.Mesh(sphere, materials.get(key));
      mesh.scale.setScalar(ball.radius);
      mesh.castShadow = mesh.receiveShadow = true;
      this.scene.add(mesh);
      return mesh;
    });
    this.add_ghosts(sphere);
    this.add_trails();
    this.add_peaks();
    this.add_arrows();
    this.changed = () => {};
  }

  // The second run's balls: seen through, without shadows, in the colour that films have for them.
  add_ghosts(sphere) {
    this.ghosts = new THREE.Group();
    const material = new THREE.MeshPhongMaterial({color: '#4338ca', transparent: true, opacity: 0.45,
                                                  depthWrite: false});
    for (const ball of this.second ? this.second.balls : []) {
      const mesh = new THREE.Mesh(sphere, material);
      mesh.scale.setScalar(ball.radius);
      this.ghosts.add(mesh);
    }
    this.scene.add(this.ghosts);
  }

  // The box of all that happens, and its middle.
  measure() {
    this.box = new THREE.Box3();
    for (const ball of [...this.motion.balls, ...(this.second ? this.second.balls : [])])
      for (const piece of ball.pieces) {
        const p = carom.vector(piece.p), r = ball.radius;
        this.box.expandByPoint(p.clone().subScalar(r));
        this.box.expandByPoint(p.clone().addScalar(r));
      }
    for (const ball of this.motion.balls)
      for (const [time] of ball.peaks) this.box.expandByPoint(carom.vector(ball.position(time)));
    if (this.box.isEmpty()) this.box.setFromArray([-1, -1, -1, 1, 1, 1]);
    this.middle = this.box.getCenter(new THREE.Vector3());
    this.size = this.box.getSize(new THREE.Vector3()).length() || 1;
  }

  add_lights() {
    this.scene.add(new THREE.HemisphereLight('#ffffff', '#b0a898', 0.62));
    const light = new THREE.DirectionalLight('#fff6e8', 0.55), reach = 0.75 * this.size;
    light.position.copy(this.middle).add(new THREE.Vector3(-0.35, -0.45, 1).multiplyScalar(this.size));
    light.target.position.copy(this.middle);
    light.castShadow = true;
    light.shadow.mapSize.set(2048, 2048);
    light.shadow.bias = -0.0005;
    Object.assign(light.shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach,
                                        near: 0.01 * this.size, far: 3 * this.size});
    this.scene.add(light, light.target);
  }

  add_surface(surface) {
    const {geometry, place, turn, walls} = this.shape(surface);
    const map = surface.plane ? carom.pattern(surface.look) : null;
    const material = new THREE.MeshLambertMaterial(
      {map, color: map ? '#ffffff' : surface.look.color, side: walls ? THREE.DoubleSide : THREE.FrontSide});
    const mesh = new THREE.Mesh(geometry, material);
    if (place) mesh.position.copy(place);
    if (turn) mesh.quaternion.copy(turn);
    mesh.receiveShadow = true;
    mesh.castShadow = !surface.plane;
    this.scene.add(mesh);
  }

  shape(surface) {
    const cylinder = (c, open, begin, angle) => {
      const from = carom.vector(c.from), to = carom.vector(c.to), along = to.clone().sub(from);
      // three.js has the axis along y, and angles from z towards x.
      const geometry = new THREE.CylinderBufferGeometry(c.radius, c.radius, along.length(), 48, 1,
                                                        open, begin, angle);
      return {geometry: geometry.rotateX(Math.PI / 2), place: from.add(to).multiplyScalar(0.5), along};
    };
    if (surface.plane) return this.plane(surface);
    if (surface.box) {
      const {position, size, quaternion: [w, x, y, z]} = surface.box;
      return {geometry: new THREE.BoxBufferGeometry(...size), place: carom.vector(position),
              turn: new THREE.Quaternion(x, y, z, w)};
    }
    if (surface.sphere)
      return {geometry: new THREE.SphereBufferGeometry(surface.sphere.radius, 48, 32),
              place: carom.vector(surface.sphere.position)};
    if (surface.ring) {
      const {position, axis, radius, tube_radius} = surface.ring;
      return {geometry: new THREE.TorusBufferGeometry(radius, tube_radius, 16, 96),
              place: carom.vector(position), turn: carom.turn_to(carom.frame(axis))};
    }
    if (surface.bowl) {
      const {position, radius, opening, depth} = surface.bowl;
      const rim = Math.acos(Math.min(1, Math.max(-1, (radius - depth) / radius)));
      const geometry = new THREE.SphereBufferGeometry(radius, 48, 32, 0, 2 * Math.PI, 0, rim);
      return {geometry: geometry.rotateX(Math.PI / 2), place: carom.vector(position),
              turn: carom.turn_to(carom.frame(opening.map((x) => -x))), walls: true};
    }
    if (surface.pipe) {
      const angle = Math.min(2 * Math.PI, surface.pipe.angle_deg * Math.PI / 180);
      const {geometry, place, along} = cylinder(surface.pipe, true, -angle / 2, angle);
      const axis = along.normalize(), down = carom.vector(surface.pipe.opening).negate();
      // After the turn about x the wall's middle lies towards -y.
      const second = down.negate(), first = second.clone().cross(axis);
      return {geometry, place, turn: carom.turn_to({first, second, axis}), walls: true};
    }
    const {geometry, place, along} = cylinder(surface.cylinder || surface.capsule, false);
    if (surface.capsule)
      for (const end of ['from', 'to']) {
        const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(surface.capsule.radius, 48, 32),
                                    new THREE.MeshLambertMaterial({color: surface.look.color}));
        ball.position.copy(carom.vector(surface.capsule[end]));
        ball.castShadow = ball.receiveShadow = true;
        this.scene.add(ball);
      }
    return {geometry, place, turn: carom.turn_to(carom.frame(along.toArray()))};
  }

  // A square of a plane that reaches far behind all that happens.
  plane(surface) {
    const {normal, offset} = surface.plane, frame = carom.frame(normal), reach = 12 * this.size;
    const place = this.middle.clone().addScaledVector(frame.axis, offset - this.middle.dot(frame.axis));
    const geometry = new THREE.PlaneBufferGeometry(2 * reach, 2 * reach);
    const uv = geometry.attributes.uv, tile = 2 * (surface.look.tile || 0.5);
    for (let i = 0; i < uv.count; ++i) {
      const corner = geometry.attributes.position;
      uv.setXY(i, (corner.getX(i) + place.dot(frame.first)) / tile,
               (corner.getY(i) + place.dot(frame.second)) / tile);
    }
    return {geometry, place, turn: carom.turn_to(frame)};
  }

  // ---- What is drawn beside the bodies ---------------------------------------------------------

  // Instants of a ball's trail: where its pieces begin and between, at most 20000 and so spread over
  // the whole motion, however many pieces it has.
  trail_times(ball) {
    const most = 20000, {duration} = this.motion, times = [];
    const step = Math.max(duration / most, 0.01);
    let last = -Infinity;
    ball.pieces.forEach((piece, i) => {
      const end = i + 1 < ball.pieces.length ? ball.pieces[i + 1].t : duration;
      for (let t = piece.t; t < end; t += step) {
        if (t - last < duration / most) continue;
        times.push(t);
        last = t;
      }
    });
    times.push(duration);
    return times;
  }

  add_trails() {
    this.trails = new THREE.Group();
    this.paths = this.motion.balls.map((ball) => {
      const times = this.trail_times(ball), points = [];
      for (const t of times) points.push(...ball.position(t));
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({color: this.ink(ball)}));
      line.frustumCulled = false;
      this.trails.add(line);
      return {times, line};
    });
    const ends = new THREE.BufferGeometry();
    ends.setAttribute('position', new THREE.BufferAttribute(new Float32Array(6 * this.paths.length), 3));
    const colors = this.motion.balls.flatMap((ball) => {
      const {r, g, b} = new THREE.Color(this.ink(ball));
      return [r, g, b, r, g, b];
    });
    ends.setAttribute('color', new THREE.Float32BufferAttribute(colors, 3));
    this.ends = new THREE.LineSegments(ends, new THREE.LineBasicMaterial(
      {vertexColors: THREE.VertexColors}));
    this.ends.frustumCulled = false;
    this.trails.add(this.ends);
    this.scene.add(this.trails);
  }

  // A ball's colour, dark enough to be seen on a light floor.
  ink(ball) {
    const color = new THREE.Color(ball.look.color), hsl = {};
    color.getHSL(hsl);
    return '#' + color.setHSL(hsl.h, hsl.s, Math.min(hsl.l, 0.42)).getHexString();
  }

  add_peaks() {
    // Hops of less than a tenth of the radius cannot be seen.
    const peaks = this.motion.balls.flatMap((ball) => ball.peaks
      .filter(([, height]) => height >= 0.1 * ball.radius)
      .map(([time, height]) => ({ball, time, height, place: ball.position(time)})));
    this.peaks = peaks.sort((a, b) => a.time - b.time);
    const points = [], colors = [];
    for (const {ball, place: [x, y, z]} of this.peaks) {
      const r = ball.radius, {r: red, g, b} = new THREE.Color(this.ink(ball));
      points.push(x - r, y, z - r, x + r, y, z - r, x, y - r, z - r, x, y + r, z - r);
      for (let i = 0; i < 4; ++i) colors.push(red, g, b);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    geometry.setAttribute('color', new THREE.Float32BufferAttribute(colors, 3));
    this.marks = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial(
      {vertexColors: THREE.VertexColors}));
    this.marks.frustumCulled = false;
    this.scene.add(this.marks);
  }

  add_arrows() {
    let fastest = 0;
    for (const ball of this.motion.balls)
      for (const piece of ball.pieces) fastest = Math.max(fastest, Math.hypot(...(piece.v || [0])));
    this.seconds = fastest > 0 ? 0.25 * this.size / fastest : 0;  // metres of arrow per m/s
    this.arrows = new THREE.Group();
    for (const ball of this.motion.balls)
      this.arrows.add(new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), 1,
                                            this.ink(ball)));
    this.scene.add(this.arrows);
  }

  // Everything as it is at t; trails reach `back` seconds back.
  show(t, back) {
    this.motion.balls.forEach((ball, i) => {
      const place = ball.position(t), [w, x, y, z] = ball.orientation(t);
      this.balls[i].position.set(...place);
      this.balls[i].quaternion.set(x, y, z, w);
      if (this.trails.visible) this.show_trail(i, t, back, place);
      if (this.arrows.visible) this.show_arrow(this.arrows.children[i], ball, t, place);
    });
    if (this.ghosts.visible)
      this.ghosts.children.forEach((ghost, i) => ghost.position.set(...this.second.balls[i].position(t)));
    this.ends.geometry.attributes.position.needsUpdate = true;
    let count = 0;
    while (count < this.peaks.length && this.peaks[count].time <= t) ++count;
    this.marks.geometry.setDrawRange(0, 4 * count);
    this.shown_peaks = count;
  }

  show_trail(i, t, back, place) {
    const {times, line} = this.paths[i];
    const count = (time) => {
      let low = 0, high = times.length;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (times[middle] <= time) low = middle + 1; else high = middle;
      }
      return low;
    };
    const end = count(t), begin = Math.min(count(t - back), Math.max(end - 1, 0));
    line.geometry.setDrawRange(begin, end - begin);
    const points = line.geometry.attributes.position.array, last = 3 * Math.max(end - 1, 0);
    this.ends.geometry.attributes.position.array.set(
      [points[last], points[last + 1], points[last + 2], ...place], 6 * i);
  }

  show_arrow(arrow, ball, t, place) {
    const velocity = carom.vector(ball.velocity(t)), length = velocity.length() * this.seconds;
    arrow.visible = length > 0.1 * ball.radius;
    if (!arrow.visible) return;
    arrow.position.set(...place);
    arrow.setDirection(velocity.normalize());
    arrow.setLength(length, Math.min(0.3 * length, ball.radius), Math.min(0.2 * length, 0.6 * ball.radius));
  }
};
