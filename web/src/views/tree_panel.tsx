// The tree of the scene: names, what is hidden or locked, and what is selected, as in the image and the text.
import { signal } from '@preact/signals';
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import { findingsOf, sentence } from '../api.ts';
import { isWithin } from '../scene/hide.ts';
import { toggled } from '../scene/marks.ts';
import { treeOf, walkTree, type NodeKind, type TreeNode } from '../scene/tree.ts';
import type { Viewer } from '../scene/viewer.ts';
import { lineOf, parseXml } from '../scene/xml.ts';
import { msg, t } from '../words.ts';
import { Icon, type IconName } from './icons.tsx';
import { say } from './ui.tsx';
import { Numbers } from './numbers.tsx';
import { double, remove, TreeTools } from './tree_tools.tsx';
import { openPanel } from './viewer_page.tsx';

const icons: Record<NodeKind, IconName> = {
  scene: 'world', camera: 'camera', light: 'lamp', group: 'group', model: 'model', include: 'include', skybox: 'sun', background: 'panel', entity: 'walk',
};
const kindWords: Record<NodeKind, string> = {
  scene: msg('Scene'), camera: msg('Camera'), light: msg('Light'), group: msg('Group'), model: msg('Model'), include: msg('Included scene'),
  skybox: msg('Skybox'), background: msg('Background'), entity: msg('Entity'),
};
export const nameOf = (node: TreeNode): string => node.name || t(kindWords[node.kind]);

const hideable: readonly NodeKind[] = ['light', 'group', 'model', 'include'];

/** What was opened or closed by hand, by the path of the entry; others are open in a small scene. */
const opened = signal<ReadonlyMap<string, boolean>>(new Map());
const filter = signal('');
const maxOpenEntries = 300;
const spareRows = 8; // above and below those in sight

interface Row {
  node: TreeNode;
  path: string; // indices among siblings, as 0.2.1
  level: number; // from 1
  place: number; // among its siblings, from 1
  siblings: number;
  open: boolean | null; // null: it has no children
}

function rowsOf(nodes: readonly TreeNode[], isSmall: boolean, words: string): Row[] {
  const out: Row[] = [];
  const matches = (node: TreeNode): boolean => `${nameOf(node)} ${node.note} ${node.kind}`.toLowerCase().includes(words);
  const visit = (all: readonly TreeNode[], level: number, above: string): boolean => {
    let isAny = false;
    all.forEach((node, index) => {
      const path = `${above}${index}`, at = out.length;
      const isOpen = words !== '' || (opened.value.get(path) ?? (isSmall || level < 2));
      out.push({ node, path, level, place: index + 1, siblings: all.length, open: node.children.length > 0 ? isOpen : null });
      const inside = isOpen && visit(node.children, level + 1, `${path}.`);
      if (words !== '' && !inside && !matches(node)) out.length = at;
      else isAny = true;
    });
    return isAny;
  };
  visit(nodes, 1, '');
  return out;
}

const attempt = (act: () => Promise<unknown>): void =>
  void act().catch((fault: unknown) => say(findingsOf(fault).map((one) => sentence(one)).join(' ')));

function setOpen(path: string, isOpen: boolean): void {
  opened.value = new Map(opened.value).set(path, isOpen);
}

const pathOf = (nodes: readonly TreeNode[], node: TreeNode): string => {
  const index = (node.parent?.children ?? nodes).indexOf(node);
  return node.parent ? `${pathOf(nodes, node.parent)}.${index}` : String(index);
};

/** Hides or shows, locks or unlocks. */
export const toggleMark = (viewer: Viewer, node: TreeNode, mark: 'hidden' | 'locked'): void =>
  attempt(() => viewer.mark({ ...viewer.marks.value, [mark]: toggled(viewer.marks.value[mark], node.element.start) }));

function TreeRow({ viewer, row, id, keys }: { viewer: Viewer; row: Row; id: string; keys: string }) {
  const { node, level, place, siblings, open, path } = row, { hidden, locked } = viewer.marks.value;
  const isSelected = viewer.selected.value === node.element.start, isHidden = isWithin(node.element, hidden), isLocked = isWithin(node.element, locked);
  const own = { hidden: hidden.includes(node.element.start), locked: locked.includes(node.element.start) };
  const label = nameOf(node);
  const name = [node.note ? `${label} ${node.note}` : label, isHidden && t('hidden'), isLocked && t('locked')].filter(Boolean).join(', ');
  const mark = (kind: 'hidden' | 'locked', icon: IconName, action: string) => (
    <button type="button" class="tree-mark" tabIndex={-1} aria-label={action} title={action} aria-pressed={own[kind]}
      onClick={(event) => {
        event.stopPropagation();
        toggleMark(viewer, node, kind);
      }}><Icon name={icon} /></button>
  );
  return (
    <li id={id} class={`tree-row${isHidden ? ' is-hidden' : ''}`} role="treeitem" aria-label={name} aria-level={level} aria-posinset={place}
      aria-setsize={siblings} aria-selected={isSelected} aria-keyshortcuts={keys} {...(open === null ? {} : { 'aria-expanded': open })}
      onClick={() => (viewer.selected.value = node.element.start)} onDblClick={() => openPanel('xml')} style={{ paddingLeft: `${0.3 + 0.9 * (level - 1)}rem` }}>
      <span class={`twisty${open === null ? '' : open ? ' open' : ' closed'}`} aria-hidden="true" onClick={(event) => {
        if (open === null) return;
        event.stopPropagation();
        setOpen(path, !open);
      }}>{open !== null && <Icon name="down" />}</span>
      <Icon name={icons[node.kind]} />
      <span class="tree-name">{label}{node.note && <small> {node.note}</small>}</span>
      {hideable.includes(node.kind) && (
        <span class="tree-marks">
          {mark('locked', own.locked ? 'lock' : 'unlock', own.locked ? t('Unlock {name}', { name: label }) : t('Lock {name}', { name: label }))}
          {mark('hidden', own.hidden ? 'hidden' : 'eye', own.hidden ? t('Show {name}', { name: label }) : t('Hide {name}', { name: label }))}
        </span>
      )}
    </li>
  );
}

/** An ARIA tree whose focus stays on the list: `aria-activedescendant` names the selected row. Rows out of sight are not built. */
function Tree({ viewer, nodes, rows }: { viewer: Viewer; nodes: readonly TreeNode[]; rows: readonly Row[] }) {
  const list = useRef<HTMLUListElement>(null);
  const [top, setTop] = useState(0);
  const [size, setSize] = useState({ row: 32, height: 400 });
  const selected = viewer.selected.value, at = rows.findIndex((row) => row.node.element.start === selected);
  useEffect(() => {
    const box = list.current;
    if (!box) return;
    const observer = new ResizeObserver(() => setSize({ row: box.querySelector('.tree-row')?.clientHeight || 32, height: box.clientHeight }));
    observer.observe(box);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    const box = list.current;
    if (at < 0 || !box) return;
    if (at * size.row < box.scrollTop) box.scrollTop = at * size.row;
    else if ((at + 1) * size.row > box.scrollTop + box.clientHeight) box.scrollTop = (at + 1) * size.row - box.clientHeight;
  }, [at, size]);
  const first = Math.max(0, Math.floor(top / size.row) - spareRows), last = Math.min(rows.length, Math.ceil((top + size.height) / size.row) + spareRows);
  const choose = (row: Row | undefined): void => {
    if (row) viewer.selected.value = row.node.element.start;
  };
  const press = (event: KeyboardEvent): void => {
    if (event.key.toLowerCase() === 'd' && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      return double(viewer, rows[at]?.node.element);
    }
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const row = rows[at], mark = row && hideable.includes(row.node.kind) ? row.node : null;
    const page = Math.max(1, Math.floor(size.height / size.row) - 1);
    const actions: Record<string, () => void> = {
      ArrowDown: () => choose(rows[Math.min(at + 1, rows.length - 1)]), ArrowUp: () => choose(rows[Math.max(0, at - 1)]),
      PageDown: () => choose(rows[Math.min(at + page, rows.length - 1)]), PageUp: () => choose(rows[Math.max(0, at - page)]),
      Home: () => choose(rows[0]), End: () => choose(rows[rows.length - 1]),
      ArrowRight: () => (row?.open === false ? setOpen(row.path, true) : row?.open && choose(rows[at + 1])),
      ArrowLeft: () => (row?.open && filter.value === '' ? setOpen(row.path, false) : row?.node.parent && (viewer.selected.value = row.node.parent.element.start)),
      Delete: () => remove(viewer, row?.node.element),
      Enter: () => row && openPanel('xml'), Escape: () => (viewer.selected.value = null),
      h: () => mark && toggleMark(viewer, mark, 'hidden'), l: () => mark && toggleMark(viewer, mark, 'locked'),
    };
    const act = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act();
  };
  // What is selected elsewhere is made visible here.
  useEffect(() => {
    const node = selected === null ? undefined : [...walkTree(nodes)].find((one) => one.element.start === selected);
    if (!node || rows.some((row) => row.node === node)) return;
    filter.value = '';
    const next = new Map(opened.value);
    for (let one = node.parent; one; one = one.parent) next.set(pathOf(nodes, one), true);
    opened.value = next;
  }, [selected, nodes]);
  return (
    <ul ref={list} class="tree" role="tree" aria-label={t('Tree of the scene')} tabIndex={0} onKeyDown={press} onScroll={(event) => setTop(event.currentTarget.scrollTop)}
      {...(at >= first && at < last ? { 'aria-activedescendant': `tree-${rows[at]?.path}` } : {})}>
      <li role="none" style={{ height: `${first * size.row}px` }} />
      {rows.slice(first, last).map((row) => <TreeRow key={row.path} viewer={viewer} row={row} id={`tree-${row.path}`} keys="H L Enter" />)}
      <li role="none" style={{ height: `${(rows.length - last) * size.row}px` }} />
    </ul>
  );
}

export function TreePanel({ viewer }: { viewer: Viewer }) {
  const [problem, setProblem] = useState('');
  useEffect(() => {
    opened.value = new Map();
    viewer.loadText().catch((fault: unknown) => setProblem(findingsOf(fault).map((one) => sentence(one)).join(' ')));
  }, [viewer]);
  const text = viewer.text.value, words = filter.value.trim().toLowerCase();
  const nodes = useMemo(() => treeOf(text ?? '', parseXml(text ?? '')), [text]);
  const count = useMemo(() => [...walkTree(nodes)].length, [nodes]);
  const rows = useMemo(() => rowsOf(nodes, count <= maxOpenEntries, words), [nodes, count, words, opened.value]);
  if (problem) return <p class="problem" role="alert">{problem}</p>;
  if (text === null) return <p class="note">{t('Loading…')}</p>;
  const selected = [...walkTree(nodes)].find((one) => one.element.start === viewer.selected.value);
  return (
    <div class="tree-panel">
      <div class="tree-head">
        <input type="search" aria-label={t('Find in the tree')} placeholder={t('Find')} value={filter.value} onInput={(event) => (filter.value = event.currentTarget.value)} />
        <TreeTools viewer={viewer} element={selected?.element} />
      </div>
      {rows.length > 0 ? <Tree viewer={viewer} nodes={nodes} rows={rows} /> : <p class="note">{words ? t('Nothing of that name.') : t('The document has no scene.')}</p>}
      {selected && (
        <div class="tree-foot">
          <div class="tree-chosen">
            <p><b>{nameOf(selected)}</b> {selected.note && <span class="note">{selected.note}</span>}</p>
            <button type="button" class="link" onClick={() => openPanel('xml')}>{t('line {line}', { line: lineOf(text, selected.element.start) })}</button>
          </div>
          <Numbers viewer={viewer} />
        </div>
      )}
    </div>
  );
}
