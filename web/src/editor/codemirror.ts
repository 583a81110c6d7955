// CodeMirror for scenes. It lives in a shadow root: there it adds its styles as constructed style
// sheets, which the page's content security policy allows and <style> elements it does not.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from '@codemirror/autocomplete';
import { defaultKeymap, indentWithTab } from '@codemirror/commands';
import { xml } from '@codemirror/lang-xml';
import {
  bracketMatching, defaultHighlightStyle, foldGutter, foldKeymap, HighlightStyle, indentOnInput, indentUnit, syntaxHighlighting,
} from '@codemirror/language';
import { lintGutter, lintKeymap, setDiagnostics, type Diagnostic } from '@codemirror/lint';
import { highlightSelectionMatches, searchKeymap } from '@codemirror/search';
import { EditorSelection, EditorState, Prec } from '@codemirror/state';
import {
  drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, highlightSpecialChars, keymap, lineNumbers,
} from '@codemirror/view';
import { tags } from '@lezer/highlight';
import catalogue from 'document:errors';
import tables from 'document:schema';
import { schemaOf } from '../../derive/schema.ts';
import { sentence, type Finding } from '../api.ts';
import { cureOf, setCatalogue } from '../cures.ts';
import { t } from '../words.ts';
import { changeBetween, indexOfColumn, wordLength } from './places.ts';

const tabLeavesMs = 5000;

const theme = EditorView.theme({
  '&': { height: '100%', color: 'var(--ink)', backgroundColor: 'transparent', fontSize: '.84rem' },
  '&.cm-focused': { outline: 'none' },
  '.cm-scroller': { fontFamily: 'var(--mono)', lineHeight: '1.5' },
  '.cm-gutters': { backgroundColor: 'transparent', color: 'var(--soft)', border: 'none' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'color-mix(in srgb, var(--accent) 9%, transparent)' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)' },
  '&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground': {
    backgroundColor: 'color-mix(in srgb, var(--accent) 28%, transparent)',
  },
  '.cm-tooltip': { backgroundColor: 'var(--raised)', color: 'var(--ink)', border: '1px solid var(--line-strong)', borderRadius: '.4rem', maxWidth: '34rem' },
  '.cm-tooltip .cm-completionInfo': { maxWidth: '22rem' },
  '.cm-tooltip-autocomplete ul li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--on-accent)' },
  '.cm-diagnostic': { whiteSpace: 'pre-wrap', fontFamily: 'inherit' },
  '.cm-panels': { backgroundColor: 'var(--raised)', color: 'var(--ink)' },
  '.cm-searchMatch': { backgroundColor: 'color-mix(in srgb, var(--lamp) 40%, transparent)' },
});

const colors = HighlightStyle.define([
  { tag: tags.tagName, color: 'var(--accent)', fontWeight: '600' },
  { tag: tags.angleBracket, color: 'var(--soft)' },
  { tag: tags.attributeName, color: 'var(--ink)' },
  { tag: tags.attributeValue, color: 'var(--code-value)' },
  { tag: tags.comment, color: 'var(--soft)', fontStyle: 'italic' },
  { tag: tags.processingInstruction, color: 'var(--soft)' },
]);

setCatalogue(catalogue);

const language = xml({
  elements: schemaOf(tables).elements.map((element) => ({
    name: element.name, children: element.children, ...(element.top ? { top: true } : {}),
    attributes: element.attributes.map((attribute, index) => ({
      name: attribute.name, ...(attribute.values ? { values: attribute.values } : {}),
      completion: { boost: attribute.help ? 50 - index : -50, ...(attribute.help ? { info: attribute.help } : {}) },
    })),
    ...(element.help ? { completion: { info: element.help } } : {}),
  })),
});

export interface Editor {
  setText(text: string): void;
  setFindings(findings: readonly Finding[]): void;
  /** Selects from there to the end of the line, and shows it. */
  reveal(line: number, column: number): void;
  /** Selects a range and shows it; the focus stays where it is. */
  select(from: number, to: number): void;
  /** The index of the cursor in the text. */
  cursor(): number;
  destroy(): void;
}

/** `moved`: the user or `reveal` put the cursor elsewhere. Undo and redo are the page's (scene/history.ts): its keys are not bound here. */
export function createEditor(host: HTMLElement, text: string, changed: (text: string) => void, moved: () => void): Editor {
  const root = host.shadowRoot ?? host.attachShadow({ mode: 'open' });
  let outside = false; // the change comes from elsewhere: it is not told again
  const view = new EditorView({
    root,
    state: EditorState.create({
      doc: text,
      extensions: [
        // Whatever else it does, Escape lets the next Tab leave: before the completion, which takes it.
        Prec.highest(keymap.of([{ key: 'Escape', run: (editor) => (editor.setTabFocusMode(tabLeavesMs), false) }])),
        lineNumbers(), foldGutter(), lintGutter(), highlightSpecialChars(), drawSelection(), indentOnInput(), bracketMatching(),
        closeBrackets(), autocompletion({ icons: false }), highlightActiveLine(), highlightActiveLineGutter(), highlightSelectionMatches(),
        indentUnit.of('    '), EditorState.tabSize.of(4), EditorView.lineWrapping,
        syntaxHighlighting(colors), syntaxHighlighting(defaultHighlightStyle, { fallback: true }), language, theme,
        EditorView.contentAttributes.of({ 'aria-label': t('XML of the scene. Tab indents; Escape, then Tab, goes on.'), spellcheck: 'false', tabindex: '0' }),
        keymap.of([...closeBracketsKeymap, ...defaultKeymap, ...searchKeymap, ...foldKeymap, ...completionKeymap, ...lintKeymap, indentWithTab]),
        EditorView.updateListener.of((update) => {
          if (update.docChanged && !outside) changed(update.state.doc.toString());
          if (update.selectionSet && !outside) moved();
        }),
      ],
    }),
  });
  root.append(view.dom);
  const diagnosticOf = (finding: Finding): Diagnostic | null => {
    const { doc } = view.state;
    if (!finding.line || finding.line > doc.lines) return null;
    const line = doc.line(finding.line), index = indexOfColumn(line.text, finding.column ?? 1);
    const from = Math.min(line.from + index, line.to), cure = cureOf(finding.code);
    return {
      from, to: Math.min(line.to, from + wordLength(line.text, index)), severity: finding.severity, source: finding.code,
      message: [sentence(finding, false), cure].filter(Boolean).join('\n'),
    };
  };
  return {
    setText(next) {
      const before = view.state.doc.toString();
      if (next === before) return;
      outside = true;
      const change = changeBetween(before, next);
      view.dispatch({
        changes: change,
        // Whoever works in the editor sees what an undo brought back.
        ...(view.hasFocus ? { selection: { anchor: change.from + change.insert.length }, scrollIntoView: true } : {}),
      });
      outside = false;
    },
    setFindings(findings) {
      const found = findings.map(diagnosticOf).filter((one) => one !== null);
      found.sort((a, b) => a.from - b.from);
      view.dispatch(setDiagnostics(view.state, found));
    },
    reveal(number, column) {
      const line = view.state.doc.line(Math.min(Math.max(1, number), view.state.doc.lines));
      const from = Math.min(line.to, line.from + indexOfColumn(line.text, column));
      view.dispatch({
        selection: EditorSelection.range(from === line.from ? line.from + (/^\s*/.exec(line.text)?.[0].length ?? 0) : from, line.to),
        effects: EditorView.scrollIntoView(from, { y: 'center' }),
      });
      view.focus();
    },
    select(from, to) {
      outside = true;
      view.dispatch({ selection: EditorSelection.range(to, from), effects: EditorView.scrollIntoView(from, { y: 'center' }) });
      outside = false;
    },
    cursor: () => view.state.selection.main.head,
    destroy: () => view.destroy(),
  };
}
