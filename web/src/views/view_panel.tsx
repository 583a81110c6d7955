// How the picture is drawn: every picture option that makes sense while looking.
import { useEffect } from 'preact/hooks';
import { deleteScene, findingsOf, sentence } from '../api.ts';
import type { Viewer } from '../scene/viewer.ts';
import { hasOption, loadOptions } from '../image_options.ts';
import { cullingShown, showHud } from './hud.tsx';
import { Check, Choice, say, Section } from './ui.tsx';
import { msg, number, t } from '../words.ts';

const asSet = ['', msg('as the scene says')] as const;
const shadings = ['points', 'wireframe', 'solid', 'chess', 'flat', 'gouraud', 'phong'];
const pairs = (words: readonly string[]): (readonly [string, string])[] => [asSet, ...words.map((word) => [word, word] as const)];

async function remove(id: string): Promise<void> {
  if (!confirm(t('Delete this upload from the server? Its links will lead nowhere.'))) return;
  try {
    await deleteScene(id);
    location.hash = '#/';
    say(t('Deleted.'));
  } catch (fault) {
    say(findingsOf(fault).map((one) => sentence(one)).join(' '));
  }
}

export function ViewPanel({ viewer }: { viewer: Viewer }) {
  useEffect(loadOptions, []);
  const options = viewer.options.value;
  const of = (name: string): string => options[name] ?? '';
  const choice = (name: string, label: string, choices: readonly (readonly [string, string])[]) => (
    <Choice label={label} value={of(name)} choices={choices.map(([key, text]) => [key, t(text)] as const)} onChange={(value) => viewer.setOption(name, value)} />
  );
  const flag = (name: string, label: string) => (
    <Check label={label} checked={of(name) === '1'} onChange={(on) => viewer.setOption(name, on ? '1' : null)} />
  );
  const background = /^#[0-9a-f]{6}$/i.test(of('background')) ? of('background') : '#000000';
  const error = Number(of('error') || 0.25);
  const counts = viewer.facts.value?.counts;
  return (
    <div class="sections">
      <Section title={t('Surfaces')}>
        {choice('shading', t('Shading'), pairs(shadings))}
        <Check label={t('Wireframe')} checked={of('shading') === 'wireframe'} onChange={(on) => viewer.setOption('shading', on ? 'wireframe' : null)} />
        {choice('filter', t('Texture filter'), pairs(['nearest', 'linear', 'mipmap', 'anisotropic']))}
        {choice('viewer', t('Highlights for'), [asSet, ['infinite', msg('a viewer far away')], ['local', msg('the viewer’s place')]])}
        {choice('specular', t('Highlights'), [asSet, ['single', msg('tinted by the texture')], ['separate', msg('above the texture')]])}
        {choice('transparency', t('See-through'), [asSet, ['on', msg('model by model')], ['exact', msg('exact in each pixel')], ['off', msg('all opaque')]])}
        <p class="note explained">{t('Model by model draws what is see-through after the rest, the farthest first. Exact sorts the surfaces in each pixel: models that pass through each other are right, too.')}</p>
        {hasOption('shadows') && choice('shadows', t('Shadows'), [asSet, ['off', msg('none')], ['map', msg('of each light')]])}
      </Section>
      <Section title={t('Precision')}>
        {choice('aa', t('Samples a pixel'), pairs(['1', '2', '4', '8', '16']))}
        <label class="field">
          <span>{t('Precision of shapes')}</span>
          <span class="with-value">
            <input type="range" min={-6} max={3} step={0.5} value={Math.log2(error)} aria-valuetext={t('{error} pixels', { error })}
              onInput={(event) => viewer.setOption('error', String(Number((2 ** Number(event.currentTarget.value)).toPrecision(3))))} />
            <output>{error} px</output>
          </span>
        </label>
        <p class="note explained">{t('How far a drawn surface may be from the exact one, in pixels: smaller is rounder and slower.')}</p>
      </Section>
      <Section title={t('Overlays')}>
        <div class="checks">
          {flag('axes', t('Axes'))}
          {flag('curves', t('Curves'))}
          {flag('focus', t('Camera’s target'))}
          {flag('debug', t('Outlines and normals'))}
          <Check label={t('Culling counts')} checked={cullingShown.value} onChange={(on) => {
            cullingShown.value = on;
            if (on) showHud(true);
          }} />
        </div>
        <p class="note explained">{t('The target is shown as a small cube: the camera looks at it and goes round it. Culled is what is outside of the view and not drawn.')}</p>
      </Section>
      <Section title={t('Image')}>
        {choice('layer', t('Shows'), [['', msg('colour')], ['depth', msg('depth')], ['normal', msg('normals')], ['id', msg('model numbers')]])}
        <div class="field">
          <span id="background-label">{t('Background')}</span>
          <span class="with-value">
            <input type="color" aria-labelledby="background-label" value={background} onInput={(event) => viewer.setOption('background', event.currentTarget.value)} />
            <button type="button" class="link" disabled={!of('background')} onClick={() => viewer.setOption('background', null)}>{t('the scene’s own')}</button>
          </span>
        </div>
      </Section>
      <Section title={t('Third person')}>
        <label class="field">
          <span>{t('Entity')}</span>
          <input type="text" value={of('entity')} placeholder={t('a scene file, as ship.xml')} spellcheck={false}
            onChange={(event) => viewer.setOption('entity', event.currentTarget.value.trim())} />
        </label>
      </Section>
      {counts && (
        <Section title={t('Scene')}>
          <dl class="counts">
            <div><dt>{t('Models')}</dt><dd>{number(counts.models)}</dd></div>
            <div><dt>{t('Triangles')}</dt><dd>{number(counts.triangles)}</dd></div>
            <div><dt>{t('Lights')}</dt><dd>{number(counts.lights)}</dd></div>
            <div><dt>{t('Textures')}</dt><dd>{number(counts.textures)} ({(counts.textureBytes / 1048576).toFixed(1)} MiB)</dd></div>
          </dl>
        </Section>
      )}
      {viewer.facts.value?.upload && viewer.id !== null && (
        <Section title={t('Upload')}>
          <button type="button" class="button" onClick={() => void remove(viewer.id as string)}>{t('Delete from the server')}</button>
        </Section>
      )}
    </div>
  );
}
