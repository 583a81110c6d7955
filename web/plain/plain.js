// One page: a gallery of the served scenes and a viewer whose every pixel the server draws.

const $ = (id) => document.getElementById(id);
const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
const degrees = 180 / Math.PI;

// A source draws itself: fetch(options, signal) -> Response.
const servedSource = (scene) => ({
  key: scene.id,
  fetch: (options, signal) =>
    fetch(`${scene.links.image}?${new URLSearchParams(options)}`, { signal }),
});

const uploadedSource = (files, main) => ({
  key: null,
  fetch(options, signal) {
    const body = bodyOf(files, main);
    return fetch(`/v1/render?${new URLSearchParams(options)}`, { method: 'POST', body, signal });
  },
});

function bodyOf(files, main) {
  const body = new FormData();
  body.append('scene', main, main.webkitRelativePath || main.name);
  for (const file of files)
    if (file !== main) body.append('file', file, file.webkitRelativePath || file.name);
  return body;
}

const view = {
  source: null,
  orbit: null,       // { azimuth, elevation, distance, target } or null: the scene's own camera
  home: null,        // the scene's own camera as an orbit
  time: 0,
  animated: false,
  playing: false,
};

let sequence = 0, shown = 0;
let flight = null;             // { controller, moving }
let pending = null;            // 'moving' | 'full'
let restTimer = 0, lastUrl = '';

function options(moving) {
  const box = $('stage').getBoundingClientRect();
  const ratio = clamp(window.devicePixelRatio || 1, 1, 2);
  const out = {
    width: clamp(Math.round(box.width * ratio), 16, 1600),
    height: clamp(Math.round(box.height * ratio), 16, 1600),
  };
  if (moving) Object.assign(out, { scale: 0.5, aa: 1, format: 'jpeg', quality: 80 });
  const form = new FormData($('controls'));
  if (form.get('shading')) out.shading = form.get('shading');
  if (form.get('axes')) out.axes = 1;
  if (form.get('curves')) out.curves = 1;
  if (view.time > 0) out.time = view.time.toFixed(3);
  if (view.orbit) {
    out.azimuth = view.orbit.azimuth.toFixed(3);
    out.elevation = view.orbit.elevation.toFixed(3);
    out.distance = view.orbit.distance.toPrecision(6);
    out.target = view.orbit.target.map((x) => +x.toPrecision(7)).join(',');
  }
  return out;
}

// Moving frames are small and follow each other without waiting; a moment after the last input
// the full picture is asked for, and a small frame still under way is given up for it.
function draw(moving) {
  if (!view.source) return;
  clearTimeout(restTimer);
  if (moving && !view.playing) restTimer = setTimeout(() => draw(false), 140);
  if (!flight) return void request(moving);
  pending = moving ? 'moving' : 'full';
  if (!moving || !flight.moving) flight.controller.abort();
}

async function request(moving) {
  const number = ++sequence;
  const source = view.source;
  flight = { controller: new AbortController(), moving };
  const asked = options(moving);
  const start = performance.now();
  try {
    const response = await source.fetch(asked, flight.controller.signal);
    if (response.ok) await showFrame(response, number, source, start);
    else await showProblem(response, source);
  } catch (fault) {
    if (fault.name !== 'AbortError' && view.source === source)
      showFindings([{ severity: 'error', message: `The server does not answer: ${fault.message}.` }]);
  }
  flight = null;
  const next = pending;
  pending = null;
  if (next) request(next === 'moving');
}

async function showFrame(response, number, source, start) {
  const blob = await response.blob();
  const url = URL.createObjectURL(blob);
  const probe = new Image();
  probe.src = url;
  await probe.decode();
  // Never an older frame over a newer one, nor one of the scene that was left.
  if (number <= shown || view.source !== source) return URL.revokeObjectURL(url);
  shown = number;
  $('picture').src = url;
  if (lastUrl) URL.revokeObjectURL(lastUrl);
  lastUrl = url;
  const camera = JSON.parse(response.headers.get('X-Farol-Camera') || 'null');
  if (camera && !view.home) view.home = orbitOf(camera);
  const findings = JSON.parse(response.headers.get('X-Farol-Diagnostics') || '[]');
  showFindings(findings);
  const stats = JSON.parse(response.headers.get('X-Farol-Stats') || '{}');
  const total = performance.now() - start;
  $('hud').textContent = `${probe.naturalWidth}×${probe.naturalHeight} · ${total.toFixed(0)} ms · ` +
    `${(blob.size / 1024).toFixed(0)} kB · ${stats.triangles ?? 0} triangles`;
  if (blob.type === 'image/png') {
    $('download').hidden = false;
    $('download').href = url;
    $('download').download = `${(source.key || 'scene').replaceAll('/', '-')}.png`;
  }
}

async function showProblem(response, source) {
  let problem = {};
  try { problem = await response.json(); } catch { /* not ours: the status says it */ }
  if (view.source !== source) return;
  if (response.status === 503) {
    // Busy, not wrong: try again when the server says so.
    const wait = Number(response.headers.get('Retry-After') || 1);
    $('hud').textContent = `busy, trying again in ${wait} s`;
    setTimeout(() => { if (view.source === source) draw(false); }, wait * 1000);
    return;
  }
  stopPlaying();
  showFindings(problem.errors ||
    [{ severity: 'error', message: problem.detail || `The server answered ${response.status}.` }]);
}

function sentence(finding) {
  const column = finding.column ? `, column ${finding.column}` : '';
  const where = finding.line ? `Line ${finding.line}${column}: ` : '';
  const text = finding.message.replace(/[.\s]*$/, '.');
  return where + text.charAt(0).toUpperCase() + text.slice(1);
}

function showFindings(findings) {
  const notable = findings.filter((one) => one.severity !== 'info');
  const key = JSON.stringify(notable);
  if ($('findings').dataset.key === key) return;
  $('findings').dataset.key = key;
  $('findings').replaceChildren(...notable.map((finding) => {
    const item = document.createElement('li');
    item.className = finding.severity;
    item.textContent = sentence(finding);
    if (finding.line) {
      item.tabIndex = 0;
      item.addEventListener('click', () => markLine(finding));
    }
    return item;
  }));
}

// Selects the line in the text box, when the scene on show came from it.
function markLine({ line }) {
  const box = $('xml');
  if ($('editor').hidden || !box.value) return;
  const lines = box.value.split('\n');
  const start = lines.slice(0, line - 1).join('\n').length + (line > 1 ? 1 : 0);
  box.focus();
  box.setSelectionRange(start, start + (lines[line - 1] || '').length);
}

function orbitOf({ eye, target }) {
  const d = eye.map((x, i) => x - target[i]);
  const distance = Math.hypot(...d) || 1;
  return {
    azimuth: Math.atan2(d[0], d[2]) * degrees,
    elevation: Math.asin(clamp(d[1] / distance, -1, 1)) * degrees,
    distance, target,
  };
}

function moveOrbit(azimuth, elevation, zoom = 1) {
  const from = view.orbit || view.home;
  if (!from) return;
  view.orbit = {
    azimuth: ((from.azimuth + azimuth + 540) % 360) - 180,
    elevation: clamp(from.elevation + elevation, -89, 89),
    distance: clamp(from.distance * zoom, 1e-4, 1e9),
    target: from.target,
  };
  keepLink();
  draw(true);
}

function resetView() {
  view.orbit = null;
  keepLink();
  draw(false);
}

const pointers = new Map();
let pinch = 0;
const stage = $('stage');

stage.addEventListener('pointerdown', (event) => {
  if (event.button !== 0) return;
  stage.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, [event.clientX, event.clientY]);
  pinch = 0;
  stage.classList.add('dragging');
});
stage.addEventListener('pointermove', (event) => {
  const last = pointers.get(event.pointerId);
  if (!last) return;
  const now = [event.clientX, event.clientY];
  pointers.set(event.pointerId, now);
  if (pointers.size === 1) {
    const perPixel = 180 / Math.max(200, stage.clientHeight);
    moveOrbit(-(now[0] - last[0]) * perPixel, (now[1] - last[1]) * perPixel);
  } else if (pointers.size === 2) {
    const [a, b] = [...pointers.values()];
    const span = Math.hypot(a[0] - b[0], a[1] - b[1]);
    if (pinch > 0 && span > 0) moveOrbit(0, 0, pinch / span);
    pinch = span;
  }
});
for (const name of ['pointerup', 'pointercancel'])
  stage.addEventListener(name, (event) => {
    if (!pointers.delete(event.pointerId)) return;
    pinch = 0;
    if (pointers.size === 0) stage.classList.remove('dragging');
  });
stage.addEventListener('wheel', (event) => {
  event.preventDefault();
  moveOrbit(0, 0, Math.exp(clamp(event.deltaY, -200, 200) * 0.0015));
}, { passive: false });
stage.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const actions = {
    ArrowLeft: () => moveOrbit(-5, 0), ArrowRight: () => moveOrbit(5, 0),
    ArrowUp: () => moveOrbit(0, 5), ArrowDown: () => moveOrbit(0, -5),
    '+': () => moveOrbit(0, 0, 0.9), '=': () => moveOrbit(0, 0, 0.9), '-': () => moveOrbit(0, 0, 1.1),
    r: resetView, R: resetView, ' ': () => view.animated && togglePlay(),
  };
  if (!actions[event.key]) return;
  event.preventDefault();
  actions[event.key]();
});
new ResizeObserver(() => draw(true)).observe(stage);

let lastTick = 0;

function setTime(seconds) {
  view.time = seconds;
  $('time').value = seconds;
  $('time-value').textContent = `${seconds.toFixed(1)} s`;
}

// The slider runs over one lap of the whole animation, or a minute where there is none.
function setAnimated({ animated, playFrom = 0, loopSeconds = 60 }) {
  view.animated = animated;
  $('time-controls').hidden = !animated;
  Object.assign($('time'), { min: playFrom, max: playFrom + loopSeconds });
}

function tick(now) {
  if (!view.playing) return;
  const from = +$('time').min, lap = $('time').max - from, step = Math.min(0.25, (now - lastTick) / 1000);
  setTime(from + (view.time - from + step) % lap);
  lastTick = now;
  draw(true);
  requestAnimationFrame(tick);
}

function togglePlay() {
  if (view.playing) return stopPlaying();
  view.playing = true;
  $('play').textContent = 'Pause';
  $('play').setAttribute('aria-pressed', 'true');
  lastTick = performance.now();
  requestAnimationFrame(tick);
}

function stopPlaying() {
  if (!view.playing) return;
  view.playing = false;
  $('play').textContent = 'Play';
  $('play').setAttribute('aria-pressed', 'false');
  keepLink();
  draw(false);
}

$('play').addEventListener('click', togglePlay);
$('time').addEventListener('input', () => { setTime(Number($('time').value)); keepLink(); draw(true); });
$('reset').addEventListener('click', resetView);
$('controls').addEventListener('change', (event) => { if (event.target.name) draw(false); });
$('controls').addEventListener('submit', (event) => event.preventDefault());

let keepPicture = false;
function open(source, { title, description, orbit = null, time = 0, ...play }) {
  Object.assign(view, { source, orbit, home: null, playing: false });
  setAnimated(play);
  setTime(time);
  pending = null;
  if (flight) flight.controller.abort();
  if (source.key || !keepPicture) $('picture').removeAttribute('src');
  keepPicture = !source.key;  // while one's own scene is being written the last good picture stays
  $('picture').alt = title;
  $('hud').textContent = '';
  $('findings').dataset.key = '';
  showFindings([]);
  $('title').textContent = title;
  $('description').textContent = description || '';
  $('play').textContent = 'Play';
  $('viewer').hidden = false;
  $('source').hidden = !source.key;
  draw(false);
}

async function openServed(id, query) {
  const response = await fetch(`/v1/scenes/${id.split('/').map(encodeURIComponent).join('/')}`);
  if (!response.ok) {
    $('viewer').hidden = true;
    $('gallery').hidden = false;
    $('gallery-note').textContent = `There is no scene “${id}”.`;
    return;
  }
  const scene = await response.json();
  const numbers = ['az', 'el', 'd'].map((name) => Number(query.get(name)));
  const target = (query.get('at') || '').split(',').map(Number);
  const orbit = query.has('az') && [...numbers, ...target].every(Number.isFinite) && target.length === 3
    ? { azimuth: numbers[0], elevation: numbers[1], distance: numbers[2], target } : null;
  open(servedSource(scene), { ...scene, orbit, time: Math.max(0, Number(query.get('t')) || 0) });
  if (scene.camera) view.home = orbitOf(scene.camera);
  $('source').href = scene.links.source;
  $('source').textContent = 'Source XML';
}

let uploaded = [], uploadedName = 'scene.xml';  // what belongs to the text in the box

function openFiles(list) {
  const files = [...list];
  const main = files.find((file) => /\.xml$/i.test(file.name));
  if (!main) {
    $('file-note').textContent = 'There is no .xml file among them.';
    return;
  }
  $('file-note').textContent = files.map((file) => file.name).join(', ');
  main.text().then((text) => { $('xml').value = text; });
  uploaded = files.filter((file) => file !== main);
  uploadedName = main.name;
  openText(main, files);
}

async function openText(main, files) {
  const source = uploadedSource(files, main);
  open(source, { title: main.name, description: '', animated: false });
  const response = await fetch('/v1/validate', { method: 'POST', body: bodyOf(files, main) });
  if (!response.ok || view.source !== source) return;  // what is wrong comes with the picture
  const { title, description, ...play } = await response.json();
  if (title) $('title').textContent = title;
  $('description').textContent = description;
  setAnimated(play);
}

$('render').addEventListener('click', () => {
  const main = new File([$('xml').value], uploadedName, { type: 'application/xml' });
  openText(main, [main, ...uploaded]);
});
$('files').addEventListener('change', (event) => openFiles(event.target.files));
addEventListener('dragover', (event) => { event.preventDefault(); document.body.classList.add('dropping'); });
addEventListener('dragleave', (event) => { if (!event.relatedTarget) document.body.classList.remove('dropping'); });
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('dropping');
  if (!event.dataTransfer.files.length) return;
  const files = event.dataTransfer.files;
  if (location.hash !== '#/try') { history.pushState(null, '', '#/try'); show(); }
  openFiles(files);
});

let scenes = null;

function blankCard(text) {
  const blank = document.createElement('div');
  blank.className = 'blank';
  blank.textContent = text;
  return blank;
}

function card(scene) {
  const item = document.createElement('li');
  item.className = 'card';
  const link = document.createElement('a');
  link.href = `#/scene/${encodeURI(scene.id)}`;
  const heading = document.createElement('h2');
  heading.textContent = scene.title;
  const text = document.createElement('p');
  if (scene.valid) {
    const image = document.createElement('img');
    image.loading = 'lazy';
    image.width = 320;
    image.height = 240;
    image.alt = '';
    // A busy server answers 503: ask again a little later, and not for ever.
    let tries = 0;
    image.onerror = () => {
      if (++tries > 4) return image.replaceWith(blankCard('no picture'));
      setTimeout(() => { image.src = `${scene.links.thumbnail}#${tries}`; }, 1000 * tries);
    };
    image.src = scene.links.thumbnail;
    link.append(image);
    text.textContent = scene.description || `${scene.counts.models} models, ${scene.counts.lights} lights`;
    if (scene.animated) text.append(' · animated');
  } else {
    link.append(blankCard('cannot be read'));
    text.className = 'bad';
    const fault = scene.diagnostics.find((one) => one.severity === 'error');
    text.textContent = fault ? sentence(fault) : 'This scene cannot be read.';
  }
  link.append(heading, text);
  item.append(link);
  return item;
}

function showCards() {
  const words = $('search').value.toLowerCase().split(/\s+/).filter(Boolean);
  const found = scenes.filter((scene) => {
    const text = `${scene.id} ${scene.title} ${scene.description}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
  $('cards').replaceChildren(...found.map(card));
  $('gallery-note').textContent = scenes.length === 0
    ? 'This server serves no scenes. Start it with --scenes FOLDER, or render your own.'
    : found.length === 0 ? 'No scene matches.' : '';
}
$('search').addEventListener('input', () => scenes && showCards());

async function openGallery() {
  $('gallery-note').textContent = scenes ? '' : 'Loading…';
  try {
    const all = [];
    for (let page = 1, pages = 1; page <= pages; ++page) {
      const response = await fetch(`/v1/scenes?page=${page}`);
      if (!response.ok) throw new Error(`status ${response.status}`);
      const body = await response.json();
      all.push(...body.scenes);
      pages = body.pages;
    }
    scenes = all.sort((a, b) => b.valid - a.valid);  // stable: those that cannot be read come last
    showCards();
  } catch (fault) {
    $('gallery-note').textContent = `The scenes cannot be listed: ${fault.message}.`;
  }
}

let linkTimer = 0;

// #/scene/ID?az=..&el=..&d=..&at=x,y,z&t=..: what is on show, so that it can be shared.
function keepLink() {
  clearTimeout(linkTimer);
  linkTimer = setTimeout(() => {
    if (!view.source || !view.source.key) return;
    const query = new URLSearchParams();
    if (view.orbit) {
      query.set('az', view.orbit.azimuth.toFixed(2));
      query.set('el', view.orbit.elevation.toFixed(2));
      query.set('d', view.orbit.distance.toPrecision(5));
      query.set('at', view.orbit.target.map((x) => +x.toPrecision(6)).join(','));
    }
    if (view.time > 0) query.set('t', view.time.toFixed(2));
    const text = query.toString();
    history.replaceState(null, '', `#/scene/${encodeURI(view.source.key)}${text ? `?${text}` : ''}`);
  }, 200);
}

function show() {
  const [path, query = ''] = location.hash.replace(/^#/, '').split('?');
  const scene = path.match(/^\/scene\/(.+)$/);
  const where = scene ? 'scene' : path === '/try' ? 'try' : 'gallery';
  view.playing = false;
  if (where !== 'scene') {
    view.source = null;
    $('viewer').hidden = true;
  }
  document.body.dataset.page = where;
  $('gallery').hidden = where !== 'gallery';
  $('editor').hidden = where !== 'try';
  for (const link of document.querySelectorAll('[data-nav]')) {
    if (link.dataset.nav === where) link.setAttribute('aria-current', 'page');
    else link.removeAttribute('aria-current');
  }
  if (where === 'gallery') openGallery();
  if (scene) openServed(decodeURI(scene[1]), new URLSearchParams(query));
}

addEventListener('hashchange', show);
show();
