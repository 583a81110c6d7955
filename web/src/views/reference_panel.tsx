// The language's reference beside the editor: the element at the cursor, from the service's own tables.
import tables from 'document:schema';
import { useEffect, useState } from 'preact/hooks';
import { schemaOf } from '../../derive/schema.ts';
import { parseXml, walkXml, type XmlElement } from '../scene/xml.ts';
import { t } from '../words.ts';

const { elements } = schemaOf(tables);
const names = elements.map(({ name }) => name);
const entryOf = (name: string) => elements.find((entry) => entry.name === name) ?? elements.find((entry) => entry.name.toLowerCase() === name.toLowerCase());

/** The innermost element around a place of the text, and the attribute that the place is in. */
export function wordsAt(text: string, at: number): { element: string; attribute: string } | null {
  let inner: XmlElement | null = null;
  for (const element of walkXml(parseXml(text))) if (element.start < at && at < element.end) inner = element;
  if (!inner) return null;
  return { element: inner.name, attribute: inner.attributes.find(({ start, end }) => start <= at && at <= end)?.name ?? '' };
}

/** `at`: the cursor's place in the text. What is chosen here stays until the cursor is in another element. */
export function ReferencePanel({ text, at }: { text: string; at: number }) {
  const here = wordsAt(text, at), [chosen, choose] = useState('');
  useEffect(() => choose(''), [here?.element]);
  const name = chosen || here?.element || 'world', entry = entryOf(name);
  return (
    <section class="reference" aria-label={t('Reference')}>
      <label class="field">
        <span>{t('Element')}</span>
        <select value={entry?.name ?? ''} onChange={(event) => choose(event.currentTarget.value)}>
          {!entry && <option value="" selected>{name}</option>}
          {names.map((one) => <option key={one} value={one} selected={one === entry?.name}>{one}</option>)}
        </select>
      </label>
      {!entry && <p class="note">{t('The scene language has no element “{name}”.', { name })}</p>}
      {entry && (
        <div lang="en">
          {entry.help && <p>{entry.help}</p>}
          {entry.attributes.length > 0 && (
            <dl>
              {entry.attributes.map((attribute) => (
                <div key={attribute.name} class={!chosen && attribute.name.toLowerCase() === here?.attribute.toLowerCase() ? 'here' : ''}>
                  <dt>{attribute.name}</dt><dd>{attribute.help}</dd>
                </div>
              ))}
            </dl>
          )}
          {entry.children.length > 0 && (
            <p class="children">
              <span lang={document.documentElement.lang}>{t('In it:')}</span>{' '}
              {entry.children.map((child) => <button key={child} type="button" class="link" onClick={() => choose(entryOf(child)?.name ?? child)}>{child}</button>)}
            </p>
          )}
        </div>
      )}
    </section>
  );
}
