// A scene alone, for a frame of another page: its image with orbit and time, and a way to the whole page.
import { useEffect, useMemo } from 'preact/hooks';
import { scenePath } from '../api.ts';
import { parseView, scenePlace } from '../router.ts';
import { newScene } from '../scene/template.ts';
import { Viewer } from '../scene/viewer.ts';
import { GonePage } from './gone.tsx';
import { Stage } from './stage.tsx';
import { StageState } from './stage_state.tsx';
import { TimeBar } from './time_bar.tsx';

const nothing = (): void => undefined;

export function EmbedPage({ id, view }: { id: string; view: URLSearchParams }) {
  const viewer = useMemo(() => new Viewer(id, null, { isRemembered: false }), [id]);
  useEffect(() => {
    void viewer.open(parseView(view), newScene);
    return () => viewer.close();
  }, [viewer]);
  const title = viewer.title.value;
  useEffect(() => {
    document.title = `${title} · Farol`;
  }, [title]);
  if (viewer.state.value === 'gone' && !viewer.pictured.value) return <GonePage id={id} />;
  return (
    <main class="viewer embed" id="main">
      <div class="view">
        <div class={`stage-area is-${viewer.state.value}`}>
          <Stage viewer={viewer} preview={view.toString() === '' ? `${scenePath(id)}/thumbnail` : ''} actions={{ pick: nothing, light: nothing }} />
          <div class="stage-notes"><StageState viewer={viewer} onPick={nothing} /></div>
          <a class="embed-link" href={`./${scenePlace(id)}`} target="_blank" rel="noopener"
            onClick={(event) => (event.currentTarget.href = `./${viewer.link()}`)}>{title}</a>
        </div>
        <TimeBar viewer={viewer} isPlain />
      </div>
    </main>
  );
}
