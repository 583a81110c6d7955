// The scene's XML beside the picture.
import { effect } from '@preact/signals';
import { useEffect, useRef, useState } from 'preact/hooks';
import { findingsOf, sentence } from '../api.ts';
import { createEditor, type Editor as CodeEditor } from '../editor/codemirror.ts';
import type { Viewer } from '../scene/viewer.ts';
import { storeEdited } from '../scene/store_edited.ts';
import { entryAround, entryAt, kindOf } from '../scene/tree.ts';
import { parseXml } from '../scene/xml.ts';
import { pressable, say, Tool } from './ui.tsx';
import { compareAddress } from '../router.ts';
import { panel } from './viewer_page.tsx';
import { saveBlob } from './save.ts';
import { t } from '../words.ts';
import { recall, remember } from '../storage.ts';
import { ReferencePanel } from './reference_panel.tsx';

export function Editor({ viewer }: { viewer: Viewer }) {
  const host = useRef<HTMLDivElement>(null);
  const [problem, setProblem] = useState('');
  const [storing, setStoring] = useState(false);
  const [cursor, setCursor] = useState(0), [hasReference, setReference] = useState(() => recall('reference') !== 'off' && matchMedia('(min-width: 60rem)').matches);
  const toggleReference = (): void => {
    remember('reference', hasReference ? 'off' : 'on');
    setReference(!hasReference);
  };
  const ready = viewer.text.value !== null;
  useEffect(() => {
    viewer.loadText().catch((fault: unknown) => setProblem(findingsOf(fault).map((one) => sentence(one)).join(' ')));
  }, [viewer]);
  useEffect(() => {
    if (!ready) return;
    const editor: CodeEditor = createEditor(host.current as HTMLDivElement, viewer.text.peek() ?? '', (text) => viewer.edit(text, 'typing'), () => {
      setCursor(editor.cursor());
      const around = entryAround(parseXml(viewer.text.peek() ?? ''), editor.cursor());
      viewer.selected.value = around && kindOf(around) !== 'scene' ? around.start : null;
    });
    const stops = [
      effect(() => editor.setText(viewer.text.value ?? '')),
      effect(() => editor.setFindings(viewer.findings.value.filter((one) => viewer.isOfDocument(one)))),
      effect(() => {
        const at = viewer.selected.value;
        // After the panel has its size, and the text is there: it may change in the same step.
        if (at !== null && panel.value === 'xml') requestAnimationFrame(() => {
          const roots = parseXml(viewer.text.peek() ?? ''), element = entryAt(roots, viewer.selected.peek());
          if (element && entryAround(roots, editor.cursor()) !== element) editor.select(element.start, element.openEnd);
          if (element) setCursor(element.start + 1);
        });
      }),
      effect(() => {
        const place = viewer.reveal.value;
        if (!place) return;
        viewer.reveal.value = null;
        // After the panel has its size: a place cannot be scrolled to before.
        requestAnimationFrame(() => editor.reveal(place.line, place.column));
      }),
    ];
    return () => {
      stops.forEach((stop) => stop());
      editor.destroy();
    };
  }, [viewer, ready]);
  const store = async (): Promise<void> => {
    setStoring(true);
    const why = await storeEdited(viewer);
    setStoring(false);
    if (why) say(t('Not stored. {why}', { why }));
  };
  const save = (): void => saveBlob(new Blob([viewer.written()], { type: 'application/xml' }), 'scene.xml');
  return (
    <div class="editor">
      {problem && <p class="problem" role="alert">{problem}</p>}
      {!ready && !problem && <p class="note">{t('Loading…')}</p>}
      <div class="code" ref={host} />
      {hasReference && ready && <ReferencePanel text={viewer.text.value ?? ''} at={cursor} />}
      <div class="editor-foot">
        <span class="note" role="status">{viewer.edited.value ? t('Edited; kept in this browser.') : t('As on the server.')}</span>
        <span class="space" />
        {viewer.edited.value && viewer.id !== null && <a href={compareAddress(viewer.id, `draft:${viewer.id}`)}>{t('Compare')}</a>}
        {viewer.edited.value && <button type="button" class="link" onClick={() => viewer.discardEdits()}>{t('Discard')}</button>}
        <Tool icon="help" shows="beside" label={t('Reference')} hint={t('The scene language: the element at the cursor')} pressed={hasReference} onClick={toggleReference} />
        <Tool icon="download" label={t('Download the XML')} onClick={save} />
        <button type="button" class="button small" {...pressable(!storing && ready, () => void store())}>
          {storing ? t('Storing…') : t('Store and share')}
        </button>
      </div>
    </div>
  );
}
