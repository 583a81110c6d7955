'use strict';
const read = (element) => JSON.parse(element.textContent);
const about = read(document.getElementById('class'));
const all = [...document.querySelectorAll('script.submission')].map((element, index) => {
  const one = read(element);
  one.index = index;
  const findings = one.tasks.flatMap((task) => task.grade ? task.grade.findings : []);
  const costly = findings.filter((finding) => finding.points > 0);
  const failure = one.tasks.find((task) => task.failure);
  const refused = one.tasks.find((task) => task.grade && task.grade.refused);
  one.first = failure ? failure.failure.message
    : refused ? refused.grade.diagnostics.filter((d) => d.severity === 'error').map((d) => d.message)[0] || ''
    : (costly[0] || {}).message || '';
  one.text = [one.id, one.name, one.identifier || '', one.passed ? 'passed' : 'failed', one.first]
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
     make('td', {class: one.passed ? 'good' : 'bad'}, one.passed ? 'passed' : 'failed'),
     make('td', {}, one.first))));
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
    slide();
    stage.replaceChildren(frame, make('div', {class: 'controls'}, slider),
      make('p', {class: 'dim'}, given === expected && !heat ? 'The pictures are equal.'
        : `Differs: ${number(100 * view.difference)} % · FLIP mean ${view.flip.mean.toFixed(3)}, 95th percentile ${view.flip.p95.toFixed(3)}` +
          ` · objects elsewhere ${number(100 * view.coverage)} % · other normals ${number(100 * view.normals)} %`),
      make('div', {class: 'side'},
        make('figure', {}, make('img', {src: expected, alt: 'reference'}), make('figcaption', {}, 'reference')),
        make('figure', {}, make('img', {src: given, alt: 'submission'}), make('figcaption', {}, 'submission')),
        heat ? make('figure', {}, make('img', {src: heat, alt: 'difference'}), make('figcaption', {}, 'difference: black none, white most')) : ''));
  };
  views.forEach((view, index) => tabs.append(make('button', {type: 'button', onclick: () => show(index)}, view.name)));
  box.append(tabs, stage);
  show(0);
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

function place(entry) {
  return entry.line ? make('span', {class: 'dim'}, ` ${entry.file || ''}:${entry.line}`) : '';
}

function detail(one) {
  const parts = [make('h2', {}, one.name || one.id),
    make('p', {}, make('strong', {class: one.passed ? 'good' : 'bad'}, `${number(one.points)} of ${number(one.most)} points`),
      make('span', {class: 'dim'}, ' · ' + [one.identifier, one.id].filter(Boolean).join(' · ')))];
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
      parts.push(make('h3', {}, 'Diagnostics'), make('ul', {class: 'findings'}, ...grade.diagnostics.map((entry) =>
        make('li', {}, make('span', {class: entry.severity === 'error' ? 'bad' : 'dim'}, entry.severity + ': '), entry.message, place(entry)))));
    parts.push(comparison(one, task, index));
    parts.push(make('h3', {}, 'Points'), make('table', {}, ...grade.criteria.map((entry) =>
      make('tr', {}, make('td', {}, entry.measure),
        make('td', {}, make('div', {class: 'bar'}, make('i', {style: `width:${entry.most ? 100 * entry.points / entry.most : 0}%`}))),
        make('td', {}, `${number(entry.points)} / ${number(entry.most)}`), make('td', {class: 'dim'}, entry.reason)))));
    if (grade.penalty) parts.push(make('p', {class: 'bad'}, `Diagnostics cost ${number(grade.penalty)} points.`));
  });
  document.getElementById('detail').replaceChildren(...parts.filter(Boolean));
}

document.getElementById('title').textContent = about.title;
document.title = about.title;
const points = all.map((one) => one.points).sort((a, b) => a - b);
document.getElementById('summary').textContent = all.length
  ? `${all.length} submissions, ${all.filter((one) => one.passed).length} passed, median ${number(points[points.length >> 1])} of ${number(all[0].most)} points`
  : 'no submissions';
const filter = document.getElementById('filter');
filter.addEventListener('input', () => { state.filter = filter.value; list(); });
for (const button of document.querySelectorAll('th button'))
  button.addEventListener('click', () => {
    state.up = state.key === button.dataset.key ? !state.up : button.dataset.key === 'name' || button.dataset.key === 'first';
    state.key = button.dataset.key;
    list();
  });
document.addEventListener('keydown', (event) => {
  if (event.target instanceof HTMLInputElement) {
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
