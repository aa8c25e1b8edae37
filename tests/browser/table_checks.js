// Pages of `carom report` with a table of runs: of several scenes, or of a sweep.
// usage: node table_checks.js CHROMIUM FOLDER PAGE.html...
'use strict';
const path = require('path');
const {Checks, launch, listen, look} = require('./common.js');
const [, , chromium, folder, ...files] = process.argv;

// In the page: the texts of a column, from top to bottom, after a click on its head.
const sorted = (column) => {
  const head = document.querySelectorAll('#runs thead th')[column];
  head.querySelector('button').click();
  return [...document.querySelectorAll('#runs tbody tr')].map((row) => row.cells[column].textContent);
};

const main = async () => {
  const checks = new Checks('table_checks'), browser = await launch(chromium, folder);
  for (const file of files) {
    const name = path.basename(file, '.html') + '-';
    const page = await browser.newPage(), {said, asked} = listen(page);
    await page.setOfflineMode(true);
    await page.setViewport({width: 1280, height: 900});
    await page.goto('file://' + path.resolve(file));
    const numeric = await page.$$eval('#runs thead th', (all) => all.findIndex((th, i) => i > 0 && th.className === 'n'));
    const rising = (await page.evaluate(sorted, numeric)).map(Number);
    const falling = (await page.evaluate(sorted, numeric)).map(Number);
    checks.check(`a click sorts by numbers, another one the other way (${name})`,
                 rising.length > 1 && rising.every((value, i) => i === 0 || value >= rising[i - 1]) &&
                     falling.every((value, i) => i === 0 || value <= falling[i - 1]), `${rising.length} rows`);
    await look(checks, page, folder, name, () => scrollTo(0, 0));
    checks.check(`no word on the console (${name})`, said.length === 0, said.slice(0, 5).join(' | '));
    checks.check(`no request (${name})`, asked.length === 0, asked.slice(0, 3).join(' '));
    await page.close();
  }
  await browser.close();
  checks.end();
};
main().catch((error) => {
  console.error(error);
  process.exit(1);
});
