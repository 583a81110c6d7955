// Materials, lights and textures by sliders; every change is a change of the XML.
import { signal } from '@preact/signals';
import { useEffect, useMemo, useState } from 'preact/hooks';
import { findingsOf, sentence } from '../api.ts';
import {
  colorOf, components, elementOf, fromHex, numberOf, partsOf, setColor, setNumber, setShininess, setTexture, shininessOf, textureOf, texturesOf,
  toHex, type Component, type Part, type Rgb,
} from '../scene/materials.ts';
import type { Viewer } from '../scene/viewer.ts';
import { spellings } from '../scene/language.ts';
import { attributeOf, parseXml, type XmlElement } from '../scene/xml.ts';
import { Section } from './ui.tsx';
import { msg, t } from '../words.ts';

const filter = signal('');
const maxListed = 200;

interface Edits {
  viewer: Viewer;
  roots: readonly XmlElement[];
  element: XmlElement;
  kind: Part['kind'];
  index: number;
}

function Slider({ label, value, min, max, step, onInput, short }: {
  label: string; value: number; min: number; max: number; step: number; onInput: (value: number) => void; short?: string;
}) {
  const shown = Number(value.toFixed(step < 0.01 ? 3 : step < 1 ? 2 : 0));
  return (
    <label class="slider">
      <span>{short ?? label}</span>
      <input type="range" aria-label={label} min={Math.min(min, value)} max={Math.max(max, value)} step={step} value={value}
        onInput={(event) => onInput(Number(event.currentTarget.value))} />
      <output>{shown}</output>
    </label>
  );
}

const names: Record<Component, string> = { diffuse: msg('Diffuse'), ambient: msg('Ambient'), specular: msg('Specular'), emissive: msg('Emissive') };
const channels = [msg('red'), msg('green'), msg('blue')];

function ColorRow({ edits, component }: { edits: Edits; component: Component }) {
  const { viewer, roots, element, kind, index } = edits, name = t(names[component]);
  const color = colorOf(roots, element, component);
  const write = (next: Rgb): void => viewer.edit(setColor(viewer.text.peek() ?? '', kind, index, component, next), 'dragging');
  const set = (channel: number, value: number): void => write(color.map((x, i) => (i === channel ? value / 255 : x)) as unknown as Rgb);
  return (
    <fieldset class="color">
      <legend>{name}</legend>
      <input type="color" aria-label={t('{component} colour', { component: name })} value={toHex(color)} onInput={(event) => write(fromHex(event.currentTarget.value))} />
      <div>
        {channels.map((channel, i) => (
          <Slider key={channel} label={t('{component} {channel}', { component: name, channel: t(channel) })} short={'RGB'.charAt(i)} min={0} max={255} step={1}
            value={Math.round((color[i] as number) * 255)} onInput={(value) => set(i, value)} />
        ))}
      </div>
    </fieldset>
  );
}

function Model({ edits }: { edits: Edits }) {
  const { viewer, roots, element, index } = edits;
  const textures = useMemo(() => texturesOf(roots), [roots]);
  const texture = textureOf(element);
  return (
    <>
      {(texture || textures.length > 0) && (
        <label class="field">
          <span>{t('Texture')}</span>
          <select value={texture} onChange={(event) => viewer.edit(setTexture(viewer.text.peek() ?? '', index, event.currentTarget.value), 'done')}>
            {!texture && <option value="" selected>{t('none')}</option>}
            {textures.map((name) => <option key={name} value={name} selected={name === texture}>{name}</option>)}
          </select>
        </label>
      )}
      {components.map((component) => <ColorRow key={component} edits={edits} component={component} />)}
      <Slider label={t('Shininess')} min={0} max={128} step={1} value={shininessOf(element)}
        onInput={(value) => viewer.edit(setShininess(viewer.text.peek() ?? '', index, value), 'dragging')} />
    </>
  );
}

function Light({ edits }: { edits: Edits }) {
  const { viewer, element, index } = edits;
  const type = (attributeOf(element, ['type'])?.value ?? 'point').toLowerCase();
  const directional = type.startsWith('dir') || type === 'sun', spot = type.startsWith('spot');
  const angles = directional && attributeOf(element, ['alpha', 'beta']) !== undefined;
  const reach = Math.max(10, (viewer.home ? Math.hypot(...viewer.home.eye) : 10) * 1.5);
  const slider = (label: string, attributes: readonly string[], otherwise: number, min: number, max: number, step: number) => (
    <Slider key={label} label={label} min={min} max={max} step={step} value={numberOf(element, attributes, otherwise)}
      onInput={(value) => viewer.edit(setNumber(viewer.text.peek() ?? '', 'light', index, attributes, value), 'dragging')} />
  );
  const axes = ['X', 'Y', 'Z'] as const;
  const vector = attributeOf(element, axes.flatMap((axis) => spellings('light', `dir${axis}`))) || !directional ? 'dir' : 'pos';
  return (
    <>
      {angles ? [slider(t('Alpha'), ['alpha'], 0, -180, 180, 1), slider(t('Beta'), ['beta'], 0, -90, 90, 1)] : (
        <>
          {!directional && axes.map((axis) => slider(t('Place {axis}', { axis }), spellings('light', `pos${axis}`), 0, -reach, reach, reach / 200))}
          {(directional || spot) && axes.map((axis) => slider(t('Direction {axis}', { axis }), spellings('light', `${vector}${axis}`), 0, -1, 1, 0.01))}
        </>
      )}
      {spot && slider(t('Cutoff'), spellings('light', 'cutoff'), 180, 0, 90, 0.5)}
      {spot && slider(t('Exponent'), spellings('light', 'exponent'), 0, 0, 128, 1)}
      {!directional && [
        slider(t('Constant'), spellings('light', 'constant'), 1, 0, 4, 0.01),
        slider(t('Linear'), spellings('light', 'linear'), 0, 0, 1, 0.005),
        slider(t('Quadratic'), spellings('light', 'quadratic'), 0, 0, 1, 0.005),
      ]}
      {(['diffuse', 'ambient', 'specular'] as const).map((component) => <ColorRow key={component} edits={edits} component={component} />)}
    </>
  );
}

function PartList({ viewer, parts }: { viewer: Viewer; parts: readonly Part[] }) {
  const words = filter.value.toLowerCase();
  const found = parts.filter((part) => `${part.label} ${part.group} ${part.kind}`.toLowerCase().includes(words));
  return (
    <ul class="parts">
      {found.slice(0, maxListed).map((part) => {
        const on = viewer.selected.value === part.start;
        return (
          <li key={`${part.kind}${part.index}`}>
            <button type="button" aria-pressed={on} onClick={() => (viewer.selected.value = on ? null : part.start)}>
              <b>{part.kind === 'light' ? t('Light: {name}', { name: part.label }) : part.label}</b>
              <span>{[part.group, t('line {line}', { line: part.line })].filter(Boolean).join(', ')}</span>
            </button>
          </li>
        );
      })}
      {found.length > maxListed && <li class="note">{t('and {count} more: type to find one', { count: found.length - maxListed })}</li>}
    </ul>
  );
}

export function Inspector({ viewer }: { viewer: Viewer }) {
  const [problem, setProblem] = useState('');
  useEffect(() => {
    viewer.loadText().catch((fault: unknown) => setProblem(findingsOf(fault).map((one) => sentence(one)).join(' ')));
  }, [viewer]);
  const text = viewer.text.value, selected = viewer.selected.value;
  const roots = useMemo(() => parseXml(text ?? ''), [text]);
  const parts = useMemo(() => partsOf(text ?? '', roots), [text, roots]);
  if (problem) return <p class="problem" role="alert">{problem}</p>;
  if (text === null) return <p class="note">{t('Loading…')}</p>;
  const part = parts.find((one) => one.start === selected), element = part && elementOf(roots, part.kind, part.index);
  return (
    <div class="sections">
      <Section title={t('Lights and models ({count})', { count: parts.length })}>
        <input type="search" aria-label={t('Find a light or model')} placeholder={t('Find, or click in the image')} value={filter.value}
          onInput={(event) => (filter.value = event.currentTarget.value)} />
        <PartList viewer={viewer} parts={parts} />
      </Section>
      {element && part && (
        <Section title={part.kind === 'light' ? t('Light: {name}', { name: part.label }) : t('Model: {name}', { name: part.label })}>
          {part.kind === 'model'
            ? <Model edits={{ viewer, roots, element, kind: part.kind, index: part.index }} />
            : <Light edits={{ viewer, roots, element, kind: part.kind, index: part.index }} />}
        </Section>
      )}
      {viewer.edited.value && (
        <p class="note">
          {t('The XML was edited and is kept in this browser.')}{' '}
          <button type="button" class="link" onClick={() => viewer.discardEdits()}>{t('Discard the edits')}</button>
        </p>
      )}
    </div>
  );
}
