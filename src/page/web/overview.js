'use strict';
// Sorts the table of runs by the column whose head is clicked: numbers by size, texts by the alphabet.
for (const table of document.querySelectorAll('table#runs')) {
  const heads = [...table.querySelectorAll('thead th')], body = table.querySelector('tbody');
  heads.forEach((head, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener('click', () => {
      const falls = head.getAttribute('aria-sort') === 'ascending';
      heads.forEach((other) => other.removeAttribute('aria-sort'));
      head.setAttribute('aria-sort', falls ? 'descending' : 'ascending');
      const value = (row) => row.cells[column].textContent;
      const compared = (a, b) => {
        const [x, y] = [value(a), value(b)], difference = Number(x) - Number(y);
        if (x === '' || y === '') return (x === '') - (y === '');  // what is missing comes last
        const order = Number.isNaN(difference) ? x.localeCompare(y, 'en') : difference;
        return falls ? -order : order;
      };
      body.append(...[...body.rows].sort(compared));
    });
  });
}
