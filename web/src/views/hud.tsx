// What the last picture cost.
import { signal } from '@preact/signals';
import type { Latency } from '../frames/timing.ts';
import type { Viewer } from '../scene/viewer.ts';
import { recall, remember } from '../storage.ts';
import { msg, t } from '../words.ts';

// Numbers for those who ask for them: they would cover the picture.
export const hudShown = signal(recall('hud') === 'on');
export const cullingShown = signal(false);

export function showHud(on: boolean): void {
  hudShown.value = on;
  remember('hud', on ? 'on' : 'off');
}

const parts: [keyof Latency, string][] = [
  ['network', msg('network')], ['queue', msg('queue')], ['prepare', msg('prepare')], ['draw', msg('draw')], ['encode', msg('encode')], ['page', msg('page')],
];

const count = (n: number | undefined): string =>
  n === undefined ? '–' : n < 10000 ? String(n) : n < 1e6 ? `${(n / 1e3).toFixed(1)} k` : `${(n / 1e6).toFixed(2)} M`;

const others = new Set(['instances', 'culled', 'triangles', 'drawCalls', 'textures', 'lights']);
const words = (name: string): string => name.replace(/([A-Z])/g, ' $1').toLowerCase();

export function HudView({ viewer }: { viewer: Viewer }) {
  const hud = viewer.hud.value;
  if (!hud || !hudShown.value) return null;
  const { latency, stats } = hud;
  return (
    <div class="hud" aria-hidden="true">
      <p>
        <b>{!hud.moving ? t('at rest') : hud.fps > 0 ? t('{fps} fps', { fps: hud.fps.toFixed(0) }) : t('moving')}</b>
        <span>{hud.width} × {hud.height}</span><span>{(hud.bytes / 1024).toFixed(0)} kB</span>
      </p>
      <svg class="bar" viewBox="0 0 100 4" preserveAspectRatio="none">
        {parts.reduce<{ at: number; out: preact.JSX.Element[] }>(({ at, out }, [key]) => {
          const width = (latency[key] / Math.max(latency.total, 0.01)) * 100;
          out.push(<rect key={key} class={key} x={at} width={width} height="4" />);
          return { at: at + width, out };
        }, { at: 0, out: [] }).out}
      </svg>
      <p class="split">
        <b>{latency.total.toFixed(0)} ms</b>
        {parts.map(([key, text]) => <span key={key} class={key}>{t(text)} {latency[key].toFixed(latency[key] < 9.95 ? 1 : 0)}</span>)}
      </p>
      <p><b>{t('{n} triangles', { n: count(stats.triangles) })}</b><span>{t('{n} culled', { n: count(stats.culled) })}</span><span>{t('{n} draws', { n: count(stats.drawCalls) })}</span></p>
      {cullingShown.value && (
        <p class="more">
          <span>{t('{n} instances drawn of {all}', { n: count(stats.instances), all: count((stats.instances ?? 0) + (stats.culled ?? 0)) })}</span>
          <span>{t('{n} textures', { n: count(stats.textures) })}</span><span>{t('{n} lights', { n: count(stats.lights) })}</span>
          {Object.entries(stats).filter(([name, value]) => !others.has(name) && typeof value === 'number')
            .map(([name, value]) => <span key={name}>{count(value)} {words(name)}</span>)}
        </p>
      )}
    </div>
  );
}
