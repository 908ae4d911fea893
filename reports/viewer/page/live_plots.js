// Plots that answer to the mouse, a finger and the keyboard: a mark shows its job and figures, and an entry of the legend
// hides its series. They are the static SVG of the page; without this script marks have the browser's own tips.

const REACH_PX = 22; // how far from a mark a pointer may be

/** The number of the nearest point within a distance of a place; -1: none is. Points are {x, y}. */
export function nearestPoint(points, x, y, reach = REACH_PX) {
  let best = -1;
  let bestSquare = reach * reach;
  points.forEach((point, n) => {
    const square = (point.x - x) ** 2 + (point.y - y) ** 2;
    if (square <= bestSquare) {
      best = n;
      bestSquare = square;
    }
  });
  return best;
}

/** Where a tip of a size stands beside a place, whole within a window. */
export function tipPlace(x, y, size, window_) {
  const gap = 14;
  const left = x + gap + size.width <= window_.width ? x + gap : x - gap - size.width;
  const top = y + gap + size.height <= window_.height ? y + gap : y - gap - size.height;
  return {left: Math.max(4, Math.min(left, window_.width - size.width - 4)), top: Math.max(4, top)};
}

class Tip {
  constructor(document_) {
    this.element = document_.createElement('div');
    this.element.className = 'tip';
    this.element.setAttribute('role', 'status');
    this.element.hidden = true;
    document_.body.append(this.element);
  }

  show(mark, x, y) {
    this.mark?.classList.remove('marked');
    this.mark = mark;
    mark.classList.add('marked');
    this.element.textContent = mark.dataset.tip;
    this.element.hidden = false;
    const {left, top} = tipPlace(x, y, this.element.getBoundingClientRect(),
      {width: document.documentElement.clientWidth, height: innerHeight});
    this.element.style.left = `${left}px`;
    this.element.style.top = `${top}px`;
  }

  hide() {
    this.mark?.classList.remove('marked');
    this.mark = null;
    this.element.hidden = true;
  }
}

function centre(mark) {
  const box = mark.getBoundingClientRect();
  return {x: box.left + box.width / 2, y: box.top + box.height / 2};
}

/** The browser's own tip becomes ours, lest both show. */
function takeTips(svg) {
  for (const title of svg.querySelectorAll('.mark > title')) {
    const mark = title.parentElement;
    mark.dataset.tip = title.textContent;
    title.remove();
    if (mark.classList.contains('point')) {
      mark.setAttribute('tabindex', '0');
      mark.setAttribute('role', 'img');
      mark.setAttribute('aria-label', mark.dataset.tip);
    }
  }
  svg.querySelector(':scope > title')?.remove();
}

function showTips(svg, tip) {
  const markAt = (event) => {
    const under = event.target.closest?.('.series .mark');
    if (under) return under;
    const points = [...svg.querySelectorAll('.series:not(.off) .point')];
    return points[nearestPoint(points.map(centre), event.clientX, event.clientY)];
  };
  const show = (event) => {
    const mark = markAt(event);
    if (mark) tip.show(mark, event.clientX, event.clientY);
    else tip.hide();
  };
  svg.addEventListener('pointermove', show);
  svg.addEventListener('pointerdown', show);
  svg.addEventListener('pointerleave', (event) => event.pointerType === 'mouse' && tip.hide());
  svg.addEventListener('focusin', (event) => {
    const mark = event.target.closest('.mark');
    if (mark) tip.show(mark, centre(mark).x, centre(mark).y);
  });
  svg.addEventListener('focusout', () => tip.hide());
}

/** Entries of the legend are switches of their series; while the pointer is on one, the others fade. */
function liveLegend(svg, tip) {
  const allSeries = [...svg.querySelectorAll('.series')];
  for (const key of svg.querySelectorAll('.key')) {
    const own = allSeries.filter((series) => series.dataset.series === key.dataset.series);
    const toggle = () => {
      const off = key.classList.toggle('off');
      own.forEach((series) => series.classList.toggle('off', off));
      key.setAttribute('aria-pressed', String(!off));
      tip.hide();
    };
    const fade = (on) => allSeries.forEach((series) => series.classList.toggle('faded', on && !own.includes(series)));
    key.setAttribute('role', 'button');
    key.setAttribute('tabindex', '0');
    key.setAttribute('aria-pressed', 'true');
    key.addEventListener('click', toggle);
    key.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' || event.key === ' ') {
        event.preventDefault();
        toggle();
      }
    });
    key.addEventListener('pointerenter', (event) => event.pointerType === 'mouse' && fade(true));
    key.addEventListener('pointerleave', () => fade(false));
  }
}

if (typeof document !== 'undefined') {
  const tip = new Tip(document);
  for (const svg of document.querySelectorAll('.plots svg')) {
    takeTips(svg);
    showTips(svg, tip);
    liveLegend(svg, tip);
  }
  document.addEventListener('keydown', (event) => event.key === 'Escape' && tip.hide());
  document.addEventListener('pointerdown', (event) => event.target.closest?.('.plots svg') || tip.hide());
  document.addEventListener('scroll', () => tip.hide(), {passive: true});
}
