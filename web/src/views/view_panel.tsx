// How the picture is drawn: every picture option that makes sense while looking.
import { deleteScene, findingsOf, sentence } from '../api.ts';
import type { Viewer } from '../scene/viewer.ts';
import { cullingShown, showHud } from './hud.tsx';
import { Check, Choice, say, Section } from './ui.tsx';

const asSet = ['', 'as the scene says'] as const;
const shadings = ['points', 'wireframe', 'solid', 'chess', 'flat', 'gouraud', 'phong'];
const pairs = (words: readonly string[]): (readonly [string, string])[] => [asSet, ...words.map((word) => [word, word] as const)];

async function remove(id: string): Promise<void> {
  if (!confirm('Delete this upload from the server? Its links will lead nowhere.')) return;
  try {
    await deleteScene(id);
    location.hash = '#/';
    say('Deleted.');
  } catch (fault) {
    say(findingsOf(fault).map((one) => sentence(one)).join(' '));
  }
}

export function ViewPanel({ viewer }: { viewer: Viewer }) {
  const options = viewer.options.value;
  const of = (name: string): string => options[name] ?? '';
  const choice = (name: string, label: string, choices: (readonly [string, string])[]) => (
    <Choice label={label} value={of(name)} choices={choices} onChange={(value) => viewer.setOption(name, value)} />
  );
  const flag = (name: string, label: string) => (
    <Check label={label} checked={of(name) === '1'} onChange={(on) => viewer.setOption(name, on ? '1' : null)} />
  );
  const background = /^#[0-9a-f]{6}$/i.test(of('background')) ? of('background') : '#000000';
  const error = Number(of('error') || 0.25);
  const counts = viewer.facts.value?.counts;
  return (
    <div class="sections">
      <Section title="Surfaces">
        {choice('shading', 'Shading', pairs(shadings))}
        <Check label="Wireframe" checked={of('shading') === 'wireframe'} onChange={(on) => viewer.setOption('shading', on ? 'wireframe' : null)} />
        {choice('filter', 'Texture filter', pairs(['nearest', 'linear', 'mipmap', 'anisotropic']))}
        {choice('viewer', 'Highlights for', [asSet, ['infinite', 'a viewer far away'], ['local', 'the viewer’s place']])}
        {choice('specular', 'Highlights', [asSet, ['single', 'tinted by the texture'], ['separate', 'above the texture']])}
      </Section>
      <Section title="Precision">
        {choice('aa', 'Samples a pixel', pairs(['1', '2', '4', '8', '16']))}
        <label class="field">
          <span>Precision of shapes</span>
          <span class="with-value">
            <input type="range" min={-6} max={3} step={0.5} value={Math.log2(error)} aria-valuetext={`${error} pixels`}
              onInput={(event) => viewer.setOption('error', String(Number((2 ** Number(event.currentTarget.value)).toPrecision(3))))} />
            <output>{error} px</output>
          </span>
        </label>
        <p class="note explained">How far a drawn surface may be from the exact one, in pixels: smaller is rounder and slower.</p>
      </Section>
      <Section title="Overlays">
        <div class="checks">
          {flag('axes', 'Axes')}
          {flag('curves', 'Curves')}
          {flag('focus', 'Camera’s target')}
          {flag('debug', 'Outlines and normals')}
          <Check label="Culling counts" checked={cullingShown.value} onChange={(on) => {
            cullingShown.value = on;
            if (on) showHud(true);
          }} />
        </div>
        <p class="note explained">The target is shown as a small cube: the camera looks at it and goes round it. Culled is what is outside of the view and not drawn.</p>
      </Section>
      <Section title="Picture">
        {choice('layer', 'Shows', [['', 'colour'], ['depth', 'depth'], ['normal', 'normals'], ['id', 'model numbers']])}
        <div class="field">
          <span id="background-label">Background</span>
          <span class="with-value">
            <input type="color" aria-labelledby="background-label" value={background} onInput={(event) => viewer.setOption('background', event.currentTarget.value)} />
            <button type="button" class="link" disabled={!of('background')} onClick={() => viewer.setOption('background', null)}>the scene’s own</button>
          </span>
        </div>
      </Section>
      <Section title="Third person">
        <label class="field">
          <span>Entity</span>
          <input type="text" value={of('entity')} placeholder="a scene file, as ship.xml" spellcheck={false}
            onChange={(event) => viewer.setOption('entity', event.currentTarget.value.trim())} />
        </label>
      </Section>
      {counts && (
        <Section title="Scene">
          <dl class="counts">
            <div><dt>Models</dt><dd>{counts.models}</dd></div>
            <div><dt>Triangles</dt><dd>{counts.triangles.toLocaleString('en')}</dd></div>
            <div><dt>Lights</dt><dd>{counts.lights}</dd></div>
            <div><dt>Textures</dt><dd>{counts.textures} ({(counts.textureBytes / 1048576).toFixed(1)} MiB)</dd></div>
          </dl>
        </Section>
      )}
      {viewer.facts.value?.upload && viewer.id !== null && (
        <Section title="Upload">
          <button type="button" class="button" onClick={() => void remove(viewer.id as string)}>Delete from the server</button>
        </Section>
      )}
    </div>
  );
}
