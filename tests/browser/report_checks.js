// What scripts/check_report.sh asks of a page of `carom report`, in headless Chromium.
// usage: node report_checks.js CHROMIUM PAGE.html FOLDER STILLS.json
// FOLDER holds node_modules (puppeteer-core, axe-core) and takes the screenshots. STILLS.json lists
// {time, png}: segmentation layers of stills of the same scene.
'use strict';
const fs = require('fs'), path = require('path'), zlib = require('zlib');
const {Checks, launch, listen, look} = require('./common.js');
const [, , chromium, page_file, folder, stills_file] = process.argv;
const checks = new Checks('check_report'), check = (...words) => checks.check(...words);

// In the page: the middles of the balls' masks as the viewer draws them, flat and unshaded.
const masks = async (t) => {
  const {stage, eye, renderer} = carom.viewer;
  carom.viewer.show(t);
  const kept = stage.balls.map((ball) => ball.material), background = stage.scene.background;
  const hidden = stage.scene.children.filter((child) => child.visible && !stage.balls.includes(child));
  hidden.forEach((child) => { child.visible = false; });
  stage.scene.background = new THREE.Color(0);
  stage.balls.forEach((ball, i) => {
    ball.material = new THREE.MeshBasicMaterial({color: (i + 1) * 0x001100, fog: false});
  });
  const target = new THREE.WebGLRenderTarget(1280, Math.round(1280 / stage.motion.camera.aspect));
  renderer.setRenderTarget(target);
  renderer.render(stage.scene, eye.camera);
  const bytes = new Uint8Array(4 * target.width * target.height);
  renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, bytes);
  renderer.setRenderTarget(null);
  stage.balls.forEach((ball, i) => { ball.material = kept[i]; });
  hidden.forEach((child) => { child.visible = true; });
  stage.scene.background = background;
  carom.viewer.show(t);
  const sums = stage.balls.map(() => [0, 0, 0]);
  for (let y = 0; y < target.height; ++y)
    for (let x = 0; x < target.width; ++x) {
      const i = Math.round(bytes[4 * (y * target.width + x) + 1] / 0x11) - 1;
      if (i < 0 || i >= sums.length) continue;
      sums[i][0] += x + 0.5;
      sums[i][1] += target.height - y - 0.5;
      sums[i][2] += 1;
    }
  return sums.map(([x, y, n]) => (n > 0 ? [x / n, y / n, n] : null));
};

// The same of a segmentation layer: a PNG of 16 bits a pixel, ids of balls from 1.
const layer_masks = (file, count) => {
  const png = fs.readFileSync(file), width = png.readUInt32BE(16), height = png.readUInt32BE(20);
  if (png[24] !== 16 || png[25] !== 0 || png[28] !== 0) throw new Error(`${file}: not 16 bits of grey`);
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at))
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT')
      parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  const raw = zlib.inflateSync(Buffer.concat(parts)), line = 2 * width;
  const sums = Array.from({length: count}, () => [0, 0, 0]);
  let above = Buffer.alloc(line);
  for (let y = 0; y < height; ++y) {
    const start = y * (line + 1), filter = raw[start], row = Buffer.from(raw.subarray(start + 1, start + 1 + line));
    for (let i = 0; i < line; ++i) {
      const left = i >= 2 ? row[i - 2] : 0, up = above[i], corner = i >= 2 ? above[i - 2] : 0;
      const guess = left + up - corner, [a, b, c] = [left, up, corner].map((v) => Math.abs(guess - v));
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      row[i] = (row[i] + [0, left, up, (left + up) >> 1, paeth][filter]) & 255;
    }
    for (let x = 0; x < width; ++x) {
      const ball = row.readUInt16BE(2 * x) - 1;
      if (ball < 0 || ball >= count) continue;
      sums[ball][0] += x + 0.5;
      sums[ball][1] += y + 0.5;
      sums[ball][2] += 1;
    }
    above = row;
  }
  return sums.map(([x, y, n]) => (n > 0 ? [x / n, y / n, n] : null));
};

const main = async () => {
  const browser = await launch(chromium, folder);
  const page = await browser.newPage(), {said, asked} = listen(page);
  await page.setOfflineMode(true);
  await page.setViewport({width: 1280, height: 900});
  await page.goto('file://' + path.resolve(page_file));
  await page.waitForFunction('window.carom && carom.viewer', {timeout: 120000});
  check('the viewer has begun', true);

  const {stills} = JSON.parse(fs.readFileSync(stills_file));
  let worst = 0, compared = 0;
  for (const {time, png} of stills) {
    const drawn = await page.evaluate(masks, time);
    const right = layer_masks(png, drawn.length);
    drawn.forEach((mask, i) => {
      // What another ball or a board covers has its middle elsewhere by a pixel's rounding.
      if (!mask || !right[i] || Math.abs(mask[2] / right[i][2] - 1) > 0.03) return;
      ++compared;
      worst = Math.max(worst, Math.hypot(mask[0] - right[i][0], mask[1] - right[i][1]));
    });
  }
  check(`balls' middles are those of ${stills.length} stills to a pixel`,
        compared >= 2 * stills.length && worst <= 1, `${worst.toFixed(3)} px at most, ${compared} balls`);

  const film = await page.evaluate(async () => {
    const video = document.querySelector('video');
    video.scrollIntoView();
    await video.play();
    await new Promise((done) => setTimeout(done, 1500));
    video.pause();
    return {time: video.currentTime, width: video.videoWidth, error: video.error && video.error.message};
  });
  check('the film plays', film.time > 0.2 && film.width > 0 && !film.error, JSON.stringify(film));

  const trail = await page.evaluate(() => {
    const count = 100000, {stage} = carom.viewer, {duration} = stage.motion;
    const times = stage.trail_times({pieces: Array.from({length: count}, (_, i) => ({t: i / count * duration}))});
    return {points: times.length, gap: Math.max(...times.map((t, i) => (i > 0 ? t - times[i - 1] : t))) / duration};
  });
  check('a trail of many pieces has no gap', trail.points <= 20001 && trail.gap < 1e-3, JSON.stringify(trail));

  const linked = await page.evaluate(async () => {
    const row = document.querySelectorAll('#bounces tbody tr')[1];
    row.querySelector('button').click();
    const impact = carom.viewer.motion.impacts[1][0];
    const svg = document.querySelector('svg[data-end]'), {left, right, end} = svg.dataset;
    const cursor = Number(svg.querySelector('.cursor').getAttribute('x1'));
    const at = carom.viewer.t;
    document.getElementById('v-after').click();
    const next = carom.viewer.t, keys = new KeyboardEvent('keydown', {key: 'ArrowLeft', bubbles: true});
    document.getElementById('v-canvas').dispatchEvent(keys);
    return {impact, at, next, back: carom.viewer.t,
            off: Math.abs(cursor - (Number(left) + at / end * (right - left)))};
  });
  check('a click on a bounce shows it, the cursors too', linked.at === linked.impact && linked.off < 1e-9);
  check('steps go from impact to impact', linked.next > linked.at && linked.back === linked.at);

  await look(checks, page, folder, '', (t) => { scrollTo(0, 0); carom.viewer.show(t); }, stills[5].time);
  check('no word on the console', said.length === 0,
        said.slice(0, 5).join(' | '));
  check('no request', asked.length === 0, asked.slice(0, 3).join(' '));
  await page.pdf({path: path.join(folder, 'page.pdf'), format: 'A4', preferCSSPageSize: true});

  const plain = await browser.newPage();
  await plain.setJavaScriptEnabled(false);
  await plain.goto('file://' + path.resolve(page_file));
  await plain.screenshot({path: path.join(folder, 'no-script.png')});
  const seen = await plain.$$eval('h2, table, svg, img', (all) => all.length);
  check('without JavaScript pictures and tables are there', seen > 10, `${seen} elements`);
  await browser.close();
  checks.end();
};
main().catch((error) => {
  console.error(error);
  process.exit(1);
});
