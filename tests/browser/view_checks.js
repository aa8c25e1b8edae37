// `carom view` in headless Chromium: the page follows the file, and stays where it was.
// usage: node view_checks.js CHROMIUM CAROM SCENE.yaml FOLDER
// SCENE.yaml is changed. FOLDER holds node_modules (puppeteer-core).
'use strict';
const fs = require('fs'), {spawn} = require('child_process');
const {Checks, launch} = require('./common.js');
const [, , chromium, program, scene, folder] = process.argv;
const checks = new Checks('check_view'), check = (...words) => checks.check(...words);

const main = async () => {
  const server = spawn(program, ['view', scene]);
  const address = await new Promise((done) => server.stdout.once('data', (data) => done(String(data).trim())));
  const browser = await launch(chromium, folder);
  const page = await browser.newPage(), said = [];
  page.on('pageerror', (error) => said.push(String(error)));
  page.on('console', (message) => { if (message.type() === 'error') said.push(message.text()); });
  await page.goto(address);
  await page.waitForFunction('window.carom && carom.viewer', {timeout: 120000});
  await page.evaluate(() => { carom.viewer.show(0.7); carom.viewer.eye.orbit(0.5, 0.1); });
  const balls = await page.evaluate(() => carom.viewer.motion.balls.length);

  const text = fs.readFileSync(scene, 'utf8'), shorter = text.replace(/.*table_tennis_2.*\n/, '');
  const begin = Date.now();
  fs.writeFileSync(scene, shorter);
  await page.waitForFunction(`window.carom && carom.viewer && carom.viewer.motion.balls.length === ${balls - 1}` +
                             ' && carom.viewer.t === 0.7 && carom.viewer.eye.free', {timeout: 120000});
  const drawn = Date.now() - begin;
  check('a saved scene is shown at the same instant from the same place', true, `${drawn} ms, drawn without a GPU`);

  // When the server has the new page: what the browser takes to draw is not its concern.
  const revision = async () => (await fetch(address + 'revision')).text();
  const before = await revision(), saved = Date.now();
  fs.writeFileSync(scene, text.replace('balls:', 'bals:'));
  while ((await revision()) === before && Date.now() - saved < 60000)
    await new Promise((done) => setTimeout(done, 20));
  check('it is read again', (await revision()) !== before, `after ${Date.now() - saved} ms`);
  await page.waitForFunction("document.body.textContent.includes('did you mean')", {timeout: 60000});
  const wrong = await page.evaluate(() => document.querySelector('pre').textContent);
  check('mistakes are shown with their lines', /edited\.yaml:\d+:\d+: error/.test(wrong), wrong.split('\n')[0]);
  fs.writeFileSync(scene, text);
  await page.waitForFunction(`window.carom && carom.viewer && carom.viewer.motion.balls.length === ${balls}`,
                             {timeout: 120000});
  check('and are gone when it is right', true);
  check('no word on the console', said.length === 0, said.join(' | '));
  server.kill('SIGINT');
  await page.waitForFunction("!document.getElementById('lost').hidden", {timeout: 60000});
  check('the page says when the server has ended', true);
  await browser.close();
  checks.end();
};
main().catch((error) => {
  console.error(error);
  process.exit(1);
});
