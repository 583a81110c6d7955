// What one does with the scene on show.
import type { Viewer } from '../scene/viewer.ts';
import { hudShown, showHud } from './hud.tsx';
import { openPanel, panel } from './viewer_page.tsx';
import { saveBlob } from './save.ts';
import { lazyView } from './lazy.tsx';
import { hadHelp, sharing, showHelp } from './sharing.ts';
import { redo, undo } from './steps.ts';
import { say, Tool, toolbarKeys } from './ui.tsx';
import { msg, t } from '../words.ts';

const Help = lazyView(() => import('./help_dialog.tsx').then((module) => module.Help));
const ShareDialog = lazyView(() => import('./share_dialog.tsx').then((module) => module.ShareDialog));

const fileName = (viewer: Viewer): string => (viewer.id ?? 'scene').replaceAll('/', '-').slice(0, 60);

const qualities = [
  ['fast', msg('fast'), msg('One sample a pixel, coarser shapes (O)')],
  ['standard', msg('standard'), msg('As the scene says')],
  ['reference', msg('reference'), msg('16 samples a pixel, finest shapes (P)')],
] as const;

export function Toolbar({ viewer }: { viewer: Viewer }) {
  const png = async (): Promise<void> => {
    const blob = await viewer.imageAs('png').catch((fault: unknown) => (viewer.report(fault), null));
    if (blob) saveBlob(blob, `${fileName(viewer)}.png`);
    else say(t('There is no full image yet.'));
  };
  const fullscreen = (): void => {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void document.querySelector('.view')?.requestFullscreen().catch(() => say(t('The browser does not allow full screen.')));
  };
  return (
    <div class="toolbar" role="toolbar" aria-label={t('Scene')} onKeyDown={toolbarKeys}>
      <div class="tools">
        <Tool icon="undo" label={t('Undo')} shows="below" keys="Ctrl+Z" disabled={!viewer.canUndo.value} onClick={() => undo(viewer)} />
        <Tool icon="redo" label={t('Redo')} shows="below" keys="Ctrl+Shift+Z" disabled={!viewer.canRedo.value} onClick={() => redo(viewer)} />
        <Tool icon="home" label={t('Reset')} shows="below" hint={t('Back to the scene’s own camera')} keys="R" onClick={() => viewer.reset()} />
        <Tool icon="walk" label={t('Walk')} shows="below" hint={t('Walk through the scene')} keys="M" pressed={viewer.walk.value !== null}
          onClick={() => viewer.toggleWalk()} />
        <Tool icon="lamp" label={t('Light')} shows="below" hint={t('Light mode: a finger, or A Z and X C, turn a light that moves with the camera')} keys="L"
          pressed={viewer.lightMode.value} onClick={() => (viewer.lightMode.value = !viewer.lightMode.value)} />
        <Tool icon="turntable" label={t('Turntable')} shows="below" hint={t('The camera goes round the scene')} keys="T" pressed={viewer.turning.value}
          onClick={() => viewer.toggleTurntable()} />
      </div>
      <div class="quality" role="group" aria-label={t('Quality of the image at rest')}>
        {qualities.map(([quality, name, hint]) => (
          <button key={quality} type="button" aria-pressed={viewer.quality.value === quality} title={t(hint)} onClick={() => viewer.setQuality(quality)}>{t(name)}</button>
        ))}
      </div>
      <div class="tools">
        <Tool icon="link" label={t('Share')} shows="beside" hint={t('Links, a frame, images, animations and a command')} onClick={() => (sharing.value = true)} />
        <Tool icon="download" label="PNG" shows="below" hint={t('Download the image as PNG')} onClick={() => void png()} />
        <Tool icon="fullscreen" label={t('Full screen')} shows="below" onClick={fullscreen} />
        <Tool icon="eye" label={t('Statistics')} shows="below" hint={t('Times and counts of the image')} pressed={hudShown.value} onClick={() => showHud(!hudShown.value)} />
        <Tool icon="help" label={t('Help')} shows="below" hint={t('Keys and a tour')} keys="?" onClick={showHelp} />
        <Tool id="panel-tool" icon="panel" label={t('Panel')} shows="beside" hint={t('Settings, files and source')} pressed={panel.value !== 'none'}
          onClick={() => openPanel(panel.value === 'none' ? 'view' : 'none')} />
      </div>
      {hadHelp.value && <Help />}
      {sharing.value && <ShareDialog viewer={viewer} />}
    </div>
  );
}
