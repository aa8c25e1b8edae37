'use strict';
// The scene's camera, and one that goes around the motion by mouse, touch and keys.

carom.Eye = class {
  constructor(stage, canvas, changed) {
    this.stage = stage;
    this.changed = changed;
    this.free = false;
    const {camera} = stage.motion, parallel = camera.height !== undefined;
    const half = 0.5 * (camera.height || 1);
    this.camera = parallel
      ? new THREE.OrthographicCamera(-half * camera.aspect, half * camera.aspect, half, -half)
      : new THREE.PerspectiveCamera(camera.fov_deg, camera.aspect);
    this.follow(0);
    this.listen(canvas);
  }

  // Stands where the scene has it at t.
  follow(t) {
    const {motion} = this.stage, {from, to, fov_deg} = motion.camera_at(t);
    this.camera.position.set(...from);
    this.target = carom.vector(to);
    if (this.camera.isPerspectiveCamera) this.camera.fov = fov_deg;
    this.camera.up.set(...motion.camera.up).normalize();
    // Looking along `up` leaves the roll open: the world's y, else x, then points up the picture.
    const along = this.target.clone().sub(this.camera.position).normalize();
    for (const next of [[0, 1, 0], [1, 0, 0]])
      if (along.clone().cross(this.camera.up).length() <= 1e-6) this.camera.up.set(...next);
    this.aim();
  }

  aim() {
    const distance = this.camera.position.distanceTo(this.target), far = 30 * this.stage.size;
    this.camera.near = this.camera.isPerspectiveCamera ? 0.01 * distance : 0;
    this.camera.far = distance + far;
    this.camera.lookAt(this.target);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
  }

  // Turns by so many radians around the target, and comes nearer by a factor.
  orbit(around, upwards, nearer = 1) {
    if (!this.free) {
      this.target.copy(this.stage.middle);
      this.camera.up.set(0, 0, 1);
      this.free = true;
    }
    const offset = this.camera.position.clone().sub(this.target);
    const distance = offset.length() * nearer;
    const rise = Math.asin(Math.min(1, Math.max(-1, offset.z / offset.length())));
    const azimuth = Math.atan2(offset.y, offset.x) - around;
    const height = Math.min(1.55, Math.max(-1.55, rise + upwards));
    this.camera.position.set(Math.cos(height) * Math.cos(azimuth), Math.cos(height) * Math.sin(azimuth),
                             Math.sin(height)).multiplyScalar(distance).add(this.target);
    if (this.camera.isOrthographicCamera) this.camera.zoom /= nearer;
    this.aim();
    this.changed();
  }

  back_to_scene() {
    this.free = false;
    if (this.camera.isOrthographicCamera) this.camera.zoom = 1;
    this.changed();
  }

  listen(canvas) {
    const fingers = new Map();
    const spread = () => {
      const [a, b] = [...fingers.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    });
    canvas.addEventListener('pointermove', (event) => {
      const last = fingers.get(event.pointerId);
      if (!last) return;
      const before = fingers.size === 2 ? spread() : 0;
      const dx = event.clientX - last.x, dy = event.clientY - last.y;
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
      if (fingers.size === 2) this.orbit(0, 0, before / Math.max(1, spread()));
      else this.orbit(0.008 * dx, 0.008 * dy);
    });
    for (const end of ['pointerup', 'pointercancel'])
      canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener('wheel', (event) => {
      // The page scrolls past the picture; with a key the wheel belongs to it.
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      this.orbit(0, 0, Math.exp(0.0015 * event.deltaY));
    }, {passive: false});
  }
};
