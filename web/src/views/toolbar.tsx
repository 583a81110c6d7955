// What one does with the scene on show.
import type { Viewer } from '../scene/viewer.ts';
import { hudShown, showHud } from './hud.tsx';
import { openPanel, panel } from './viewer_page.tsx';
import { saveBlob } from './save.ts';
import { lazyView } from './lazy.tsx';
import { hadHelp, sharing, showHelp } from './sharing.ts';
import { say, Tool } from './ui.tsx';

const Help = lazyView(() => import('./help_dialog.tsx').then((module) => module.Help), 'the help');
const ShareDialog = lazyView(() => import('./share_dialog.tsx').then((module) => module.ShareDialog), 'the dialog');

const fileName = (viewer: Viewer): string => (viewer.id ?? 'scene').replaceAll('/', '-').slice(0, 60);

export function Toolbar({ viewer }: { viewer: Viewer }) {
  const png = async (): Promise<void> => {
    const blob = await viewer.imageAs('png').catch((fault: unknown) => (viewer.report(fault), null));
    if (blob) saveBlob(blob, `${fileName(viewer)}.png`);
    else say('There is no full picture yet.');
  };
  const fullscreen = (): void => {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void document.querySelector('.view')?.requestFullscreen().catch(() => say('The browser does not allow full screen.'));
  };
  return (
    <div class="toolbar" role="toolbar" aria-label="Scene">
      <div class="tools">
        <Tool icon="undo" label="Undo" short="Undo" keys="Ctrl+Z" disabled={!viewer.canUndo.value} onClick={() => viewer.undo()} />
        <Tool icon="redo" label="Redo" short="Redo" keys="Ctrl+Shift+Z" disabled={!viewer.canRedo.value} onClick={() => viewer.redo()} />
        <Tool icon="home" label="Reset the view" short="Reset" keys="R" onClick={() => viewer.reset()} />
        <Tool icon="walk" label="Walk" short="Walk" keys="M" pressed={viewer.walk.value !== null} onClick={() => viewer.toggleWalk()} />
        <Tool icon="lamp" label="Light mode: A Z and X C turn the camera's light" short="Light" keys="L" pressed={viewer.lightMode.value}
          onClick={() => (viewer.lightMode.value = !viewer.lightMode.value)} />
        <Tool icon="turntable" label="Turntable" short="Turntable" keys="T" pressed={viewer.turning.value} onClick={() => viewer.toggleTurntable()} />
      </div>
      <div class="quality" role="group" aria-label="Quality of the picture at rest">
        {(['fast', 'standard', 'reference'] as const).map((quality) => (
          <button key={quality} type="button" aria-pressed={viewer.quality.value === quality}
            title={quality === 'fast' ? 'One sample a pixel, coarser shapes (O)' : quality === 'reference' ? '16 samples a pixel, finest shapes (P)' : 'As the scene says'}
            onClick={() => viewer.setQuality(quality)}>{quality}</button>
        ))}
      </div>
      <div class="tools">
        <Tool icon="link" label="Share" text="Share" onClick={() => (sharing.value = true)} />
        <Tool icon="download" label="Download PNG" short="PNG" onClick={() => void png()} />
        <Tool icon="fullscreen" label="Full screen" short="Full screen" onClick={fullscreen} />
        <Tool icon="eye" label="Times and counts" short="Numbers" pressed={hudShown.value} onClick={() => showHud(!hudShown.value)} />
        <Tool icon="help" label="Keys and a tour" keys="?" short="Help" onClick={showHelp} />
        <Tool icon="panel" label="Panel" pressed={panel.value !== 'none'} text="Panel"
          onClick={() => openPanel(panel.value === 'none' ? 'view' : 'none')} />
      </div>
      {hadHelp.value && <Help />}
      {sharing.value && <ShareDialog viewer={viewer} />}
    </div>
  );
}
