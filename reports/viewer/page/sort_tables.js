// Tables that a click on a head, or Enter on it, sorts: ascending, descending, as they were.

const collator = new Intl.Collator('en', {numeric: true, sensitivity: 'base'});

/** The number of a cell: what the page states (data-value), else the number that the text begins with; NaN without any. */
export function numberOf(text, stated) {
  if (stated !== undefined && stated !== null && stated !== '') return Number(stated);
  const match = /^\s*[-+]?(\d[\d,]*\.?\d*|\.\d+)(e[-+]?\d+)?(?=$|[\s%([])/i.exec(text); // not the 2 of a case '2-boxes'
  return match ? Number(match[0].replaceAll(',', '')) : NaN;
}

/** How two cells compare: numbers before texts, and a missing figure ("-") after all, whatever the direction. */
export function compareCells(a, b, direction) {
  const rank = (cell) => (Number.isNaN(cell.number) ? (/^-?(\s|$)/.test(cell.text) ? 2 : 1) : 0);
  if (rank(a) !== rank(b)) return rank(a) - rank(b);
  if (rank(a) === 2) return 0;
  return direction * (rank(a) === 0 ? a.number - b.number : collator.compare(a.text, b.text));
}

/**
 * The order of rows by a column; equal ones stay as they are. Figures of different units are not compared: in a table
 * with several figures (`figureColumn`), a column of figures is sorted within each of them.
 */
export function orderRows(rows, column, direction, figureColumn = -1) {
  const places = new Map();
  const place = (row) => {
    const figure = row[figureColumn].text;
    if (!places.has(figure)) places.set(figure, places.size);
    return places.get(figure);
  };
  const grouped = figureColumn >= 0 && column > figureColumn;
  const groups = grouped ? rows.map(place) : rows.map(() => 0);
  const order = rows.map((_, n) => n);
  return order.sort((a, b) => groups[a] - groups[b] ||
    compareCells(rows[a][column], rows[b][column], direction) || a - b);
}

const nextDirection = {0: 1, 1: -1, '-1': 0};
const ariaSort = {0: 'none', 1: 'ascending', '-1': 'descending'};

function cellsOf(row) {
  return [...row.cells].map((cell) => {
    const text = cell.textContent.trim();
    return {text, number: numberOf(text, cell.dataset.value)};
  });
}

/** Puts a button into every head of a table. */
export function makeSortable(table) {
  const body = table.tBodies[0];
  const heads = [...table.tHead.rows[0].cells];
  const original = [...body.rows];
  if (original.length < 2) return;
  const cells = original.map(cellsOf);
  const figureColumn = Number(table.dataset.figures ?? -1);
  let sorted = {column: -1, direction: 0};
  const sortBy = (column) => {
    const direction = column === sorted.column ? nextDirection[sorted.direction] : 1;
    sorted = {column, direction};
    const order = direction === 0 ? original.map((_, n) => n) : orderRows(cells, column, direction, figureColumn);
    body.append(...order.map((n) => original[n]));
    heads.forEach((head, n) => head.setAttribute('aria-sort', ariaSort[n === column ? direction : 0]));
  };
  heads.forEach((head, column) => {
    const button = head.ownerDocument.createElement('button');
    button.type = 'button';
    button.className = 'sort';
    button.append(...head.childNodes);
    button.addEventListener('click', () => sortBy(column));
    head.append(button);
    head.setAttribute('aria-sort', 'none');
  });
}

if (typeof document !== 'undefined') {
  document.querySelectorAll('table.sortable').forEach(makeSortable);
}
