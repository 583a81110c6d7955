// What one does with the scene on show.
import { signal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { curlOf } from '../scene/curl.ts';
import type { Viewer } from '../scene/viewer.ts';
import { helpKeys } from './help.ts';
import { hudShown, showHud } from './hud.tsx';
import { openPanel, panel } from './viewer_page.tsx';
import { saveBlob } from './save.ts';
import { copy, say, Tool } from './ui.tsx';

const helpShown = signal(false);

const fileName = (viewer: Viewer): string => (viewer.id ?? 'scene').replaceAll('/', '-').slice(0, 60);

export function Help() {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    if (helpShown.value) dialog.current?.showModal();
    else dialog.current?.close();
  }, [helpShown.value]);
  return (
    <dialog ref={dialog} class="help" aria-labelledby="help-title" onClose={() => (helpShown.value = false)}>
      <h2 id="help-title">Moving about</h2>
      <dl>
        {helpKeys.map(([keys, text]) => (
          <div key={keys}><dt>{keys.split(' ').map((key) => <kbd key={key}>{key}</kbd>)}</dt><dd>{text}</dd></div>
        ))}
      </dl>
      <button type="button" class="button" onClick={() => (helpShown.value = false)}>Close</button>
    </dialog>
  );
}

export function Toolbar({ viewer }: { viewer: Viewer }) {
  const share = (): void => {
    if (viewer.edited.value) say('The link shows the scene as it is stored, without your edits.');
    void copy(location.href.replace(/#.*$/, '') + viewer.link(), 'Link');
  };
  const png = async (): Promise<void> => {
    const blob = await viewer.exactImage().catch((fault: unknown) => (viewer.report(fault), null));
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
        <Tool icon="undo" label="Undo" keys="Ctrl+Z" disabled={!viewer.canUndo.value} onClick={() => viewer.undo()} />
        <Tool icon="redo" label="Redo" keys="Ctrl+Shift+Z" disabled={!viewer.canRedo.value} onClick={() => viewer.redo()} />
        <Tool icon="home" label="Reset the view" keys="R" onClick={() => viewer.reset()} />
        <Tool icon="walk" label="Walk" keys="M" pressed={viewer.walk.value !== null} onClick={() => viewer.toggleWalk()} />
        <Tool icon="lamp" label="Light mode: A Z and X C turn the camera's light" keys="L" pressed={viewer.lightMode.value}
          onClick={() => (viewer.lightMode.value = !viewer.lightMode.value)} />
        <Tool icon="turntable" label="Turntable" keys="T" pressed={viewer.turning.value} onClick={() => viewer.toggleTurntable()} />
      </div>
      <div class="quality" role="group" aria-label="Quality of the picture at rest">
        {(['fast', 'standard', 'reference'] as const).map((quality) => (
          <button key={quality} type="button" aria-pressed={viewer.quality.value === quality}
            title={quality === 'fast' ? 'One sample a pixel, coarser shapes (O)' : quality === 'reference' ? '16 samples a pixel, finest shapes (P)' : 'As the scene says'}
            onClick={() => viewer.setQuality(quality)}>{quality}</button>
        ))}
      </div>
      <div class="tools">
        <Tool icon="link" label="Copy a link to this view" onClick={share} />
        <Tool icon="terminal" label="Copy as curl" onClick={() => void copy(curlOf(viewer), 'Command')} />
        <Tool icon="download" label="Download PNG" onClick={() => void png()} />
        <Tool icon="fullscreen" label="Full screen" onClick={fullscreen} />
        <Tool icon="eye" label="Times and counts" pressed={hudShown.value} onClick={() => showHud(!hudShown.value)} />
        <Tool icon="help" label="Keys" onClick={() => (helpShown.value = true)} />
        <Tool icon="panel" label="Panel" pressed={panel.value !== 'none'} text="Panel"
          onClick={() => openPanel(panel.value === 'none' ? 'view' : 'none')} />
      </div>
      <Help />
    </div>
  );
}
