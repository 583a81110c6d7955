'use strict';
const read = (element) => JSON.parse(element.textContent);
const about = read(document.getElementById('class'));
/** Why most points were lost, where no finding says it. */
function mostLost(one) {
  const lost = one.tasks.flatMap((task) => task.grade ? task.grade.criteria : []).filter((entry) => entry.points < entry.most);
  lost.sort((a, b) => (b.most - b.points) - (a.most - a.points));
  return lost.length ? lost[0].reason : '';
}
const all = [...document.querySelectorAll('script.submission')].map((element, index) => {
  const one = read(element);
  one.index = index;
  const findings = one.tasks.flatMap((task) => task.grade ? task.grade.findings : []);
  const costly = findings.filter((finding) => finding.points > 0);
  const failure = one.tasks.find((task) => task.failure);
  const refused = one.tasks.find((task) => task.grade && task.grade.refused);
  one.first = failure ? failure.failure.message
    : refused ? refused.grade.diagnostics.filter((d) => d.severity === 'error').map((d) => d.message)[0] || ''
    : costly.length ? costly[0].message : mostLost(one);
  one.unread = Boolean(failure || refused);
  // What could not be graded is not the same as what is wrong: it wants a look, or a letter.
  one.result = one.passed ? 'passed' : one.unread ? 'not graded' : 'failed';
  one.text = [one.id, one.name, one.identifier || '', one.result, one.first]
    .concat(findings.map((finding) => finding.message + ' ' + finding.code)).join(' ').toLowerCase();
  return one;
});
const pictures = (id) => {
  const element = document.getElementById(id);
  return element ? read(element) : [];
};

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== undefined && child !== ''));
  return element;
}
const number = (value) => (Math.round(value * 100) / 100).toString();

const body = document.querySelector('#list tbody');
const state = {key: 'name', up: true, filter: '', chosen: -1, shown: []};

function list() {
  const words = state.filter.toLowerCase().split(/\s+/).filter(Boolean);
  state.shown = all.filter((one) => words.every((word) => one.text.includes(word)));
  const value = (one) => state.key === 'name' ? (one.name || one.id).toLowerCase() : one[state.key];
  state.shown.sort((a, b) => {
    const x = value(a), y = value(b);
    const order = typeof x === 'string' ? x.localeCompare(y) : Number(x) - Number(y);
    return (state.up ? order : -order) || a.index - b.index;
  });
  body.replaceChildren(...state.shown.map((one) => make('tr', {
    tabindex: one.index === state.chosen || (state.chosen < 0 && one === state.shown[0]) ? '0' : '-1',
    'aria-selected': String(one.index === state.chosen), 'data-index': one.index,
    onclick: () => choose(one.index),
  }, make('td', {}, one.name || one.id,
          one.name ? make('div', {class: 'dim'}, one.identifier || one.id) : ''),
     make('td', {}, `${number(one.points)} / ${number(one.most)}`),
     make('td', {class: one.passed ? 'good' : 'bad'}, one.result),
     one.first ? make('td', {}, one.first) : make('td', {class: 'dim'}, one.points === one.most ? 'as the reference' : '–'))));
  document.getElementById('none').hidden = state.shown.length > 0;
  for (const head of document.querySelectorAll('th')) {
    const key = head.firstElementChild.dataset.key;
    head.setAttribute('aria-sort', key !== state.key ? 'none' : state.up ? 'ascending' : 'descending');
  }
}

function choose(index, focus = true) {
  state.chosen = index;
  for (const row of body.children) {
    const here = Number(row.dataset.index) === index;
    row.setAttribute('aria-selected', String(here));
    row.tabIndex = here ? 0 : -1;
    if (here && focus) row.focus();
  }
  history.replaceState(null, '', '#' + encodeURIComponent(all[index].id));
  detail(all[index]);
}

function comparison(one, task, taskIndex) {
  const theirs = pictures('r' + taskIndex), mine = pictures(`p${one.index}-${taskIndex}`);
  const views = task.grade.views;
  if (!views.length) return '';
  const shares = (view) => [
    `Differs: ${number(100 * view.difference)} %`,
    view.flip && `FLIP mean ${view.flip.mean.toFixed(3)}, 95th percentile ${view.flip.p95.toFixed(3)}`,
    view.ssim !== undefined && `SSIM ${view.ssim.toFixed(3)}`,
    view.coverage !== undefined && `objects elsewhere ${number(100 * view.coverage)} %`,
    view.depth !== undefined && `other depth ${number(100 * view.depth)} %`,
    view.normals !== undefined && `other normals ${number(100 * view.normals)} %`,
  ].filter(Boolean).join(' · ');
  const box = make('div'), tabs = make('div', {class: 'tabs'}), stage = make('div');
  const show = (index) => {
    [...tabs.children].forEach((tab, i) => tab.setAttribute('aria-pressed', String(i === index)));
    const view = views[index], expected = theirs[index] || theirs[0];
    const given = mine[2 * index] || expected, heat = mine[2 * index + 1];
    const over = make('img', {class: 'over', src: given, alt: 'submission'});
    const line = make('hr');
    const frame = make('div', {class: 'compare'}, make('img', {src: expected, alt: 'reference'}), over, line,
      make('span', {class: 'left'}, 'submission'), make('span', {class: 'right'}, 'reference'));
    const slider = make('input', {type: 'range', min: 0, max: 100, value: 50, 'aria-label': 'Share of the submission that is shown'});
    const slide = () => {
      over.style.clipPath = `inset(0 ${100 - slider.value}% 0 0)`;
      line.style.left = slider.value + '%';
    };
    slider.addEventListener('input', slide);
    const follow = (event) => {
      if (!(event.buttons & 1)) return;
      const {left, width} = frame.getBoundingClientRect();
      slider.value = Math.round(100 * (event.clientX - left) / width);
      slide();
    };
    frame.addEventListener('pointerdown', (event) => {
      event.preventDefault();
      frame.setPointerCapture(event.pointerId);
      follow(event);
    });
    frame.addEventListener('pointermove', follow);
    slide();
    stage.replaceChildren(frame, make('div', {class: 'controls'}, slider),
      make('p', {class: 'dim'}, given === expected && !heat ? 'The pictures are equal.'
        : shares(view)),
      make('div', {class: 'side'},
        make('figure', {}, make('img', {src: expected, alt: 'reference'}), make('figcaption', {}, 'reference')),
        make('figure', {}, make('img', {src: given, alt: 'submission'}), make('figcaption', {}, 'submission')),
        heat ? make('figure', {}, make('img', {src: heat, alt: 'difference'}), make('figcaption', {}, 'difference: black none, white most')) : ''));
  };
  views.forEach((view, index) => tabs.append(make('button', {type: 'button', onclick: () => show(index)}, view.name,
    make('span', {class: 'dim'}, view.difference ? ` ${number(100 * view.difference)} %` : ' equal'))));
  box.append(make('h3', {}, 'Pictures'), tabs, stage);
  // What differs most is seen first.
  show(views.reduce((most, view, index) => view.difference > views[most].difference ? index : most, 0));
  return box;
}

function excerpt(text) {
  const block = make('pre');
  for (const line of text.split('\n')) {
    if (!line) continue;
    block.append(/^\d+ > /.test(line) ? make('b', {}, line) : line + '\n');
  }
  return block;
}

/** Diagnostics of one message as one, with all their lines. */
function merged(diagnostics) {
  const found = new Map();
  for (const entry of diagnostics) {
    const key = entry.severity + entry.message, known = found.get(key);
    if (!known) found.set(key, {...entry, lines: entry.line ? [entry.line] : []});
    else if (entry.line) known.lines.push(entry.line);
  }
  return [...found.values()];
}

function place({file, lines}) {
  if (!lines.length) return '';
  const listed = lines.slice(0, 12).join(', ') + (lines.length > 12 ? ` and ${lines.length - 12} more` : '');
  return make('span', {class: 'dim'}, ` ${file ? file + ', ' : ''}line${lines.length > 1 ? 's' : ''} ${listed}`);
}

function detail(one) {
  const parts = [make('h2', {}, one.name || one.id),
    make('p', {}, make('strong', {class: one.passed ? 'good' : 'bad'}, `${number(one.points)} of ${number(one.most)} points`),
      one.unread ? ' · not graded' : '', make('span', {class: 'dim'}, ' · ' + [one.identifier, one.id].filter(Boolean).join(' · ')))];
  one.tasks.forEach((task, index) => {
    if (task.task) parts.push(make('h3', {}, task.task));
    if (task.failure) {
      parts.push(make('p', {class: 'bad'}, `${task.failure.message} [${task.failure.code}]`));
      return;
    }
    const grade = task.grade;
    if (grade.findings.length) {
      parts.push(make('h3', {}, 'Findings'), make('ul', {class: 'findings'}, ...grade.findings.map((finding) =>
        make('li', {}, finding.message, ' ',
          make('span', {class: finding.points > 0 ? 'bad' : 'dim'}, finding.points > 0 ? `−${number(finding.points)}` : 'costs nothing'),
          finding.excerpt ? excerpt(finding.excerpt) : ''))));
    }
    if (grade.diagnostics.length)
      parts.push(make('h3', {}, 'Diagnostics'), make('ul', {class: 'findings'}, ...merged(grade.diagnostics).map((entry) =>
        make('li', {}, make('span', {class: entry.severity === 'error' ? 'bad' : 'dim'}, entry.severity + ': '), entry.message, place(entry),
          entry.excerpt ? excerpt(entry.excerpt) : ''))));
    if (grade.refused) {
      parts.push(make('p', {}, 'It could not be read: there is nothing to compare, and no criterion gives points.'));
      return;
    }
    if (!grade.findings.length && !grade.diagnostics.length && grade.points === grade.most)
      parts.push(make('p', {class: 'good'}, 'Nothing was found that differs.'));
    parts.push(comparison(one, task, index));
    parts.push(make('h3', {}, 'Points'), make('table', {class: 'points'}, ...grade.criteria.map((entry) =>
      make('tr', {}, make('td', {}, entry.measure),
        make('td', {}, make('div', {class: 'bar'}, make('i', {style: `width:${entry.most ? 100 * entry.points / entry.most : 0}%`}))),
        make('td', {}, `${number(entry.points)} / ${number(entry.most)}`), make('td', {class: 'dim'}, entry.reason)))));
    if (grade.penalty) parts.push(make('p', {class: 'bad'}, `Diagnostics cost ${number(grade.penalty)} points.`));
  });
  document.getElementById('detail').replaceChildren(...parts.filter(Boolean));
}

document.getElementById('title').textContent = about.title;
document.title = `Grades: ${about.title}`;
const points = all.map((one) => one.points).sort((a, b) => a - b);
const middle = points.length >> 1, median = points.length % 2 ? points[middle] : (points[middle - 1] + points[middle]) / 2;
const unread = all.filter((one) => one.unread).length;
document.getElementById('summary').textContent = all.length
  ? `${all.length} submission${all.length > 1 ? 's' : ''}, ${all.filter((one) => one.passed).length} passed, ` +
    (unread ? `${unread} could not be graded, ` : '') + `median ${number(median)} of ${number(all[0].most)} points`
  : 'no submissions';
const filter = document.getElementById('filter');
filter.addEventListener('input', () => { state.filter = filter.value; list(); });
for (const button of document.querySelectorAll('th button'))
  button.addEventListener('click', () => {
    state.up = state.key === button.dataset.key ? !state.up : button.dataset.key !== 'points';
    state.key = button.dataset.key;
    list();
  });
document.addEventListener('keydown', (event) => {
  // Up and down go to the next submission from the slider too: left and right move it.
  const sliding = event.target.type === 'range' && /^Arrow(Up|Down)$/.test(event.key);
  if (event.target instanceof HTMLInputElement && !sliding) {
    if (event.key === 'Escape') event.target.blur();
    return;
  }
  if (event.key === '/') {
    event.preventDefault();
    filter.focus();
    return;
  }
  const step = {ArrowDown: 1, j: 1, ArrowUp: -1, k: -1}[event.key];
  if (!step || !state.shown.length || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  const at = state.shown.findIndex((one) => one.index === state.chosen);
  const next = Math.min(state.shown.length - 1, Math.max(0, at < 0 ? 0 : at + step));
  choose(state.shown[next].index);
});
list();
const wanted = all.find((one) => '#' + encodeURIComponent(one.id) === location.hash);
if (wanted) choose(wanted.index, false);
