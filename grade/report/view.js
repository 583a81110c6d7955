// The grades of a class: a table that is sorted and filtered, and what is known of the submission chosen from
// it. Both the report of `farol grade` and the web page show it.

/** Its words, by the ids of the message catalogue without "part.page/" (grade/report/messages.h). */
const english = {
  'all-equal': 'The pictures are equal',
  'and-more': '{list} and {count} more',
  'as-reference': 'as the reference',
  'causes': 'Causes',
  'choose': 'Choose a submission: click it, or use the arrow keys; / goes to the filter',
  'costs-nothing': 'costs nothing',
  'coverage': 'objects elsewhere {share} %',
  'depth': 'other depth {share} %',
  'details': 'Details',
  'diagnostics': 'Diagnostics',
  'diagnostics-cost': 'Diagnostics cost {points} points',
  'difference': 'difference',
  'difference-caption': 'difference: black none, white most',
  'differs': 'Differs: {share} %',
  'earns-nothing': 'earns nothing',
  'equal': 'equal',
  'error': 'error',
  'failed': 'failed',
  'filter': 'Filter',
  'filter-hint': 'name, finding, passed, failed',
  'finding': 'First finding',
  'flip': 'FLIP mean {mean}, 95th percentile {percentile}',
  'info': 'info',
  'line': 'line {line}',
  'lines': 'lines {lines}',
  'median': 'median {median} of {most} points',
  'no-match': 'No submission matches',
  'no-submissions': 'no submissions',
  'normals': 'other normals {share} %',
  'not-graded': 'not graded',
  'not-graded-reason': 'Not graded: {reason}',
  'not-seen': 'costs nothing: it cannot be seen',
  'nothing-differs': 'Nothing was found that differs',
  'one-submission': '1 submission',
  'passed': 'passed',
  'passed-count': '{count} passed',
  'pictures': 'Pictures',
  'points': 'Points',
  'points-of': '{points} of {most} points',
  'reference': 'reference',
  'result': 'Result',
  'share-shown': 'Share of the submission that is shown',
  'similarity': 'The image shows {share} % of the reference',
  'submission': 'submission',
  'submission-head': 'Submission',
  'submissions': 'Submissions',
  'submissions-count': '{count} submissions',
  'title': 'Grades: {title}',
  'unexplained': 'Unexplained: the pictures still differ when all of this is corrected (−{points})',
  'unread-count': '{count} could not be graded',
  'warning': 'warning',
};
let words = english;
/** A word of the page in its language, with the values of its placeholders. */
const say = (id, values = {}) => words[id].replace(/\{([a-z]+)\}/g, (all, name) => values[name]);

/** Why most points were lost, where no finding says it. */
function mostLost(one) {
  const lost = one.tasks.flatMap((task) => task.grade ? task.grade.criteria : []).filter((entry) => entry.points < entry.most);
  lost.sort((a, b) => (b.most - b.points) - (a.most - a.points));
  return lost.length ? lost[0].reason : '';
}
/** Why a task has no mark; grades of earlier versions have their first error alone. */
function reasonOf(grade) {
  if (grade.reason) return grade.reason.message;
  return grade.diagnostics.filter((d) => d.severity === 'error').map((d) => d.message)[0] || '';
}
/** The submission with what the table shows of it and what the filter looks into. */
function rowOf(one, index) {
  const findings = one.tasks.flatMap((task) => task.grade ? task.grade.findings : []);
  const costly = findings.filter((finding) => finding.points > 0);
  const failure = one.tasks.find((task) => task.failure);
  const refused = one.tasks.find((task) => task.grade && task.grade.refused);
  const first = failure ? failure.failure.message
    : refused ? reasonOf(refused.grade)
    : costly.length ? costly[0].message : mostLost(one);
  const unread = one.tasks.length > 0 && one.tasks.every((task) => task.failure || task.grade && task.grade.refused);
  // A submission that could not be graded is not wrong: it wants a look, or a letter.
  const result = one.state || say(one.passed ? 'passed' : unread ? 'not-graded' : 'failed');
  const text = [one.id, one.name, one.identifier || '', result, first]
    .concat(findings.map((finding) => finding.message + ' ' + finding.code)).join(' ').toLowerCase();
  return {...one, index, first, unread, result, text};
}

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

/** Both pictures in one frame, the submission over the reference as far as the slider says. */
function slider(given, expected) {
  const over = make('img', {class: 'over', src: given, alt: say('submission')});
  const line = make('hr');
  const frame = make('div', {class: 'compare'}, make('img', {src: expected, alt: say('reference')}), over, line,
    make('span', {class: 'left'}, say('submission')), make('span', {class: 'right'}, say('reference')));
  const share = make('input', {type: 'range', min: 0, max: 100, value: 50, 'aria-label': say('share-shown')});
  const slide = () => {
    over.style.clipPath = `inset(0 ${100 - share.value}% 0 0)`;
    line.style.left = share.value + '%';
  };
  share.addEventListener('input', slide);
  const follow = (event) => {
    if (!(event.buttons & 1)) return;
    const {left, width} = frame.getBoundingClientRect();
    share.value = Math.round(100 * (event.clientX - left) / width);
    slide();
  };
  frame.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    frame.setPointerCapture(event.pointerId);
    follow(event);
  });
  frame.addEventListener('pointermove', follow);
  slide();
  return [frame, make('div', {class: 'controls'}, share)];
}

function comparison(task) {
  const theirs = task.references(), mine = task.pictures(), views = task.grade.views;
  if (!views.length) return '';
  const shares = (view) => view.difference === undefined ? '' : [
    say('differs', {share: number(100 * view.difference)}),
    view.flip && say('flip', {mean: view.flip.mean.toFixed(3), percentile: view.flip.p95.toFixed(3)}),
    view.ssim !== undefined && `SSIM ${view.ssim.toFixed(3)}`,
    view.coverage !== undefined && say('coverage', {share: number(100 * view.coverage)}),
    view.depth !== undefined && say('depth', {share: number(100 * view.depth)}),
    view.normals !== undefined && say('normals', {share: number(100 * view.normals)}),
  ].filter(Boolean).join(' · ');
  const box = make('div'), tabs = make('div', {class: 'tabs'}), stage = make('div');
  const show = (index) => {
    [...tabs.children].forEach((tab, i) => tab.setAttribute('aria-pressed', String(i === index)));
    const view = views[index], expected = theirs[index] || theirs[0];
    const given = mine[2 * index] || expected, heat = mine[2 * index + 1];
    const figure = (src, alt, caption) => src ? make('figure', {}, make('img', {src, alt}), make('figcaption', {}, caption)) : '';
    stage.replaceChildren(...(expected ? slider(given, expected) : []),
      make('p', {class: 'dim'}, expected && given === expected && !heat ? say('all-equal') + '.' : shares(view)),
      make('div', {class: 'side'}, figure(expected, say('reference'), say('reference')), figure(given, say('submission'), say('submission')),
        figure(heat, say('difference'), say('difference-caption'))));
  };
  views.forEach((view, index) => tabs.append(make('button', {type: 'button', onclick: () => show(index)}, view.name,
    view.difference === undefined ? '' : make('span', {class: 'dim'}, view.difference ? ` ${number(100 * view.difference)} %` : ' ' + say('equal')))));
  box.append(make('h3', {}, say('pictures')), tabs, stage);
  // What differs most is seen first.
  show(views.reduce((most, view, index) => view.difference > views[most].difference ? index : most, 0));
  return box;
}

function excerpt(text) {
  const block = make('pre');
  block.tabIndex = 0;  // long lines scroll, by the keyboard too
  for (const line of text.split('\n')) {
    if (!line) continue;
    block.append(/^\d+ > /.test(line) ? make('b', {}, line) : line + '\n');
  }
  return block;
}

/** What a cause costs; what is missing earns nothing, and what nobody sees costs nothing. */
function costText(finding) {
  if (finding.points > 0) return `−${number(finding.points)}`;
  return say(finding.seen === false ? 'not-seen' : finding.code.endsWith('.missing') ? 'earns-nothing' : 'costs-nothing');
}

/** The lines at every place of a cause, three at most. */
function excerptsOf(finding) {
  const texts = [finding.excerpt, ...(finding.places || []).map((place) => place.excerpt)].filter(Boolean);
  return texts.slice(0, 3).map(excerpt);
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
  const first = lines.slice(0, 12).join(', ');
  const listed = lines.length > 12 ? say('and-more', {list: first, count: lines.length - 12}) : first;
  const text = lines.length > 1 ? say('lines', {lines: listed}) : say('line', {line: listed});
  return make('span', {class: 'dim'}, ` ${file ? file + ', ' : ''}${text}`);
}

/** Styles are set by the script: the web page's policy allows no attributes of them. */
function bar(percent) {
  const filled = make('i');
  filled.style.width = `${percent}%`;
  return filled;
}

/** A requirement or a part that a person marks: its text, how far it is met, and the lines that show it. */
function requirement(entry) {
  const lines = (entry.matches || []).map((thing) => thing.line).filter(Boolean);
  return make('td', {}, entry.text, ' ',
    make('strong', {class: entry.state === 'met' || entry.state === 'marked' ? 'good' : entry.state === 'open' ? 'dim' : 'bad'}, entry.state),
    make('span', {class: 'dim'}, ` ${entry.reason || ''}`), place({lines}));
}

/** All that is known of a submission, as elements. */
function detailOf(one) {
  if (!one.tasks.length) return [make('h2', {}, one.name || one.id), make('p', {class: 'dim'}, one.result)];
  const parts = [make('h2', {}, one.name || one.id),
    make('p', {}, make('strong', {class: one.passed ? 'good' : 'bad'}, one.unread ? say('not-graded') : say('points-of', {points: number(one.points), most: number(one.most)})), make('span', {class: 'dim'}, ' · ' + [one.identifier, one.id].filter(Boolean).join(' · ')))];
  one.tasks.forEach((task) => {
    if (task.task) parts.push(make('h3', {}, task.task));
    if (task.failure) {
      parts.push(make('p', {class: 'bad'}, task.failure.message + (task.failure.code ? ` [${task.failure.code}]` : '')));
      return;
    }
    const grade = task.grade;
    if (grade.findings.length) {
      parts.push(make('h3', {}, say('causes')), make('ul', {class: 'findings'}, ...grade.findings.map((finding) =>
        make('li', {}, finding.message, ' ',
          make('span', {class: finding.points > 0 ? 'bad' : 'dim'}, costText(finding)), ...excerptsOf(finding)))));
    }
    if (grade.unexplained && grade.unexplained.points > 0)
      parts.push(make('p', {class: 'bad'}, say('unexplained', {points: number(grade.unexplained.points)}) + '.'));
    if (grade.diagnostics.length)
      parts.push(make('h3', {}, say('diagnostics')), make('ul', {class: 'findings'}, ...merged(grade.diagnostics).map((entry) =>
        make('li', {}, make('span', {class: entry.severity === 'error' ? 'bad' : 'dim'}, say(entry.severity) + ': '), entry.message, place(entry),
          entry.excerpt ? excerpt(entry.excerpt) : ''))));
    if (grade.refused) {
      parts.push(make('p', {class: 'bad'}, say('not-graded-reason', {reason: reasonOf(grade)}) + '.'));
      if (grade.similarity !== undefined)
        parts.push(make('p', {}, say('similarity', {share: number(100 * grade.similarity)}) + '.'), comparison(task));
      return;
    }
    if (!grade.findings.length && !grade.diagnostics.length && grade.points === grade.most)
      parts.push(make('p', {class: 'good'}, say('nothing-differs') + '.'));
    parts.push(comparison(task));
    parts.push(make('h3', {}, say('points')), make('table', {class: 'points'}, ...grade.criteria.map((entry) =>
      make('tr', {}, make('td', {}, entry.measure),
        make('td', {}, make('div', {class: 'bar'}, bar(entry.most ? 100 * entry.points / entry.most : 0))),
        make('td', {}, entry.state === 'open' ? `open / ${number(entry.most)}` : `${number(entry.points)} / ${number(entry.most)}`),
        entry.text ? requirement(entry) : make('td', {class: 'dim'}, entry.reason)))));
    if (grade.penalty) parts.push(make('p', {class: 'bad'}, say('diagnostics-cost', {points: number(grade.penalty)}) + '.'));
  });
  return parts.filter(Boolean);
}

/** "5 submissions, 3 passed, 1 could not be graded, median 61 of 100 points", of those that were graded. */
function summaryOf(all) {
  const graded = all.filter((one) => one.tasks.length);
  if (!graded.length) return all.length ? '' : say('no-submissions');
  const points = graded.filter((one) => !one.unread).map((one) => one.points).sort((a, b) => a - b);
  const middle = points.length >> 1, median = points.length % 2 ? points[middle] : (points[middle - 1] + points[middle]) / 2;
  const unread = graded.filter((one) => one.unread).length, most = Math.max(...graded.map((one) => one.most));
  const passed = graded.filter((one) => one.passed).length;
  return [graded.length > 1 ? say('submissions-count', {count: graded.length}) : say('one-submission'), say('passed-count', {count: passed}),
    unread && say('unread-count', {count: unread}),
    points.length && say('median', {median: number(median), most: number(most)})].filter(Boolean).join(', ');
}

/**
 * Puts the summary and the filter into `head`, the table and the details into `body`, and listens to keys in
 * `keys`. `show` takes the submissions, `{id, name, identifier, points, most, passed, state, tasks}` (state: why
 * there are no tasks yet), `choose` the number of one. Tasks hold a grade or a failure, and give pictures, two a view.
 * `translation` has the words of another language by their ids.
 */
export function gradesView({head, body, keys, chosen = () => {}, translation = {}}) {
  words = {...english, ...translation};
  const summary = make('p', {id: 'summary'});
  const filter = make('input', {id: 'filter', type: 'search', placeholder: say('filter-hint'), autocomplete: 'off'});
  const names = {name: say('submission-head'), points: say('points'), result: say('result'), first: say('finding')};
  const heads = Object.keys(names).map((key) => make('th', {'aria-sort': 'none', 'data-key': key},
    make('button', {type: 'button', onclick: () => sortBy(key)}, names[key])));
  const rows = make('tbody'), none = make('p', {hidden: ''}, say('no-match') + '.');
  const detail = make('section', {id: 'detail', 'aria-label': say('details'), 'aria-live': 'polite', tabindex: '-1'}, make('p', {class: 'hint'},
    say('choose') + '.'));
  head.append(summary, make('label', {}, say('filter') + ' ', filter));
  body.append(make('section', {id: 'list', 'aria-label': say('submissions')},
    make('table', {}, make('thead', {}, make('tr', {}, ...heads)), rows), none), detail);
  const state = {key: 'name', up: true, chosen: -1, all: [], shown: []};

  function list() {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    state.shown = state.all.filter((one) => words.every((word) => one.text.includes(word)));
    const value = (one) => state.key === 'name' ? (one.name || one.id).toLowerCase() : one[state.key];
    state.shown.sort((a, b) => {
      const x = value(a), y = value(b);
      const order = typeof x === 'string' ? x.localeCompare(y) : Number(x) - Number(y);
      return (state.up ? order : -order) || a.index - b.index;
    });
    rows.replaceChildren(...state.shown.map((one) => make('tr', {
      tabindex: one.index === state.chosen || (state.chosen < 0 && one === state.shown[0]) ? '0' : '-1',
      'aria-selected': String(one.index === state.chosen), 'data-index': one.index,
      onclick: () => choose(one.index),
    }, make('td', {}, one.name || one.id,
            one.name ? make('div', {class: 'dim'}, one.identifier || one.id) : ''),
       make('td', {}, one.unread ? '–' : one.most ? `${number(one.points)} / ${number(one.most)}` : '–'),
       make('td', {class: one.state ? 'dim' : one.passed ? 'good' : 'bad'}, one.result),
       one.first ? make('td', {}, one.first)
         : make('td', {class: 'dim'}, one.tasks.length && one.points === one.most ? say('as-reference') : '–'))));
    none.hidden = state.shown.length > 0 || state.all.length === 0;
    for (const cell of heads) cell.setAttribute('aria-sort', cell.dataset.key !== state.key ? 'none' : state.up ? 'ascending' : 'descending');
  }

  function sortBy(key) {
    state.up = state.key === key ? !state.up : key !== 'points';
    state.key = key;
    list();
  }

  function choose(index, focus = true) {
    state.chosen = index;
    for (const row of rows.children) {
      const here = Number(row.dataset.index) === index;
      row.setAttribute('aria-selected', String(here));
      row.tabIndex = here ? 0 : -1;
      if (here && focus) row.focus();
    }
    detail.replaceChildren(...detailOf(state.all[index]));
    chosen(state.all[index]);
  }

  filter.addEventListener('input', list);
  keys.addEventListener('keydown', (event) => {
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
  return {
    choose,
    show(all) {
      const before = state.all[state.chosen];
      state.all = all.map(rowOf);
      state.chosen = before ? state.all.findIndex((one) => one.id === before.id) : -1;
      summary.textContent = summaryOf(state.all);
      list();
      // What is read is not drawn anew unless it has changed.
      const after = state.all[state.chosen];
      if (before && !after) detail.replaceChildren();
      else if (after && after.tasks !== before.tasks) detail.replaceChildren(...detailOf(after));
    },
  };
}
