'use strict';
// The motion as docs/exports.md describes it: any instant of it, exactly.
const carom = {};

carom.Ball = class {
  constructor(json) {
    Object.assign(this, json);
  }

  // The piece that holds at t: the last that has begun.
  piece(t) {
    const pieces = this.pieces;
    let low = 0, high = pieces.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (pieces[middle].t <= t) low = middle; else high = middle - 1;
    }
    return pieces[low];
  }

  position(t) {
    const piece = this.piece(t), s = t - piece.t;
    return [0, 1, 2].map((i) => {
      const v = piece.v ? piece.v[i] : 0, a = piece.a ? piece.a[i] : 0;
      return piece.p[i] + s * (v + (0.5 * s) * a) + carom.term(piece.curve, 'position', s, i);
    });
  }

  velocity(t) {
    const piece = this.piece(t), s = t - piece.t;
    return [0, 1, 2].map((i) => (piece.v ? piece.v[i] : 0) + s * (piece.a ? piece.a[i] : 0) +
                                carom.rate(piece.curve, 'position', s, i));
  }

  // w, x, y, z
  orientation(t) {
    const piece = this.piece(t), s = t - piece.t;
    const w = piece.w || [0, 0, 0], b = piece.b || [0, 0, 0], q = piece.q || [1, 0, 0, 0];
    const third = piece.curve ? 0 : s * s * s / 12;
    const turn = [0, 1, 2].map((i) => {
      const j = (i + 1) % 3, k = (i + 2) % 3;
      return s * (w[i] + 0.5 * s * b[i]) - third * (w[j] * b[k] - w[k] * b[j]) +
             carom.term(piece.curve, 'turn', s, i);
    });
    const angle = Math.hypot(...turn);
    if (angle === 0) return q;
    const c = Math.cos(angle / 2), f = Math.sin(angle / 2) / angle;
    const [x, y, z] = turn.map((u) => u * f);
    return [c * q[0] - x * q[1] - y * q[2] - z * q[3], c * q[1] + x * q[0] + y * q[3] - z * q[2],
            c * q[2] - x * q[3] + y * q[0] + z * q[1], c * q[3] + x * q[2] - y * q[1] + z * q[0]];
  }
};

// u^3 (c[0] + c[1] u + ...), u = s / seconds.
carom.term = (curve, name, s, i) => {
  if (!curve) return 0;
  const u = s / curve.seconds;
  return u * u * u * curve[name].reduceRight((sum, c) => sum * u + c[i], 0);
};
carom.rate = (curve, name, s, i) => {
  if (!curve) return 0;
  const u = s / curve.seconds;
  return u * u / curve.seconds *
         curve[name].reduceRight((sum, c, k) => sum * u + (k + 3) * c[i], 0);
};

carom.Motion = class {
  constructor(json) {
    Object.assign(this, json);
    this.balls = json.balls.map((ball) => new carom.Ball(ball));
    this.impacts = json.events.filter((event) => event[3] === 'impact');
    this.instants = [...new Set(this.impacts.map((event) => event[0]))];
  }

  // The camera's from, to and field of view at t; of one that moves the cubic through its keys.
  camera_at(t) {
    const {rate, keys, from, to, fov_deg} = this.camera;
    if (!keys) return {from, to, fov_deg};
    const place = Math.min(Math.max(t * rate, 0), keys.length - 1);
    const k = Math.min(Math.floor(place), Math.max(keys.length - 2, 0)), u = place - k;
    const at = (i) => keys[Math.min(Math.max(i, 0), keys.length - 1)];
    const [a, b, c, d] = [at(k - 1), at(k), at(k + 1), at(k + 2)];
    const value = b.map((_, i) => b[i] + 0.5 * u * (c[i] - a[i] +
        u * (2 * a[i] - 5 * b[i] + 4 * c[i] - d[i] + u * (3 * (b[i] - c[i]) + d[i] - a[i]))));
    return {from: value.slice(0, 3), to: value.slice(3, 6), fov_deg: value[6]};
  }

  // The event at or before t, for a line of text.
  last_event(t) {
    let low = 0, high = this.events.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.events[middle][0] <= t) low = middle + 1; else high = middle;
    }
    return low > 0 ? this.events[low - 1] : null;
  }
};

// Texts that are compressed: gzip in base64, within elements that do not run.
carom.unpacked = async (id) => {
  const text = atob(document.getElementById(id).textContent.trim());
  const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).text();
};
