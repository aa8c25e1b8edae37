// What the checks in headless Chromium share.
'use strict';
const fs = require('fs'), path = require('path');

// Says of each check whether it holds, and at the end how many did.
exports.Checks = class {
  constructor(name) {
    this.name = name;
    this.failed = this.passed = 0;
  }

  check(what, ok, detail = '') {
    ok ? ++this.passed : ++this.failed;
    console.log(`${ok ? 'ok  ' : 'FAIL'} ${what}${detail === '' ? '' : ': ' + detail}`);
  }

  end() {
    console.log(`${this.name}: ${this.passed} passed, ${this.failed} failed`);
    process.exit(this.failed ? 1 : 0);
  }
};

// `folder` holds node_modules.
exports.launch = (chromium, folder) => require(path.join(folder, 'node_modules', 'puppeteer-core')).launch({
  executablePath: chromium, headless: true,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
         '--ignore-gpu-blocklist', '--disable-background-networking'],
});

// What a page says on its console, and what it asks of a network.
exports.listen = (page) => {
  const said = [], asked = [];
  page.on('console', (message) => {
    if (['error', 'warning', 'warn'].includes(message.type())) said.push(message.text());
  });
  page.on('pageerror', (error) => said.push(String(error)));
  page.on('request', (request) => {
    if (!/^(data|blob|file):/.test(request.url())) asked.push(request.url());
  });
  return {said, asked};
};

// axe, widths and screenshots (FOLDER/NAMEdesktop-light.png ...), in light and dark. `prepare` runs
// in the page before each picture.
exports.look = async (checks, page, folder, name, prepare, argument) => {
  for (const scheme of ['light', 'dark']) {
    await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
    // The policy lets no script in from outside; the debugger's own evaluation is none.
    await page.evaluate(fs.readFileSync(path.join(folder, 'node_modules/axe-core/axe.min.js'), 'utf8'));
    const {violations} = await page.evaluate(() => axe.run(document));
    checks.check(`axe finds nothing (${name}${scheme})`, violations.length === 0,
                 violations.map((v) => `${v.id} ${v.nodes.slice(0, 2).map((n) => n.html.slice(0, 90))}`).join('; '));
    for (const [screen, width, height] of [['desktop', 1280, 900], ['phone', 390, 844]]) {
      await page.setViewport({width, height});
      await page.evaluate(prepare, argument);
      await new Promise((done) => setTimeout(done, 400));
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      checks.check(`nothing reaches beyond the ${screen} (${name}${scheme})`, wide <= width, `${wide} px`);
      await page.screenshot({path: path.join(folder, `${name}${screen}-${scheme}.png`)});
      await page.screenshot({path: path.join(folder, `${name}${screen}-${scheme}-all.png`), fullPage: true});
    }
  }
  await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: 'light'}]);
};
